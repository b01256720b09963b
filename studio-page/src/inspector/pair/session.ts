/** The pair that is open: what was found for it, what the author has tried since, and what the server said of that. */

import { computed, effect, signal, untracked } from "@preact/signals";
import { complain } from "../../state/notices";
import { connected, dimension, procedure, tileOf } from "../../state/studio";
import { evaluate, onEvaluated } from "../../wire/live";
import type { Evaluated, MeshMessage, ResidualsMessage } from "../../wire/binary";
import { prepare, thin, whenItFails } from "../../viewer/solids/preparing";
import type { Solid } from "../../viewer/solids/solid";
import type {
  VerdictMessage,
  DrawingMessage,
  Parameter,
  Problem,
  Reference,
  Slug,
  Told,
  Value,
  Values,
} from "../../wire/messages";
import { RequestError, requests } from "../../wire/requests";
import { edit, edited, forgetEdits, redoEdit, undoEdit } from "./edits";

export type Colouring = "plain" | "distance" | "parts";
/** A mesh is made ready for the stage before it is shown. */
export type ShownMesh = Omit<MeshMessage, "positions" | "indices" | "labels"> & { solid: Solid };
export type Shown = ShownMesh | DrawingMessage;
/** What an evaluation says of the replica besides its geometry. */
export type Outcome = Required<Pick<Shown, "parameters" | "active" | "at_limit" | "units" | "milliseconds">>;

export const slug = signal<Slug | null>(null);
export const reference = signal<Reference | null>(null);
export const original = signal<Shown | null>(null);
export const replica = signal<Shown | null>(null);
export const residuals = signal<{ reference: ResidualsMessage | null; replica: ResidualsMessage | null }>({
  reference: null,
  replica: null,
});
export const outcome = signal<Outcome | null>(null);
export const figures = signal<VerdictMessage | null>(null);
export const failure = signal<Problem | null>(null);
/** The request whose answer is still to come; 0 when there is none. */
export const waiting = signal(0);
export const colouring = signal<Colouring>("plain");

export const values = computed((): Values => {
  const defaults = Object.fromEntries(procedure.value.parameters.map((one) => [one.name, one.default]));
  return {
    ...defaults,
    ...(reference.value?.parameters ?? {}),
    ...(outcome.value?.parameters ?? {}),
    ...(edited.value ?? {}),
  };
});
export const active = computed(() => new Set(outcome.value?.active ?? reference.value?.active ?? []));
export const atLimit = computed(() => new Set(outcome.value?.at_limit ?? reference.value?.at_limit ?? []));

/** Number of the evaluation whose replica came last. */
let newest = 0;
let said = 0;

whenItFails(() => complain("A large mesh could not be made ready: the browser may lack memory. Reload the page."));
let unanswered = 0;

/** Say of files which axes point where and what they hold. It is shown at once, so that two words in a moment are both kept. */
export async function tell(slugs: Slug[], told: Told): Promise<void> {
  const open = reference.value;
  said += 1;
  unanswered += 1;
  if (open) reference.value = { ...open, told };
  try {
    await requests.tell({ slugs, told });
  } catch (error) {
    if (open && reference.value?.slug === open.slug) reference.value = { ...reference.value, told: open.told };
    throw error;
  } finally {
    unanswered -= 1;
  }
}

/** Take what is known of the pair; what the author has said of its file since that was asked for stays. */
function read(found: Reference, since: number | null): void {
  const open = reference.value;
  reference.value = open && since !== said ? { ...found, told: open.told } : found;
}

/** Show one pair until the returned function is called. */
export function open(next: Slug): () => void {
  slug.value = next;
  for (const empty of [reference, original, replica, outcome, figures, failure]) empty.value = null;
  forgetEdits();
  residuals.value = { reference: null, replica: null };
  const deaf = onEvaluated(hear);
  const unwatch = watch(next);
  return () => {
    deaf();
    unwatch();
    slug.value = null;
  };
}

/** Whether a shape is open that has no reference. */
export const alone = signal(false);

/** Show a shape without a reference until the returned function is called. */
export function openAlone(start: Values): () => void {
  slug.value = null;
  for (const empty of [reference, original, replica, outcome, figures, failure]) empty.value = null;
  forgetEdits();
  edited.value = start;
  alone.value = true;
  const deaf = onEvaluated(hear);
  const unwatch = effect(() => {
    const { digest, state } = procedure.value;
    if (connected.value && digest && state === "good") untracked(ask);
  });
  return () => {
    deaf();
    unwatch();
    alone.value = false;
    for (const empty of [replica, outcome, failure]) empty.value = null;
    forgetEdits();
  };
}

/** Ask again whenever what was found for the pair, or the procedure, or the connection has changed. */
function watch(next: Slug): () => void {
  let shape: string | null | undefined;
  const known = computed(() => {
    const tile = tileOf(next);
    const { digest, state } = procedure.value;
    return [
      tile?.reference,
      tile?.replica,
      tile?.fidelity,
      tile?.distance,
      tile?.grade,
      tile?.stage,
      tile?.stale,
      digest,
      state,
      connected.value,
      colouring.value,
    ].join();
  });
  return effect(() => {
    void known.value;
    untracked(() => {
      if (!connected.value) return;
      const tile = tileOf(next);
      const since = unanswered > 0 ? null : said;
      if (tile && tile.reference !== shape) {
        shape = tile.reference;
        const asked: Promise<MeshMessage | DrawingMessage> =
          dimension.value === 3 ? requests.mesh(next) : requests.drawing(next);
        asked.then((found) => shapeOf(found, (ready) => slug.value === next && (original.value = ready)), note(next));
      }
      requests.reference(next).then((found) => slug.value === next && read(found, since), note(next));
      ask();
    });
  });
}

/** Calls `ready` with what can be shown; again with the same shape when it can be measured. */
function shapeOf(message: MeshMessage | DrawingMessage, ready: (shown: Shown) => void): void {
  if (message.type === "drawing") return ready(message);
  const { positions, indices, labels, ...said } = message;
  prepare({ positions, indices, discs: said.discs }, labels, (solid) => ready({ ...said, solid }));
  return undefined;
}

/** Tell an error of a request, unless the author has gone on. */
function note(next: Slug): (error: unknown) => void {
  return (error) => {
    const gone = error instanceof RequestError && error.status === 404;
    if (slug.value === next && !gone) complain(error);
  };
}

function ask(): void {
  if (!slug.value && !alone.value) return;
  const coloured = colouring.value === "distance" && dimension.value === 3 && !alone.value;
  waiting.value = evaluate(slug.value, edited.value, beyond(), coloured);
}

/** Names of the numbers that the author set outside their Ranges. */
export function beyond(): string[] {
  return procedure.value.parameters.filter((one) => isBeyond(one, edited.value?.[one.name])).map(({ name }) => name);
}

export function isBeyond({ low, high }: Parameter, value: Value | undefined): boolean {
  return low !== null && high !== null && typeof value === "number" && (value < low || value > high);
}

export function set(name: string, value: Value): void {
  edit({ ...values.value, [name]: value }, name);
  ask();
}

/** Back to what was found, or to other parameters. */
export function reset(to: Values | null = null): void {
  edit(to && { ...values.value, ...to }, "all");
  ask();
}

export function undo(): void {
  if (undoEdit()) ask();
}

export function redo(): void {
  if (redoEdit()) ask();
}

export function resetOne(name: string): void {
  const found = reference.value?.parameters?.[name];
  if (found !== undefined) set(name, found);
}

function hear(message: Evaluated): void {
  if (message.slug !== slug.value) return;
  switch (message.type) {
    case "mesh":
    case "drawing":
      newest = message.id;
      shapeOf(message, (ready) => {
        // A newer one may have been ready sooner, and another pair may be open by now.
        if (newest === message.id && slug.value === message.slug) replica.value = ready;
      });
      outcome.value = message.parameters ? (message as unknown as Outcome) : outcome.value;
      residuals.value = { reference: null, replica: null };
      failure.value = null;
      return;
    case "verdict":
      figures.value = message;
      if (message.id >= waiting.value) waiting.value = 0;
      return;
    case "residuals":
      thin(message, (fine) => {
        if (newest <= message.id && slug.value === message.slug)
          residuals.value = { ...residuals.value, [message.shape]: fine };
      });
      return;
    case "failed":
      failure.value = message.problem;
      if (message.id >= waiting.value) waiting.value = 0;
  }
}
