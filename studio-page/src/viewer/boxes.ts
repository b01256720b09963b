/** Boxes along the axes, their corners and their edges. */

import { Box3, Vector3 } from "three";

/** The box around all that is indexed: the last and largest one. */
export function bounds({ boxes }: { boxes: Float32Array }): Box3 {
  const all = boxes.subarray(-6);
  return all.length ? new Box3(new Vector3().fromArray(all), new Vector3().fromArray(all, 3)) : new Box3();
}

export function corners({ min, max }: Box3): Vector3[] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map(
    (i) => new Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z),
  );
}

export function boxEdges(box: Box3): [Vector3, Vector3][] {
  const at = corners(box);
  const pairs = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((i) =>
    [1, 2, 4].filter((bit) => !(i & bit)).map((bit) => [i, i | bit] as const),
  );
  return pairs.map(([i, j]) => [at[i]!, at[j]!]);
}
