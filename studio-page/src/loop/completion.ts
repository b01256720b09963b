/** The kit's names while one types: those of shapes after a dot, the others elsewhere. Python's own names come beside. */

import { snippetCompletion } from "@codemirror/autocomplete";
import type { Completion, CompletionContext, CompletionResult } from "@codemirror/autocomplete";
import kit from "./kit.json";

const SHAPES = ["Solid", "Sketch"];

const [ofShapes, others] = [true, false].map((member) =>
  kit.filter(({ of }) => SHAPES.includes(of) === member).map(completion),
) as [Completion[], Completion[]];

export function kitNames(context: CompletionContext): CompletionResult | null {
  const word = context.matchBefore(/\w*/);
  if (!word || (word.from === word.to && !context.explicit && before(context, word.from) !== ".")) return null;
  const member =
    before(context, word.from) === "." && !/\bsw\.$/.test(context.state.sliceDoc(word.from - 3, word.from));
  return { from: word.from, options: member ? ofShapes : others, validFor: /^\w*$/ };
}

const before = (context: CompletionContext, at: number) => context.state.sliceDoc(Math.max(0, at - 1), at);

function completion({ name, of, call, says }: (typeof kit)[number]): Completion {
  const known = { label: name, detail: `${call} ${of.replace("shapewright.", "")}`.trim(), info: says };
  if (!call) return { ...known, type: "class" };
  // The cursor goes to the first argument.
  return snippetCompletion(call === "()" ? `${name}()` : `${name}(#{})`, { ...known, type: "function" });
}
