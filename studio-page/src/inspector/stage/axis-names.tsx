/** The names of the axes, at their ends, in both halves of the stage. */

import { AXES } from "../../viewer/furniture";
import type { Side } from "../../viewer/stage";
import { drawn, furnished, stage } from "../pair/layout";

export function AxisNames() {
  void drawn.value;
  const open = stage.value;
  if (!open || !furnished.value) return null;
  const sides: Side[] = open.layout === "over" ? ["reference"] : ["reference", "replica"];
  return (
    <svg class="axis-names" aria-hidden="true">
      {sides.flatMap((side) =>
        AXES.map(({ name, end, colour }) => {
          const at = open.project(end, side);
          return (
            at && (
              <text key={`${side} ${name}`} x={at.x} y={at.y} style={{ fill: colour }}>
                {name}
              </text>
            )
          );
        }),
      )}
    </svg>
  );
}
