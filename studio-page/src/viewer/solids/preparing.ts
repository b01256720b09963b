/** Meshes are made ready for the stage: small ones at once, large ones by a worker. */

import { AT_ONCE, bodyOf, MOST_DRAWN, sightOf } from "./solid";
import type { Solid, Triangles } from "./solid";
import type { Done, Task } from "./worker";

/** Tasks without their numbers. */
type Asked = Task extends infer T ? (T extends Task ? Omit<T, "id"> : never) : never;

let worker: Worker | null = null;
let onTrouble: () => void = () => undefined;
let last = 0;
const heard = new Map<number, (done: Done) => void>();

/** Calls `ready` when the mesh can be shown, before this returns where it is small; and again when it can be measured. */
export function prepare(mesh: Triangles, labels: Int32Array | null, ready: (solid: Solid) => void): void {
  if (mesh.indices.length <= 3 * AT_ONCE) {
    const sight = sightOf(mesh, labels);
    return ready({ sight, body: bodyOf(mesh, sight) });
  }
  let sight: Solid["sight"] | null = null;
  const { positions, indices, discs } = mesh;
  ask({ kind: "solid", mesh: { positions, indices, discs }, labels }, (done) => {
    if (done.kind === "sight") ready({ sight: (sight = done.sight), body: null });
    if (done.kind === "body" && sight) ready({ sight, body: done.body });
    return done.kind === "body";
  });
  return undefined;
}

/** A coloured mesh of at most as many triangles as are drawn; calls `ready` before this returns where it is so already. */
export function thin<M extends Triangles & { colours: Float32Array }>(mesh: M, ready: (mesh: M) => void): void {
  if (mesh.indices.length <= 3 * MOST_DRAWN) return ready(mesh);
  const { positions, indices, colours } = mesh;
  ask({ kind: "colours", mesh: { positions, indices }, colours }, (done) => {
    if (done.kind === "colours") ready({ ...mesh, ...done.thin });
    return true;
  });
  return undefined;
}

/** trouble: called where the worker fails, as without memory. */
export function whenItFails(trouble: () => void): void {
  onTrouble = trouble;
}

/** answered: returns whether that was the last answer. */
function ask(task: Asked, answered: (done: Done) => boolean): void {
  if (!worker) {
    worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    worker.addEventListener("message", ({ data }: MessageEvent<Done>) => heard.get(data.id)?.(data));
    worker.addEventListener("error", () => onTrouble());
  }
  const id = ++last;
  heard.set(id, (done) => {
    if (answered(done)) heard.delete(id);
  });
  worker.postMessage({ ...task, id } as Task);
}
