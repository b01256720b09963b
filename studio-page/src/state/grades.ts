/** What the judge says, in numbers that compare and in words. */

import type { Counts, Grade, Judge, Piece, Pose, Tile } from "../wire/messages";

export function counted(some: readonly Pick<Tile, "grade" | "compatible">[]): Counts {
  const of = (grade: Grade) => some.filter((one) => one.grade === grade).length;
  return {
    replicated: of("replicated"),
    close: of("close"),
    different: of("different"),
    compatible: some.filter(({ compatible }) => compatible).length,
  };
}

/** What decides: the fidelity, or by the paper's judge the distance. */
export function valueOf(judge: Judge, one: Pick<Tile, "fidelity" | "distance">): number | null {
  return judge === "fidelity" ? one.fidelity : one.distance;
}

/** By how much a value became better. */
export function gain(judge: Judge, before: number | null, after: number | null): number | null {
  if (before === null || after === null) return null;
  return judge === "fidelity" ? after - before : before - after;
}

/** The smallest gain that is worth saying, as in comparisons of runs. */
export const NOTED: Record<Judge, number> = { fidelity: 0.1, paper: 0.02 };

/** The largest region of each kind, in words. */
export function differences(missing: readonly Piece[], surplus: readonly Piece[]): { piece: Piece; words: string }[] {
  const told = ([piece, ...others]: readonly Piece[], what: string) => {
    if (!piece) return [];
    const more = others.length ? `, and ${others.length} more` : "";
    return [{ piece, words: `${what}: a piece ${Math.round(100 * piece.size)} % as long as the shape${more}` }];
  };
  return [...told(missing, "Missing"), ...told(surplus, "Too much")];
}

/** How a reference stands, in a word or two. */
export function stands({ turned, on_its_head, mirrored }: Pose): string {
  if (on_its_head) return "on its head";
  return mirrored ? "mirrored" : `turned ${turned}°`;
}
