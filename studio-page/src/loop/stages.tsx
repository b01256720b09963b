/** The stages of the fit: which are done, which one runs, and how long they took. */

import { elapsedInStage } from "../state/clock";
import { fitting, jobs } from "../state/studio";
import { Icon } from "../ui/icons";
import { duration, percent } from "../ui/numbers";

const WHAT: Record<string, string> = {
  open: "start, and read what it needs",
  sample: "draw parameters and build their shapes",
  render: "draw pictures of the samples",
  train: "learn parameters from pictures",
  describe: "describe the references",
  predict: "predict parameters of the references",
  replicate: "build the replicas",
  refine: "search on from the predictions",
  compare: "measure, and group what differs",
  picture: "draw thumbnails",
  save: "write the run",
};

export function Stages() {
  const job = jobs.fit.value;
  if (!job.stages.length) return <p class="soft">The stages of a fit appear here while it runs.</p>;
  return (
    <ol class="stages">
      {job.stages.map(({ name, done, total, remark, seconds }, i) => {
        const last = i === job.stages.length - 1;
        const running = fitting.value && last;
        const broken = last && (job.state === "cancelled" || job.state === "failed");
        const share = total > 0 ? Math.min(1, done / total) : 0;
        return (
          <li key={i} class={running ? "running" : broken ? "broken" : ""}>
            {running ? <i class="pulse" /> : <Icon name={broken ? "close" : "check"} />}
            <b>{name}</b>
            <span class="soft">{broken ? `${job.state} here` : remark || WHAT[name]}</span>
            <span class="amount">{(running || broken) && total > 1 ? `${done}/${total} · ${percent(share)}` : ""}</span>
            <span class="time">{duration(running ? elapsedInStage("fit") : seconds)}</span>
            {running && (
              <div class="bar">
                <i style={{ width: `${100 * share}%` }} />
              </div>
            )}
          </li>
        );
      })}
    </ol>
  );
}
