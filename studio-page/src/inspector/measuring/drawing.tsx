/** Points and lines of a measure, drawn over the stage in both of its halves. */

import { Vector3 } from "three";
import { bounds, boxEdges } from "../../viewer/boxes";
import type { Side, Stage } from "../../viewer/stage";
import { fixed } from "../../ui/numbers";
import { degrees, hover, length, points, snapping, tool } from "./points";
import { drawn, stage } from "../pair/layout";

export function MeasureDrawing() {
  void drawn.value;
  const open = stage.value;
  if (!open || tool.value === "off") return null;
  const sides: Side[] = open.layout === "over" ? ["reference"] : ["reference", "replica"];
  return (
    <svg class="measure" aria-hidden="true">
      {sides.map((side) => (
        <Half key={side} open={open} side={side} />
      ))}
    </svg>
  );
}

function Half({ open, side }: { open: Stage; side: Side }) {
  const pane = open.pane(side);
  const id = `half-${side}`;
  const see = (point: Vector3) => open.project(point, side);
  const seen = points.value.flatMap(({ point }) => see(point) ?? []);
  const under = hover.value;
  const cursor = under && (under.side === side || open.layout === "over") ? see(under.point) : null;
  const label = length.value
    ? fixed(length.value.total)
    : degrees.value === null
      ? null
      : `${degrees.value.toFixed(1)}°`;
  const middle = degrees.value === null ? halfway(seen) : seen[1];
  return (
    <g clipPath={`url(#${id})`}>
      <clipPath id={id}>
        <rect x={pane.x} y={pane.y} width={pane.width} height={pane.height} />
      </clipPath>
      {snapping.value.box && <BoundingBox open={open} side={side} />}
      {seen.length > 1 && <path class="line" d={`M${seen.map(({ x, y }) => `${x} ${y}`).join("L")}`} />}
      {seen.length > 0 && seen.length < 3 && !label && cursor && (
        <path class="line next" d={`M${seen.at(-1)!.x} ${seen.at(-1)!.y}L${cursor.x} ${cursor.y}`} />
      )}
      {seen.map(({ x, y }, i) => (
        <circle key={i} class="point" cx={x} cy={y} r={4} />
      ))}
      {cursor && under && <Cursor x={cursor.x} y={cursor.y} kind={under.kind} />}
      {label && middle && (
        <text class="value" x={middle.x + 9} y={middle.y - 9}>
          {label}
        </text>
      )}
    </g>
  );
}

const halfway = (seen: { x: number; y: number }[]) => {
  const [a, b] = seen;
  return a && b ? { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 } : undefined;
};

function Cursor({ x, y, kind }: { x: number; y: number; kind: string }) {
  const shape =
    kind === "vertex" || kind === "box" ? "M-5 -5H5V5H-5Z" : kind === "edge" ? "M-6 0L0 -6L6 0L0 6Z" : "M-5 0H5M0 -5V5";
  return (
    <g class="cursor" transform={`translate(${x} ${y})`}>
      <path d={shape} />
      <text x={9} y={16}>
        {kind === "surface" ? "" : kind}
      </text>
    </g>
  );
}

function BoundingBox({ open, side }: { open: Stage; side: Side }) {
  const body = open.surfaces[side].solid?.body;
  if (!body) return null;
  const lines = boxEdges(bounds(body.faces)).flatMap(([a, b]) => {
    const [from, to] = [open.project(a, side), open.project(b, side)];
    return from && to ? [`M${from.x} ${from.y}L${to.x} ${to.y}`] : [];
  });
  return <path class="box" d={lines.join("")} />;
}
