/** Binary messages: the length of a header, the header as JSON, and its buffers in order. */

import type { DrawingMessage, FailedMessage, MeshHead, ResidualsHead, VerdictMessage } from "./messages";

export interface MeshMessage extends MeshHead {
  positions: Float32Array;
  indices: Uint32Array;
  labels: Int32Array | null;
}

export interface ResidualsMessage extends ResidualsHead {
  positions: Float32Array;
  indices: Uint32Array;
  colours: Float32Array;
  distances: Float32Array;
}

/** The answers of live evaluation. */
export type Evaluated = MeshMessage | DrawingMessage | VerdictMessage | ResidualsMessage | FailedMessage;

const ARRAYS = { f32: Float32Array, u32: Uint32Array, i32: Int32Array } as const;

/** The message in a buffer; its arrays are views of the same memory. */
export function decode(buffer: ArrayBuffer): MeshMessage | ResidualsMessage {
  const length = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length))) as MeshHead | ResidualsHead;
  let at = 4 + length;
  const arrays: Record<string, Float32Array | Uint32Array | Int32Array> = {};
  for (const [name, kind, count] of head.buffers) {
    arrays[name] = new ARRAYS[kind](buffer, at, count);
    at += 4 * count;
  }
  return { labels: null, ...head, ...arrays } as unknown as MeshMessage | ResidualsMessage;
}
