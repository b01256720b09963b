/** What the judge says of the replica now, and said as found. */

import { change, fit, mark } from "../state/actions";
import { differences, gain, stands, valueOf } from "../state/grades";
import { collection, dimension, fitting, marking, marks, settings, tileOf } from "../state/studio";
import { Button } from "../ui/controls";
import { Icon } from "../ui/icons";
import { fixed, plural, significant } from "../ui/numbers";
import { GradeMark } from "../ui/picture";
import { Spoken } from "../ui/spoken";
import type { Piece } from "../wire/messages";
import { MEASURES } from "../wire/messages/settings";
import { boxOf, pointed } from "./causes";
import { edited } from "./pair/edits";
import { failure, figures, outcome, reference, replica, waiting } from "./pair/session";

export function Figures() {
  const failed = failure.value;
  const now = failed ? null : (figures.value ?? reference.value);
  const { judge } = collection.value;
  const value = now && valueOf(judge, now);
  const found = reference.value && valueOf(judge, reference.value);
  const better = edited.value ? gain(judge, found, value) : null;
  return (
    <section class={`figures ${waiting.value && figures.value ? "waiting" : ""}`}>
      <Spoken text={failed ? "no shape" : value === null ? "" : `${now?.grade ?? ""}, ${fixed(value, 2)}`} />
      <div class="main">
        <GradeMark grade={now && value !== null ? now.grade : null} />
        <output data-figure="value">{fixed(value)}</output>
        <span class={`verdict ${now && value !== null ? now.grade : ""}`}>
          <span data-figure="grade">{failed ? "no shape" : value === null ? "not measured" : now?.grade}</span>
          <small title={cutsSaid()}>{cutsSaid()}</small>
        </span>
        {better !== null && Math.abs(better) >= 0.0005 && (
          <span class={`change ${better > 0 ? "better" : "worse"}`} title={`${fixed(found)} as found`}>
            {better > 0 === (judge === "fidelity") ? "↑" : "↓"}
            {fixed(Math.abs(better))}
          </span>
        )}
      </div>
      <Regions missing={now?.missing ?? []} surplus={now?.surplus ?? []} />
      <p class="paper" title={collection.value.criterion}>
        Paper's: {collection.value.measure} <span data-figure="distance">{fixed(now?.distance)}</span>
        {now && now.distance !== null && (now.compatible ? ", compatible" : ", incompatible")}
      </p>
      <dl>
        {MEASURED.filter((name) => dimension.value === 3 || !SOLID.has(name)).map((name) => (
          <div key={name} title={MEASURES[name]}>
            <dt>{name === "iou" && dimension.value === 2 ? "Area IoU" : SHORT[name]}</dt>
            <dd data-measure-of={name}>{fixed(now?.measures[name], name === "chamfer" ? 4 : 3)}</dd>
          </div>
        ))}
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

const SHORT: Record<string, string> = {
  iou: "Silhouette IoU",
  volume_iou: "Volume IoU",
  f1: "F-score 1 %",
  f2: "F-score 2 %",
  chamfer: "Chamfer",
  depth: "Depth difference",
};
const MEASURED = Object.keys(SHORT);
/** Of meshes alone. */
const SOLID = new Set(["volume_iou", "depth"]);

function cutsSaid(): string {
  const { judge, replicated, close, criterion } = collection.value;
  return judge === "fidelity"
    ? `fidelity; replicated from ${fixed(replicated, 2)}, close from ${fixed(close, 2)}`
    : criterion;
}

/** The largest regions without a counterpart, in words; the stage marks the one that the pointer is on. */
function Regions({ missing, surplus }: { missing: Piece[]; surplus: Piece[] }) {
  const told = differences(missing, surplus);
  return (
    <ul class="regions-said">
      {told.map(({ piece, words }) => (
        <li
          key={words}
          title={words}
          onPointerEnter={() => (pointed.value = boxOf(piece, missing.includes(piece) ? "unexplained" : "surplus"))}
          onPointerLeave={() => (pointed.value = null)}
        >
          {words}
        </li>
      ))}
    </ul>
  );
}

/** A reference that stands another way than its replica, and what to do. */
export function Standing() {
  const pose = tileOf(reference.value?.slug ?? "")?.pose;
  if (!pose) return null;
  const picture = reference.value?.explanation?.causes.find(({ picture }) => picture)?.picture;
  const facing = settings.value?.facing;
  const find = () => void change({ facing: "found" }).then(() => fit());
  return (
    <section class="standing" data-standing>
      <h3>
        <Icon name="turned" /> Stands another way: {stands(pose)}
      </h3>
      {picture && <img src={`data:image/png;base64,${picture}`} alt="The reference as it would fit" />}
      <p>This reference {pose.text}.</p>
      {!pose.on_its_head && !pose.mirrored && facing === "given" && (
        <Button disabled={fitting.value} title="Sets Facing to found in the settings of the loop" onClick={find}>
          Fit with facing found
        </Button>
      )}
    </section>
  );
}

/** Whether the author calls the two the same, whatever the judge says. */
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
        {marks.value.length === 0 ? "The cut follows your marks." : `${plural(marks.value.length, "pair")} marked.`}
        {marking.value.asked.includes(open.slug) && " The judge is not sure of this one: a mark here decides much."}
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
