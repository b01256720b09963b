/** The page: header, what is wrong, and one view. */

import { useSignalEffect } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { CollectionView } from "../collection/view";
import { ExploreView } from "../explore/view";
import { FeedbackView } from "../feedback/view";
import { HistoryView } from "../history/view";
import { Inspector } from "../inspector/view";
import { startEditing } from "../loop/editing";
import { LoopView } from "../loop/view";
import { ParametersView } from "../parameters/view";
import { asking, Palette } from "../palette/palette";
import { fit } from "../state/actions";
import { useKeys } from "../state/keys";
import { go, route, VIEWS } from "../state/route";
import { collection, connected, fitting, jobs, procedure, project, ready, unsure } from "../state/studio";
import { switchTheme } from "../state/theme";
import { Empty } from "../ui/controls";
import { Header } from "./header";
import { Help, helping } from "./help";
import { DropCover } from "../first/drop";
import { Lost } from "./lost";
import { Notices } from "./notices";
import { ProgressLine } from "./progress";
import { Problems } from "./problems";

const SHOWN = {
  collection: CollectionView,
  loop: LoopView,
  history: HistoryView,
  feedback: FeedbackView,
  explore: ExploreView,
  parameters: ParametersView,
} as const;

export function App() {
  useKeys("Everywhere", [
    { keys: ["?"], does: "these keys", run: () => (helping.value = true) },
    {
      keys: VIEWS.map((_, i) => `${i + 1}`),
      does: "Collection, Loop, History, Feedback, Explore, Parameters",
      run: (event) => go(VIEWS[Number(event.key) - 1]!),
    },
    {
      keys: ["Enter"],
      modified: true,
      does: "fit",
      run: () => {
        if (!fitting.value && procedure.value.state !== "broken") fit();
      },
    },
    { keys: ["k"], modified: true, does: "all commands and references", run: () => (asking.value = !asking.value) },
    { keys: ["d"], does: "dark or light", run: switchTheme },
  ]);
  useSignalEffect(() => {
    document.title = title();
  });
  useEffect(startEditing, []);
  if (!ready.value) {
    return (
      <Empty title={connected.value ? "Opening the project…" : "No connection to the studio's server"}>
        {!connected.value && <Lost />}
      </Empty>
    );
  }
  const View = SHOWN[route.value.view];
  const { slug } = route.value;
  return (
    <>
      <Header />
      <ProgressLine />
      <Lost />
      <Problems />
      <main class={slug ? "covered" : ""}>
        <View />
      </main>
      {slug && <Inspector slug={slug} />}
      <Help />
      <DropCover />
      <Palette />
      <Notices />
    </>
  );
}

/** What the browser's tab says: how the loop stands, even from afar. */
function title(): string {
  const { counts, count, run } = collection.value;
  const name = project.value.name || "shapewright studio";
  if (fitting.value) return `${jobs.fit.value.stages.at(-1)?.name ?? "fit"}… ${name}`;
  if (procedure.value.state === "broken") return `broken: ${name}`;
  return run === null || unsure.value.stale > 0 ? name : `${counts.replicated}/${count} ${name}`;
}
