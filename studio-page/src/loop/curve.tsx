/** The training curve: loss on what is learned from, and on what is held out. */

import { fixed } from "../ui/numbers";
import type { Epoch } from "../wire/messages";

const WIDTH = 420;
const HEIGHT = 150;
const LEFT = 34;
const BOTTOM = 20;

export function Curve({ curve, epochs }: { curve: Epoch[]; epochs: number }) {
  const last = curve.at(-1);
  if (!last) return <p class="soft">The training curve appears here with the first epoch.</p>;
  const end = Math.max(epochs, last.epoch, 2);
  const highest = Math.max(...curve.flatMap(({ train, validation }) => [train, validation ?? 0])) || 1;
  const x = (epoch: number) => LEFT + ((epoch - 1) / (end - 1)) * (WIDTH - LEFT - 8);
  const y = (loss: number) => 8 + (1 - loss / highest) * (HEIGHT - BOTTOM - 8);
  const path = (of: (epoch: Epoch) => number | null) =>
    curve
      .flatMap((one) => (of(one) === null ? [] : [`${x(one.epoch).toFixed(1)} ${y(of(one)!).toFixed(1)}`]))
      .join("L");
  const held = path((one) => one.validation);
  return (
    <figure class="curve">
      <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label="Training curve">
        {[0, 0.5, 1].map((share) => (
          <g key={share}>
            <line class="grid" x1={LEFT} x2={WIDTH - 8} y1={y(share * highest)} y2={y(share * highest)} />
            <text x={LEFT - 6} y={y(share * highest) + 3.5} class="end">
              {fixed(share * highest, 2)}
            </text>
          </g>
        ))}
        <text x={LEFT} y={HEIGHT - 4}>
          1
        </text>
        <text x={WIDTH - 8} y={HEIGHT - 4} class="end">
          epoch {end}
        </text>
        <path class="train" d={`M${path((one) => one.train)}`} />
        {held && <path class="validation" d={`M${held}`} />}
        <circle class="train" cx={x(last.epoch)} cy={y(last.train)} r={2.5} />
        {last.validation !== null && <circle class="validation" cx={x(last.epoch)} cy={y(last.validation)} r={2.5} />}
      </svg>
      <figcaption>
        <span class="key train">training {fixed(last.train)}</span>
        {last.validation !== null && <span class="key validation">held out {fixed(last.validation)}</span>}
      </figcaption>
    </figure>
  );
}
