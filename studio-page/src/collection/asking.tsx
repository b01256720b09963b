/** Pairs to mark: those of which the judge is least sure. */

import { signal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { mark } from "../state/actions";
import { valueOf } from "../state/grades";
import { inspect } from "../state/route";
import { collection, marking, tileOf } from "../state/studio";
import { Button } from "../ui/controls";
import { cutSaid } from "../feedback/marks";
import { fixed, plural } from "../ui/numbers";
import { GradeMark, Picture } from "../ui/picture";
import type { Slug, Tile } from "../wire/messages";

const away = signal(false);
/** The pair that was marked last here. */
const last = signal<{ slug: Slug; same: boolean } | null>(null);

export function Asking() {
  // A mark notes what the run measured, so it is asked for only while the run's replica is shown.
  const asked = marking.value.asked.flatMap((slug) => {
    const tile = tileOf(slug);
    return tile && tile.stage === "trained" && !tile.stale ? [tile] : [];
  });
  const self = useRef<HTMLElement>(null);
  const shown = asked.map(({ slug }) => slug).join();
  useLayoutEffect(() => {
    // The pair that had the focus is marked and gone: the next one gets it.
    const lost = document.activeElement === null || document.activeElement === document.body;
    if (lost && last.peek()) self.current?.querySelector<HTMLElement>(".row button")?.focus({ preventScroll: true });
  }, [shown]);
  if (away.value || (!asked.length && !last.value)) return null;
  const { learned } = marking.value;
  return (
    <section class="asking" aria-label="Pairs to mark" ref={self}>
      <header>
        <h2>
          {asked.length
            ? `Mark ${asked.length === 1 ? "this pair: it decides" : `these ${plural(asked.length, "pair")}: they decide`} most`
            : "Nothing more to mark"}
        </h2>
        <Button kind="quiet" icon="close" title="Put these away until the page is opened again" onClick={putAway} />
      </header>
      <p class="soft">
        The judge is least sure of these. Are reference and replica the same to your eye?{" "}
        {collection.value.judge === "fidelity" ? "The cut follows" : "The threshold of the next fit follows"} your
        marks.
      </p>
      <ul>
        {asked.map((tile) => (
          <Pair key={tile.slug} tile={tile} />
        ))}
      </ul>
      <p role="status">
        {learned && cutSaid(learned)} <Undo />
      </p>
    </section>
  );
}

const putAway = () => (away.value = true);

function say(slug: Slug, same: boolean): void {
  last.value = { slug, same };
  mark(slug, slug, same);
}

function Pair({ tile }: { tile: Tile }) {
  const { slug, name } = tile;
  return (
    <li class="card" data-asked={slug} aria-label={name}>
      <button type="button" class="pair" aria-label={`${name}, open`} onClick={() => inspect(slug)}>
        <Picture url={tile.reference} tint={null} alt="reference" />
        <Picture url={tile.replica} tint={null} alt="replica" />
      </button>
      <p>
        <span class="name">{name}</span>
        <span class="value">
          <GradeMark grade={tile.grade} />
          {fixed(valueOf(collection.value.judge, tile), 2)}
        </span>
      </p>
      <div class="row">
        <Button title={`${name}: the same`} onClick={() => say(slug, true)}>
          the same
        </Button>
        <Button title={`${name}: not the same`} onClick={() => say(slug, false)}>
          not the same
        </Button>
      </div>
    </li>
  );
}

function Undo() {
  const marked = last.value;
  const name = marked && tileOf(marked.slug)?.name;
  if (!marked || !name) return null;
  const undo = () => {
    mark(marked.slug, marked.slug, null);
    last.value = null;
  };
  return (
    <span>
      {name}: {marked.same ? "the same" : "not the same"}{" "}
      <Button kind="quiet" icon="reset" title={`Take the mark of ${name} away`} onClick={undo}>
        Undo
      </Button>
    </span>
  );
}
