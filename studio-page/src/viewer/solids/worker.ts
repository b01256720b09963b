/** Makes large meshes ready in a thread of its own, so that the page does not stand still. */

import { bodyOf, sightOf, thinColours } from "./solid";
import type { Body, Sight, Triangles } from "./solid";

export type Task =
  | { id: number; kind: "solid"; mesh: Triangles; labels: Int32Array | null }
  | { id: number; kind: "colours"; mesh: Triangles; colours: Float32Array };
export type Done =
  | { id: number; kind: "sight"; sight: Sight }
  | { id: number; kind: "body"; body: Body }
  | { id: number; kind: "colours"; thin: ReturnType<typeof thinColours> };

self.addEventListener("message", ({ data }: MessageEvent<Task>) => {
  if (data.kind === "colours")
    return send({ id: data.id, kind: "colours", thin: thinColours(data.mesh, data.colours) });
  const sight = sightOf(data.mesh, data.labels);
  const whole = sight.indices === data.mesh.indices;
  // What is drawn whole is needed here still, so it is copied and not given away.
  send({ id: data.id, kind: "sight", sight }, whole ? [] : undefined);
  send({ id: data.id, kind: "body", body: bodyOf(data.mesh, sight) });
  return undefined;
});

function send(done: Done, given: Transferable[] = [...new Set(buffers(done))]): void {
  // The worker's own postMessage; TypeScript takes it for that of a window.
  (self.postMessage as (message: Done, given: Transferable[]) => void)(done, given);
}

function buffers(of: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(of)) return [of.buffer as ArrayBuffer];
  return of && typeof of === "object" ? Object.values(of).flatMap(buffers) : [];
}
