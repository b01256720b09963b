/** What to write next: changes of the procedure that were tried and helped. */

import { tintOf } from "../state/scale";
import { copy } from "../state/actions";
import { inspect } from "../state/route";
import { procedure, tiles } from "../state/studio";
import { Button } from "../ui/controls";
import { plural } from "../ui/numbers";
import { Picture } from "../ui/picture";
import type { Suggestion } from "../wire/messages";
import { Parts } from "./parts";

const SHOWN = 6;

export function SuggestionCard({ suggestion, index }: { suggestion: Suggestion; index: number }) {
  const { kind, title, text, snippet, picture, references, gain, source } = suggestion;
  return (
    <article class="card suggestion">
      <header>
        <span class="badge cause">{kind.replaceAll("_", " ")}</span>
        <h3>{title}</h3>
        {gain !== null && gain !== undefined && (
          <span class="gain" title="Further references that become replicated, as tried">
            +{gain}
          </span>
        )}
      </header>
      <p>{text}</p>
      {picture && (
        <figure>
          <figcaption class="soft">
            <span>reference</span>
            <span>replica now</span>
            <span>replica then</span>
          </figcaption>
          <img
            src={picture}
            alt="References with what the replica lacks in orange, the replicas now and then"
            loading="lazy"
          />
        </figure>
      )}
      <div class="content">
        {source !== null ? (
          <Parts index={index} title={title} />
        ) : (
          snippet && (
            <pre>
              <code>{snippet}</code>
            </pre>
          )
        )}
        {references.length > 0 && (
          <div class="for">
            {references.slice(0, SHOWN).map((slug) => (
              <button
                key={slug}
                type="button"
                class="thumb"
                title={tiles.value.get(slug)?.name ?? slug}
                onClick={() => inspect(slug)}
              >
                <Picture
                  url={tiles.value.get(slug)?.reference ?? null}
                  tint={tintOf(tiles.value.get(slug))}
                  alt={slug}
                />
              </button>
            ))}
            <span class="soft">{plural(references.length, "reference")}</span>
          </div>
        )}
        {procedure.value.stale && (
          <p class="soft">Tried on the text of the last fit. Applying it keeps what you have written since.</p>
        )}
        {snippet && (
          <div class="row">
            <Button icon="copy" kind="quiet" onClick={() => void copy(snippet, "the snippet")}>
              Copy as text
            </Button>
          </div>
        )}
      </div>
    </article>
  );
}
