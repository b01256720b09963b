/** A group of references that look alike: its representative, or all of it, opened in place. */

import { useLayoutEffect } from "preact/hooks";
import { valueOf } from "../state/grades";
import { collection } from "../state/studio";
import { Button } from "../ui/controls";
import { fixed, plural } from "../ui/numbers";
import type { Tile } from "../wire/messages";
import { at, focusOn } from "./focus";
import { openGroups, toggleGroup } from "./order";
import { TileCard } from "./tile";
import { Tiles } from "./tiles";

export function GroupCard({ tiles, number }: { tiles: Tile[]; number: number }) {
  const [representative, ...others] = tiles;
  const slug = representative?.slug ?? "";
  const open = openGroups.value.has(slug) && others.length > 0;
  useLayoutEffect(() => {
    // Its tiles are new ones now: the focus that was on one of them is lost.
    const lost = document.activeElement === null || document.activeElement === document.body;
    if (lost && tiles.some((tile) => tile.slug === at.value)) focusOn(slug);
  }, [open]);
  if (!representative) return null;
  const toggle = () => toggleGroup(slug);
  if (!open) {
    return (
      <div class={`group ${others.length ? "stacked" : ""}`} data-group={slug}>
        <TileCard tile={representative}>
          {others.length > 0 && (
            <button
              type="button"
              class="more"
              aria-expanded={false}
              title={`Open group ${number} (o)`}
              onClick={toggle}
            >
              +{others.length} more
            </button>
          )}
        </TileCard>
      </div>
    );
  }
  return (
    <section class="group open" data-group={slug} aria-label={`Group ${number}`}>
      <header>
        <h3>Group {number}</h3>
        <p class="soft">
          {plural(tiles.length, "reference")} · {collection.value.judge === "fidelity" ? "fidelity" : "distances"}{" "}
          {spread(tiles)}
        </p>
        <Button kind="quiet" icon="up" title="Close this group (o)" onClick={toggle}>
          Close
        </Button>
      </header>
      <Tiles tiles={tiles} />
    </section>
  );
}

function spread(tiles: Tile[]): string {
  const values = tiles.map((tile) => valueOf(collection.value.judge, tile));
  const known = values.flatMap((value) => (value === null ? [] : [value]));
  if (!known.length) return "not measured";
  const [low, high] = [fixed(Math.min(...known), 2), fixed(Math.max(...known), 2)];
  return low === high ? low : `${low} to ${high}`;
}
