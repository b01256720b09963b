/** Pairs that the author called the same or different. */

import { mark } from "../state/actions";
import { inspect } from "../state/route";
import { valueOf } from "../state/grades";
import { collection, marking, marks, tiles } from "../state/studio";
import { Button } from "../ui/controls";
import { fixed, plural } from "../ui/numbers";
import { GradeMark, Picture } from "../ui/picture";
import type { Learned, Mark } from "../wire/messages";

export function Marks() {
  const known = marks.value.filter(({ a, b }) => tiles.value.has(a) && tiles.value.has(b));
  return (
    <section>
      <h2>
        Marked pairs <small>{known.length}</small>
      </h2>
      {marking.value.learned && <p class="soft">{cutSaid(marking.value.learned)}</p>}
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

function Line({ one }: { one: Mark }) {
  const [a, b] = [tiles.value.get(one.a)!, tiles.value.get(one.b)!];
  const own = one.a === one.b;
  return (
    <li>
      <button type="button" class="thumb" title={a.name} onClick={() => inspect(a.slug)}>
        <Picture url={a.reference} tint={null} alt={a.name} />
      </button>
      <button type="button" class="thumb" title={own ? `replica of ${a.name}` : b.name} onClick={() => inspect(b.slug)}>
        <Picture url={own ? a.replica : b.reference} tint={own ? a.colour : null} alt={b.name} />
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
