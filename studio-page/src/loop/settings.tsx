/** How a fit runs. */

import { change } from "../state/actions";
import { notifying, switchNotifying } from "../state/notifying";
import { dimension, settings } from "../state/studio";
import { Select, Toggle } from "../ui/controls";
import { significant } from "../ui/numbers";
import type { ChosenSettings as Values } from "../wire/messages";
import { PRESETS, SETTINGS } from "../wire/messages/settings";

type Numeric = { [K in keyof Values]: Values[K] extends number ? K : never }[keyof Values];

const NUMBERS: [name: Numeric, label: string, shown?: (now: Values) => boolean][] = [
  ["samples", "Samples"],
  ["epochs", "Epochs"],
  ["rounds", "Adaptive rounds"],
  ["seed", "Seed"],
  ["replicated", "Replicated from", ({ judge }) => judge === "fidelity"],
  ["close", "Close from", ({ judge }) => judge === "fidelity"],
  ["threshold", "Paper's threshold", () => dimension.value === 3],
  ["vif", "Paper's least VIF", () => dimension.value === 2],
  ["shape_seconds", "Seconds a shape"],
];

const CHOICES = [
  ["refine", "Search"],
  ["facing", "Facing"],
  ["judge", "Judge"],
] as const;

const WORDS = [
  ["drop", "Drop"],
  ["leave_out", "Leave out"],
] as const;

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
      <Toggle
        label="Note when done"
        title="A note of the browser at the end of a fit, an explanation or an export; the browser asks once"
        on={notifying.value}
        onChange={(on) => void switchNotifying(on)}
      />
      <Select
        label="Preset"
        options={options(PRESETS)}
        value={now.preset}
        onChange={(preset) => void change({ preset })}
      />
      {CHOICES.map(([name, label]) => (
        <Select
          key={name}
          label={label}
          title={SETTINGS[name].help}
          options={options<string>(SETTINGS[name].choices)}
          value={now[name]}
          onChange={(value) => void change({ [name]: value })}
        />
      ))}
      <Select
        label="Colours"
        title="Of grades: from purple to yellow, as everybody can read them, or the paper's red to green"
        options={[
          { value: "clear", label: "clear to all" },
          { value: "paper", label: "green to red" },
        ]}
        value={now.scale}
        onChange={(scale) => void change({ scale })}
      />
      {NUMBERS.filter(([, , shown]) => !shown || shown(now)).map(([name, label]) => (
        <label key={name} class="field" title={SETTINGS[name].help}>
          <span>{label}</span>
          <input
            type="number"
            min={SETTINGS[name].least}
            max={SETTINGS[name].most ?? undefined}
            step={SETTINGS[name].step}
            value={significant(now[name])}
            onChange={(event) => {
              const value = event.currentTarget.valueAsNumber;
              if (Number.isFinite(value)) void change({ [name]: value });
            }}
          />
        </label>
      ))}
      {WORDS.map(([name, label]) => (
        <label key={name} class="field" title={SETTINGS[name].help}>
          <span>{label}</span>
          <input
            type="text"
            value={now[name]}
            placeholder={name === "leave_out" ? "none" : undefined}
            onChange={(event) => void change({ [name]: event.currentTarget.value })}
          />
        </label>
      ))}
    </div>
  );
}
