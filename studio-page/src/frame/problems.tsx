/** What is wrong with the project, in one line that opens. */

import { useSignal } from "@preact/signals";
import { openEditorAt } from "../loop/editing";
import { go, inspect } from "../state/route";
import { collection, problems, procedure, tiles } from "../state/studio";
import { Button } from "../ui/controls";
import { Icon } from "../ui/icons";
import { plural } from "../ui/numbers";
import type { Problem } from "../wire/messages";

export function Problems() {
  const open = useSignal(false);
  const [first, ...others] = problems.value;
  if (!first) return null;
  const shown = open.value ? problems.value : [first];
  return (
    <section class="problems" role="alert">
      {shown.map((problem, i) => (
        <ProblemLine key={i} problem={problem} />
      ))}
      {procedure.value.state === "broken" && collection.value.run !== null && (
        <p class="soft">Shown is what the last version that worked could do.</p>
      )}
      {others.length > 0 && (
        <Button kind="quiet" onClick={() => (open.value = !open.value)}>
          {open.value ? "Only the first" : `${plural(others.length, "further problem")}`}
        </Button>
      )}
    </section>
  );
}

export function ProblemLine({ problem }: { problem: Problem }) {
  const { file, line, text, message, count, slugs } = problem;
  const show = () => {
    go("loop");
    openEditorAt(line ?? 1, file ?? "");
  };
  return (
    <div class="problem">
      <Icon name="warn" />
      <div>
        <p>
          <b>{message}</b>
          {count !== null && count > 0 && <span class="soft"> · {plural(count, "shape")}</span>}
          {slugs.slice(0, 4).map((slug) => (
            <button key={slug} type="button" class="link" onClick={() => inspect(slug)}>
              {tiles.value.get(slug)?.name ?? slug}
            </button>
          ))}
        </p>
        {file && (
          <p>
            <button type="button" class="link mono" onClick={show}>
              {file}
              {line !== null && `:${line}`}
            </button>
            {text && <code>{text.trim()}</code>}
          </p>
        )}
      </div>
    </div>
  );
}
