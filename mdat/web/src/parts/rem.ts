// The size of text on this screen. What is drawn or counted in pixels grows with it, as the style sheet's rem does.

const BASE_PX = 13;

/** Pixels of the style sheet for one at the smallest screen: 1 at 1280 pixels, some 1.5 at 3840. */
export function textScale(): number {
  return Number.parseFloat(getComputedStyle(document.documentElement).fontSize) / BASE_PX;
}
