/** Keeps the most recently used answers by key, at most `capacity` of them; what failed is asked again. */
export class Cache<Value> {
  private readonly kept = new Map<string, Promise<Value>>();
  private readonly capacity: number;

  constructor(capacity: number) {
    this.capacity = capacity;
  }

  get(key: string, make: () => Promise<Value>): Promise<Value> {
    const known = this.kept.get(key);
    const value = known ?? make();
    this.kept.delete(key);
    this.kept.set(key, value);
    if (known === undefined) {
      value.catch(() => this.kept.get(key) === value && this.kept.delete(key));
      this.forgetOldest();
    }
    return value;
  }

  get size(): number {
    return this.kept.size;
  }

  private forgetOldest(): void {
    if (this.kept.size <= this.capacity) return;
    const oldest = this.kept.keys().next().value;
    if (oldest !== undefined) this.kept.delete(oldest);
  }
}
