/** Above the tiles: how many are compatible, what is shown, in what order. */

import { createRef } from "preact";
import { collection } from "../state/studio";
import { Segments, Select } from "../ui/controls";
import { Icon } from "../ui/icons";
import { percent } from "../ui/numbers";
import { focusOn } from "./focus";
import { counts, filter, leafed, search, sort } from "./order";
import type { Filter, Sort } from "./order";
import { Strip } from "./strip";

const FILTERS: { value: Filter; label: string; title: string }[] = [
  { value: "all", label: "All", title: "All references" },
  { value: "incompatible", label: "Incompatible", title: "What the procedure cannot replicate yet" },
  { value: "compatible", label: "Compatible", title: "What the procedure replicates" },
  { value: "limit", label: "At limit", title: "A parameter rests on the end of its Range" },
  { value: "failed", label: "Failed", title: "The procedure gave an error" },
];
const SORTS: { value: Sort; label: string }[] = [
  { value: "groups", label: "Groups, largest first" },
  { value: "farthest", label: "Farthest first" },
  { value: "nearest", label: "Nearest first" },
  { value: "name", label: "Name" },
  { value: "better", label: "Most improved" },
  { value: "worse", label: "Most worsened" },
];

export const searchField = createRef<HTMLInputElement>();

export function Toolbar() {
  const { compatible, count, run } = collection.value;
  return (
    <div class="toolbar">
      <div class="score">
        <b>{run === null && compatible === 0 ? count : compatible}</b>
        {run === null && compatible === 0 ? (
          <span>references</span>
        ) : (
          <span>
            of {count} compatible <span class="soft">{count > 0 && percent(compatible / count)}</span>
          </span>
        )}
      </div>
      <Strip />
      {collection.value.tiles.some(({ replica }) => replica) && <Filters />}
      <Select label="Order" hidden options={SORTS} value={sort.value} onChange={(value) => (sort.value = value)} />
      <Search />
    </div>
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
