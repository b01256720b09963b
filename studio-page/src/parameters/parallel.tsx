/** Parallel coordinates: a line for each reference through all parameters; a drag on an axis brushes. */

import { useSignal } from "@preact/signals";
import { colourOfGrade } from "../state/scale";
import { collection, tiles } from "../state/studio";
import { shown, words } from "../ui/numbers";
import type { Grade, ParameterRow } from "../wire/messages";
import { brush, brushed, brushing, share, spreads } from "./brushes";
import type { Spread } from "./brushes";
import { table } from "./table";

const HEIGHT = 230;
const WIDTH = 1140;
const LEAST_GAP = 96;
const MOST_GAP = 210;
const TOP = 22;
const SIDE = 56;
const GRADES: readonly (Grade | "none")[] = ["none", "different", "close", "replicated"];

const strokeOf = (grade: Grade | "none") => (grade === "none" ? undefined : { stroke: colourOfGrade(grade) });

export function Parallel() {
  const all = spreads.value;
  const drag = useSignal<{ name: string; from: number; to: number } | null>(null);
  if (all.length < 2 || !table.value.rows.length) return null;
  const gap = Math.min(MOST_GAP, Math.max(LEAST_GAP, WIDTH / (all.length - 1)));
  const width = 2 * SIDE + gap * (all.length - 1);
  const out = new Set(collection.value.left_out);
  const lines = new Map<string, string>(GRADES.map((grade) => [grade, ""]));
  let chosen = "";
  for (const row of table.value.rows) {
    if (out.has(row.slug)) continue;
    const line = lineOf(row, all, gap);
    const tile = tiles.value.get(row.slug);
    const grade = tile && tile.distance !== null ? tile.grade : "none";
    if (brushed.value.has(row.slug)) chosen += line;
    else lines.set(grade, lines.get(grade) + line);
  }
  const at = (event: PointerEvent) => {
    const box = (event.currentTarget as SVGElement).ownerSVGElement!.getBoundingClientRect();
    return 1 - ((event.clientY - box.top) * ((HEIGHT + 2 * TOP) / box.height) - TOP) / HEIGHT;
  };
  const end = (spread: Spread) => {
    const { from, to } = drag.value!;
    drag.value = null;
    const [low, high] = [Math.min(from, to), Math.max(from, to)];
    brush(spread.parameter.name, high - low < 0.01 ? [] : binsWithin(spread, low, high));
  };
  return (
    <div class="parallel-frame">
      <svg
        class={`parallel ${brushing.value ? "brushing" : ""}`}
        viewBox={`0 0 ${width} ${HEIGHT + 2 * TOP}`}
        width={width}
        height={HEIGHT + 2 * TOP}
        role="img"
        aria-label="A line for each reference through all parameters. The bars above select the same by keyboard."
      >
        {GRADES.map((grade) => (
          <path key={grade} style={strokeOf(grade)} d={lines.get(grade)} />
        ))}
        <path class="chosen" d={chosen} />
        {all.map((spread, i) => {
          const { name } = spread.parameter;
          const x = SIDE + i * gap;
          const open = drag.value?.name === name ? drag.value : null;
          const [low, high] = ends(spread);
          return (
            <g key={name} data-axis={name}>
              <line x1={x} x2={x} y1={TOP} y2={TOP + HEIGHT} />
              <text x={x} y={12}>
                {short(words(name))}
                <title>{name}</title>
              </text>
              <text class="end" x={x + 4} y={TOP + 9}>
                {high}
              </text>
              <text class="end" x={x + 4} y={TOP + HEIGHT - 2}>
                {low}
              </text>
              {open && (
                <rect
                  class="brush"
                  x={x - 7}
                  width={14}
                  y={TOP + (1 - Math.max(open.from, open.to)) * HEIGHT}
                  height={Math.abs(open.from - open.to) * HEIGHT}
                />
              )}
              <rect
                class="grip"
                x={x - 14}
                width={28}
                y={TOP - 8}
                height={HEIGHT + 16}
                onPointerDown={(event) => {
                  event.currentTarget.setPointerCapture(event.pointerId);
                  drag.value = { name, from: at(event), to: at(event) };
                }}
                onPointerMove={(event) => {
                  if (drag.value?.name === name) drag.value = { ...drag.value, to: at(event) };
                }}
                onPointerUp={() => drag.value && end(spread)}
                onPointerCancel={() => (drag.value = null)}
              >
                <title>Drag to select the references that lie there</title>
              </rect>
            </g>
          );
        })}
      </svg>
    </div>
  );
}

function lineOf({ parameters, active }: ParameterRow, all: Spread[], gap: number): string {
  let line = "";
  let drawing = false;
  all.forEach(({ parameter }, i) => {
    const value = parameters[parameter.name];
    // Where a parameter changes nothing the line has a gap.
    if (value === undefined || !active.includes(parameter.name)) {
      drawing = false;
      return;
    }
    const y = TOP + (1 - share(parameter, value)) * HEIGHT;
    line += `${drawing ? "L" : "M"}${SIDE + i * gap} ${y.toFixed(1)}`;
    drawing = true;
  });
  return line;
}

function binsWithin({ parameter, bins, members }: Spread, low: number, high: number): number[] {
  const count = bins.length;
  const discrete = parameter.kind !== "scalar" && members.length === count && parameter.kind !== "integer";
  return bins.flatMap((_, i) => {
    const middle = discrete ? i / Math.max(1, count - 1) : (i + 0.5) / count;
    return middle >= low && middle <= high ? [i] : [];
  });
}

function ends({ parameter, bins }: Spread): [string, string] {
  const numbers = parameter.kind === "scalar" || parameter.kind === "integer";
  return numbers ? [shown(parameter.low), shown(parameter.high)] : [bins[0]!.label, bins.at(-1)!.label];
}

const short = (text: string) => (text.length > 15 ? `${text.slice(0, 14)}…` : text);
