/** What was written between two iterations; long stretches that stayed are left out. */

import { useSignal } from "@preact/signals";
import { Button } from "../ui/controls";
import { Lines } from "../ui/lines";
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
      <Lines lines={whole.value ? lines : near(lines)} />
    </section>
  );
}

/** Changed lines and those around them. */
function near(lines: DiffLine[]): DiffLine[] {
  const kept = new Set(
    lines.flatMap(({ kind }, i) =>
      kind === "same" ? [] : Array.from({ length: 2 * CONTEXT + 1 }, (_, k) => i - CONTEXT + k),
    ),
  );
  return lines.filter((_, i) => kept.has(i));
}
