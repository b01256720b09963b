/** Above the tiles: how many are replicated, what is shown, in what order. */

import { signal } from "@preact/signals";
import { createRef } from "preact";
import { collection, tags, tileOf, unsure } from "../state/studio";
import { laying, saveSheet } from "../files/sheet";
import { Button, Segments, Select } from "../ui/controls";
import { Icon } from "../ui/icons";
import { percent } from "../ui/numbers";
import { GradeMark } from "../ui/picture";
import { focusOn } from "./focus";
import { counts, filter, leafed, likeness, search, sort, tag } from "./order";
import type { Filter, Sort } from "./order";
import { Strip } from "./strip";

const FILTERS: { value: Filter; label: string; title: string }[] = [
  { value: "all", label: "All", title: "All references" },
  { value: "different", label: "Different", title: "What the procedure cannot replicate yet" },
  { value: "close", label: "Close", title: "What its replica resembles, but is not the same as" },
  { value: "replicated", label: "Replicated", title: "What the procedure replicates" },
  { value: "turned", label: "Stand another way", title: "Turned, on their heads or mirrored: the explanation says so" },
  { value: "longer", label: "Longer Range", title: "A longer Range would bring it nearer: the explanation says so" },
  { value: "failed", label: "Failed", title: "The procedure gave an error" },
  { value: "duplicates", label: "Duplicates", title: "The same shape, or nearly, more than once" },
  { value: "noted", label: "Noted", title: "With tags or a note" },
  { value: "selected", label: "Selected", title: "What you selected" },
];
const SORTS: { value: Sort; label: string }[] = [
  { value: "groups", label: "Groups, largest first" },
  { value: "worst", label: "Worst first" },
  { value: "best", label: "Best first" },
  { value: "name", label: "Name" },
  { value: "better", label: "Most improved" },
  { value: "worse", label: "Most worsened" },
];

export const searchField = createRef<HTMLInputElement>();

export function Toolbar() {
  return (
    <div class="toolbar">
      <Score />
      <Strip />
      {FILTERS.some(({ value }) => value !== "all" && value !== "different" && counts.value[value] > 0) && <Filters />}
      <TagFilter />
      <Select label="Order" hidden options={sorts()} value={sort.value} onChange={(value) => (sort.value = value)} />
      <Search />
      <Segments
        label="Shown as"
        value={mapped.value ? "map" : "tiles"}
        onChange={(value) => (mapped.value = value === "map")}
        options={[
          { value: "tiles", label: "Tiles" },
          { value: "map", label: "Map", title: "Alike ones near each other, and random shapes among them" },
        ]}
      />
      <SheetButton />
    </div>
  );
}

/** Whether the references are shown on a map. */
export const mapped = signal(false);

function sorts(): { value: Sort; label: string }[] {
  const like = likeness.value && tileOf(likeness.value.slug);
  return like ? [...SORTS, { value: "alike", label: `Like ${like.name}` }] : SORTS;
}

function TagFilter() {
  if (!tags.value.size) return null;
  const options = [...tags.value].map(([name, count]) => ({ value: name, label: `${name} (${count})` }));
  return (
    <Select
      label="Tag"
      hidden
      options={[{ value: "", label: "Any tag" }, ...options]}
      value={tags.value.has(tag.value) ? tag.value : ""}
      onChange={(value) => (tag.value = value)}
    />
  );
}

function SheetButton() {
  const title = "Contact sheet: a picture (PNG) of the tiles as they are ordered and filtered now";
  return <Button icon="sheet" kind="quiet" title={title} disabled={laying.value} onClick={() => void saveSheet()} />;
}

function Score() {
  const { counts, count, criterion, judge, run } = collection.value;
  if (run === null && !collection.value.tiles.some(({ replica }) => replica)) {
    return (
      <div class="score">
        <b>{count}</b> references
      </div>
    );
  }
  return (
    <div class="score">
      <b>{counts.replicated}</b>
      <span>
        of {count} replicated <span class="soft">{count > 0 && percent(counts.replicated / count)}</span>
      </span>
      {judge === "fidelity" && (
        <span>
          <GradeMark grade="close" /> {counts.close} close
        </span>
      )}
      <span>
        <GradeMark grade="different" /> {counts.different} different
      </span>
      <Unsure />
      <span class="soft" title={`Compatible: ${criterion}`}>
        {judge === "fidelity" ? `paper's measure: ${counts.compatible} of ${count}` : "by the paper's measure"}
      </span>
    </div>
  );
}

/** What the count is not sure of. */
function Unsure() {
  const { stale, unmeasured } = unsure.value;
  if (stale === 0 && unmeasured === 0) return null;
  const parts = [
    ...(stale ? [`${stale} by an older version of the procedure`] : []),
    ...(unmeasured ? [`${unmeasured} not measured yet`] : []),
  ];
  return (
    <span class="warn" data-unsure>
      of these {parts.join(", ")}
    </span>
  );
}

function Filters() {
  const some = FILTERS.filter(({ value }) => value === "all" || value === filter.value || counts.value[value] > 0);
  return (
    <Segments
      label="Show"
      value={filter.value}
      onChange={(value) => (filter.value = value)}
      options={some.map(({ value, label, title }) => ({
        value,
        title,
        label: (
          <>
            {label} <small>{counts.value[value]}</small>
          </>
        ),
      }))}
    />
  );
}

function Search() {
  return (
    <label class="search">
      <Icon name="search" />
      <input
        ref={searchField}
        type="search"
        placeholder="Name"
        aria-label="Search by name (/)"
        value={search.value}
        onInput={(event) => (search.value = event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key === "Enter" || event.key === "ArrowDown") {
            event.preventDefault();
            focusOn(leafed.value[0] ?? null);
          } else if (event.key === "Escape") {
            search.value = "";
            event.currentTarget.blur();
          }
        }}
      />
      <kbd>/</kbd>
    </label>
  );
}
