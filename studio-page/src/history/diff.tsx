/** What was written between two iterations; long stretches that stayed are folded. */

import { useSignal } from "@preact/signals";
import { Button } from "../ui/controls";
import type { DiffLine } from "../wire/messages";

const CONTEXT = 3;

export function Diff({ lines }: { lines: DiffLine[] }) {
  const whole = useSignal(false);
  const added = lines.filter(({ kind }) => kind === "added").length;
  const removed = lines.filter(({ kind }) => kind === "removed").length;
  if (!added && !removed) return <p class="soft">The procedure is the same in both.</p>;
  return (
    <section class="diff">
      <header>
        <h2>
          Procedure <small class="good">+{added}</small> <small class="bad">−{removed}</small>
        </h2>
        <Button kind="quiet" onClick={() => (whole.value = !whole.value)}>
          {whole.value ? "Only what changed" : "Whole file"}
        </Button>
      </header>
      <table>
        <tbody>
          {(whole.value ? lines : near(lines)).map((line, i) =>
            line === null ? (
              <tr key={i} class="gap">
                <td colSpan={4}>⋯</td>
              </tr>
            ) : (
              <tr key={i} class={line.kind}>
                <td class="n">{line.before}</td>
                <td class="n">{line.after}</td>
                <td class="sign">{{ same: "", added: "+", removed: "−" }[line.kind]}</td>
                <td class="text">{line.text}</td>
              </tr>
            ),
          )}
        </tbody>
      </table>
    </section>
  );
}

/** Changed lines and those around them; null where lines are left out. */
function near(lines: DiffLine[]): (DiffLine | null)[] {
  const kept = new Set(
    lines.flatMap(({ kind }, i) =>
      kind === "same" ? [] : Array.from({ length: 2 * CONTEXT + 1 }, (_, k) => i - CONTEXT + k),
    ),
  );
  const shown: (DiffLine | null)[] = [];
  lines.forEach((line, i) => {
    if (kept.has(i)) shown.push(line);
    else if (shown.at(-1) !== null) shown.push(null);
  });
  return shown;
}
