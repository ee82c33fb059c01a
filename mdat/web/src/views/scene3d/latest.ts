// One request at a time, and after it only the latest that was asked for meanwhile: a fast cursor does not pile up requests.
export class Latest<Value> {
  private running = false;
  private waiting: (() => void) | null = null;

  ask(make: () => Promise<Value>, take: (value: Value) => void, fail: (error: unknown) => void): void {
    const start = () => {
      this.running = true;
      make()
        .then(take, fail)
        .finally(() => this.next());
    };
    if (this.running) this.waiting = start;
    else start();
  }

  private next(): void {
    this.running = false;
    const { waiting } = this;
    this.waiting = null;
    waiting?.();
  }
}
