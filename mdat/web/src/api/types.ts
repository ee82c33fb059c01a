// The things of the server's REST interface, as /api gives them. Units are in the names.

/** What the server is, and what a first visit can make. */
export interface About {
  version: string;
  folder: string;
  features: string[];
  first?: { mission: string; scenario: string; command: string };
}

/** A row of the list of recordings. */
export interface RecordingEntry {
  id: string;
  name: string;
  size_bytes: number;
  /** Seconds since 1970. */
  modified: number;
  open: boolean;
  error?: string;
}

/** A number of a topic that can be plotted. */
export interface ValueInfo {
  id: string;
  /** A name; of telemetry with its meaning behind a colon. */
  label: string;
  unit: string;
  topic: string;
  group: string;
  /** Names by number, where the value is one of a few. */
  choices?: string[];
}

export interface CameraInfo {
  /** Full angles, horizontal and vertical. */
  frustum_deg: [number, number];
  range_m: [number, number];
}

export interface RecordingInfo {
  id: string;
  name: string;
  file?: string;
  command: string;
  mission: string;
  scenario: string;
  sensor: string;
  seed: number | null;
  commit: string;
  start_s: number;
  end_s: number;
  frames: number;
  settings: Record<string, string>;
  damage: string[];
  has_truth: boolean;
  own: boolean;
  parts: string[];
  modes: string[];
  topics: { name: string; type: string; messages: number }[];
  values: ValueInfo[];
  camera: CameraInfo | null;
  size_m: number;
}

/** T_sensor_target, or another transform: position and Hamilton quaternion, scalar last. */
export interface PoseData {
  position_m: [number, number, number];
  quaternion_xyzw: [number, number, number, number];
}

export interface Gate {
  name: string;
  value: number | null;
  limit: number | null;
  kind?: "at least" | "at most";
  unit: string;
  pass: boolean;
}

/** Where the registration was after a pass; the first is where it began, without a step. */
export interface IterationStep {
  step_mm: number | null;
  step_deg: number | null;
  rms_mm: number | null;
  inliers: number | null;
  pose?: PoseData;
}

export interface WeakDirection {
  /** Translation in sensor axes, then rotation about them times the model's radius; sigma is in metres. */
  direction: [number, number, number, number, number, number];
  sigma: number;
}

export interface FrameInfo {
  index: number;
  time_s: number;
  /** Mode, verdict and reason are null where another program recorded the frame. */
  mode: string | null;
  valid: boolean | null;
  wrong: boolean | null;
  reason: string | null;
  gates: Gate[];
  inliers?: number | null;
  rays?: number | null;
  hits?: number | null;
  missed?: number | null;
  rms_mm?: number | null;
  poses: { estimate: PoseData | null; filtered: PoseData | null; truth: PoseData | null };
  T_world_sensor: PoseData | null;
  /** 36 numbers, row by row, translation first, in metres and radians; rotation about the sensor's axes. */
  covariance: number[] | null;
  weak: WeakDirection[];
  error: { position_mm: number; angle_deg: number; normalised_squared: number | null } | null;
  iterations: IterationStep[] | null;
  why: string;
}

export type EventLevel = "info" | "warning" | "error";

export interface LogEvent {
  time_s: number;
  frame: number;
  level: EventLevel;
  name: string;
  text: string;
}

export interface EventPage {
  total: number;
  events: LogEvent[];
}

export interface Statistics {
  count: number;
  mean: number | null;
  sigma: number | null;
  min: number | null;
  max: number | null;
  rms: number | null;
  median: number | null;
  p95: number | null;
}

/** Progress of a job of the server: done from 0 to 1; the id of what it made once it is there. */
export interface Job {
  done: number;
  text: string;
  id?: string;
  error?: string;
  remedy?: string;
}

/** A mission that can be flown live. */
export interface LiveMission {
  id: string;
  file: string;
  shipped: boolean;
}

/** Only a scenario of one run can be watched. */
export interface LiveScenario {
  name: string;
  frames: number;
  runs: number;
  seed: number;
}

/** A command that was given to a component, and what became of it. */
export interface CommandRecord {
  number: number;
  name: string;
  /** It armed the command of this name. */
  arm: boolean;
  values: Record<string, string>;
  phase: "waiting" | "sent" | "accepted" | "executed" | "failed" | "refused" | "unanswered" | "not_sent";
  why: string;
}

/** An item of a command: one number, or as many as `count`. */
export interface CommandItem {
  name: string;
  type: "u8" | "u16" | "u32" | "i64" | "f32" | "f64";
  count: number;
  unit: string;
  minimum: number | null;
  maximum: number | null;
  enumeration?: string;
  meaning: string;
}

export interface CommandInfo {
  name: string;
  meaning: string;
  /** It has to be armed before. */
  hazardous: boolean;
  items: CommandItem[];
}

export interface CommandList {
  commands: CommandInfo[];
  enumerations: Record<string, { value: number; name: string; meaning: string }[]>;
}

/** The run that the server flies or the component that it is connected to, or the last one; sent anew at each change. */
export interface LiveState {
  phase: "idle" | "preparing" | "running" | "over" | "failed";
  paused: boolean;
  /** Seconds of the run in one of the clock; 0: as fast as it goes. */
  pace: number;
  /** Of its recording. */
  id: string;
  name: string;
  mission: string;
  scenario: string;
  command: string;
  error: string | null;
  /** Of a component elsewhere; null: a run of the server. */
  address: string | null;
  /** Why nothing can come from it now. */
  trouble: string | null;
  /** That came and belong to no packet. */
  other_bytes: number;
  may_command: boolean;
  commands: CommandRecord[];
  /** That a run will have. */
  frames: number;
  boundaries: number;
  /** Of the recording so far. */
  bytes: number;
  packets: number;
  missing: number;
  rate_per_s: number;
  /** Since the last packet. */
  age_s: number | null;
}
