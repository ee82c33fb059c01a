// The rows of a long list that are to be drawn, and the pages of them that have to be asked for.

/** Height of a row in rem. */
export const ROW_REM = 1.85;
export const PAGE = 200;

export interface Visible {
  first: number;
  last: number;
}

/** Rows that lie in the window of the list, and some around. */
export function visibleRows(scroll_px: number, height_px: number, row_px: number, total: number, around = 8): Visible {
  const first = Math.max(0, Math.floor(scroll_px / row_px) - around);
  const last = Math.min(total, Math.ceil((scroll_px + height_px) / row_px) + around);
  return { first, last: Math.max(first, last) };
}

/** Numbers of the pages that hold these rows. */
export function pagesOf({ first, last }: Visible): number[] {
  const pages: number[] = [];
  for (let page = Math.floor(first / PAGE); page * PAGE < last; ++page) pages.push(page);
  return pages;
}

/** The row to choose after a key; null where the key says nothing. */
export function rowAfterKey(key: string, row: number, total: number, page: number): number | null {
  const steps: Record<string, number> = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page };
  if (key in steps) return Math.min(total - 1, Math.max(0, row + steps[key]));
  return null;
}
