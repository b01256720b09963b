/** Measures that the author takes on the shapes: points, and what lies between them. */

import { computed, signal } from "@preact/signals";
import type { Vector3 } from "three";
import type { Snap, Snapping } from "../../viewer/snapping";
import { outcome, reference } from "../pair/session";

export type Tool = "off" | "distance" | "angle";

export const tool = signal<Tool>("off");
export const snapping = signal<Snapping>({ vertex: true, edge: true, box: true });
export const points = signal<readonly Snap[]>([]);
export const hover = signal<Snap | null>(null);

export const needed = computed(() => (tool.value === "angle" ? 3 : 2));
export const complete = computed(() => tool.value !== "off" && points.value.length === needed.value);

export function take(tool_: Tool): void {
  tool.value = tool_;
  points.value = [];
  hover.value = null;
}

/** A click: one more point, or the first of the next measure. */
export function place(point: Snap): void {
  points.value = complete.value ? [point] : [...points.value, point];
}

export function undo(): void {
  points.value = points.value.slice(0, -1);
}

export interface Unit {
  name: string;
  title: string;
  /** Length of one normalised unit. */
  size: number;
}

/** Units that a length can be told in: the common one, the reference's file's, the procedure's. */
export const units = computed((): Unit[] => {
  const own = reference.value?.units?.scale;
  const made = outcome.value?.units.size;
  return [
    { name: "normalised", title: "The largest extent is 1", size: 1 },
    ...(own ? [{ name: "reference", title: "Units of the reference's file", size: 1 / own }] : []),
    ...(made ? [{ name: "procedure", title: "Units of the procedure", size: Math.max(...made) }] : []),
  ];
});

export interface Length {
  total: number;
  /** Along x, y and z of the normalised frame. */
  along: [number, number, number];
}

export const length = computed((): Length | null => {
  const [a, b] = points.value;
  if (tool.value !== "distance" || !a || !b) return null;
  const d = b.point.clone().sub(a.point);
  return { total: d.length(), along: [Math.abs(d.x), Math.abs(d.y), Math.abs(d.z)] };
});

/** Degrees at the second of three points. */
export const degrees = computed((): number | null => {
  const [a, apex, b] = points.value;
  if (tool.value !== "angle" || !a || !apex || !b) return null;
  const arm = (to: Vector3) => to.clone().sub(apex.point);
  return (arm(a.point).angleTo(arm(b.point)) * 180) / Math.PI;
});
