/** How near the replica is now, and was as found. */

import { mark } from "../state/actions";
import { collection, dimension, marks } from "../state/studio";
import { Button } from "../ui/controls";
import { fixed, plural, significant } from "../ui/numbers";
import { Dot } from "../ui/picture";
import { edited, failure, figures, outcome, reference, replica, waiting } from "./pair/session";

export function Figures() {
  const now = figures.value ?? reference.value;
  const found = reference.value?.distance ?? null;
  const moved = edited.value && now?.distance != null && found !== null ? now.distance - found : null;
  const failed = failure.value;
  return (
    <section class={`figures ${waiting.value && figures.value ? "waiting" : ""}`} aria-live="polite">
      <div class="main">
        <Dot colour={failed ? null : (now?.colour ?? null)} />
        <output data-figure="distance">{failed ? "–" : fixed(now?.distance)}</output>
        <span class={`verdict ${now?.compatible && !failed ? "good" : ""}`}>
          {failed
            ? "no shape"
            : now?.distance == null
              ? "not measured"
              : now.compatible
                ? "compatible"
                : "incompatible"}
          <small>{collection.value.criterion}</small>
        </span>
        {moved !== null && Math.abs(moved) >= 0.0005 && (
          <span class={`change ${moved < 0 ? "better" : "worse"}`} title={`${fixed(found)} as found`}>
            {moved < 0 ? "↓" : "↑"}
            {fixed(Math.abs(moved))}
          </span>
        )}
      </div>
      <dl>
        <div title="Overlap of the silhouettes: 1 is perfect">
          <dt>IoU</dt>
          <dd>{fixed(failed ? null : now?.iou)}</dd>
        </div>
        {dimension.value === 3 && (
          <div title="Mean distance of the surfaces, as part of the largest extent">
            <dt>Chamfer</dt>
            <dd>{fixed(failed ? null : now?.chamfer, 4)}</dd>
          </div>
        )}
        <div title="Time that the procedure took">
          <dt>Built in</dt>
          <dd>{outcome.value ? `${significant(outcome.value.milliseconds, 2)} ms` : "–"}</dd>
        </div>
      </dl>
      {failed && (
        <div class="failure">
          <p>{failed.message}</p>
          {failed.line !== null && (
            <code>
              {failed.file}:{failed.line} {failed.text?.trim()}
            </code>
          )}
          {replica.value && <p class="soft">Shown is the last replica that could be built.</p>}
        </div>
      )}
    </section>
  );
}

/** Whether the author calls the two the same, whatever the distance says. */
export function Judgement() {
  const open = reference.value;
  if (!open) return null;
  const given = marks.value.find(({ a, b }) => a === open.slug && b === open.slug)?.same;
  const say = (same: boolean) => mark(open.slug, open.slug, given === same ? null : same);
  return (
    <section class="judgement">
      <h3>To your eye</h3>
      <div class="row">
        <Button pressed={given === true} title="Mark this pair as the same (s)" onClick={() => say(true)}>
          the same
        </Button>
        <Button pressed={given === false} title="Mark this pair as different (x)" onClick={() => say(false)}>
          different
        </Button>
      </div>
      <p class="soft">
        {marks.value.length === 0
          ? "Marks tell what the threshold should be."
          : `${plural(marks.value.length, "pair")} marked.`}
      </p>
    </section>
  );
}

export function Facts() {
  const open = reference.value;
  if (!open) return null;
  const size = open.units?.size.map((side) => significant(side, 4)).join(" × ");
  return (
    <section class="facts">
      <h3>Reference</h3>
      <dl>
        {size && (
          <div>
            <dt>Size</dt>
            <dd title="Extents along the axes of its file, in its own units">{size}</dd>
          </div>
        )}
        {open.triangles !== null && (
          <div>
            <dt>Triangles</dt>
            <dd>{open.triangles.toLocaleString()}</dd>
          </div>
        )}
        {open.path && (
          <div>
            <dt>File</dt>
            <dd>
              <code>{open.path}</code>
            </dd>
          </div>
        )}
      </dl>
      {open.notes.map((note) => (
        <p class="soft" key={note}>
          {note}
        </p>
      ))}
    </section>
  );
}
