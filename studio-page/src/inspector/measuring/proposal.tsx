/** A measured length as the end of a parameter's Range, as a line for the procedure. */

import { useSignal } from "@preact/signals";
import { proposeRange } from "../../loop/editing";
import { copy } from "../../state/actions";
import { procedure } from "../../state/studio";
import { Button, Select } from "../../ui/controls";
import { significant } from "../../ui/numbers";
import type { Parameter } from "../../wire/messages";
import { units } from "./points";
import type { Length } from "./points";

const PARTS = ["length", "dx", "dy", "dz"] as const;

export function Proposal({ length }: { length: Length }) {
  const ranged = procedure.value.parameters.filter(({ kind }) => kind === "scalar" || kind === "integer");
  const name = useSignal(ranged[0]?.name ?? "");
  const unit = useSignal(units.value.at(-1)?.name ?? "normalised");
  const part = useSignal<(typeof PARTS)[number]>("length");
  const parameter = ranged.find((one) => one.name === name.value);
  const scale = units.value.find((one) => one.name === unit.value)?.size ?? 1;
  if (!parameter) return null;
  const measured = [length.total, ...length.along][PARTS.indexOf(part.value)]! * scale;
  const [low, high] = widened(parameter, measured);
  const same = low === parameter.low && high === parameter.high;
  const line = `Range(${significant(low, 3)}, ${significant(high, 3)})`;
  return (
    <div class="proposal">
      <div class="row">
        <Select
          label="Parameter"
          options={ranged.map((one) => ({ value: one.name, label: one.name }))}
          value={name.value}
          onChange={(value) => (name.value = value)}
        />
        <Select
          label="Measure"
          options={PARTS.map((value) => ({ value, label: value }))}
          value={part.value}
          onChange={(value) => (part.value = value)}
        />
        <Select
          label="Units"
          options={units.value.map((one) => ({ value: one.name, label: one.name }))}
          value={unit.value}
          onChange={(value) => (unit.value = value)}
        />
      </div>
      <p>
        <code>
          {name.value}: {line}
        </code>
        {same ? (
          <span class="soft"> holds {significant(measured, 3)} already</span>
        ) : (
          <span class="soft">
            {" "}
            instead of {parameter.low} to {parameter.high}
          </span>
        )}
      </p>
      <div class="row">
        <Button icon="copy" onClick={() => void copy(line, "the Range")}>
          Copy
        </Button>
        <Button
          disabled={same}
          onClick={() => void proposeRange(name.value, significant(low, 3), significant(high, 3))}
        >
          Put into the editor
        </Button>
      </div>
    </div>
  );
}

/** The Range, widened so that it holds a value; rounded outwards. */
function widened({ low, high, kind }: Parameter, value: number): [number, number] {
  const step = kind === "integer" ? 1 : 10 ** (Math.floor(Math.log10(Math.max(value, 1e-9))) - 1);
  const ends = [low ?? value, high ?? value] as const;
  return [
    value < ends[0] ? Math.floor(value / step + 1e-6) * step : ends[0],
    value > ends[1] ? Math.ceil(value / step - 1e-6) * step : ends[1],
  ];
}
