/** What the journeys of the tests and the benchmark ask of the stage: nothing else reads it. */

import { Vector3 } from "three";

type Side = "reference" | "replica";

/** What is asked of a stage. */
interface Observed {
  readonly canvas: HTMLCanvasElement;
  readonly objects: Record<"geometries" | "textures" | "programs", number>;
  readonly faces: Record<Side, { drawn: number; measured: number }>;
  project(point: Vector3, side: Side): { x: number; y: number } | null;
}

declare global {
  interface Window {
    shapewright: {
      /** Contexts that are alive, and the objects of the one that is open. */
      gpu: () => Record<"contexts" | "geometries" | "textures" | "programs", number>;
      /** Triangles of both shapes that are drawn, and that are measured; null while nothing is open. */
      faces: () => Observed["faces"] | null;
      /** How many replicas were put on the stage so far. */
      shown: () => number;
      /** Where on the page a point of the normalised frame is seen; null while nothing is open. */
      seen: (side: Side, point: [number, number, number]) => { x: number; y: number } | null;
    };
  }
}

const alive = new Set<Observed>();
let replicas = 0;

export function began(stage: Observed): void {
  alive.add(stage);
}

export function ended(stage: Observed): void {
  alive.delete(stage);
}

export function replicaShown(): void {
  replicas += 1;
}

window.shapewright = {
  shown: () => replicas,
  gpu: () => {
    const [open] = alive;
    return { contexts: alive.size, geometries: 0, textures: 0, programs: 0, ...open?.objects };
  },
  faces: () => [...alive][0]?.faces ?? null,
  seen: (side, point) => {
    const [open] = alive;
    const at = open?.project(new Vector3(...point), side);
    if (!open || !at) return null;
    const box = open.canvas.getBoundingClientRect();
    return { x: box.left + at.x, y: box.top + at.y };
  },
};
