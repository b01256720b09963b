/** The keys that work where one is. */

import { signal } from "@preact/signals";
import { keyMaps, MODIFIER, singleKeys, switchSingleKeys } from "../state/keys";
import { Dialog, Toggle } from "../ui/controls";

export const helping = signal(false);

const NAMES: Record<string, string> = {
  ArrowLeft: "←",
  ArrowRight: "→",
  ArrowUp: "↑",
  ArrowDown: "↓",
  Escape: "Esc",
  Enter: "⏎",
  " ": "Space",
};

export function Help() {
  if (!helping.value) return null;
  return (
    <Dialog title="Keys" class="help" onClose={() => (helping.value = false)}>
      {[...keyMaps.value].reverse().map(({ place, keys }) => (
        <section key={place}>
          <h3>{place}</h3>
          <dl>
            {keys.map(({ keys: names, modified, does }) => (
              <div key={does}>
                <dt>
                  {modified && <kbd>{MODIFIER.trim()}</kbd>}
                  {names.map((name) => (
                    <kbd key={name}>{NAMES[name] ?? name}</kbd>
                  ))}
                </dt>
                <dd>{does}</dd>
              </div>
            ))}
          </dl>
        </section>
      ))}
      <Toggle label="Single keys act" title="Keys of one letter" on={singleKeys.value} onChange={switchSingleKeys} />
    </Dialog>
  );
}
