/** The procedure's text, to be edited here or in the author's own editor. */

import { effect, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { MODIFIER } from "../state/keys";
import { complain } from "../state/notices";
import { problems, procedure, project } from "../state/studio";
import { Button } from "../ui/controls";
import type { Editor } from "./codemirror";
import { base, dirty, giveUp, goal, gone, save, saveAsNew, startEditing, text, theirs } from "./editing";

export function EditorPane() {
  const place = useRef<HTMLDivElement>(null);
  const loaded = useSignal(false);
  useEffect(() => {
    startEditing();
    let gone = false;
    let ends: (() => void)[] = [];
    import("./codemirror")
      .then(({ createEditor }) => {
        if (gone || !place.current) return;
        const editor = createEditor(place.current, project.value.procedure, text.value, {
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
  }, []);
  const state = dirty.value ? "not saved" : procedure.value.state === "broken" ? "broken" : "";
  return (
    <section class="editor" tabIndex={-1} data-keeps-keys>
      <header>
        <h2 class="mono">{base.value?.path ?? project.value.procedure}</h2>
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
      <footer class="soft">What is saved here is run on this machine, with your rights.</footer>
    </section>
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
