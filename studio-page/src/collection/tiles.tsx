/** The tiles of a section: some hundreds first, and more as one comes to their end. There may be ten thousands. */

import { useComputed } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import type { Tile } from "../wire/messages";
import { at } from "./focus";
import { TileCard } from "./tile";

/** Two screens of small tiles. */
const SOME = 200;

export function Tiles({ tiles }: { tiles: Tile[] }) {
  const [asked, ask] = useState(SOME);
  const end = useRef<HTMLParagraphElement>(null);
  // The tile that one comes back to from the inspector is shown, however far down it is.
  const focused = useComputed(() => (Math.floor(tiles.findIndex(({ slug }) => slug === at.value) / SOME) + 1) * SOME);
  const count = Math.max(asked, focused.value);
  const left = tiles.length - count;
  useEffect(() => {
    if (left <= 0) return;
    const observer = new IntersectionObserver(
      (entries) => entries.some(({ isIntersecting }) => isIntersecting) && ask(count + SOME),
      { rootMargin: "100% 0px" },
    );
    observer.observe(end.current!);
    return () => observer.disconnect();
  }, [count, left > 0]);
  return (
    <>
      <div class="tiles">
        {tiles.slice(0, count).map((tile) => (
          <TileCard key={tile.slug} tile={tile} />
        ))}
      </div>
      {left > 0 && (
        <p ref={end} class="soft">
          {left} more
        </p>
      )}
    </>
  );
}
