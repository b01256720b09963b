/** Before an explanation: what there is to explain, group after group. */

import { tintOf } from "../state/scale";
import { inspect } from "../state/route";
import { collection, tiles } from "../state/studio";
import { plural } from "../ui/numbers";
import { Picture } from "../ui/picture";
import type { Slug } from "../wire/messages";

const MOST = 14;

export function Misfits() {
  const open = (slug: Slug) => tiles.value.get(slug)?.grade !== "replicated" && tiles.value.has(slug);
  const groups = collection.value.groups.map(({ members }) => members.filter(open)).filter((group) => group.length > 0);
  if (!groups.length) return null;
  return (
    <div class="misfits">
      <h3>What there is to explain: {plural(groups.length, "group")}</h3>
      {groups.map((group, i) => (
        <div class="cause-row" key={group[0]}>
          <header>
            <span class="badge cause">group {i + 1}</span>
            <span class="soft">{plural(group.length, "reference")}</span>
          </header>
          <div class="for">
            {group.slice(0, MOST).map((slug) => (
              <button
                key={slug}
                type="button"
                class="twin"
                title={tiles.value.get(slug)?.name}
                onClick={() => inspect(slug)}
              >
                <Picture url={tiles.value.get(slug)?.reference ?? null} tint={null} alt="reference" />
                <Picture
                  url={tiles.value.get(slug)?.replica ?? null}
                  tint={tintOf(tiles.value.get(slug))}
                  alt="replica"
                />
              </button>
            ))}
            {group.length > MOST && <span class="soft">+{group.length - MOST}</span>}
          </div>
        </div>
      ))}
    </div>
  );
}
