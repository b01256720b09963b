/** Pairs that the author called the same or different. */

import { mark } from "../state/actions";
import { inspect } from "../state/route";
import { collection, marks, tiles } from "../state/studio";
import { Button } from "../ui/controls";
import { fixed } from "../ui/numbers";
import { Dot, Picture } from "../ui/picture";
import type { Mark } from "../wire/messages";

export function Marks() {
  const known = marks.value.filter(({ a, b }) => tiles.value.has(a) && tiles.value.has(b));
  return (
    <section>
      <h2>
        Marked pairs <small>{known.length}</small>
      </h2>
      {known.length === 0 ? (
        <p class="soft">
          Open a pair and say whether it is the same or different to your eye (keys s and x). From some marks of each
          kind, a threshold that means what you mean can be found; it is {fixed(collection.value.threshold, 2)} now.
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
        <span class="distance">
          <Dot colour={a.colour} />
          {fixed(a.distance)}
        </span>
      )}
      <span class={`badge ${one.same ? "good" : "bad"}`}>{one.same ? "same" : "different"}</span>
      <Button kind="quiet" icon="close" title="Take this mark away" onClick={() => mark(one.a, one.b, null)} />
    </li>
  );
}
