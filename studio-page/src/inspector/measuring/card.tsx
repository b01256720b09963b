/** What was measured, in every unit; to copy, or to propose as a parameter's range. */

import { useSignal } from "@preact/signals";
import { copy } from "../../state/actions";
import { procedure } from "../../state/studio";
import { Button, Toggle } from "../../ui/controls";
import { significant } from "../../ui/numbers";
import { Proposal } from "./proposal";
import { complete, degrees, length, points, snapping, take, tool, units } from "./points";

const HINTS = {
  distance: ["Click the first point.", "Click the second point."],
  angle: ["Click the end of one arm.", "Click the corner.", "Click the end of the other arm."],
} as const;

export function MeasureCard() {
  const proposing = useSignal(false);
  if (tool.value === "off") return null;
  const hint = complete.value ? null : HINTS[tool.value][points.value.length];
  const ranged = procedure.value.parameters.some(({ kind }) => kind === "scalar" || kind === "integer");
  return (
    <section class="measure-card" aria-label="Measure">
      <header>
        <h3>{tool.value === "angle" ? "Angle" : "Distance"}</h3>
        <Button kind="quiet" icon="close" title="Stop measuring (Esc)" onClick={() => take("off")} />
      </header>
      <div class="row">
        <span class="soft">Snap to</span>
        {(["vertex", "edge", "box"] as const).map((kind) => (
          <Toggle
            key={kind}
            label={kind}
            on={snapping.value[kind]}
            onChange={(on) => (snapping.value = { ...snapping.value, [kind]: on })}
          />
        ))}
      </div>
      {hint && <p class="soft">{hint}</p>}
      {length.value && <Lengths />}
      {degrees.value !== null && <output class="angle">{degrees.value.toFixed(2)}°</output>}
      {complete.value && (
        <div class="row">
          <Button icon="copy" onClick={() => void copy(measured(), "the measure")}>
            Copy
          </Button>
          {length.value && ranged && (
            <Button pressed={proposing.value} onClick={() => (proposing.value = !proposing.value)}>
              Propose as Range…
            </Button>
          )}
        </div>
      )}
      {length.value && proposing.value && <Proposal length={length.value} />}
    </section>
  );
}

function Lengths() {
  const { total, along } = length.value!;
  const rows = [
    ["length", total],
    ["dx", along[0]],
    ["dy", along[1]],
    ["dz", along[2]],
  ] as const;
  return (
    <table class="lengths">
      <thead>
        <tr>
          <td />
          {units.value.map(({ name, title }) => (
            <th key={name} title={title}>
              {name}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {rows.map(([name, value]) => (
          <tr key={name}>
            <th>{name}</th>
            {units.value.map((unit) => (
              <td key={unit.name} data-measure={`${name} ${unit.name}`}>
                {unit.size === 1 ? value.toFixed(4) : significant(value * unit.size, 5)}
              </td>
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function measured(): string {
  if (degrees.value !== null) return `${degrees.value.toFixed(2)}°`;
  const { total, along } = length.value!;
  return units.value
    .map(({ name, size }) => {
      const [d, x, y, z] = [total, ...along].map((value) => significant(value * size, 5));
      return `${name}: ${d} (dx ${x}, dy ${y}, dz ${z})`;
    })
    .join("\n");
}
