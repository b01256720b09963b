/** The procedure's text, to be edited here or in the author's own editor. */

import { effect, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { MODIFIER } from "../state/keys";
import { complain } from "../state/notices";
import { problems, procedure, project } from "../state/studio";
import { Button, Select } from "../ui/controls";
import type { Editor } from "./codemirror";
import { base, dirty, file, files, giveUp, goal, gone, openFile, save, saveAsNew, startEditing } from "./editing";
import { text, theirs } from "./editing";

export function EditorPane() {
  const place = useRef<HTMLDivElement>(null);
  const loaded = useSignal(false);
  // A file that was never there opens as well, to be told of.
  const opened = base.value || gone.value ? file.value : null;
  useEffect(startEditing, []);
  useEffect(() => {
    if (opened === null) return undefined;
    let gone = false;
    let ends: (() => void)[] = [];
    import("./codemirror")
      .then(({ createEditor }) => {
        if (gone || !place.current) return;
        const editor = createEditor(place.current, opened || project.value.procedure, text.value, {
          onText: (next) => (text.value = next),
          onSave: () => void save(),
        });
        loaded.value = true;
        ends = [...follow(editor), () => editor.destroy()];
      })
      .catch(complain);
    return () => {
      gone = true;
      ends.forEach((end) => end());
    };
  }, [opened]);
  const state = dirty.value ? "not saved" : procedure.value.state === "broken" ? "broken" : "";
  return (
    <section class="editor" tabIndex={-1} data-keeps-keys>
      <header>
        <FileChoice />
        <span class={state === "broken" ? "bad" : "warn"}>{state}</span>
        <Button disabled={!dirty.value} onClick={() => base.value && giveUp(base.value)}>
          Discard
        </Button>
        <Button
          kind={dirty.value ? "primary" : "plain"}
          disabled={!dirty.value}
          title={`Save, and run (${MODIFIER}S)`}
          onClick={() => void save()}
        >
          Save
        </Button>
      </header>
      {theirs.value && (
        <div class="conflict" role="alert">
          <p>The file has changed on disk since you began to edit it here.</p>
          <Button onClick={() => theirs.value && giveUp(theirs.value)}>Take the file's text</Button>
          <Button onClick={() => void save(true)}>Overwrite with mine</Button>
          <Button onClick={() => void saveAsNew()}>Save mine as a new file</Button>
        </div>
      )}
      {gone.value !== "" && (
        <div class="conflict" role="alert">
          <p>{gone.value}. The text here is kept.</p>
          <Button onClick={() => void save(true)}>Write it again</Button>
          <Button onClick={() => void saveAsNew()}>Save it as a new file</Button>
        </div>
      )}
      {/* The key keeps this element, which the editor is in, from becoming one of those above. */}
      <div class="code" key="code" ref={place}>
        {!loaded.value && <p class="soft">Loading the editor…</p>}
      </div>
      <footer class="soft" tabIndex={-1}>
        What is saved here is run on this machine, with your rights. Esc, then Tab, leads out of the text.
      </footer>
    </section>
  );
}

/** The name of the file; where there are several, they are to choose from. */
function FileChoice() {
  const name = file.value || project.value.procedure;
  const all = files.value.includes(name) ? files.value : [name, ...files.value];
  if (all.length < 2) return <h2 class="mono">{name}</h2>;
  return (
    <h2 class="mono">
      <Select
        label="File"
        hidden
        title="Text files in the procedure's folder"
        options={all.map((value) => ({ value, label: value }))}
        value={name}
        onChange={(value) => void openFile(value)}
      />
    </h2>
  );
}

/** Keep the editor as the signals have it. */
function follow(editor: Editor): (() => void)[] {
  return [
    effect(() => editor.write(text.value)),
    effect(() => {
      // A problem's line is of the text on disk.
      const here = problems.value.filter(({ file, line }) => line !== null && file === base.value?.path);
      editor.mark(here);
    }),
    effect(() => {
      if (goal.value === null || !base.value) return;
      editor.goTo(goal.value);
      goal.value = null;
    }),
  ];
}
