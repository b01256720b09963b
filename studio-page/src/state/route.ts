/** Where the author is: the view and, in the inspector, the shape; kept in the address so that "back" works. */

import { signal } from "@preact/signals";
import type { Slug } from "../wire/messages";

export const VIEWS = ["collection", "loop", "history", "feedback", "explore", "parameters"] as const;
export type ViewName = (typeof VIEWS)[number];

export interface Route {
  view: ViewName;
  /** The reference open in the inspector, over the collection. */
  slug: Slug | null;
  /** What of the view is open, where it says so in the address. */
  rest: string | null;
}

export const route = signal<Route>(read());

window.addEventListener("hashchange", () => (route.value = read()));

export function go(view: ViewName): void {
  location.hash = view;
}

export function inspect(slug: Slug): void {
  const hash = `inspect/${encodeURIComponent(slug)}`;
  // Leafing through shapes leaves one step for "back", not one for each shape.
  if (route.value.slug) {
    history.replaceState(null, "", `#${hash}`);
    route.value = read();
  } else location.hash = hash;
}

function read(): Route {
  const [head = "", ...tail] = location.hash.slice(1).split("/");
  const rest = tail.join("/") || null;
  if (head === "inspect" && tail[0]) return { view: "collection", slug: decoded(tail[0]), rest: null };
  return { view: VIEWS.find((view) => view === head) ?? "collection", slug: null, rest };
}

/** An address that was typed may be none: it stands for itself then. */
function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}
