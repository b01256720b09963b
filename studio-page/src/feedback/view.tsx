/** Feedback: why references differ, what to write next, and what the author thinks the same. */

import { useSignal, useSignalEffect } from "@preact/signals";
import { cancel, explain } from "../state/actions";
import { left } from "../state/clock";
import { complain } from "../state/notices";
import { collection, explained, jobs } from "../state/studio";
import { Button } from "../ui/controls";
import { duration, percent } from "../ui/numbers";
import type { Explanation } from "../wire/messages";
import { requests } from "../wire/requests";
import { Causes } from "./causes";
import { Marks } from "./marks";
import { Misfits } from "./misfits";
import { SuggestionCard } from "./suggestions";
import { TriedChanges, spent } from "./tried";

export function FeedbackView() {
  const explanation = useSignal<Explanation | null>(null);
  useSignalEffect(() => {
    const { run } = collection.value;
    if (!explained.value) {
      explanation.value = null;
      return;
    }
    requests
      .explanation()
      .then((found) => {
        if (collection.peek().run === run) explanation.value = found;
      })
      .catch(complain);
  });
  const found = explanation.value;
  return (
    <div class="feedback">
      <div class="main">
        {found ? (
          <>
            <section>
              <header>
                <h2>
                  What to write next <small>{found.suggestions.length}</small>
                </h2>
                <Explain again />
              </header>
              {found.sample && <p class="soft">{found.sample.text}</p>}
              {found.suggestions.length === 0 && (
                <p class="soft">
                  {found.unsuggested ??
                    `Nothing is suggested: no change that was tried makes a reference replicated.${spent(found)}`}
                </p>
              )}
              <div class="cards">
                {found.suggestions.map((suggestion, i) => (
                  <SuggestionCard key={i} suggestion={suggestion} index={i} />
                ))}
              </div>
              <TriedChanges explanation={found} />
            </section>
            <Causes explanation={found} />
          </>
        ) : (
          <section class="unexplained">
            <h2>Why they differ, and what to write next</h2>
            <p class="soft">
              {collection.value.run === null
                ? "After the first fit, what differs can be explained here."
                : "For every reference that is not replicated: where it differs, why, and which change of the procedure would help. Each suggestion is tried before it is shown."}
            </p>
            <Explain />
            <Misfits />
          </section>
        )}
      </div>
      <aside>
        <Marks />
      </aside>
    </div>
  );
}

function Explain({ again = false }: { again?: boolean }) {
  const job = jobs.explain.value;
  const stage = job.stages.at(-1);
  const about = left("explain");
  if (job.state === "running" || job.state === "cancelling") {
    return (
      <div class="row">
        <span class="soft">
          {stage?.name ?? "starting"} {stage && stage.total > 1 ? percent(stage.done / stage.total) : "…"}
          {about !== null && ` about ${duration(Math.ceil(about))} left`}
        </span>
        <Button disabled={job.state === "cancelling"} onClick={() => cancel("explain")}>
          Cancel
        </Button>
      </div>
    );
  }
  return (
    <div class="row">
      <Button kind={again ? "plain" : "primary"} disabled={collection.value.run === null} onClick={explain}>
        {again ? "Explain again" : "Explain this run"}
      </Button>
      {job.problem && <span class="bad">{job.problem.message}</span>}
    </div>
  );
}
