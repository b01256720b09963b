/** The parameters of all replicas: asked for while somebody looks at them, and again when replicas change. */

import { effect, signal } from "@preact/signals";
import { complain } from "../state/notices";
import { collection, procedure } from "../state/studio";
import type { ParameterTable } from "../wire/messages";
import { requests } from "../wire/requests";

export const table = signal<ParameterTable>({ run: null, rows: [], validation: {}, samples: null });
const PAUSE = 250;
let watchers = 0;
let stop: () => void = () => undefined;

/** Keep the table as the collection is, until the returned function is called. */
export function watchTable(): () => void {
  watchers += 1;
  if (watchers === 1) stop = follow();
  return () => {
    watchers -= 1;
    if (watchers === 0) stop();
  };
}

function follow(): () => void {
  let timer = 0;
  const end = effect(() => {
    void [collection.value, procedure.value.digest];
    window.clearTimeout(timer);
    timer = window.setTimeout(() => {
      requests.parameters().then((found) => (table.value = found), complain);
    }, PAUSE);
  });
  return () => {
    window.clearTimeout(timer);
    end();
  };
}
