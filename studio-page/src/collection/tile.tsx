/** One reference and its replica. */

import { useComputed } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { Badges, Pick } from "../curating/badges";
import { extend, toggle } from "../curating/selection";
import { tintOf } from "../state/scale";
import { gain, NOTED, stands, valueOf } from "../state/grades";
import { inspect } from "../state/route";
import { collection, settings } from "../state/studio";
import { Icon } from "../ui/icons";
import { fixed } from "../ui/numbers";
import { GradeMark, Picture } from "../ui/picture";
import type { Tile } from "../wire/messages";
import { at } from "./focus";
import { entry, leafed } from "./order";
import { watch } from "./visible";

const STAGES: Partial<Record<Tile["stage"], [string, string]>> = {
  carried: ["carried", "Parameters carried over from the version before"],
  early: ["early", "The most similar of the first samples"],
  predicted: ["predicted", "As predicted, before the search"],
};

/** Drawn anew only when its tile changes: there may be hundreds, and a fit changes them often. */
export function TileCard({ tile, children }: Props) {
  return useMemo(
    () => <Card tile={tile}>{children}</Card>,
    [tile, children, collection.value.judge, settings.value?.scale],
  );
}

interface Props {
  tile: Tile;
  children?: ComponentChildren;
}

function Card({ tile, children }: Props) {
  const stage = STAGES[tile.stage];
  const { slug } = tile;
  const button = useRef<HTMLButtonElement>(null);
  useEffect(() => watch(button.current!), [slug]);
  const tabIndex = useComputed(() => (entry.value === slug ? 0 : -1));
  return (
    <article class={`tile ${tile.stale ? "stale" : ""}`}>
      <Pick slug={slug} name={tile.name} order={() => leafed.value} />
      <button
        type="button"
        class="pair"
        ref={button}
        data-tile={tile.slug}
        tabIndex={tabIndex}
        aria-label={`${tile.name}, ${describe(tile)}`}
        onFocus={() => (at.value = tile.slug)}
        onClick={(event) => {
          if (event.shiftKey) extend(slug, leafed.value);
          else if (event.ctrlKey || event.metaKey) toggle(slug);
          else inspect(slug);
        }}
      >
        <Picture url={tile.reference} tint={null} alt="reference" />
        <Picture url={tile.replica} tint={tintOf(tile)} alt="replica" dim={tile.stale} />
      </button>
      <footer onClick={() => inspect(tile.slug)}>
        <span class="name" title={tile.name}>
          {tile.name}
        </span>
        <Badges slug={slug} />
        {tile.problem && (
          <span class="badge bad" title={tile.problem.message}>
            <Icon name="warn" />
          </span>
        )}
        {tile.pose && (
          <span class="badge warn" title={tile.pose.text}>
            <Icon name="turned" />
            <span>{stands(tile.pose)}</span>
          </span>
        )}
        {tile.longer.length > 0 && (
          <span class="badge warn" title={`A longer Range would bring it nearer: ${tile.longer.join(", ")}`}>
            <Icon name="limit" />
          </span>
        )}
        {tile.stale ? (
          <span class="badge" title="Made by an older version of the procedure">
            stale
          </span>
        ) : (
          stage && (
            <span class="badge" title={stage[1]}>
              {stage[0]}
            </span>
          )
        )}
        <Change tile={tile} />
        {tile.replica && (
          <span class="value" title={describe(tile)}>
            <GradeMark grade={measured(tile) ? tile.grade : null} />
            {fixed(valueOf(collection.value.judge, tile), 2)}
          </span>
        )}
      </footer>
      {children}
    </article>
  );
}

function describe(tile: Tile): string {
  if (tile.problem) return tile.problem.message;
  if (!measured(tile)) return "not measured yet";
  const paper = `${tile.compatible ? "compatible" : "incompatible"} by the paper's measure, at ${fixed(tile.distance)}`;
  const posed = tile.pose ? `; ${tile.pose.text}` : "";
  return `${tile.grade}${tile.fidelity === null ? "" : `, fidelity ${fixed(tile.fidelity, 2)}`}; ${paper}${posed}`;
}

const measured = (tile: Tile): boolean => valueOf(collection.value.judge, tile) !== null;

/** By how much it became better or worse since the run before, where that is worth saying. */
function Change({ tile }: { tile: Tile }) {
  const { judge } = collection.value;
  const better = gain(judge, tile.previous, valueOf(judge, tile));
  if (better === null || Math.abs(better) < NOTED[judge]) return null;
  return (
    <span
      class={`change ${better > 0 ? "better" : "worse"}`}
      title={`${better > 0 ? "Better" : "Worse"}: ${fixed(tile.previous, 2)} in the run before`}
    >
      {better > 0 === (judge === "fidelity") ? "↑" : "↓"}
      {fixed(Math.abs(better), 2)}
    </span>
  );
}
