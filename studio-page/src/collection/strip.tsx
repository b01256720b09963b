/** All distances on one line: a tick for each reference, and the threshold. */

import { inspect } from "../state/route";
import { collection } from "../state/studio";
import { fixed } from "../ui/numbers";

const WIDTH = 260;
const HEIGHT = 22;

export function Strip() {
  const { tiles, threshold } = collection.value;
  const known = tiles.filter((tile) => tile.distance !== null);
  if (!known.length) return null;
  const end = Math.max(2 * threshold, ...known.map((tile) => tile.distance!)) * 1.02;
  const x = (distance: number) => (distance / end) * WIDTH;
  return (
    <svg class="strip" viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label="Distances of all references">
      <line class="axis" x1={0} x2={WIDTH} y1={HEIGHT - 0.5} y2={HEIGHT - 0.5} />
      {known.map((tile) => (
        <rect
          key={tile.slug}
          x={x(tile.distance!) - 1}
          y={5}
          width={2}
          height={HEIGHT - 6}
          fill={tile.colour ?? undefined}
          onClick={() => inspect(tile.slug)}
        >
          <title>{`${tile.name}: ${fixed(tile.distance)}`}</title>
        </rect>
      ))}
      <path class="threshold" d={`M${x(threshold)} 0V${HEIGHT}`} />
      <title>{`Threshold ${fixed(threshold)}`}</title>
    </svg>
  );
}
