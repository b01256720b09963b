/** All commands and references by name: Ctrl K, some letters, Enter. */

import { signal, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { Dialog } from "../ui/controls";
import { commands } from "./commands";
import type { Command } from "./commands";
import { matching } from "./matching";

export const asking = signal(false);

const MOST = 40;

export function Palette() {
  return asking.value ? <Asked /> : null;
}

function Asked() {
  const words = useSignal("");
  const at = useSignal(0);
  const list = useRef<HTMLUListElement>(null);
  const field = useRef<HTMLInputElement>(null);
  const all = useRef<Command[]>(commands());
  const found = matching(all.current, words.value, ({ name, kind }) => `${name} ${kind}`).slice(0, MOST);
  const chosen = Math.min(at.value, found.length - 1);
  useEffect(() => field.current?.focus(), []);
  useEffect(() => {
    list.current?.querySelector("[aria-selected=true]")?.scrollIntoView({ block: "nearest" });
  }, [chosen, words.value]);
  const run = (command: Command | undefined) => {
    if (!command) return;
    asking.value = false;
    // When the dialog has gone and given the focus back.
    setTimeout(command.run);
  };
  const move = (event: KeyboardEvent) => {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (by && found.length) at.value = (chosen + by + found.length) % found.length;
    else if (event.key === "Enter") run(found[chosen]);
    else return;
    event.preventDefault();
  };
  return (
    <Dialog title="Commands" class="palette" onClose={() => (asking.value = false)}>
      <input
        ref={field}
        type="text"
        role="combobox"
        aria-label="Command or reference"
        aria-expanded="true"
        aria-controls="palette-list"
        aria-activedescendant={found.length ? `palette-${chosen}` : undefined}
        placeholder="A view, a command or a reference"
        value={words.value}
        onInput={(event) => {
          words.value = event.currentTarget.value;
          at.value = 0;
        }}
        onKeyDown={move}
      />
      <ul id="palette-list" role="listbox" aria-label="Found" ref={list}>
        {found.map((command, i) => (
          <li
            key={`${command.kind} ${command.name}`}
            id={`palette-${i}`}
            role="option"
            aria-selected={i === chosen}
            onPointerMove={() => (at.value = i)}
            onClick={() => run(command)}
          >
            <span>{command.name}</span>
            <span class="soft">{command.kind}</span>
            {command.key && <kbd>{command.key}</kbd>}
          </li>
        ))}
      </ul>
      {!found.length && <p class="soft">Nothing is called so.</p>}
    </Dialog>
  );
}
