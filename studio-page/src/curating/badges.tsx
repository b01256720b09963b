/** On a tile: its tags, whether something is noted, and whether it is a duplicate. */

import { useComputed } from "@preact/signals";
import { duplicateOf, noted, tiles } from "../state/studio";
import { Icon } from "../ui/icons";
import type { Slug } from "../wire/messages";
import { extend, selected, toggle } from "./selection";

export function Badges({ slug }: { slug: Slug }) {
  const mine = useComputed(() => noted.value[slug]).value;
  const twin = useComputed(() => duplicateOf.value.get(slug)).value;
  // Names stay: to follow all tiles for them would draw each tile anew with every change of another one.
  const other = twin && tiles.peek().get(twin.of)?.name;
  return (
    <>
      {other && (
        <span
          class="badge"
          data-duplicate={twin.of}
          title={`${twin.equal ? "The same as" : "Nearly the same as"} ${other}`}
        >
          {twin.equal ? "=" : "≈"} {other}
        </span>
      )}
      {mine?.tags.slice(0, 2).map((tag) => (
        <span key={tag} class="badge tag">
          {tag}
        </span>
      ))}
      {mine && mine.tags.length > 2 && <small title={mine.tags.join(", ")}>+{mine.tags.length - 2}</small>}
      {mine?.note && (
        <span class="badge" title={mine.note}>
          <Icon name="note" />
        </span>
      )}
    </>
  );
}

/** The box in the corner of a tile. */
export function Pick({ slug, name, order }: { slug: Slug; name: string; order: () => readonly Slug[] }) {
  const on = useComputed(() => selected.value.has(slug)).value;
  return (
    <button
      type="button"
      class="pick"
      role="checkbox"
      tabIndex={-1}
      aria-checked={on}
      aria-label={`Select ${name}`}
      title="Select (x); with Shift all up to here"
      onClick={(event) => (event.shiftKey ? extend(slug, order()) : toggle(slug))}
    >
      {on && <Icon name="check" />}
    </button>
  );
}
