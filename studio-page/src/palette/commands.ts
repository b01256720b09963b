/** What the palette offers: views, what can be done from anywhere, what the keys of the view do, and the references. */

import { cancel, change, explain, fit } from "../state/actions";
import { saveSheet } from "../files/sheet";
import { keyMaps, MODIFIER } from "../state/keys";
import type { Key } from "../state/keys";
import { go, inspect, VIEWS } from "../state/route";
import { collection, fitting, jobs, procedure, settings } from "../state/studio";
import { switchTheme } from "../state/theme";

export interface Command {
  name: string;
  kind: string;
  key?: string | undefined;
  run: () => void;
}

export function commands(): Command[] {
  return [...views(), ...actions(), ...keys(), ...references()];
}

const views = (): Command[] =>
  VIEWS.map((view, i) => ({
    name: view[0]!.toUpperCase() + view.slice(1),
    kind: "view",
    key: `${i + 1}`,
    run: () => go(view),
  }));

function actions(): Command[] {
  const usable = procedure.value.state !== "broken" && collection.value.count > 0;
  const explaining = jobs.explain.value.state === "running";
  const on = settings.value?.auto_fit;
  const offered: (Command | false)[] = [
    usable && !fitting.value && { name: "Fit", kind: "command", key: `${MODIFIER}⏎`, run: () => fit() },
    usable && !fitting.value && { name: "Fit afresh", kind: "command", run: () => fit(true) },
    fitting.value && { name: "Cancel the fit", kind: "command", run: () => cancel("fit") },
    collection.value.run !== null && !explaining && { name: "Explain this run", kind: "command", run: explain },
    { name: "Dark or light colours", kind: "command", key: "d", run: switchTheme },
    { name: "Save a contact sheet", kind: "command", run: () => void saveSheet() },
    {
      name: on ? "Do not fit after every save" : "Fit after every save",
      kind: "command",
      run: () => void change({ auto_fit: !on }),
    },
  ];
  return offered.filter((one) => one !== false);
}

/** Keys that mean one thing; what moves the focus or the eye is of no use here. */
const MOVES = ["Escape", "Enter", "ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "d", "k"];

const keys = (): Command[] =>
  keyMaps.value.flatMap(({ place, keys: all }) => all.flatMap((key) => (isOne(key) ? [ofKey(place, key)] : [])));

const isOne = ({ keys: names }: Key) => names.length === 1 && !MOVES.includes(names[0]!);

function ofKey(place: string, { keys: names, does, modified, run }: Key): Command {
  const [name] = names;
  return {
    name: does[0]!.toUpperCase() + does.slice(1),
    kind: place.toLowerCase(),
    key: `${modified ? MODIFIER : ""}${name === " " ? "Space" : name}`,
    run: () => run(new KeyboardEvent("keydown", { key: name!, ctrlKey: Boolean(modified) })),
  };
}

const references = (): Command[] =>
  collection.value.tiles.map(({ slug, name }) => ({ name, kind: "reference", run: () => inspect(slug) }));
