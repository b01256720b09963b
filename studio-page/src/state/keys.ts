/** Keys of the views that are shown, for acting on them and for the help that lists them. */

import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";

export interface Key {
  /** As KeyboardEvent.key gives them; the first is the one that the help names. */
  keys: string[];
  does: string;
  run: (event: KeyboardEvent) => void;
}

export interface KeyMap {
  place: string;
  keys: Key[];
}

/** The maps in force, the innermost last. */
export const keyMaps = signal<KeyMap[]>([]);

/** Keep a map of keys in force while the component is shown. */
export function useKeys(place: string, keys: Key[]): void {
  const newest = useRef(keys);
  newest.current = keys;
  useEffect(() => {
    // The map is registered once; what its keys do is always the newest.
    const map: KeyMap = {
      place,
      keys: keys.map((key, i) => ({ ...key, run: (event) => newest.current[i]?.run(event) })),
    };
    keyMaps.value = [...keyMaps.value, map];
    return () => {
      keyMaps.value = keyMaps.value.filter((other) => other !== map);
    };
  }, [place, keys.length]);
}

const ARROWS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown"];

/** Whether a key belongs to the element that has the focus. */
function taken({ key, target }: KeyboardEvent): boolean {
  if (!(target instanceof Element)) return false;
  if (target.closest("[contenteditable=true], textarea, dialog[open]")) return true;
  if (target.closest("select")) return key !== "Escape";
  const input = target.closest("input");
  if (input?.type === "range" || target.closest("[role=radiogroup]")) return ARROWS.includes(key);
  if (input && input.type !== "checkbox") return true;
  return (key === " " || key === "Enter") && target.closest("button:not([data-tile]), a, summary, input") !== null;
}

window.addEventListener("keydown", (event) => {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || taken(event)) return;
  for (const map of [...keyMaps.value].reverse()) {
    const key = map.keys.find(({ keys }) => keys.includes(event.key));
    if (!key) continue;
    event.preventDefault();
    key.run(event);
    return;
  }
});
