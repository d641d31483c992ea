// The values of a case file that a form can show: texts, numbers, truth, lists and tables on one line. The
// engine reads the file; this only takes apart the text of one value, and writes it back.

export type Value = string | number | boolean | Value[] | { [key: string]: Value };

/** What is not read by this subset, such as a date or a text of several lines. */
class Foreign extends Error {}

/** A value as it stands in the file; nothing where it is of a form that a form cannot show. */
export function readValue(text: string): Value | undefined {
  try {
    const reader = new Reader(text);
    const value = reader.value();
    return reader.atEnd() ? value : undefined;
  } catch (error) {
    if (error instanceof Foreign || error instanceof SyntaxError) return undefined;
    throw error;
  }
}

/** A value as the file has it. */
export function writeValue(value: Value): string {
  if (typeof value === "string") return JSON.stringify(value).replaceAll("\u007f", "\\u007f");
  if (Array.isArray(value)) return `[${value.map(writeValue).join(", ")}]`;
  if (typeof value === "object") {
    const entries = Object.entries(value).map(([key, inner]) => `${key} = ${writeValue(inner)}`);
    return entries.length === 0 ? "{}" : `{ ${entries.join(", ")} }`;
  }
  return String(value);
}

class Reader {
  private at = 0;

  constructor(private readonly text: string) {}

  atEnd(): boolean {
    this.skip();
    return this.at === this.text.length;
  }

  value(): Value {
    this.skip();
    const next = this.text[this.at];
    if (next === '"' || next === "'") return this.string();
    if (next === "[") return this.list();
    if (next === "{") return this.table();
    return this.bare();
  }

  private skip(): void {
    this.take(/(?:[ \t\r\n]|#[^\n]*)*/y);
  }

  private take(pattern: RegExp): string | undefined {
    pattern.lastIndex = this.at;
    const found = pattern.exec(this.text)?.[0];
    if (found !== undefined) this.at += found.length;
    return found;
  }

  private string(): string {
    if (this.text.startsWith('"""', this.at) || this.text.startsWith("'''", this.at)) throw new Foreign();
    const literal = this.take(/'[^'\n]*'/y);
    if (literal !== undefined) return literal.slice(1, -1);
    const basic = this.take(/"(?:[^"\\\n]|\\.)*"/y);
    if (basic === undefined) throw new Foreign();
    const eight = (_: string, digits: string) => String.fromCodePoint(Number.parseInt(digits, 16));
    return JSON.parse(basic.replaceAll(/\\U([0-9a-fA-F]{8})/g, eight).replaceAll("\t", "\\t")) as string;
  }

  private list(): Value[] {
    this.at += 1;
    const values: Value[] = [];
    for (;;) {
      this.skip();
      if (this.take(/\]/y)) return values;
      values.push(this.value());
      this.skip();
      if (!this.take(/,/y) && this.text[this.at] !== "]") throw new Foreign();
    }
  }

  private table(): { [key: string]: Value } {
    this.at += 1;
    const table: { [key: string]: Value } = {};
    for (;;) {
      this.skip();
      if (this.take(/\}/y)) return table;
      const key = this.take(/[A-Za-z0-9_-]+/y);
      this.skip();
      if (key === undefined || !this.take(/=/y)) throw new Foreign();
      table[key] = this.value();
      this.skip();
      if (!this.take(/,/y) && this.text[this.at] !== "}") throw new Foreign();
    }
  }

  private bare(): Value {
    const word = this.take(/[A-Za-z0-9_.+-]+/y);
    if (word === "true" || word === "false") return word === "true";
    const digits = word?.replaceAll("_", "");
    if (digits === undefined || !/^[+-]?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?$/.test(digits)) throw new Foreign();
    return Number(digits);
  }
}

/** A text such as `21.3 20.3 in`: the numbers, as they are written, and the unit behind them. The `e3` of `3.7e3 lb` is part of its number. */
export function splitUnit(text: string): { number: string; unit: string } | undefined {
  const found = /^\s*([-+−]?[\d.][\d.eE+\-−,; \t]*?)\s*((?![eE][-+−]?\d)[^\d\s.,;+\-−].*?)?\s*$/u.exec(text);
  if (!found) return undefined;
  return { number: found[1] ?? "", unit: found[2] ?? "" };
}
