/** The stages of the fit: which are done, which one runs, and how long they took. */

import { fitting, jobs } from "../state/studio";
import { Icon } from "../ui/icons";
import { duration, percent } from "../ui/numbers";

const WHAT: Record<string, string> = {
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
        const running = fitting.value && i === job.stages.length - 1;
        const share = total > 0 ? Math.min(1, done / total) : 0;
        return (
          <li key={i} class={running ? "running" : ""}>
            {running ? <i class="pulse" /> : <Icon name="check" />}
            <b>{name}</b>
            <span class="soft">{remark || WHAT[name]}</span>
            <span class="amount">{running && total > 1 ? `${done}/${total} · ${percent(share)}` : ""}</span>
            <span class="time">{duration(seconds)}</span>
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
