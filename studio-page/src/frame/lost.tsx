/** Why the page has no connection to the studio, and what to do. */

import { connected, lost, startedAnew } from "../state/studio";
import { Icon } from "../ui/icons";

export function Lost() {
  if (connected.value) return null;
  return (
    <section class="problems lost" role="alert" data-lost={startedAnew.value ? "anew" : "gone"}>
      <div class="problem">
        <Icon name="warn" />
        <div>
          <p>
            <b>{lost.value}</b>
          </p>
          {startedAnew.value ? (
            <p>
              Its terminal shows an address with a new token: open that, in this browser. This page goes on then, too.
              What you typed in the editor is kept. With <code>shapewright studio --keep-token</code> pages that are
              open connect again by themselves.
            </p>
          ) : (
            <p>
              If it has ended, start <code>shapewright studio</code> again. What is shown here is of before. What you
              typed in the editor is kept.
            </p>
          )}
        </div>
      </div>
    </section>
  );
}
