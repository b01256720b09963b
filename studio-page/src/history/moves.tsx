/** References that changed sides, or moved, between two iterations. */

import { tintOf } from "../state/scale";
import { inspect } from "../state/route";
import { tiles } from "../state/studio";
import { fixed } from "../ui/numbers";
import { GradeMark, Picture } from "../ui/picture";
import type { Comparison, Move } from "../wire/messages";

const KINDS = [
  { kind: "gained", title: "Newly replicated" },
  { kind: "lost", title: "No longer replicated" },
  { kind: "closer", title: "Better, same side of the cut" },
  { kind: "further", title: "Worse, same side of the cut" },
] as const;

export function Moves({ comparison }: { comparison: Comparison }) {
  const some = KINDS.filter(({ kind }) => comparison[kind].length > 0);
  const { same, added, removed, judge } = comparison;
  return (
    <div class="moves">
      {some.length === 0 && <p class="soft">No reference has changed between the two.</p>}
      {some.map(({ kind, title }, i) => (
        <section key={kind} class={kind}>
          <h2>
            {title} <small>{comparison[kind].length}</small>
            {i === 0 && (
              <span class="soft">
                reference, {comparison.before.run}, {comparison.after.run}
              </span>
            )}
          </h2>
          <div class="tiles">
            {comparison[kind].map((move) => (
              <MoveCard key={move.name} move={move} />
            ))}
          </div>
        </section>
      ))}
      <p class="soft">
        {same} stayed where they were.{" "}
        {judge === "fidelity"
          ? "Numbers are fidelities."
          : "Numbers are distances by the paper's measure, which judges here."}
        {added.length > 0 && ` New references: ${added.join(", ")}.`}
        {removed.length > 0 && ` Gone: ${removed.join(", ")}.`}
      </p>
    </div>
  );
}

function MoveCard({ move }: { move: Move }) {
  const slug = move.slug !== null && tiles.value.has(move.slug) ? move.slug : null;
  return (
    <article class="tile move">
      <button
        type="button"
        class="pair"
        disabled={slug === null}
        aria-label={move.name}
        onClick={() => slug !== null && inspect(slug)}
      >
        <Picture url={move.reference} tint={null} alt="reference" />
        <Picture
          url={move.replica_before}
          tint={tintOf({ grade: move.grade_before, distance: null, colour: move.colour_before })}
          alt="before"
        />
        <Picture
          url={move.replica_after}
          tint={tintOf({ grade: move.grade_after, distance: null, colour: move.colour_after })}
          alt="after"
        />
      </button>
      <footer>
        <span class="name" title={move.name}>
          {move.name}
        </span>
        <span class="value">
          <GradeMark grade={move.before === null ? null : move.grade_before} />
          {fixed(move.before, 2)}
        </span>
        <span class="value">
          → <GradeMark grade={move.after === null ? null : move.grade_after} />
          {fixed(move.after, 2)}
        </span>
      </footer>
    </article>
  );
}
