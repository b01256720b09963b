/** Parameters at a glance. */
export function ParametersView() {
  return null;
}
