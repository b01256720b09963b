/** What the procedure and the jobs print, the newest at the end. */

import { useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { inspect } from "../state/route";
import { tileOf } from "../state/studio";
import { Button, Segments } from "../ui/controls";
import { plural } from "../ui/numbers";
import type { Line, Slug } from "../wire/messages";
import { emptyConsole, printed } from "../state/printed";

export function ConsolePanel() {
  const of = useSignal<"all" | "procedure" | "jobs">("all");
  const shown = printed.value.filter(({ speaker }) =>
    of.value === "all" ? true : (speaker === "procedure") === (of.value === "procedure"),
  );
  return (
    <section class="console">
      <header>
        <h2>Console</h2>
        <Segments
          label="Printed by"
          value={of.value}
          onChange={(value) => (of.value = value)}
          options={[
            { value: "all", label: "All", title: "All that was printed" },
            {
              value: "procedure",
              label: "Procedure",
              title: "What the procedure printed while the studio built shapes",
            },
            { value: "jobs", label: "Jobs", title: "What fits, explanations and exports printed" },
          ]}
        />
        <Button disabled={!printed.value.length} title="Empty the console of this page" onClick={emptyConsole}>
          Clear
        </Button>
      </header>
      {shown.length ? (
        <Lines lines={shown} named />
      ) : (
        <p class="soft">What the procedure prints appears here, beside the reference that it was built for.</p>
      )}
    </section>
  );
}

/** What was printed while replicas of one reference were built. */
export function PrintedFor({ slug }: { slug: Slug }) {
  const lines = printed.value.filter((line) => line.slug === slug);
  if (!lines.length) return null;
  return (
    <section class="console">
      <h3>
        Printed <small>{plural(lines.length, "line")}</small>
      </h3>
      <Lines lines={lines.slice(-100)} named={false} />
    </section>
  );
}

/** It stays at its end while nobody has scrolled up. No live region: it would speak all the time. */
function Lines({ lines, named }: { lines: Line[]; named: boolean }) {
  const place = useRef<HTMLDivElement>(null);
  const ends = useRef(true);
  useLayoutEffect(() => {
    if (ends.current && place.current) place.current.scrollTop = place.current.scrollHeight;
  }, [lines.at(-1)?.number]);
  return (
    <div
      class="printed"
      ref={place}
      role="region"
      aria-label="Printed lines"
      tabIndex={0}
      onScroll={({ currentTarget: { scrollTop, scrollHeight, clientHeight } }) =>
        (ends.current = scrollHeight - scrollTop - clientHeight < 8)
      }
    >
      {lines.map(({ number, speaker, slug, text }) => (
        <p key={number}>
          {named &&
            (slug ? (
              <button type="button" class="link" title={`Built for ${slug}`} onClick={() => inspect(slug)}>
                {tileOf(slug)?.name ?? slug}
              </button>
            ) : (
              <span class="soft">{speaker}</span>
            ))}
          <code>{text}</code>
        </p>
      ))}
    </div>
  );
}
