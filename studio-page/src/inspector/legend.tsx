/** What the colours on the stage mean. */

import type { Signal } from "@preact/signals";
import { Segments } from "../ui/controls";
import { partColour } from "../viewer/paint";
import { theme } from "../state/theme";
import { colouring, original, replica, residuals } from "./pair/session";
import { blend, COLOURS, layout, under } from "./pair/layout";
import type { Side } from "../wire/messages";

export function Legend() {
  const mesh = replica.value;
  if (colouring.value === "distance") return <Residual />;
  if (colouring.value === "parts" && mesh?.type === "mesh") {
    const reference = original.value?.type === "mesh" ? original.value.label_names : [];
    const names = mesh.label_names;
    if (!names.length) return <p class="legend soft">The procedure labels no parts: use .label("name").</p>;
    return (
      <p class="legend">
        {names.map((name, i) => (
          <span key={name}>
            <i class="swatch" style={{ backgroundColor: partColour(i) }} />
            {name}
          </span>
        ))}
        {reference.length === 0 && <span class="soft">the reference has no labels</span>}
      </p>
    );
  }
  if (layout.value === "beside") {
    return <p class="legend soft">Drag to turn, wheel to come nearer, right-drag to move.</p>;
  }
  return <OverLegend />;
}

export function OverLegend() {
  const colours = COLOURS[theme.value];
  return (
    <p class="legend">
      <Opacity of="reference" colour={colours.reference} opacity={under} />
      <Opacity of="replica" colour={colours.over} opacity={blend} />
    </p>
  );
}

function Opacity({ of, colour, opacity }: { of: Side; colour: string; opacity: Signal<number> }) {
  return (
    <label>
      <i class="swatch" style={{ backgroundColor: colour }} />
      {of}
      <input
        type="range"
        aria-label={`Opacity of the ${of}`}
        min={0}
        max={1}
        step={0.05}
        value={opacity.value}
        onInput={(event) => (opacity.value = event.currentTarget.valueAsNumber)}
      />
    </label>
  );
}

function Residual() {
  const known = residuals.value.replica ?? residuals.value.reference;
  const limit = known?.limit ?? 0.1;
  const signed = Boolean(residuals.value.replica?.signed || residuals.value.reference?.signed);
  return (
    <p class="legend residual">
      <span>{signed ? `inside ${limit}` : ""}</span>
      <i class={`ramp ${signed ? "" : "half"}`} />
      <span>
        {signed ? "outside" : "off by"} {limit}
      </span>
      <span class="soft">{known ? "of the largest extent, from the other surface" : "measuring…"}</span>
    </p>
  );
}

export function LayoutSwitch({ flat }: { flat: boolean }) {
  return (
    <Segments
      label="Layout"
      value={layout.value}
      onChange={(value) => (layout.value = value)}
      options={[
        { value: "beside", label: "Side by side", title: "Reference and replica beside each other (b)" },
        { value: "over", label: "Overlay", title: "The replica over the reference (b)" },
        ...(flat ? [{ value: "difference" as const, label: "Difference", title: "Only where they differ (b)" }] : []),
      ]}
    />
  );
}
