// Which lines of a text differ from those of another.

export interface LineChange {
  sign: "-" | "+";
  /** From 1, in the text that has it. */
  line: number;
  text: string;
}

/** Longest runs of lines that both have, from a[i] and b[k] on. */
function commonLines(a: string[], b: string[]): Uint32Array[] {
  const common = Array.from({ length: a.length + 1 }, () => new Uint32Array(b.length + 1));
  for (let i = a.length - 1; i >= 0; --i)
    for (let k = b.length - 1; k >= 0; --k)
      common[i][k] = a[i] === b[k] ? common[i + 1][k + 1] + 1 : Math.max(common[i + 1][k], common[i][k + 1]);
  return common;
}

/** What equal lines at both ends leave. */
function middle(a: string[], b: string[]): { from: number; a: string[]; b: string[] } {
  let from = 0;
  while (from < a.length && from < b.length && a[from] === b[from]) ++from;
  let tail = 0;
  while (tail < a.length - from && tail < b.length - from && a[a.length - 1 - tail] === b[b.length - 1 - tail]) ++tail;
  return { from, a: a.slice(from, a.length - tail), b: b.slice(from, b.length - tail) };
}

export function changedLines(before: string, after: string): LineChange[] {
  const { from, a, b } = middle(before.split("\n"), after.split("\n"));
  const common = commonLines(a, b);
  const changes: LineChange[] = [];
  for (let i = 0, k = 0; i < a.length || k < b.length; ) {
    if (i < a.length && k < b.length && a[i] === b[k]) {
      ++i;
      ++k;
    } else if (k === b.length || (i < a.length && common[i + 1][k] >= common[i][k + 1])) {
      changes.push({ sign: "-", line: from + i + 1, text: a[i++] });
    } else {
      changes.push({ sign: "+", line: from + k + 1, text: b[k++] });
    }
  }
  return changes;
}
