// Commands as objects, so that what was changed can be taken back.
import { computed, type ReadonlySignal, signal } from "@preact/signals";

export interface Command {
  /** What it does, as a person would say it. */
  label: string;
  apply(): void;
  revert(): void;
}

const KEPT = 100;

export class History {
  private readonly done = signal<Command[]>([]);
  private readonly undone = signal<Command[]>([]);
  readonly canUndo: ReadonlySignal<string | null> = computed(() => this.done.value.at(-1)?.label ?? null);
  readonly canRedo: ReadonlySignal<string | null> = computed(() => this.undone.value.at(-1)?.label ?? null);

  run(command: Command): void {
    command.apply();
    this.done.value = [...this.done.peek().slice(-KEPT + 1), command];
    this.undone.value = [];
  }

  undo(): Command | null {
    return this.move(this.done, this.undone, (command) => command.revert());
  }

  redo(): Command | null {
    return this.move(this.undone, this.done, (command) => command.apply());
  }

  private move(from: typeof this.done, to: typeof this.done, act: (command: Command) => void): Command | null {
    const command = from.peek().at(-1) ?? null;
    if (command === null) return null;
    act(command);
    from.value = from.peek().slice(0, -1);
    to.value = [...to.peek(), command];
    return command;
  }
}

/** A command that sets a value, and sets it back. */
export function setting<T>(label: string, target: { value: T; peek(): T }, value: T): Command {
  const before = target.peek();
  const put = (x: T) => {
    target.value = x;
  };
  return { label, apply: () => put(value), revert: () => put(before) };
}
