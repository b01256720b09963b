/** Why references differ, collected over the collection: each cause, and whom it befalls. */

import { tintOf } from "../state/scale";
import { inspect } from "../state/route";
import { tiles } from "../state/studio";
import { Picture } from "../ui/picture";
import type { Explanation, SharedCause } from "../wire/messages";

const MOST = 16;

export function Causes({ explanation }: { explanation: Explanation }) {
  const shared = explanation.summary;
  return (
    <section>
      <h2>Why they differ</h2>
      {shared.length === 0 && <p class="soft">No reference has a cause to show.</p>}
      {shared.map((cause, i) => (
        <SharedRow key={i} cause={cause} />
      ))}
    </section>
  );
}

function SharedRow({ cause: { kind, text, references } }: { cause: SharedCause }) {
  const known = references.filter((slug) => tiles.value.has(slug));
  return (
    <div class="cause-row">
      <header>
        <span class="badge cause">{kind.replaceAll("_", " ")}</span>
        <span class="soft">{text}</span>
      </header>
      <div class="for">
        {known.slice(0, MOST).map((slug) => (
          <button
            key={slug}
            type="button"
            class="thumb"
            title={tiles.value.get(slug)?.name}
            onClick={() => inspect(slug)}
          >
            <Picture url={tiles.value.get(slug)?.reference ?? null} tint={tintOf(tiles.value.get(slug))} alt={slug} />
          </button>
        ))}
        {known.length > MOST && <span class="soft">+{known.length - MOST}</span>}
      </div>
    </div>
  );
}
