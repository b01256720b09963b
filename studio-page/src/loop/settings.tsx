/** How a fit runs. */

import { change } from "../state/actions";
import { settings } from "../state/studio";
import { Select, Toggle } from "../ui/controls";
import type { ChosenSettings as Values } from "../wire/messages";

type Numeric = { [K in keyof Values]: Values[K] extends number ? K : never }[keyof Values];

const NUMBERS: { name: Numeric; label: string; title: string; whole: boolean }[] = [
  { name: "samples", label: "Samples", title: "Parameter vectors drawn to learn from", whole: true },
  { name: "epochs", label: "Epochs", title: "Passes of training over the samples", whole: true },
  { name: "rounds", label: "Adaptive rounds", title: "Rounds of further samples around what was found", whole: true },
  { name: "seed", label: "Seed", title: "Of everything random", whole: true },
  { name: "threshold", label: "Threshold", title: "The largest distance of a compatible reference", whole: false },
  { name: "shape_seconds", label: "Seconds a shape", title: "How long building one shape may take", whole: false },
];

const options = <T extends string>(...values: T[]) => values.map((value) => ({ value, label: value }));

export function Settings() {
  const now = settings.value;
  if (!now) return null;
  return (
    <div class="settings">
      <Toggle label="Fit after every save" on={now.auto_fit} onChange={(auto_fit) => void change({ auto_fit })} />
      <Toggle
        label="Start afresh"
        title="Learn anew, instead of going on from the run before"
        on={now.fresh}
        onChange={(fresh) => void change({ fresh })}
      />
      <Select
        label="Preset"
        options={options<Values["preset"]>("fast", "paper")}
        value={now.preset}
        onChange={(preset) => void change({ preset })}
      />
      <Select
        label="Search"
        options={options<Values["refine"]>("off", "quick", "thorough")}
        value={now.refine}
        onChange={(refine) => void change({ refine })}
      />
      {NUMBERS.map(({ name, label, title, whole }) => (
        <label key={name} class="field" title={title}>
          <span>{label}</span>
          <input
            type="number"
            step={whole ? 1 : "any"}
            value={now[name]}
            onChange={(event) => {
              const value = event.currentTarget.valueAsNumber;
              if (Number.isFinite(value)) void change({ [name]: value });
            }}
          />
        </label>
      ))}
    </div>
  );
}
