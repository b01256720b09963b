/** The stage with both meshes, and the drawing of measures over it. */

import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { Color } from "three";
import { theme } from "../state/theme";
import { replicaShown } from "../viewer/diagnostics";
import { blended, parts, plain } from "../viewer/paint";
import { snap } from "../viewer/snapping";
import { Stage } from "../viewer/stage";
import type { Side } from "../viewer/stage";
import type { Surface } from "../viewer/surface";
import type { ShownMesh } from "./pair/session";
import { hover, place, points, snapping, tool } from "./measuring/points";
import { MeasureDrawing } from "./measuring/drawing";
import { RegionsDrawing } from "./regions-drawing";
import { colouring, failure, original, replica, residuals } from "./pair/session";
import { blend, COLOURS, drawn, furnished, layout, parallel, section, stage, under, wireframe } from "./pair/layout";
import { AxisNames } from "./stage/axis-names";

export function Space({ onFail }: { onFail: () => void }) {
  const place_ = useRef<HTMLDivElement>(null);
  useEffect(() => {
    let open: Stage;
    try {
      open = new Stage(place_.current!);
    } catch {
      onFail();
      return undefined;
    }
    open.onDraw = () => (drawn.value = drawn.peek() + 1);
    stage.value = open;
    const ends = [follow(open), point(open)];
    return () => {
      ends.forEach((end) => end());
      stage.value = null;
      open.dispose();
    };
  }, []);
  return (
    <div class={`space ${tool.value === "off" ? "" : "measuring"}`} ref={place_} data-stage>
      <RegionsDrawing />
      <AxisNames />
      <MeasureDrawing />
    </div>
  );
}

/** Keep the stage as the signals have it. */
function follow(open: Stage): () => void {
  const shape = (side: Side) => effect(() => showShape(open, side));
  const cover = (side: Side) => effect(() => showCover(open, side));
  const dress = effect(() => {
    const colours = COLOURS[theme.value];
    const over = layout.value !== "beside";
    const ink = new Color().setStyle(colours.ink);
    const failed = failure.value !== null;
    open.surfaces.reference.dress(over ? under.value : 1, ink, 0.75);
    open.surfaces.replica.dress(over ? blend.value : failed ? 0.35 : 1, ink, failed ? 0.25 : 0.75);
    open.arrange(over ? "over" : "beside");
  });
  const furnish = effect(() => {
    void [original.value, replica.value]; // the grid lies under both
    open.furnish(furnished.value, new Color().setStyle(COLOURS[theme.value].net));
  });
  const see = effect(() => open.eye.seeIn(parallel.value ? "parallel" : "perspective"));
  const wire = effect(() => open.wire(wireframe.value));
  const cut = effect(() => open.section(section.value));
  const shapes = [shape("reference"), shape("replica"), cover("reference"), cover("replica")];
  const ends = [...shapes, dress, furnish, see, wire, cut];
  return () => ends.forEach((end) => end());
}

const message = (side: Side): ShownMesh | null => {
  const found = side === "reference" ? original.value : replica.value;
  return found?.type === "mesh" ? found : null;
};

function showShape(open: Stage, side: Side): void {
  open.surfaces[side].show(message(side)?.solid ?? null);
  if (side === "replica") replicaShown();
  open.invalidate();
}

function showCover(open: Stage, side: Side): void {
  const mesh = message(side);
  const surface: Surface = open.surfaces[side];
  const colours = COLOURS[theme.value];
  const plainColour = side === "replica" && layout.value !== "beside" ? colours.over : colours[side];
  if (!mesh) return;
  const fine = residuals.value[side];
  if (colouring.value === "distance" && fine) surface.cover(fine, blended(fine.colours));
  else if (colouring.value === "parts" && mesh.solid.sight.labels)
    surface.cover(mesh.solid.sight, parts(mesh.solid.sight.labels));
  else surface.cover(mesh.solid.sight, plain(plainColour));
  open.invalidate();
}

/** Clicks that are no drags place points; moves show where a point would be. */
function point(open: Stage): () => void {
  let down: [number, number] | null = null;
  let asked = 0;
  const at = (event: PointerEvent) => {
    const box = open.canvas.getBoundingClientRect();
    return snap(open, event.clientX - box.left, event.clientY - box.top, snapping.value);
  };
  const moved = (event: PointerEvent) => {
    if (tool.value === "off" || event.buttons) return;
    cancelAnimationFrame(asked);
    asked = requestAnimationFrame(() => (hover.value = at(event)));
  };
  const pressed = (event: PointerEvent) => (down = [event.clientX, event.clientY]);
  const released = (event: PointerEvent) => {
    if (tool.value === "off" || !down || event.button !== 0) return;
    if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
    const found = at(event);
    if (found) place(found);
  };
  const left = () => (hover.value = null);
  const { canvas } = open;
  canvas.addEventListener("pointermove", moved);
  canvas.addEventListener("pointerdown", pressed, { capture: true });
  canvas.addEventListener("pointerup", released);
  canvas.addEventListener("pointerleave", left);
  const unpoint = effect(() => {
    if (tool.value === "off") hover.value = null;
    void points.value;
    canvas.style.cursor = tool.value === "off" ? "grab" : "crosshair";
  });
  return unpoint;
}
