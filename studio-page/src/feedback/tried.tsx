/** What was tried, whether or not it is suggested, how far it got, and what it cost. */

import { duration, fixed, plural } from "../ui/numbers";
import type { Explanation } from "../wire/messages";

/** How long changes were looked for and tried, as a sentence; empty where nobody knows. */
export function spent({ seconds }: Explanation): string {
  const took = (seconds?.hypotheses ?? 0) + (seconds?.trials ?? 0);
  return took > 0 ? ` Looking for changes and trying them took ${duration(took)}.` : "";
}

export function TriedChanges({ explanation }: { explanation: Explanation }) {
  const { tried = [], suggestions } = explanation;
  if (!tried.length) return null;
  return (
    <details class="tried" open={!suggestions.length}>
      <summary>{plural(tried.length, "change")} tried</summary>
      <table>
        <thead>
          <tr>
            <th>change</th>
            <th>kind</th>
            <th>references nearer</th>
            <th title="How far the nearest is from a perfect replica: at most 1 is replicated">
              best, replicated from 1 down
            </th>
            <th>time</th>
          </tr>
        </thead>
        <tbody>
          {tried.map(({ title, kind, nearer, best, seconds }, i) => (
            <tr key={i}>
              <td>{title}</td>
              <td>{kind}</td>
              <td>{nearer}</td>
              <td>{best === null ? "–" : fixed(best, 2)}</td>
              <td>{duration(seconds)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </details>
  );
}
