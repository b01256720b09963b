/** What the author notes of the open reference. */

import { sortLike } from "../curating/bar";
import { Mine, Note, Tags } from "../curating/form";
import { go } from "../state/route";
import { duplicateOf, leftOut, tileOf } from "../state/studio";
import { Button } from "../ui/controls";
import type { Slug } from "../wire/messages";

export function NotedOf({ slug }: { slug: Slug }) {
  const twin = duplicateOf.value.get(slug);
  const like = () => void sortLike(slug).then(() => go("collection"));
  return (
    <section class="noted" aria-label="Notes">
      <h3>Notes</h3>
      {twin && (
        <p class="soft">
          {twin.equal ? "The same as" : "Nearly the same as"}{" "}
          <a href={`#inspect/${encodeURIComponent(twin.of)}`}>{tileOf(twin.of)?.name ?? twin.of}</a>
          {twin.quarters > 0 && `, turned by ${90 * twin.quarters}°`}.
        </p>
      )}
      <Tags slugs={[slug]} />
      <Note slug={slug} />
      <div class="row">
        <Mine slugs={[slug]} />
        <Button title="The collection, the most like this one first" onClick={like}>
          Sort by likeness
        </Button>
      </div>
      {leftOut.value.has(slug) && <p class="soft">It does not count, and the next fit does without it.</p>}
    </section>
  );
}
