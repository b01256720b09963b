/**
 * A scale of colours whose lightness rises from what is different to what is replicated, and that runs from blue to yellow,
 * the difference that nearly all colour-blind people see. The ends and the middle are as in Viridis, light enough to tint
 * pictures on dark ground.
 */

import type { Grade } from "../wire/messages";

type Rgb = readonly [number, number, number];

const STOPS: readonly [at: number, rgb: Rgb][] = [
  [0, [122, 91, 181]],
  [0.5, [53, 165, 150]],
  [1, [240, 218, 90]],
];
const GRADES: Record<Grade, number> = { different: 0, close: 0.5, replicated: 1 };

/** #rrggbb of how good something is, 0 to 1. */
export function clear(good: number): string {
  const at = Math.min(1, Math.max(0, good));
  const after = Math.max(1, STOPS.findIndex(([stop]) => at <= stop)); // prettier-ignore
  const [[from, low], [to, high]] = [STOPS[after - 1]!, STOPS[after]!];
  const share = (at - from) / (to - from);
  return "#" + low.map((value, k) => hex(value + share * (high[k]! - value))).join("");
}

export const ofGrade = (grade: Grade): string => clear(GRADES[grade]);

/** Of a distance: the best at none, the middle at the threshold, the worst at so many thresholds. */
export function ofDistance(distance: number, threshold: number, far: number): string {
  const share = distance / threshold;
  return clear(share <= 1 ? 1 - share / 2 : 0.5 - Math.min(1, (share - 1) / (far - 1)) / 2);
}

const hex = (value: number) => Math.round(value).toString(16).padStart(2, "0");
