/** Which names somebody may mean by a few letters. */

/** Those that hold all words, the ones first that begin with the first; all in their order where there are no words. */
export function matching<T>(all: readonly T[], words: string, nameOf: (one: T) => string): T[] {
  const parts = words.toLowerCase().split(/\s+/).filter(Boolean);
  const [first] = parts;
  if (!first) return [...all];
  const found = all.flatMap((one) => {
    const name = nameOf(one).toLowerCase();
    if (!parts.every((part) => name.includes(part))) return [];
    const rank = name.startsWith(first) ? 0 : new RegExp(`\\b${escaped(first)}`).test(name) ? 1 : 2;
    return [{ one, rank }];
  });
  return found.sort((a, b) => a.rank - b.rank).map(({ one }) => one);
}

const escaped = (text: string) => text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
