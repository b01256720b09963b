/** The control of one parameter, by its kind. */

import { Button, Segments, Select, Toggle } from "../ui/controls";
import type { Parameter, Value } from "../wire/messages";

export interface Control {
  parameter: Parameter;
  value: Value;
  /** As found, as the network said, and about how far off that may be; null where unknown. */
  found: Value | null;
  predicted: Value | null;
  spread: number | null;
  disabled: boolean;
  /** Its Range and the prediction, in words. */
  told: string;
  onChange: (value: Value) => void;
}

const FEW = 4;

export function ControlOf(props: Control) {
  switch (props.parameter.kind) {
    case "scalar":
      return <Slider {...props} />;
    case "integer":
      return <Stepper {...props} />;
    case "binary":
      return (
        <Toggle
          label={props.value ? "yes" : "no"}
          name={props.parameter.name}
          on={Boolean(props.value)}
          onChange={(on) => props.onChange(on)}
        />
      );
    case "choice":
      return <Choice {...props} />;
  }
}

function Slider({ parameter, value, found, predicted, spread, disabled, told, onChange }: Control) {
  const low = parameter.low ?? 0;
  const high = parameter.high ?? 1;
  const share = (at: Value | null) => Math.min(1, Math.max(0, (Number(at) - low) / (high - low || 1)));
  const percent = (at: number) => `${(100 * at).toFixed(2)}%`;
  const band =
    predicted !== null && spread !== null
      ? { left: share(Number(predicted) - spread), right: share(Number(predicted) + spread) }
      : null;
  return (
    <div class="slider" title={told}>
      <div class="rail">
        <div class="track" aria-hidden="true">
          {band && <i class="spread" style={{ left: percent(band.left), width: percent(band.right - band.left) }} />}
          <i class="fill" style={{ width: percent(share(value)) }} />
          {predicted !== null && <i class="predicted" style={{ left: percent(share(predicted)) }} />}
          {found !== null && <i class="found" style={{ left: percent(share(found)) }} />}
        </div>
        <input
          type="range"
          aria-label={parameter.name}
          title={parameter.meaning || undefined}
          min={low}
          max={high}
          step={(high - low) / 400}
          value={Number(value)}
          disabled={disabled}
          onInput={(event) => onChange(Math.min(high, Math.max(low, event.currentTarget.valueAsNumber)))}
        />
      </div>
    </div>
  );
}

function Stepper({ parameter, value, disabled, onChange }: Control) {
  const [low, high, now] = [parameter.low ?? 0, parameter.high ?? 0, Number(value)];
  if (high - low < 6) {
    const levels = Array.from({ length: high - low + 1 }, (_, i) => `${low + i}`);
    return (
      <Segments
        label={parameter.name}
        options={levels.map((level) => ({ value: level, label: level, disabled }))}
        value={`${now}`}
        onChange={(level) => onChange(Number(level))}
      />
    );
  }
  return (
    <div class="stepper" role="group" aria-label={parameter.name}>
      <Button disabled={disabled || now <= low} title={`${parameter.name} less`} onClick={() => onChange(now - 1)}>
        −
      </Button>
      <output>{now}</output>
      <Button disabled={disabled || now >= high} title={`${parameter.name} more`} onClick={() => onChange(now + 1)}>
        +
      </Button>
    </div>
  );
}

function Choice({ parameter, value, disabled, onChange }: Control) {
  const options = parameter.options ?? [];
  const labels = options.map((option) => ({ value: String(option), label: String(option), disabled }));
  const choose = (label: string) => onChange(options[labels.findIndex((one) => one.value === label)]!);
  const short = labels.reduce((sum, { label }) => sum + label.length + 3, 0) < 40;
  return options.length <= FEW && short ? (
    <Segments label={parameter.name} options={labels} value={String(value)} onChange={choose} />
  ) : (
    <Select label={parameter.name} hidden options={labels} value={String(value)} onChange={choose} />
  );
}
