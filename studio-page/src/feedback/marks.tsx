/** Pairs that the author called the same or different. */

import { tintOf } from "../state/scale";
import { change, mark } from "../state/actions";
import { inspect } from "../state/route";
import { valueOf } from "../state/grades";
import { collection, marking, marks, settings, tiles } from "../state/studio";
import { Button } from "../ui/controls";
import { fixed, plural } from "../ui/numbers";
import { GradeMark, Picture } from "../ui/picture";
import type { ChosenSettings, Judge, Learned, Mark, Tile } from "../wire/messages";
import { SETTINGS } from "../wire/messages/settings";

export function Marks() {
  const known = marks.value.filter(({ a, b }) => tiles.value.has(a) && tiles.value.has(b));
  return (
    <section>
      <h2>
        Marked pairs <small>{known.length}</small>
      </h2>
      {marking.value.learned && <Cut learned={marking.value.learned} />}
      {known.length === 0 ? (
        <p class="soft">
          Open a pair and say whether it is the same or different to your eye (keys s and x), or mark those that the
          collection asks for. The cut follows your marks.
        </p>
      ) : (
        <ul class="marks">
          {known.map((one) => (
            <Line key={`${one.a}/${one.b}`} one={one} />
          ))}
        </ul>
      )}
    </section>
  );
}

/** What the marks say of the cut. */
export function cutSaid({ judge, count, cut, agrees, usual, usual_agrees }: Learned): string {
  const what = judge === "fidelity" ? "Replicated is a fidelity of at least" : "Compatible is a distance of at most";
  const without = cut === usual ? "as without marks" : `${fixed(usual)} without marks agrees with ${usual_agrees}`;
  return `${what} ${fixed(cut)}: it agrees with ${agrees} of ${plural(count, "mark")} (${without}).`;
}

/** The cut that the marks ask for: what would change with it, and a button to use it. */
function Cut({ learned }: { learned: Learned }) {
  const now = settings.value;
  if (!now) return null;
  const byFidelity = learned.judge === "fidelity";
  const [asked, usual] = [cutOf(learned.judge, learned.cut), cutOf(learned.judge, learned.usual)];
  const inForce = holds(now, asked);
  const { gained, lost } = turning(byFidelity ? learned.cut : null);
  return (
    <div class="cut" data-cut={inForce ? "holds" : "open"}>
      <p>{cutSaid(learned)}</p>
      {inForce ? (
        <p class="soft">This cut holds{byFidelity ? "" : " from the next fit on"}.</p>
      ) : (
        <p class="soft">
          {byFidelity
            ? `Now it is ${fixed(now.replicated)}. With the marks' cut ${changed(gained, lost)}`
            : `The next fit has ${fixed(now.threshold)}; with the marks' threshold it would have ${fixed(learned.cut)}.`}
        </p>
      )}
      <div class="row">
        {!inForce && <Button kind="primary" onClick={() => void change(asked)}>{`Use ${fixed(learned.cut)}`}</Button>}
        {!holds(now, usual) && (
          <Button
            title="The cut without marks"
            onClick={() => void change(usual)}
          >{`Use ${fixed(learned.usual)}, as without marks`}</Button>
        )}
      </div>
    </div>
  );
}

type Cuts = Partial<Pick<ChosenSettings, "replicated" | "close" | "threshold">>;

/** The settings that go with a cut: close begins no later than replicated. */
function cutOf(judge: Judge, cut: number): Cuts {
  if (judge === "paper") return { threshold: cut };
  return { replicated: cut, close: Math.min(CLOSE, cut) };
}

const CLOSE = SETTINGS.close.usual;
const holds = (now: ChosenSettings, cuts: Cuts): boolean =>
  (Object.keys(cuts) as (keyof Cuts)[]).every((name) => Math.abs(now[name] - cuts[name]!) < 1e-9);

/** Names of the references that another cut of the fidelity would make replicated, or would make so no longer. */
function turning(cut: number | null): { gained: string[]; lost: string[] } {
  const measured = collection.value.tiles.filter(({ fidelity }) => cut !== null && fidelity !== null);
  const named = (some: Tile[]) => some.map(({ name }) => name);
  return {
    gained: named(measured.filter(({ fidelity, grade }) => fidelity! >= cut! && grade !== "replicated")),
    lost: named(measured.filter(({ fidelity, grade }) => fidelity! < cut! && grade === "replicated")),
  };
}

function changed(gained: string[], lost: string[]): string {
  if (!gained.length && !lost.length) return "no reference changes its grade.";
  const listed = (names: string[]) => (names.length > 4 ? `${names.slice(0, 4).join(", ")} …` : names.join(", "));
  const more = gained.length ? [`${gained.length} more would be replicated (${listed(gained)})`] : [];
  const less = lost.length ? [`${lost.length} would no longer be (${listed(lost)})`] : [];
  return `${[...more, ...less].join(", and ")}.`;
}

function Line({ one }: { one: Mark }) {
  const [a, b] = [tiles.value.get(one.a)!, tiles.value.get(one.b)!];
  const own = one.a === one.b;
  return (
    <li>
      <button type="button" class="thumb" title={a.name} onClick={() => inspect(a.slug)}>
        <Picture url={a.reference} tint={null} alt={a.name} />
      </button>
      <button type="button" class="thumb" title={own ? `replica of ${a.name}` : b.name} onClick={() => inspect(b.slug)}>
        <Picture url={own ? a.replica : b.reference} tint={own ? tintOf(a) : null} alt={b.name} />
      </button>
      <span class="name">{own ? a.name : `${a.name}, ${b.name}`}</span>
      {own && (
        <span class="value">
          <GradeMark grade={a.grade} />
          {fixed(valueOf(collection.value.judge, a), 2)}
        </span>
      )}
      <span class={`badge ${one.same ? "good" : "bad"}`}>{one.same ? "same" : "different"}</span>
      <Button kind="quiet" icon="close" title="Take this mark away" onClick={() => mark(one.a, one.b, null)} />
    </li>
  );
}
