/** Lines of two texts: what was removed, what was added, and what lies around. */

import type { DiffLine } from "../wire/messages";

const SIGNS = { same: "", added: "+", removed: "−" } as const;

/** lines: in order; where some are left out, their numbers leap. */
export function Lines({ lines }: { lines: DiffLine[] }) {
  let before = 0;
  let after = 0;
  return (
    <table class="lines">
      <tbody>
        {lines.map((line, i) => {
          const follows = line.before === null ? line.after === after + 1 : line.before === before + 1;
          before = line.before ?? before;
          after = line.after ?? after;
          return [
            !follows && (
              <tr key={`gap ${i}`} class="gap">
                <td colSpan={4}>⋯</td>
              </tr>
            ),
            <tr key={i} class={line.kind}>
              <td class="n">{line.before}</td>
              <td class="n">{line.after}</td>
              <td class="sign">{SIGNS[line.kind]}</td>
              <td class="text">{line.text}</td>
            </tr>,
          ];
        })}
      </tbody>
    </table>
  );
}
