// Missions as texts, as /api/mission gives them, and the part of the JSON Schema that forms are made from.

export interface Problem {
  /** 0: no place in the text. */
  line: number;
  column: number;
  key: string;
  value: string;
  expected: string;
}

/** A value that holds, in the unit that its key names, and where it came from. */
export interface EffectiveValue {
  key: string;
  value: string;
  unit: string;
  place: string;
  line: number;
}

/** What a text says; of one with problems these alone. */
export interface MissionView {
  problems: Problem[];
  warnings?: string[];
  values?: EffectiveValue[];
  scenarios?: { name: string; frames: number; runs: number; seed: number }[];
  /** What `mdat mission set` has to set to make the text of the saved one; null: it cannot. */
  settings?: string[] | null;
}

export interface OpenedMission extends MissionView {
  id: string;
  file: string;
  shipped: boolean;
  digest: string;
  text: string;
}

export interface Schema {
  type?: string;
  $ref?: string;
  const?: string;
  enum?: string[];
  description?: string;
  default?: unknown;
  minimum?: number;
  maximum?: number;
  minItems?: number;
  maxItems?: number;
  items?: Schema;
  anyOf?: Schema[];
  oneOf?: Schema[];
  properties?: Record<string, Schema>;
  required?: string[];
  additionalProperties?: Schema | false;
  "x-unit"?: string;
}
