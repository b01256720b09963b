/** Why references differ, collected over the collection: each cause, and whom it befalls. */

import { inspect } from "../state/route";
import { tiles } from "../state/studio";
import { plural } from "../ui/numbers";
import { Picture } from "../ui/picture";
import type { Explanation, Slug } from "../wire/protocol";

const MOST = 14;

export function Causes({ explanation }: { explanation: Explanation }) {
  const byKind = new Map<string, { slug: Slug; text: string }[]>();
  for (const [slug, { causes }] of Object.entries(explanation.references)) {
    for (const { kind, text } of causes) byKind.set(kind, [...(byKind.get(kind) ?? []), { slug, text }]);
  }
  const kinds = [...byKind].sort(([, a], [, b]) => b.length - a.length);
  return (
    <section>
      <h2>Why they differ</h2>
      {kinds.length === 0 && <p class="soft">No reference has a cause to show.</p>}
      {kinds.map(([kind, found]) => (
        <div class="cause-row" key={kind}>
          <header>
            <span class="badge cause">{kind.replaceAll("_", " ")}</span>
            <span class="soft">{plural(new Set(found.map(({ slug }) => slug)).size, "reference")}</span>
          </header>
          <div class="for">
            {found.slice(0, MOST).map(({ slug, text }, i) => (
              <button key={i} type="button" class="thumb" title={`${tiles.value.get(slug)?.name ?? slug}: ${text}`} onClick={() => inspect(slug)}>
                <Picture url={tiles.value.get(slug)?.reference ?? null} tint={tiles.value.get(slug)?.colour ?? null} alt={slug} />
              </button>
            ))}
            {found.length > MOST && <span class="soft">+{found.length - MOST}</span>}
          </div>
        </div>
      ))}
    </section>
  );
}
