/** The collection: what cannot be replicated yet first, in groups, largest first; what can, folded. */

import { useEffect } from "preact/hooks";
import { SelectionBar } from "../curating/bar";
import { select, toggle } from "../curating/selection";
import { MapView } from "../map/view";
import { useKeys } from "../state/keys";
import { inspect, route } from "../state/route";
import { collection, fitting } from "../state/studio";
import { Button, Empty } from "../ui/controls";
import { Icon } from "../ui/icons";
import { plural } from "../ui/numbers";
import { at, focusOn, move } from "./focus";
import { GroupCard } from "./group";
import { Asking } from "./asking";
import { DropZone } from "../first/drop";
import { Welcome } from "../first/welcome";
import { FoundAxes } from "./axes";
import { Next } from "./next";
import {
  filter,
  leafed,
  leftOutOpen,
  replicatedOpen,
  search,
  searching,
  sections,
  shownTiles,
  tag,
  toggleGroup,
} from "./order";
import type { Section } from "./order";
import { Tiles } from "./tiles";
import { mapped, searchField, Toolbar } from "./toolbar";

export function CollectionView() {
  const inspecting = route.value.slug !== null;
  useEffect(() => {
    if (!inspecting) focusOn(at.value);
  }, [inspecting]);
  const { count, left_out, skipped, run } = collection.value;
  if (count === 0 && !left_out.length && run === null) return <Welcome />;
  if (count === 0 && !left_out.length) return <NoReferences />;
  return (
    <>
      <CollectionKeys inspecting={inspecting} />
      <Toolbar />
      <div class="collection">
        {run === null && !fitting.value && <Welcome />}
        <Next />
        <FoundAxes />
        {filter.value === "all" && !searching.value && !mapped.value && <Asking />}
        {mapped.value ? (
          <MapView shown={shownTiles.value} />
        ) : sections.value.length === 0 ? (
          <NothingFound />
        ) : (
          <Sections />
        )}
        {skipped.length > 0 && (
          <details class="skipped">
            <summary>{plural(skipped.length, "file")} could not be read</summary>
            <ul>
              {skipped.map(({ path, reason }) => (
                <li key={path}>
                  <code>{path}</code> {reason}
                </li>
              ))}
            </ul>
          </details>
        )}
      </div>
      <SelectionBar />
    </>
  );
}

/** Keys of the collection rest while the inspector lies over it. */
function CollectionKeys({ inspecting }: { inspecting: boolean }) {
  return inspecting ? null : <ActiveKeys />;
}

function ActiveKeys() {
  useKeys("Collection", [
    { keys: ["ArrowRight", "n"], does: "next", run: () => move("next") },
    { keys: ["ArrowLeft", "p"], does: "previous", run: () => move("previous") },
    { keys: ["ArrowDown", "j"], does: "a row down", run: () => move("down") },
    { keys: ["ArrowUp", "k"], does: "a row up", run: () => move("up") },
    { keys: ["Enter"], does: "open in the inspector", run: openFocused },
    { keys: ["o", " "], does: "open or close the group", run: toggleFocused },
    { keys: ["c"], does: "fold or unfold the replicated", run: () => (replicatedOpen.value = !replicatedOpen.value) },
    { keys: ["x"], does: "select, or no more", run: () => at.value && toggle(at.value) },
    { keys: ["Escape"], does: "select none", run: () => select([]) },
    { keys: ["/"], does: "search", run: () => searchField.current?.focus() },
  ]);
  return null;
}

function openFocused(): void {
  const slug = at.value ?? leafed.value[0];
  if (slug) inspect(slug);
}

function toggleFocused(): void {
  const section = sections.value.find(
    ({ kind, tiles }) => kind === "group" && tiles.some(({ slug }) => slug === at.value),
  );
  const representative = section?.tiles[0]?.slug;
  if (!representative || (section?.tiles.length ?? 0) < 2) return;
  toggleGroup(representative);
  at.value = representative;
}

function Sections() {
  const groups = sections.value.filter(({ kind }) => kind === "group");
  const others = sections.value.filter(({ kind }) => kind !== "group");
  return (
    <>
      {groups.length > 0 && (
        <section aria-label="Not replicated, in groups">
          <h2>
            Not replicated, alike <small>{groups.reduce((sum, { tiles }) => sum + tiles.length, 0)}</small>
            <span class="soft"> in {plural(groups.length, "group")}</span>
          </h2>
          <div class="tiles">
            {groups.map(({ tiles }, i) => (
              <GroupCard key={tiles[0]!.slug} tiles={tiles} number={i + 1} />
            ))}
          </div>
        </section>
      )}
      {others.map((section) => (
        <Plain key={section.kind} section={section} />
      ))}
    </>
  );
}

function Plain({ section: { kind, tiles } }: { section: Section }) {
  const open = { replicated: replicatedOpen, "left out": leftOutOpen, loose: null, all: null, group: null }[kind];
  const folded = open !== null && filter.value === "all" && !searching.value && !open.value;
  const title = {
    loose: collection.value.run ? "Not replicated, in no group" : "References",
    replicated: "Replicated",
    "left out": "Not mine",
    all: "",
    group: "",
  }[kind];
  return (
    <section aria-label={title || "References"}>
      {title && (
        <h2>
          {open ? (
            <button type="button" class="fold" aria-expanded={!folded} onClick={() => (open.value = folded)}>
              <Icon name={folded ? "right" : "down"} />
              {title} <small>{tiles.length}</small>
            </button>
          ) : (
            <>
              {title} <small>{tiles.length}</small>
            </>
          )}
        </h2>
      )}
      {!folded && <Tiles tiles={tiles} />}
    </section>
  );
}

function NothingFound() {
  const clear = () => {
    search.value = "";
    filter.value = "all";
    tag.value = "";
  };
  return (
    <Empty title="No reference is like that">
      <Button onClick={clear}>Show all</Button>
    </Empty>
  );
}

function NoReferences() {
  return (
    <Empty title="No references yet">
      <DropZone />
    </Empty>
  );
}
