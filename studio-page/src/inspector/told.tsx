/** What the author says of a file alone: which of its axes point up and to the front, and whether it holds several objects. */

import { leafed } from "../collection/order";
import { complain } from "../state/notices";
import { dimension, tileOf } from "../state/studio";
import { Button, Select } from "../ui/controls";
import type { Slug, Told } from "../wire/messages";
import { reference, tell } from "./pair/session";

const AXES = ["x", "-x", "y", "-y", "z", "-z"] as const;
const UNITS = ["mm", "cm", "m", "in", "ft"] as const;
const AS_ALL = "as all";
const SPLIT = [
  { value: AS_ALL, label: "as the others" },
  { value: "off", label: "one shape" },
  { value: "apart", label: "several, far apart" },
  { value: "names", label: "one for each name" },
];

export function ToldOf() {
  const open = reference.value;
  if (!open || dimension.value === 2) return null;
  const others = leafed.value.filter((slug) => slug !== open.slug).length;
  const say = (slugs: Slug[], told: Told) => void tell(slugs, told).catch(complain);
  const stands = tileOf(open.slug)?.axes;
  const found = stands?.by === "author" ? null : stands;
  const axes = (which: "up" | "front") => [
    { value: AS_ALL, label: found ? `as found: ${found[which]}` : "as the others" },
    ...AXES.map((axis) => ({ value: axis, label: axis })),
  ];
  // A front alone would leave the up as the file has it, and not as it was found.
  const sayAxis = (which: "up" | "front", axis: string) =>
    say([open.slug], {
      ...open.told,
      ...(which === "front" && axis !== AS_ALL && found ? { up: open.told.up ?? found.up } : {}),
      [which]: axis === AS_ALL ? null : axis,
    });
  return (
    <section class="told" data-told>
      <h3>Its file</h3>
      <Select
        label="Up"
        title="The axis of the file that points up"
        options={axes("up")}
        value={open.told.up ?? AS_ALL}
        onChange={(axis) => sayAxis("up", axis)}
      />
      <Select
        label="Front"
        title="The axis of the file that points to the front"
        options={axes("front")}
        value={open.told.front ?? AS_ALL}
        onChange={(axis) => sayAxis("front", axis)}
      />
      <Select
        label="Unit"
        title="Of its lengths; it counts where the procedure says that sizes do"
        options={[{ value: AS_ALL, label: "as the file says" }, ...UNITS.map((unit) => ({ value: unit, label: unit }))]}
        value={open.told.unit ?? AS_ALL}
        onChange={(unit) => say([open.slug], { ...open.told, unit: unit === AS_ALL ? null : (unit as Told["unit"]) })}
      />
      <Select
        label="Objects"
        title="Which objects in the file the next fit takes as references of their own"
        options={SPLIT}
        value={open.told.split ?? AS_ALL}
        onChange={(split) =>
          say([open.slug], { ...open.told, split: split === AS_ALL ? null : (split as Told["split"]) })
        }
      />
      {others > 0 && (
        <Button
          title="Say the same of all references that the collection shows now"
          onClick={() => say(leafed.value, open.told)}
        >
          Say so of all {leafed.value.length} shown
        </Button>
      )}
    </section>
  );
}
