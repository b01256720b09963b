import { dismiss, notices } from "../state/notices";
import { Button } from "../ui/controls";

export function Notices() {
  return (
    <div class="notices" role="status" aria-live="polite">
      {notices.value.map(({ id, text, bad, action }) => (
        <div key={id} class={bad ? "notice bad" : "notice"}>
          <p>{text}</p>
          {action && (
            <Button
              onClick={() => {
                action.run();
                dismiss(id);
              }}
            >
              {action.label}
            </Button>
          )}
          <Button kind="quiet" icon="close" title="Dismiss" onClick={() => dismiss(id)} />
        </div>
      ))}
    </div>
  );
}
