// The mission that is designed. Its text is the only truth: the form changes spans of it, by the server, and shows what it says.
import { computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import { getJson, postJson, withQuery } from "../api/client.ts";
import { History } from "../app/history.ts";
import { remark, tell } from "../app/notices.ts";
import { sectionsOf } from "./schema.ts";
import type { EffectiveValue, MissionView, OpenedMission, Problem, Schema } from "./types.ts";

const LOOK_MS = 400;
const BURST_MS = 800;
const MOST_CHANGES = 5;

export class Mission {
  readonly id: string;
  readonly file: string;
  readonly shipped: boolean;
  readonly schema: Schema;
  readonly text: Signal<string>;
  /** As the file holds it. */
  readonly saved: Signal<string>;
  readonly problems: Signal<Problem[]> = signal([]);
  readonly warnings: Signal<string[]> = signal([]);
  /** Of the last text without problems. */
  readonly values: Signal<EffectiveValue[]> = signal([]);
  readonly scenarios: Signal<{ name: string; runs: number }[]> = signal([]);
  /** The values that the form has changed since the file was saved or the text was typed, by key. */
  readonly settings: Signal<ReadonlyMap<string, string>> = signal(new Map());
  /** What `mdat mission set` has to set to make the text of the saved one, as KEY=VALUE; null: it cannot, as something is gone. */
  readonly same: Signal<string[] | null> = signal([]);
  readonly section: Signal<string> = signal("scan");
  readonly filter: Signal<string> = signal("");
  /** The line to show; the pane of the text goes there. */
  readonly line: Signal<number> = signal(0);
  readonly history = new History();
  readonly byKey: ReadonlySignal<Map<string, EffectiveValue>> = computed(() => new Map(this.values.value.map((each) => [each.key, each])));
  readonly changed: ReadonlySignal<boolean> = computed(() => this.text.value !== this.saved.value);
  readonly sections = computed(() => sectionsOf(this.schema, this.text.value, this.values.value));
  /** The last change of the form, until the server has made it. */
  pending: Promise<void> = Promise.resolve();
  private digest: string;
  private asked = 0;
  /** What is being typed. */
  private burst: { text: string; at_ms: number } | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(opened: OpenedMission, schema: Schema) {
    this.id = opened.id;
    this.file = opened.file;
    this.shipped = opened.shipped;
    this.schema = schema;
    this.digest = opened.digest;
    this.text = signal(opened.text);
    this.saved = signal(opened.text);
    this.take(opened);
  }

  static async open(id: string): Promise<Mission> {
    const [opened, schema] = await Promise.all([getJson<OpenedMission>(withQuery("/api/mission", { id })), getJson<Schema>("/api/schema")]);
    return new Mission(opened, schema);
  }

  private path(act: string): string {
    return withQuery(`/api/mission/${act}`, { id: this.id });
  }

  private take(view: MissionView): void {
    if (view.settings !== undefined) this.same.value = view.settings;
    this.problems.value = view.problems;
    if (view.problems.length > 0) return;
    this.warnings.value = view.warnings ?? [];
    this.values.value = view.values ?? [];
    this.scenarios.value = view.scenarios ?? [];
  }

  /** A value of the form: the server changes its span of the text. One after the other: each in the text that the one before has left. */
  set(key: string, value: string): void {
    this.pending = this.pending.then(() => this.change(key, value)).catch(tell);
  }

  /** What is typed meanwhile is not lost, and neither is the value: the span is then looked for in the newer text. */
  private async change(key: string, value: string): Promise<void> {
    for (let i = 0; i < MOST_CHANGES; ++i) {
      const old = this.text.peek();
      const wish = { text: old, saved: this.saved.peek(), set: [`${key}=${value}`] };
      const answer = await postJson<MissionView & { text: string }>(this.path("set"), wish);
      if (old === this.text.peek()) return this.apply(key, value, answer);
    }
    remark(`${key} is not changed, as the text changes all the time. Set it again.`);
  }

  private apply(key: string, value: string, answer: MissionView & { text: string }): void {
    const before = this.settings.peek();
    const old = this.text.peek();
    if (answer.text === old) return;
    const after = new Map([...before, [key, value]]);
    ++this.asked;
    this.burst = null;
    this.history.run({ label: `${key} = ${value}`, apply: () => this.put(answer.text, after), revert: () => this.put(old, before) });
    this.take(answer);
    this.line.value = answer.values?.find((each) => each.key === key)?.line ?? this.line.peek();
  }

  private put(text: string, settings: ReadonlyMap<string, string>): void {
    this.text.value = text;
    this.settings.value = settings;
  }

  /** The text as it was typed, taken back as far as a pause in the typing; it is looked at once the typing pauses. */
  type(text: string): void {
    const now = performance.now();
    if (this.burst === null || now - this.burst.at_ms > BURST_MS) {
      const burst = { text, at_ms: now };
      const settings = this.settings.peek();
      const old = this.text.peek();
      this.burst = burst;
      this.history.run({ label: "typing", apply: () => this.put(burst.text, new Map()), revert: () => this.put(old, settings) });
    } else {
      this.burst.text = text;
      this.burst.at_ms = now;
      this.text.value = text;
    }
    this.lookSoon();
  }

  /** A change of lines that no setting says, as one step to be taken back. */
  rewrite(label: string, text: string): void {
    const old = this.text.peek();
    const settings = this.settings.peek();
    this.burst = null;
    this.history.run({ label, apply: () => this.put(text, new Map()), revert: () => this.put(old, settings) });
    this.look().catch(tell);
  }

  /** Goes to the line of a table's header. */
  showHeader(path: string): void {
    const lines = this.text.peek().split("\n");
    this.line.value = 1 + lines.findIndex((line) => line.trim().startsWith(`[${path}]`));
  }

  lookSoon(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.look().catch(tell), LOOK_MS);
  }

  async look(): Promise<void> {
    const mine = ++this.asked;
    const view = await postJson<MissionView>(this.path("look"), { text: this.text.peek(), saved: this.saved.peek() });
    if (mine === this.asked) this.take(view);
  }

  undo(redo: boolean): void {
    this.burst = null;
    const command = redo ? this.history.redo() : this.history.undo();
    remark(command === null ? `Nothing to ${redo ? "do again" : "undo"}.` : `${redo ? "Done again" : "Undone"}: ${command.label}.`);
    if (command !== null) this.lookSoon();
  }

  async save(): Promise<boolean> {
    const text = this.text.peek();
    try {
      this.digest = (await postJson<{ digest: string }>(this.path("save"), { text, digest: this.digest })).digest;
    } catch (error) {
      tell(error);
      return false;
    }
    this.saved.value = text;
    this.settings.value = new Map();
    this.same.value = [];
    remark("Saved.");
    return true;
  }

  /** Gives the id of the copy. */
  async copy(name: string): Promise<string | null> {
    try {
      return (await postJson<{ id: string }>(this.path("copy"), { name })).id;
    } catch (error) {
      tell(error);
      return null;
    }
  }
}

/** The mission that is open; null elsewhere. */
export const mission: Signal<Mission | null> = signal(null);
