/** What can be said of all that are selected. */

import { leafed, likeness, sort } from "../collection/order";
import { complain } from "../state/notices";
import { dimension, tileOf } from "../state/studio";
import { Button, Select } from "../ui/controls";
import { plural } from "../ui/numbers";
import type { Slug, Told } from "../wire/messages";
import { requests } from "../wire/requests";
import { measureIn, turn } from "./actions";
import { Mine, Tags } from "./form";
import { select, selection } from "./selection";

export function SelectionBar() {
  const slugs = selection.value;
  if (!slugs.length) return null;
  const [only] = slugs;
  return (
    <section class="selection" aria-label="Selected references">
      <b role="status">{plural(slugs.length, "reference")} selected</b>
      <Button kind="quiet" title="All references that are shown" onClick={() => select(leafed.value)}>
        All shown
      </Button>
      <Button kind="quiet" icon="close" title="Select none (Esc)" onClick={() => select([])} />
      <Tags slugs={slugs} />
      <Mine slugs={slugs} />
      {dimension.value === 3 && <Turns slugs={slugs} />}
      {slugs.length === 1 && only && (
        <Button title={`The most like ${tileOf(only)?.name ?? only} first`} onClick={() => void sortLike(only)}>
          Sort by likeness
        </Button>
      )}
    </section>
  );
}

export async function sortLike(slug: Slug): Promise<void> {
  try {
    likeness.value = { slug, apart: await requests.alike(slug) };
    sort.value = "alike";
  } catch (error) {
    complain(error);
  }
}

const UNITS = ["mm", "cm", "m", "in", "ft"] as const;

function Turns({ slugs }: { slugs: Slug[] }) {
  return (
    <span class="row turns">
      <Button title="A quarter turn about the up axis" icon="turned" onClick={() => turn(slugs, "around")}>
        Turn 90°
      </Button>
      <Button title="A quarter turn towards the front" onClick={() => turn(slugs, "tip")}>
        Tip 90°
      </Button>
      <Button title="Upside down" onClick={() => turn(slugs, "over")}>
        Flip
      </Button>
      <Select
        label="Unit"
        title="Of the lengths in these files; it counts where the procedure says that sizes do"
        options={[
          { value: "", label: "Unit…" },
          { value: "none", label: "as the file says" },
          ...UNITS.map((unit) => ({ value: unit, label: unit })),
        ]}
        hidden
        value=""
        onChange={(unit) => unit && measureIn(slugs, unit === "none" ? null : (unit as Told["unit"]))}
      />
    </span>
  );
}
