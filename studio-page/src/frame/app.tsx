/** The page: header, what is wrong, and one view. */

import { CollectionView } from "../collection/view";
import { FeedbackView } from "../feedback/view";
import { HistoryView } from "../history/view";
import { Inspector } from "../inspector/view";
import { LoopView } from "../loop/view";
import { fit } from "../state/actions";
import { useKeys } from "../state/keys";
import { go, route, VIEWS } from "../state/route";
import { connected, fitting, procedure, ready } from "../state/studio";
import { switchTheme } from "../state/theme";
import { Empty } from "../ui/controls";
import { Header, ProgressLine } from "./header";
import { Help, helping } from "./help";
import { Notices } from "./notices";
import { Problems } from "./problems";

const SHOWN = { collection: CollectionView, loop: LoopView, history: HistoryView, feedback: FeedbackView } as const;

export function App() {
  useKeys("Everywhere", [
    { keys: ["?"], does: "these keys", run: () => (helping.value = true) },
    {
      keys: VIEWS.map((_, i) => `${i + 1}`),
      does: "Collection, Loop, History, Feedback",
      run: (event) => go(VIEWS[Number(event.key) - 1]!),
    },
    {
      keys: ["f"],
      does: "fit",
      run: () => {
        if (!fitting.value && procedure.value.state !== "broken") fit();
      },
    },
    { keys: ["d"], does: "dark or light", run: switchTheme },
  ]);
  if (!ready.value) {
    return (
      <Empty title={connected.value ? "Opening the project…" : "No connection to the studio's server"}>
        {!connected.value && <p>Is `shapewright studio` still running? The page connects again by itself.</p>}
      </Empty>
    );
  }
  const View = SHOWN[route.value.view];
  const { slug } = route.value;
  return (
    <>
      <Header />
      <ProgressLine />
      <Problems />
      <main class={slug ? "covered" : ""}>
        <View />
      </main>
      {slug && <Inspector slug={slug} />}
      <Help />
      <Notices />
    </>
  );
}
