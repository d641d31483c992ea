// The case as it was left, kept by the tab until it is closed, so that a reload does not lose it. No other page and no
// later user of the computer can read it.
import type { Units } from "./engine.js";

interface Kept {
  /** Of the file. */
  name: string;
  text: string;
  /** The text of the file, of which this may be a change. */
  saved: string;
  units: Units;
}

export interface Draft extends Kept {
  /** (ms since 1970) its last change. */
  time: number;
}

const KEY = "deltav-draft";

/** A browser may forbid a page to keep anything, or have no room for it: then there is no draft. */
function allowed<T>(access: () => T): T | null {
  try {
    return access();
  } catch {
    return null;
  }
}

function isDraft(value: unknown): value is Draft {
  const { name, text, saved, units, time } = (value ?? {}) as Partial<Record<keyof Draft, unknown>>;
  return [name, text, saved].every((part) => typeof part === "string") && ["", "si", "us", "uk"].some((one) => one === units) && typeof time === "number";
}

/** The draft; nothing where there is none. */
export function keptDraft(): Draft | null {
  const value = allowed((): unknown => JSON.parse(sessionStorage.getItem(KEY) ?? "null"));
  return isDraft(value) ? value : null;
}

/** Keeps a case in place of the last one; one that is kept already is as old as it was. */
export function keepDraft(kept: Kept): void {
  const last = keptDraft();
  if (last && (["name", "text", "saved", "units"] as const).every((part) => last[part] === kept[part])) return;
  allowed(() => sessionStorage.setItem(KEY, JSON.stringify({ ...kept, time: Date.now() } satisfies Draft)));
}

export function forgetDraft(): void {
  allowed(() => sessionStorage.removeItem(KEY));
}
