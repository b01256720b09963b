/** Which axes of the files point up and to the front, where these are to be found: the pictures show it. */

import { collection } from "../state/studio";
import type { Axes } from "../wire/messages";

const SAID: Record<Axes["by"], string> = {
  found: "turned",
  default: "as the files have it",
  floor: "as their floors lie",
  format: "as their format says",
  author: "as you say",
};

export function FoundAxes() {
  const ways = new Map<string, { axes: Axes; count: number }>();
  for (const { axes } of collection.value.tiles) {
    if (!axes) continue;
    const key = [axes.up, axes.front, axes.by].join();
    ways.set(key, { axes, count: (ways.get(key)?.count ?? 0) + 1 });
  }
  if (!ways.size) return null;
  return (
    <p class="hint" data-axes>
      Up and front were found:{" "}
      {[...ways.values()]
        .sort((a, b) => b.count - a.count)
        .map(({ axes: { up, front, by }, count }, i) => (
          <span key={`${up}${front}${by}`}>
            {i > 0 && "; "}
            <b>
              {up} up, {front} front
            </b>{" "}
            in {count}, {SAID[by]}
          </span>
        ))}
      . One that does not stand right: open it, and say so there.
    </p>
  );
}
