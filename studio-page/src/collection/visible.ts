/** Tells the server which tiles are on the screen, so that it draws and measures these first. */

import { look } from "../wire/live";

const PAUSE = 150;

const seen = new Set<string>();
let waiting = 0;

const observer = new IntersectionObserver((entries) => {
  for (const { target, isIntersecting } of entries) {
    const slug = (target as HTMLElement).dataset.tile!;
    if (isIntersecting) seen.add(slug);
    else seen.delete(slug);
  }
  waiting ||= window.setTimeout(() => {
    waiting = 0;
    if (seen.size) look([...seen]);
  }, PAUSE);
});

/** Watch a tile until the returned function is called. */
export function watch(tile: HTMLElement): () => void {
  observer.observe(tile);
  return () => {
    observer.unobserve(tile);
    seen.delete(tile.dataset.tile!);
  };
}
