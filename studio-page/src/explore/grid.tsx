/** The shapes: as they come, or in rows and columns along two parameters. */

import { Icon } from "../ui/icons";
import { shown, words } from "../ui/numbers";
import { Picture } from "../ui/picture";
import type { Value } from "../wire/messages";
import { along, answered, faults, planned, shapes } from "./shapes";

export function Grid() {
  const [rows, columns] = along.value;
  if (rows && columns) return <Table rows={rows.values} columns={columns.values} names={[rows.name, columns.name]} />;
  return (
    <ol class="shapes-grid" data-along={rows?.name ?? ""} data-answer={answered.value}>
      {planned.value.map((_, i) => (
        <li key={i}>
          <Shape index={i} label={rows ? `${words(rows.name)} ${shown(rows.values[i])}` : null} />
        </li>
      ))}
    </ol>
  );
}

function Table(props: { rows: Value[]; columns: Value[]; names: [string, string] }) {
  const { rows, columns, names } = props;
  return (
    <div class="shapes-table" data-along={names.join()} data-answer={answered.value}>
      <table>
        <thead>
          <tr>
            <th class="soft" scope="col">
              {words(names[0])} ↓ {words(names[1])} →
            </th>
            {columns.map((value) => (
              <th key={String(value)} scope="col">
                {shown(value)}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {rows.map((value, i) => (
            <tr key={String(value)}>
              <th scope="row">{shown(value)}</th>
              {columns.map((_, j) => (
                <td key={j}>
                  <Shape index={i * columns.length + j} label={null} />
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Shape({ index, label }: { index: number; label: string | null }) {
  const one = shapes.value.get(index);
  const wrong = one?.soundness ? faults(one.soundness) : [];
  const what = !one ? "is being built" : (one.problem?.message ?? (wrong.length ? wrong.join(", ") : "sound"));
  return (
    <a
      class={`shape ${wrong.length ? "unsound" : ""} ${one?.problem ? "failed" : ""} ${one ? "" : "waits"}`}
      href={`#explore/${index}`}
      data-shape={index}
      aria-label={`Shape ${index + 1}${label ? `, ${label}` : ""}: ${what}`}
      title={what}
    >
      <Picture url={one?.picture ?? null} tint={null} alt="" />
      {(label || wrong.length > 0 || one?.problem) && (
        <span class="what">
          {label && <span class="grow">{label}</span>}
          {one?.problem && <span class="badge bad">{one.problem.kind}</span>}
          {wrong.length > 0 && (
            <span class="badge warn">
              <Icon name="warn" />
              <span>{wrong[0]}</span>
            </span>
          )}
        </span>
      )}
    </a>
  );
}
