// Line icons of 16 by 16, drawn in the colour of the text.
const PATHS = {
  play: "M5 3.5v9l7-4.5z",
  pause: "M5 3.5v9M11 3.5v9",
  reverse: "M11 3.5v9L4 8z",
  stepForward: "M4 3.5v9L10 8zM12 3.5v9",
  stepBack: "M12 3.5v9L6 8zM4 3.5v9",
  first: "M12.5 3.5v9L7.5 8zM7.5 3.5v9L2.5 8z",
  last: "M3.5 3.5v9L8.5 8zM8.5 3.5v9L13.5 8z",
  loop: "M4 6.5h7.5M9.5 4.5l2 2-2 2M12 9.5H4.5M6.5 7.5l-2 2 2 2",
  close: "M4 4l8 8M12 4l-8 8",
  add: "M8 3v10M3 8h10",
  remove: "M3 8h10",
  table: "M2.5 3.5h11v9h-11zM2.5 6.5h11M2.5 9.5h11M6.5 3.5v9",
  download: "M8 2.5v7M5 7l3 3 3-3M3 13h10",
  picture: "M2.5 3.5h11v9h-11zM3 11l3-3 2.5 2.5L11 7.5l2.5 2.5M5.5 6.2h.1",
  copy: "M5.5 5.5h7v7h-7zM10.5 5.5v-2h-7v7h2",
  sun: "M8 5.2a2.8 2.8 0 1 0 .01 0M8 1.5v1.6M8 12.9v1.6M1.5 8h1.6M12.9 8h1.6M3.4 3.4l1.1 1.1M11.5 11.5l1.1 1.1M3.4 12.6l1.1-1.1M11.5 4.5l1.1-1.1",
  moon: "M12.8 9.6A5.3 5.3 0 0 1 6.4 3.2a5.3 5.3 0 1 0 6.4 6.4z",
  keys: "M1.5 4.5h13v7h-13zM4 7h.1M6.6 7h.1M9.2 7h.1M11.8 7h.1M5 9.3h6",
  command: "M2.5 3.5h11v9h-11zM4.5 6l2 2-2 2M8 10h3",
  undo: "M4 6.5h5.5a3 3 0 0 1 0 6H6.5M6.5 4L4 6.5 6.5 9",
  redo: "M12 6.5H6.5a3 3 0 0 0 0 6H9.5M9.5 4L12 6.5 9.5 9",
  ruler: "M2 10.5L10.5 2 14 5.5 5.5 14zM5 8l1.3 1.3M7 6l1.3 1.3M9 4l1.3 1.3",
  fit: "M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3",
  layers: "M8 2.5L14 6 8 9.5 2 6zM2 9l6 3.5L14 9",
  warning: "M8 2.5L14.5 13.5h-13zM8 6.5v3.5M8 11.8v.1",
  error: "M8 1.8a6.2 6.2 0 1 0 .01 0M8 4.8v4M8 11v.1",
  info: "M8 1.8a6.2 6.2 0 1 0 .01 0M8 7.3v4M8 4.9v.1",
  check: "M3 8.5l3.5 3.5L13 4.5",
  maximise: "M3 9.5V13h3.5M13 6.5V3H9.5M3 13l4-4M13 3L9 7",
  home: "M2.5 7.5L8 3l5.5 4.5M4 6.5V13h8V6.5",
  stop: "M4 4h8v8H4z",
  slower: "M8 4L4 8l4 4M12 4L8 8l4 4",
  faster: "M4 4l4 4-4 4M8 4l4 4-4 4",
  jump: "M3 4l4 4-4 4M8 4l4 4-4 4M13.5 4v8",
} as const;

export type IconName = keyof typeof PATHS;

const FILLED: IconName[] = ["play", "reverse", "stepForward", "stepBack", "first", "last", "stop"];

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 16 16" aria-hidden="true" fill={FILLED.includes(name) ? "currentColor" : "none"}>
      <path d={PATHS[name]} stroke="currentColor" stroke-width="1.4" stroke-linecap="round" stroke-linejoin="round" />
    </svg>
  );
}
