/** How a fit runs. */

import { change } from "../state/actions";
import { settings } from "../state/studio";
import { Select, Toggle } from "../ui/controls";
import type { ChosenSettings as Values } from "../wire/messages";
import { PRESETS, SETTINGS } from "../wire/messages/settings";

type Numeric = { [K in keyof Values]: Values[K] extends number ? K : never }[keyof Values];

const NUMBERS: [name: Numeric, label: string][] = [
  ["samples", "Samples"],
  ["epochs", "Epochs"],
  ["rounds", "Adaptive rounds"],
  ["seed", "Seed"],
  ["threshold", "Threshold"],
  ["shape_seconds", "Seconds a shape"],
];

const options = <T extends string>(values: readonly T[]) => values.map((value) => ({ value, label: value }));

export function Settings() {
  const now = settings.value;
  if (!now) return null;
  return (
    <div class="settings">
      <Toggle label="Fit after every save" on={now.auto_fit} onChange={(auto_fit) => void change({ auto_fit })} />
      <Toggle
        label="Start afresh"
        title="Learn anew, and do not resume the run before"
        on={now.fresh}
        onChange={(fresh) => void change({ fresh })}
      />
      <Select
        label="Preset"
        options={options(PRESETS)}
        value={now.preset}
        onChange={(preset) => void change({ preset })}
      />
      <Select
        label="Search"
        options={options(SETTINGS.refine.choices)}
        value={now.refine}
        onChange={(refine) => void change({ refine })}
      />
      {NUMBERS.map(([name, label]) => (
        <label key={name} class="field" title={SETTINGS[name].help}>
          <span>{label}</span>
          <input
            type="number"
            min={SETTINGS[name].least}
            max={SETTINGS[name].most ?? undefined}
            step={SETTINGS[name].step}
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
