/** Tags, a note, and whether a reference belongs to the collection: of one, or of all that are selected. */

import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { tags } from "../state/studio";
import { Button } from "../ui/controls";
import type { Slug } from "../wire/messages";
import { note, notedOf } from "./actions";

const PAUSE = 1200;

export function Tags({ slugs }: { slugs: Slug[] }) {
  const text = useSignal("");
  const counts = new Map<string, number>();
  for (const slug of slugs) for (const tag of notedOf(slug).tags) counts.set(tag, (counts.get(tag) ?? 0) + 1);
  const add = (event: Event) => {
    event.preventDefault();
    const news = text.value.split(",").map((one) => one.trim()).filter(Boolean); // prettier-ignore
    if (news.length) note(slugs, { add: news }, `Tagged ${news.join(", ")}`);
    text.value = "";
  };
  return (
    <form class="tags-form" onSubmit={add}>
      {[...counts].map(([tag, count]) => (
        <span key={tag} class="badge tag" data-tag={tag}>
          {tag}
          {count < slugs.length && <small> {count}</small>}
          <button
            type="button"
            aria-label={`Take the tag ${tag} away`}
            title={`Take the tag ${tag} away`}
            onClick={() => note(slugs, { remove: [tag] }, `No longer ${tag}`)}
          >
            ×
          </button>
        </span>
      ))}
      <input
        type="text"
        list="known-tags"
        maxLength={40}
        placeholder="Tag"
        aria-label="Add a tag"
        value={text.value}
        onInput={(event) => (text.value = event.currentTarget.value)}
      />
      <datalist id="known-tags">
        {[...tags.value.keys()].map((tag) => (
          <option key={tag} value={tag} />
        ))}
      </datalist>
    </form>
  );
}

/** What is typed is kept a moment after the last letter, and at once where the field is left. */
export function Note({ slug }: { slug: Slug }) {
  const field = useRef<HTMLTextAreaElement>(null);
  const timer = useRef(0);
  const { note: kept } = notedOf(slug);
  useEffect(() => {
    const here = field.current!;
    if (document.activeElement !== here) here.value = kept;
  }, [slug, kept]);
  const save = () => {
    window.clearTimeout(timer.current);
    const text = field.current?.value.trim();
    if (text !== undefined && text !== notedOf(slug).note) note([slug], { note: text }, null);
  };
  useEffect(() => {
    window.addEventListener("pagehide", save);
    return () => {
      save();
      window.removeEventListener("pagehide", save);
    };
  }, [slug]);
  return (
    <textarea
      ref={field}
      class="note"
      rows={2}
      maxLength={4000}
      placeholder="A note to yourself"
      aria-label="Note"
      onInput={() => {
        window.clearTimeout(timer.current);
        timer.current = window.setTimeout(save, PAUSE);
      }}
      onBlur={save}
    />
  );
}

export function Mine({ slugs }: { slugs: Slug[] }) {
  const out = slugs.filter((slug) => notedOf(slug).not_mine);
  const all = out.length === slugs.length;
  return (
    <Button
      pressed={all}
      title={
        all ? "Count it again, and let the next fit take it" : "It leaves the count, and the next fit does without"
      }
      onClick={() => note(slugs, { not_mine: !all }, all ? "Yours again" : "Not yours")}
    >
      Not mine
    </Button>
  );
}
