/** Axes of files, and where points of the normalised frame are seen in pictures that the server draws. */

import type { Axis, Units, Vector } from "../wire/messages";
import type { Camera } from "../wire/requests";

export const AXES = ["x", "-x", "y", "-y", "z", "-z"] as const satisfies readonly Axis[];

/** Which axis of a file an axis of the normalised frame is: 0 to the right, 1 up, 2 to the front. */
export function axisOf({ axes }: Units, which: 0 | 1 | 2): Axis {
  const row = axes[which] ?? [];
  const place = row.findIndex((part) => Math.abs(part) > 0.5);
  const name = ["x", "y", "z"][place] ?? "y";
  return (row[place]! < 0 ? `-${name}` : name) as Axis;
}

/** As shapewright.rendering.cameras has it for thumbnails. */
const DISTANCE = 3.6;
const FIELD_OF_VIEW = 27.5;

interface Frame {
  right: Vector;
  up: Vector;
  backward: Vector;
}

export function cameraOf({ azimuth, elevation }: Camera): Frame {
  const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
  const [sin, cos, high, level] = [Math.sin(a), Math.cos(a), Math.sin(e), Math.cos(e)];
  const right: Vector = [cos, 0, -sin];
  const backward: Vector = [sin * level, high, cos * level];
  return { right, backward, up: [-sin * high, level, -cos * high] };
}

export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Where a point is seen in a square picture of this many pixels: across and down. */
export function project({ right, up, backward }: Frame, point: Vector, side: number): [number, number] {
  const away = DISTANCE - dot(point, backward);
  const scale = side / 2 / (away * Math.tan((FIELD_OF_VIEW * Math.PI) / 360));
  return [side / 2 + scale * dot(point, right), side / 2 - scale * dot(point, up)];
}
