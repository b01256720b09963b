/** All references on one line: a tick for each at its fidelity, or by the paper's judge its distance, and the cuts. */

import { valueOf } from "../state/grades";
import { inspect } from "../state/route";
import { collection } from "../state/studio";
import { fixed } from "../ui/numbers";
import type { Tile } from "../wire/messages";

const WIDTH = 260;
const HEIGHT = 22;
/** Ticks that each have a place of their own. */
const FEW = 500;

export function Strip() {
  const { tiles, judge, replicated, close, threshold } = collection.value;
  const known = tiles.flatMap((tile) => {
    const value = valueOf(judge, tile);
    return value === null ? [] : [{ tile, value }];
  });
  if (!known.length) return null;
  const byFidelity = judge === "fidelity";
  const cuts = byFidelity ? { replicated, close } : { threshold };
  const end = byFidelity ? 1 : Math.max(2 * threshold, ...known.map(({ value }) => value)) * 1.02;
  const x = (value: number) => 1 + (value / end) * (WIDTH - 2);
  const told = Object.entries(cuts).map(([name, cut]) => `${name} ${fixed(cut)}`);
  const what = byFidelity ? "Fidelity" : "Distances";
  return (
    <svg class="strip" viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label={`${what} of all references`}>
      <line class="axis" x1={0} x2={WIDTH} y1={HEIGHT - 0.5} y2={HEIGHT - 0.5} />
      {ticks(known, x).map(({ tile, value }) => (
        <rect
          key={tile.slug}
          class={tile.grade}
          x={x(value) - 1}
          y={5}
          width={2}
          height={HEIGHT - 6}
          onClick={() => inspect(tile.slug)}
        >
          <title>{`${tile.name}: ${fixed(value)}, ${tile.grade}`}</title>
        </rect>
      ))}
      {Object.entries(cuts).map(([name, cut]) => (
        <path key={name} class="threshold" data-cut={name} d={`M${x(cut)} 0V${HEIGHT}`} />
      ))}
      <title>{`${what}; cuts: ${told.join(", ")}`}</title>
    </svg>
  );
}

/** One of those that would stand at one place: of thousands hardly any could be told apart. */
function ticks<Known extends { tile: Tile; value: number }>(known: Known[], x: (value: number) => number): Known[] {
  const there = new Map<string, Known>();
  for (const one of known) {
    const place = `${one.tile.grade} ${Math.round(2 * x(one.value))}`;
    if (!there.has(place)) there.set(place, one);
  }
  return known.length > FEW ? [...there.values()] : known;
}
