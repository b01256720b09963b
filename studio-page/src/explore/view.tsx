/** Explore: random shapes of the procedure, or shapes along one or two parameters, and whether they are sound. */

import { useEffect } from "preact/hooks";
import { useKeys } from "../state/keys";
import { go, route } from "../state/route";
import { procedure } from "../state/studio";
import { Button, Empty } from "../ui/controls";
import { Grid } from "./grid";
import { Locks } from "./locks";
import { LoneShape } from "./lone";
import {
  asked,
  change,
  faults,
  planned,
  problem,
  reroll,
  rollBack,
  seeds,
  shapes,
  startExploring,
  vary,
} from "./shapes";

export function ExploreView() {
  useEffect(startExploring, []);
  const { rest } = route.value;
  if (procedure.value.parameters.length === 0) {
    return (
      <Empty title="Nothing to explore yet">
        <p>Random shapes of the procedure appear here as soon as it can be read and has parameters.</p>
      </Empty>
    );
  }
  if (rest !== null) return <LoneShape index={Number(rest)} />;
  return (
    <div class="explore">
      <ExploreKeys />
      <div class="main">
        <Bar />
        {problem.value && <p class="failure">{problem.value.message}</p>}
        <Grid />
      </div>
      <aside aria-label="Parameters that stay, and that vary">
        <Locks />
      </aside>
    </div>
  );
}

function ExploreKeys() {
  useKeys("Explore", [
    { keys: ["r"], does: "re-roll", run: reroll },
    { keys: ["b"], does: "the seed before", run: rollBack },
    { keys: ["Escape"], does: "back to the collection", run: () => go("collection") },
  ]);
  return null;
}

function Bar() {
  const varies = vary.value.length > 0;
  return (
    <div class="toolbar">
      <Button icon="dice" kind="primary" title="Other random shapes (r)" onClick={reroll}>
        Re-roll
      </Button>
      <label class="field" title="The same seed gives the same shapes">
        <span>Seed</span>
        <input
          type="number"
          min={0}
          step={1}
          aria-label="Seed"
          disabled={varies}
          value={asked.value.seed}
          onChange={(event) => {
            const seed = event.currentTarget.valueAsNumber;
            if (Number.isSafeInteger(seed) && seed >= 0) change({ seed });
            else event.currentTarget.value = `${asked.value.seed}`;
          }}
        />
      </label>
      <Button
        icon="undo"
        kind="quiet"
        disabled={!seeds.value.length}
        title="Back to the seed before (b)"
        onClick={rollBack}
      />
      <p class="grow" role="status" data-soundness>
        {said()}
      </p>
    </div>
  );
}

/** How many shapes there are, and what is wrong with how many. */
function said(): string {
  const built = [...shapes.value.values()];
  const failed = built.filter((one) => one.problem !== null).length;
  const examined = built.flatMap(({ soundness }) => (soundness ? [soundness] : []));
  const unsound = examined.filter((one) => !one.sound);
  const kinds = new Map<string, number>();
  for (const one of unsound)
    for (const fault of faults(one)) {
      const kind = fault.replace(/^\d+ /, "").replace(/s$/, "");
      kinds.set(kind, (kinds.get(kind) ?? 0) + 1);
    }
  const told = [...kinds].map(([kind, count]) => `${count} ${kind}`).join(", ");
  const missing = planned.value.length - built.length;
  const parts = [
    missing > 0 && !problem.value ? `${built.length} of ${planned.value.length} shapes` : `${built.length} shapes`,
    ...(examined.length ? [unsound.length ? `${unsound.length} not sound: ${told}` : "all sound"] : []),
    ...(failed ? [`${failed} failed`] : []),
  ];
  return parts.join(" · ");
}
