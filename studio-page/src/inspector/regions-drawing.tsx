/** Regions where reference and replica differ, as boxes over the stage. */

import { Vector3 } from "three";
import type { Side, Stage } from "../viewer/stage";
import type { Piece, Region } from "../wire/messages";
import { AXES, boxOf, pointed, regionsShown } from "./causes";
import { figures, reference } from "./pair/session";
import { drawn, stage } from "./pair/layout";

/** Each edge of a box joins two of its corners that differ in one direction. */
const EDGES = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((i) =>
  [1, 2, 4].filter((bit) => !(i & bit)).map((bit) => [i, i | bit] as const),
);

export function RegionsDrawing() {
  void drawn.value;
  const open = stage.value;
  const shown = [...(regionsShown.value ? regions() : []), ...(pointed.value ? [pointed.value] : [])];
  if (!open || !shown.length) return null;
  return (
    <svg class="regions" aria-hidden="true">
      {shown.map((region, i) => (
        <path key={i} class={`${region.side} ${region === pointed.value ? "pointed" : ""}`} d={outline(open, region)} />
      ))}
    </svg>
  );
}

/** As explained, else as the judge finds them. */
function regions(): Region[] {
  const explained = reference.value?.explanation?.regions ?? [];
  if (explained.length) return explained;
  const now = figures.value ?? reference.value;
  const boxes = (pieces: Piece[], side: Region["side"]) => pieces.map((piece) => boxOf(piece, side));
  return now ? [...boxes(now.missing, "unexplained"), ...boxes(now.surplus, "surplus")] : [];
}

function outline(open: Stage, { side, centre, size, axes }: Region): string {
  const half: Side = side === "unexplained" ? "reference" : "replica";
  const seen = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => {
    const corner = new Vector3(...centre);
    axes.forEach((axis, k) => corner.addScaledVector(new Vector3(...axis), ((i >> k) & 1 ? 0.5 : -0.5) * size[k]!));
    const placement = reference.value?.explanation?.placement;
    if (side === "surplus" && placement && axes !== AXES)
      corner.divideScalar(placement.scale).add(new Vector3(...placement.centre));
    return open.project(corner, half);
  });
  return EDGES.map(([i, j]) => [seen[i], seen[j]] as const)
    .flatMap(([a, b]) => (a && b ? [`M${a.x} ${a.y}L${b.x} ${b.y}`] : []))
    .join("");
}
