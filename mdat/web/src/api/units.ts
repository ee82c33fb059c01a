// Units as people write them: the server says "deg", "us" and "1".

const WRITTEN: Record<string, string> = { "1": "", "-": "", deg: "°", "deg/s": "°/s", us: "µs", "us/s": "µs/s" };

export function unitText(unit: string): string {
  return WRITTEN[unit] ?? unit.replace(/\^2/g, "²");
}

/** A label without the meaning that telemetry has behind its name. */
export function shortLabel(label: string): string {
  const colon = label.indexOf(": ");
  return colon < 0 ? label : label.slice(0, colon);
}
