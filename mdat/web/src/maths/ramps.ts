// Colours of numbers. Cividis and the diverging ramp can be told apart by all common kinds of colour vision; both are read together with
// a scale of numbers. They are made for a dark and a light ground alike: no end vanishes in either.

export type Rgb = [number, number, number];

const hex = (text: string): Rgb => [1, 3, 5].map((i) => Number.parseInt(text.slice(i, i + 2), 16) / 255) as Rgb;

/** Cividis (Nuñez, Anderton, Renslow 2018), nine stops. */
const CIVIDIS = ["#00306f", "#2a406c", "#48526b", "#5e626e", "#727374", "#878479", "#a89a72", "#cbb55f", "#fdea45"].map(hex);
/** Negative blue, positive orange, grey about zero. */
const DIVERGING = ["#0b4fb3", "#2f7fd6", "#79b4ea", "#a9b1b8", "#f0b469", "#e07f1d", "#b04a00"].map(hex);
/** Okabe and Ito's colours for classes. */
const CLASSES = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#b8a200", "#8c8c8c"].map(hex);

export type RampName = "sequential" | "diverging";

/** The colour at a share from 0 to 1; what lies outside takes the end's. */
export function rampColour(ramp: RampName, share: number): Rgb {
  const stops = ramp === "sequential" ? CIVIDIS : DIVERGING;
  const at = Math.min(1, Math.max(0, share)) * (stops.length - 1);
  const low = Math.min(stops.length - 2, Math.floor(at));
  const part = at - low;
  return [0, 1, 2].map((i) => stops[low][i] * (1 - part) + stops[low + 1][i] * part) as Rgb;
}

export function classColour(index: number): Rgb {
  return CLASSES[((index % CLASSES.length) + CLASSES.length) % CLASSES.length];
}

export const cssColour = (rgb: Rgb): string => `rgb(${rgb.map((c) => Math.round(c * 255)).join(" ")})`;

/** A horizontal gradient of the ramp. */
export function rampGradient(ramp: RampName): string {
  const stops = ramp === "sequential" ? CIVIDIS : DIVERGING;
  return `linear-gradient(to right, ${stops.map(cssColour).join(", ")})`;
}
