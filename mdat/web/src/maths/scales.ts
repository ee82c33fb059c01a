// Numbers for people: ticks at 1, 2 and 5, limits that outliers do not stretch, and short text with units.

/** The largest of 1, 2, 5 times a power of ten that is not above x; x > 0. */
export function niceBelow(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x));
  const lead = x / power;
  if (lead >= 5 - 1e-9) return 5 * power;
  return (lead >= 2 - 1e-9 ? 2 : 1) * power;
}

/** The smallest of 1, 2, 5 times a power of ten that is not below x; x > 0. */
export function niceAbove(x: number): number {
  const below = niceBelow(x);
  if (below >= x * (1 - 1e-9)) return below;
  const lead = Math.round(below / 10 ** Math.floor(Math.log10(below) + 1e-9));
  return below * (lead === 2 ? 2.5 : 2);
}

/** Ticks from low to high, at most `most` of them. */
export function ticks(low: number, high: number, most: number): number[] {
  if (!(high > low) || most < 1) return [];
  const step = niceAbove((high - low) / most);
  const found: number[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) found.push(i * step);
  return found;
}

/** The value that the share (0 to 1) of the finite values does not exceed; NaN without any. */
export function quantile(values: ArrayLike<number>, share: number): number {
  const finite = Float64Array.from(Array.from(values).filter(Number.isFinite)).sort();
  if (finite.length === 0) return Number.NaN;
  return finite[Math.min(finite.length - 1, Math.floor(share * finite.length))];
}

const DASH = "–";

const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** As in 1.97 × 10⁸. */
function powerText(x: number, figures: number): string {
  const [lead, power] = x.toExponential(figures - 1).split("e");
  const raised = power
    .replace("+", "")
    .replace("-", "⁻")
    .replace(/\d/g, (digit) => RAISED[Number(digit)]);
  return `${lead.replace("-", "−")} × 10${raised}`;
}

/** Decimals that a step needs, so that no two ticks look alike. */
export function decimalsOf(step: number): number {
  for (let decimals = 0; decimals < 9; ++decimals) {
    const scaled = Math.abs(step) * 10 ** decimals;
    if (Math.abs(scaled - Math.round(scaled)) < 1e-6 * scaled) return decimals;
  }
  return 9;
}

/** Ticks of an axis as text: all with the decimals of their step. */
export function tickTexts(marks: number[]): string[] {
  if (marks.length < 2) return marks.map((mark) => shortNumber(mark));
  const decimals = decimalsOf(marks[1] - marks[0]);
  return marks.map((mark) => (Math.abs(mark) >= 1e6 ? shortNumber(mark) : mark.toFixed(decimals).replace("-", "−")));
}

/** A sentence: with a capital and a full stop. */
export function sentence(text: string): string {
  const whole = text.charAt(0).toUpperCase() + text.slice(1);
  return whole === "" || /[.!?]$/.test(whole) ? whole : `${whole}.`;
}

/** Three significant figures, without exponents from a millionth to a million; a dash for what is not there. */
export function shortNumber(x: number | null | undefined, figures = 3): string {
  if (x === null || x === undefined || !Number.isFinite(x)) return DASH;
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e6 || size < 1e-5) return powerText(x, figures);
  const decimals = Math.max(0, figures - 1 - Math.floor(Math.log10(size)));
  return x.toFixed(Math.min(decimals, 8)).replace("-", "−");
}

export function withUnit(x: number | null | undefined, unit: string, figures = 3): string {
  const text = shortNumber(x, figures);
  if (text === DASH || unit === "" || unit === "-" || unit === "1") return text;
  return unit === "°" || unit === "%" ? `${text}${unit === "%" ? " " : ""}${unit}` : `${text} ${unit}`;
}

/** A length in metres, or in millimetres below one. */
export function lengthText(length_m: number): string {
  return length_m < 1 ? withUnit(1000 * length_m, "mm", 4) : withUnit(length_m, "m", 4);
}

/** A count, with thin spaces between thousands. */
export function countText(count: number | null | undefined): string {
  if (count === null || count === undefined || !Number.isFinite(count)) return DASH;
  return Math.round(count)
    .toString()
    .replace(/\B(?=(\d{3})+$)/g, "\u2009");
}

/** Seconds with as many decimals as a step of that size needs. */
export function timeText(time_s: number, step_s = 0.01): string {
  const decimals = Math.min(6, Math.max(0, -Math.floor(Math.log10(step_s) + 1e-9)));
  return time_s.toFixed(decimals).replace("-", "−");
}

export function bytesText(bytes: number): string {
  if (bytes < 1e3) return `${bytes} B`;
  if (bytes < 1e6) return `${(bytes / 1e3).toFixed(0)} kB`;
  return bytes < 1e9 ? `${(bytes / 1e6).toFixed(1)} MB` : `${(bytes / 1e9).toFixed(2)} GB`;
}
