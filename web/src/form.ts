// The case as a form: for each key of the file a field, with its unit, its range and what the glossary says of it.
// The form holds nothing of its own: it shows the text, and writes into it.
import { book } from "./book.js";
import { h, markup, unique } from "./dom.js";
import * as engine from "./engine.js";
import type { Check, Field, Group, Problem } from "./engine.js";
import { isWordUsual, label, nameOf, root } from "./keys.js";
import { inForm, inWords, said } from "./said.js";
import { texts } from "./texts/en.js";
import { unitFor } from "./units.js";
import { type Value, readValue, splitUnit, writeValue } from "./toml.js";

const words = texts.form;

/** The ways to say how well a number is known, by the keys of the range. */
const RANGES: Record<string, string[]> = {
  exact: [],
  sd: ["value", "sd"],
  uniform: ["low", "high"],
  triangular: ["low", "mode", "high"],
  within: ["value", "within", "confidence"],
};

/** The numbers that may name their source: those of [avoid], without its places. */
const SOURCED = /^avoid\.(?!.*\.[xy]$)/;

const FIXED = ["vehicle1.fixed", "vehicle2.fixed"];

/** So many fields of a table in a list all stand there; of more, the first do that the file gives or needs. */
const FEW = 6;

/** A part of the form that shows one key. */
interface Row {
  element: HTMLElement;
  /** What the file says of it now. */
  show(raw: string | undefined): void;
  focus(): void;
}

export interface FormHost {
  /** Writes a key, in TOML; the empty text takes it away. Answers why it cannot, or nothing. */
  write(key: string, toml: string): string | null;
  /** Shows a key in the text. */
  reveal(key: string): void;
}

export class Form {
  readonly element = h("form", { class: "form", autocomplete: "off", "aria-label": words.label });
  private rows = new Map<string, Row>();
  private errors = new Map<string, HTMLElement>();
  /** Why a field shows what the case does not have. */
  private unwritten = new Map<string, string>();
  private groups = new Map<string, { details: HTMLDetailsElement; fill(): void; more?: HTMLDetailsElement }>();
  private check: Check | null = null;
  /** What is wrong with the file, or missing in it for its question. */
  private problems: Problem[] = [];
  private open = new Set<string>(["vehicle1", "vehicle2", "impact", "vehicle1.crush", "vehicle2.crush"]);
  private badges = new Map<string, HTMLElement>();
  private shape = "";
  /** The key to which the focus goes once the form is built anew. */
  private next: string | null = null;

  constructor(private readonly host: FormHost) {
    this.element.addEventListener("submit", (event) => event.preventDefault());
  }

  /** Shows the file. Keys that were added elsewhere move to the others, unless someone is at work in the form. */
  update(check: Check, problems: Problem[]): void {
    // Of a text that is no TOML nothing can be shown: the form waits until that is mended.
    const isBroken = check.problems.length > 0 && Object.keys(check.values).length === 0;
    this.element.classList.toggle("stale", isBroken);
    this.element.inert = isBroken;
    if (isBroken) {
      if (this.rows.size === 0) this.element.replaceChildren(h("p", { class: "note" }, words.broken));
      return;
    }
    this.check = check;
    this.problems = problems;
    const shape = [
      ...Object.keys(check.values).sort(),
      ...problems.flatMap(({ key }) => (key === null || key in check.values ? [] : [key])),
      ...FIXED.map((key) => check.values[key]?.text),
    ].join(" ");
    const busy = this.element.contains(document.activeElement);
    if (shape !== this.shape && !(busy && this.shape !== "")) {
      this.shape = shape;
      this.build();
    }
    if (this.next !== null && this.shape !== "") {
      this.focus(this.next);
      this.next = null;
    }
    for (const [key, row] of this.rows) row.show(check.values[key]?.text);
    for (const [key, badge] of this.badges) {
      const name = readValue(check.values[`${key}.name`]?.text ?? "");
      badge.textContent = this.given(key) ? (typeof name === "string" ? name : "") : words.notGiven;
    }
    this.showProblems();
  }

  /** Another file: nothing of the one before stays. */
  reset(): void {
    this.shape = "";
    for (const part of [this.rows, this.errors, this.unwritten, this.groups, this.badges]) part.clear();
    this.element.replaceChildren();
  }

  /** Puts the focus on the field of a key; false where the form has none. */
  focus(key: string): boolean {
    const parts = key.split(".");
    for (let length = 1; length <= parts.length; length += 1) {
      const group = this.groups.get(parts.slice(0, length).join("."));
      if (!group) continue;
      group.fill();
      group.details.open = true;
    }
    for (let name = key; name !== ""; name = name.includes(".") ? name.slice(0, name.lastIndexOf(".")) : "") {
      const row = this.rows.get(name.replace(/\[\d+\]$/, ""));
      if (row) {
        const more = row.element.closest<HTMLDetailsElement>("details.more");
        if (more) more.open = true;
        row.focus();
        row.element.scrollIntoView({ block: "center" });
        return true;
      }
    }
    return false;
  }

  private build(): void {
    this.rows.clear();
    this.errors.clear();
    this.unwritten.clear();
    this.groups.clear();
    this.badges.clear();
    const top = root();
    const head: Group = { ...top, groups: [] };
    this.element.replaceChildren(
      ...this.contents(head),
      ...top.groups.filter((group) => this.given(group.key)).map((group) => this.group(group, 0)),
      ...top.groups.filter((group) => !this.given(group.key)).map((group) => this.group(group, 0)),
    );
  }

  private given(key: string): boolean {
    const values = this.check?.values ?? {};
    return key in values || Object.keys(values).some((name) => name.startsWith(`${key}.`) || name.startsWith(`${key}[`));
  }

  /** The file lacks it, or it says how large a fixed object is. */
  private isNeeded(key: string): boolean {
    const [vehicle, diameter] = key.split(".");
    if (diameter === "diameter" && this.check?.values[`${vehicle}.fixed`]?.text === "true") return true;
    return this.problems.some((problem) => problem.key === key);
  }

  private group(group: Group, depth: number): HTMLElement {
    const given = this.given(group.key);
    // What is wrong with the whole of it, or with a key that has no field.
    const error = h("p", { class: "error", hidden: true });
    this.errors.set(group.key, error);
    const body = h("div", { class: "group-body" }, error);
    const badge = h("span", { class: "badge" });
    const summary = h("summary", {}, h("span", { class: "group-title" }, label(group.key)), badge);
    this.badges.set(group.key, badge);
    const vehicle = /^vehicle([12])$/.exec(group.key)?.[1];
    const details = h("details", {
      class: `group depth-${Math.min(depth, 2)}${vehicle ? ` vehicle-${vehicle}` : ""}`,
      "data-key": group.key,
    }, summary, body);
    let filled = false;
    const fill = () => {
      if (filled) return;
      filled = true;
      body.append(...this.contents(group, depth));
      for (const [key, row] of this.rows) if (key.startsWith(group.key)) row.show(this.check?.values[key]?.text);
      this.showProblems();
    };
    this.groups.set(group.key, { details, fill });
    details.addEventListener("toggle", () => {
      if (details.open) {
        fill();
        this.open.add(group.key);
      } else this.open.delete(group.key);
    });
    if ((given && (depth > 0 || group.key === "avoid")) || this.open.has(group.key)) {
      fill();
      details.open = true;
    }
    return details;
  }

  /** First what the file gives and what it needs, then the rest behind one line. */
  private contents(group: Group, depth = 0): HTMLElement[] {
    const isShown = (entry: { key: string; required?: boolean }) => this.given(entry.key) || entry.required === true || this.isNeeded(entry.key);
    // A word in place of the whole table, such as `crush = "none"`.
    const word: Field[] = group.choices?.length
      ? [{ ...group, choices: group.choices, kind: "choice", units: [], required: false, range: false, fields: [] }]
      : [];
    const isWord = typeof readValue(this.check?.values[group.key]?.text ?? "") === "string";
    const shown = [...(isWord ? word : []), ...group.fields.filter(isShown)];
    const others = group.fields.filter((field) => !isShown(field));
    const rest = isWord ? others : isWordUsual(group.key) ? [...word, ...others] : [...others, ...word];
    const groups = group.groups.filter(isShown);
    const restOfGroups = group.groups.filter((inner) => !isShown(inner));
    const elements: HTMLElement[] = [
      ...shown.map((field) => this.row(field)),
      ...groups.map((inner) => this.group(inner, depth + 1)),
    ];
    if (rest.length + restOfGroups.length > 0) {
      const body = h("div", { class: "group-body" });
      const more = h("details", { class: "more" }, h("summary", {}, words.more(rest.length + restOfGroups.length)), body);
      let filled = false;
      const fill = () => {
        if (filled) return;
        filled = true;
        body.append(...rest.map((field) => this.row(field)), ...restOfGroups.map((inner) => this.group(inner, depth + 1)));
      };
      if (shown.length + groups.length === 0 && group.key !== "") {
        fill();
        return [...elements, ...body.childNodes] as HTMLElement[];
      }
      more.addEventListener("toggle", fill);
      // Fields that are folded away have to be found by their key, too.
      fill();
      elements.push(more);
    }
    return elements;
  }

  /** The innermost field that shows a key. */
  private shownBy(key: string): string | undefined {
    const isWithin = (name: string) => key === name || key.startsWith(`${name}.`) || key.startsWith(`${name}[`);
    return [...this.errors.keys()].filter(isWithin).sort((a, b) => b.length - a.length)[0];
  }

  private showProblems(): void {
    const shown = this.problems.map((problem) => ({ problem, by: problem.key && this.shownBy(problem.key) }));
    for (const [key, place] of this.errors) {
      const own = shown.filter(({ by }) => by === key).map(({ problem }) => problem);
      const unwritten = this.unwritten.get(key);
      const sentences = [
        ...(unwritten === undefined ? [] : [unwritten]),
        ...own.map((problem) => inForm(problem, this.check?.values[key]?.text).join(" ")),
      ];
      const isWrong = sentences.length > 0;
      place.hidden = !isWrong;
      place.replaceChildren(...sentences.map((words) => h("span", {}, said(words))));
      const row = this.rows.get(key)?.element;
      row?.classList.toggle("wrong", isWrong);
      for (const input of row?.querySelectorAll(":scope > .control :is(input, select, textarea)") ?? []) {
        if (isWrong) input.setAttribute("aria-invalid", "true");
        else input.removeAttribute("aria-invalid");
      }
    }
  }

  /** The frame that all fields have: name, help, what is wrong. */
  private frame(field: Field, id: string): {
    element: HTMLElement;
    line: HTMLElement;
  } {
    const help = h("div", { class: "help", id: `${id}-help`, hidden: true });
    const ask = h("button", {
      type: "button",
      class: "ask",
      "aria-expanded": "false",
      "aria-controls": `${id}-help`,
      "aria-label": words.help(nameOf(field.key)),
      title: field.title,
      onclick: () => {
        help.hidden = !help.hidden;
        ask.setAttribute("aria-expanded", String(!help.hidden));
        if (help.childNodes.length === 0) help.append(...explanation(field));
      },
    }, "?");
    const error = h("p", { class: "error", id: `${id}-error`, hidden: true });
    this.errors.set(field.key, error);
    const line = h("div", { class: "control" });
    const name = h("label", { for: id, title: field.title }, label(field.key),
      field.required ? h("span", { class: "required" }, ` ${words.required}`) : null);
    const element = h("div", { class: "field", "data-key": field.key },
      h("div", { class: "name" }, name, ask), line, error, help);
    return { element, line };
  }

  /** A list of tables: each with its fields, and a button for one more. */
  private list(field: Field): HTMLElement {
    const id = unique("field");
    const { element, line } = this.frame(field, id);
    const items = h("div", { class: "items" });
    const given = () => {
      let count = 0;
      while (`${field.key}[${count + 1}]` in (this.check?.values ?? {})) count += 1;
      return count;
    };
    let made = 0;
    const item = () => {
      made += 1;
      const key = `${field.key}[${made}]`;
      const place = made;
      const remove = h("button", {
        type: "button",
        class: "quiet",
        "aria-label": words.remove(nameOf(key)),
        onclick: () => {
          // The others move up: the form is built anew, though someone is at work in it.
          this.shape = "";
          this.next = field.key;
          if (place <= given()) this.host.write(key, "");
          else if (this.check) this.update(this.check, this.problems);
        },
      }, words.removeItem);
      const name = `${words.item[key.slice(key.lastIndexOf(".") + 1).replace(/\[\d+\]$/, "")] ?? label(field.key)} ${made}`;
      const inner: Group = { key, title: name, help: "", fields: field.fields.map((one) => moved(one, field.key, key)), groups: [] };
      const fields = h("div", { class: "item", role: "group", "aria-label": nameOf(key) },
        h("div", { class: "item-head" }, h("span", {}, name), remove),
        ...(inner.fields.length <= FEW ? inner.fields.map((one) => this.row(one)) : this.contents(inner, 2)));
      items.append(fields);
      return fields;
    };
    const add = h("button", {
      type: "button",
      id,
      "aria-label": words.addTo(nameOf(field.key)),
      onclick: () => {
        // One that is still empty is filled in first.
        const last = items.lastElementChild;
        const isEmpty = last && [...last.querySelectorAll("input")].every((input) => input.value === "");
        (isEmpty ? last : item()).querySelector<HTMLElement>("input, select")?.focus();
      },
    }, words.add);
    const toText = h("button", { type: "button", class: "quiet", onclick: () => this.host.reveal(field.key), "aria-label": words.inTextOf(nameOf(field.key)) }, words.inText);
    line.append(add, toText);
    element.append(items);
    this.rows.set(field.key, {
      element,
      show: () => {
        while (made < given()) item();
      },
      focus: () => add.focus(),
    });
    this.rows.get(field.key)?.show(undefined);
    return element;
  }

  private row(field: Field): HTMLElement {
    if (field.kind === "tables" && field.fields.length > 0) return this.list(field);
    const id = unique("field");
    const { element, line } = this.frame(field, id);
    const complain = (words: string | null) => {
      if (words === (this.unwritten.get(field.key) ?? null)) return;
      if (words === null) this.unwritten.delete(field.key);
      else this.unwritten.set(field.key, words);
      this.showProblems();
    };
    const write = (toml: string) => {
      // Other fields are the first of an object that is fixed: the form is built anew, though someone is at work in it.
      if (FIXED.includes(field.key)) {
        this.shape = "";
        this.next = field.key;
      }
      complain(this.host.write(field.key, toml));
    };
    const usualUnit = () => (this.check ? unitFor(field, this.check) : (field.units[0] ?? ""));
    const list = numbersOf(field.key);
    const control = (list ? numbered(list) : (CONTROLS[field.kind] ?? raw))({
      field, id, write, complain, usualUnit, reveal: () => this.host.reveal(field.key),
    });
    line.append(...control.elements);
    const row: Row = {
      element,
      show: control.show,
      focus: () => element.querySelector<HTMLElement>("input, select, textarea, .control button")?.focus(),
    };
    this.rows.set(field.key, row);
    row.show(this.check?.values[field.key]?.text);
    return element;
  }
}

/** A field of the tables of a list, as that of one of them. */
function moved(field: Field, from: string, to: string): Field {
  return { ...field, key: to + field.key.slice(from.length), fields: field.fields.map((inner) => moved(inner, from, to)) };
}

/** What a key means: first in a sentence or two, then what the glossary says. */
function explanation(field: Field): HTMLElement[] {
  const meaning = h("p", {}, h("strong", {}, `${field.title}. `), field.help, " ", h("code", {}, field.key));
  const words = engine.explain(field.key);
  const chapter = book.key(field.key, nameOf(field.key));
  const more = chapter ? [h("p", {}, chapter)] : [];
  if (!("html" in words)) return [meaning, ...more];
  const glossary = h("div");
  markup(glossary, words.html);
  inWords(glossary);
  return [meaning, glossary, ...more];
}

interface Asked {
  field: Field;
  id: string;
  write(toml: string): void;
  /** Says why the field shows what the case does not have; nothing once it shows the case again. */
  complain(words: string | null): void;
  /** The unit of an empty field. */
  usualUnit(): string;
  reveal(): void;
}

interface Control {
  elements: HTMLElement[];
  show(raw: string | undefined): void;
}

const isBusy = (...inputs: HTMLElement[]): boolean => inputs.some((input) => input === document.activeElement);

function text({ id, write }: Asked): Control {
  const input = h("input", { id, type: "text", "aria-describedby": `${id}-error` });
  input.addEventListener("input", () => input.value !== "" && write(writeValue(input.value)));
  input.addEventListener("change", () => input.value === "" && write(""));
  return {
    elements: [input],
    show: (raw) => {
      const value = raw === undefined ? "" : readValue(raw);
      const now = typeof value === "string" ? value : (raw ?? "");
      if (!isBusy(input) && input.value !== now) input.value = now;
    },
  };
}

function choice({ field, id, write }: Asked): Control {
  const select = h("select", { id, "aria-describedby": `${id}-error` });
  const fill = (extra?: string, name = extra) => {
    select.replaceChildren(
      h("option", { value: "" }, words.notGivenOption),
      ...(field.choices).map((word) => h("option", { value: word }, texts.choices[field.key.replace(/^.*[.](?=[^.]+$)/, "")]?.[word] ?? word)),
      ...(extra === undefined ? [] : [h("option", { value: extra }, name)]),
    );
  };
  fill();
  select.addEventListener("change", () => {
    if (select.value !== "" && !field.choices.includes(select.value)) return;
    write(select.value === "" ? "" : writeValue(select.value));
  });
  return {
    elements: [select],
    show: (raw) => {
      const value = raw === undefined ? "" : readValue(raw);
      const now = typeof value === "string" ? value : (raw ?? "");
      // In place of a word stands a table, which has fields of its own.
      if (now !== "" && !field.choices.includes(now)) fill(now, typeof value === "string" ? now : words.byFields);
      select.value = now;
    },
  };
}

/** The numbers that stand for a size of car, each with what it means; nothing for other keys. */
function numbersOf(key: string): [string, string][] | null {
  if (key.endsWith(".stiffness.category")) return words.categories;
  if (!/^vehicle[12]\.class$/.test(key)) return null;
  const explained = engine.explain("class");
  if (!("html" in explained)) return null;
  const page = h("div");
  markup(page, explained.html);
  const rows = (page.querySelector("pre")?.textContent ?? "").split("\n").map((line) => line.trim().split(/\s+/));
  const row = (name: string) => rows.find(([first]) => first === name)?.slice(1) ?? [];
  // A class is that with the nearest wheelbase: it reaches halfway to its neighbours.
  const inches = row("in").map(Number);
  const limits = inches.slice(1).map((inch, place) => (inch + (inches[place] ?? 0)) / 2);
  const wide = limits.map((inch) => ({ inches: inch.toFixed(0), metres: Number.parseFloat(engine.convert(`${inch} in`, "m") ?? "").toFixed(2) }));
  const list = row("class").map((number, place) => [number, words.sizeClass(number, wide[place - 1], wide[place])] as [string, string]);
  return list.length > 0 ? list : null;
}

const numbered = (list: [string, string][]) => ({ id, write }: Asked): Control => {
  const select = h("select", { id, "aria-describedby": `${id}-error` });
  const fill = (extra?: string) =>
    select.replaceChildren(
      h("option", { value: "" }, words.notGivenOption),
      ...list.map(([number, name]) => h("option", { value: number }, name)),
      ...(extra === undefined ? [] : [h("option", { value: extra }, extra)]));
  fill();
  select.addEventListener("change", () => write(select.value));
  return {
    elements: [select],
    show: (raw) => {
      if (raw !== undefined && !list.some(([number]) => number === raw)) fill(raw);
      select.value = raw ?? "";
    },
  };
};

/** Commas between the numbers of a list are no part of them; of "9,5" nobody knows that. */
const withoutCommas = (list: string): string =>
  list.replaceAll(/[,;]\s+/g, " ").replaceAll(/(?<![\d.,])\d+(?:\.\d+)?(?:[,;]\d+(?:\.\d+)?){2,}(?![\d.,])/g, (numbers) =>
    numbers.split(/[,;]/).slice(1).every((group) => /^\d{3}$/.test(group)) ? numbers : numbers.replaceAll(/[,;]/g, " "));

function flag({ id, write }: Asked): Control {
  const select = h("select", { id, "aria-describedby": `${id}-error` },
    h("option", { value: "" }, words.notGivenOption),
    h("option", { value: "true" }, words.yes),
    h("option", { value: "false" }, words.no));
  select.addEventListener("change", () => write(select.value));
  return { elements: [select], show: (raw) => (select.value = raw ?? "") };
}

/** What has no form of its own stands as it does in the file. */
function raw({ field, id, write, complain, reveal }: Asked): Control {
  const input = h("input", { id, type: "text", class: "raw", "aria-describedby": `${id}-error`, spellcheck: "false" });
  input.addEventListener("input", () => input.value !== "" && readValue(input.value) !== undefined && write(input.value));
  input.addEventListener("change", () => (input.value === "" || readValue(input.value) === undefined) && write(input.value));
  const toText = h("button", { type: "button", class: "quiet", onclick: reveal, "aria-label": words.inTextOf(nameOf(field.key)) }, words.inText);
  return {
    elements: [input, toText],
    show: (given) => {
      const now = (given ?? "").replaceAll(/\s*\n\s*/g, " ");
      if (isBusy(input)) return;
      if (input.value !== now) input.value = now;
      complain(null);
    },
  };
}

/** A number, or several, with a unit where it has one, and with a range where it may have one. */
function quantity({ field, id, write, complain, usualUnit }: Asked): Control {
  const isList = field.kind === "quantities" || field.kind === "numbers";
  const central = isList ? "values" : "value";
  const { units } = field;
  let unit = units[0] ?? "";
  let parts: Record<string, string> = {};
  let shown: string | undefined;
  let isForeign = false;
  /** Someone has chosen the unit of a field that is still empty. */
  let isChosen = false;

  const inputs = new Map<string, HTMLInputElement>();
  const main = h("input", {
    id,
    type: "text",
    inputmode: isList ? "text" : "decimal",
    class: isList ? "number long" : "number",
    "aria-describedby": `${id}-error`,
    spellcheck: "false",
  });
  const select = h("select", { class: "unit", "aria-label": words.unitOf(nameOf(field.key)) });
  const modes = h("select", { class: "mode", "aria-label": words.knownOf(nameOf(field.key)), title: words.known });
  const range = h("div", { class: "range" });
  const source = h("input", { type: "text", class: "source", "aria-label": `${nameOf(field.key)}: ${words.source}` });
  const origin = h("label", { class: "range-part origin" }, h("span", { "aria-hidden": "true" }, words.source), source);
  const allowed = Object.entries(RANGES).filter(([, keys]) =>
    isList ? keys.every((key) => !["low", "mode", "high"].includes(key)) : true,
  );
  const keysOf = (mode: string): string[] =>
    (RANGES[mode] ?? []).map((key) => (key === "value" ? central : key));

  const fillUnits = () => {
    const all = unit === "" || units.includes(unit) ? units : [...units, unit];
    select.replaceChildren(...all.map((name) => h("option", { value: name }, name)));
    select.value = unit;
    select.hidden = all.length === 0;
  };

  // A number of its own has no unit; per cent and probabilities have none of the field.
  const written = (key: string, number: string): Value => {
    const trimmed = number.trim();
    if (key === "within") return /%\s*$/.test(trimmed) ? trimmed : `${trimmed} %`;
    const isBare = key === "confidence" || units.length === 0;
    if (isBare) {
      if (isList && key === central) {
        const numbers = trimmed.split(/[\s,;]+/).map(Number);
        return numbers.some(Number.isNaN) ? trimmed : numbers;
      }
      const value = Number(trimmed.replace("−", "-"));
      return trimmed === "" || Number.isNaN(value) ? trimmed : value;
    }
    // Someone who types the unit as well means that one.
    const digits = isList && key === central ? withoutCommas(trimmed) : trimmed;
    return splitUnit(digits)?.unit ? digits : `${digits} ${unit}`.trim();
  };

  const commit = () => {
    const keys = Object.keys(parts);
    if (keys.length === 0 || keys.every((key) => (parts[key] ?? "").trim() === "")) return;
    const named: Record<string, Value> = source.value.trim() === "" ? {} : { source: source.value };
    if (keys.length === 1 && keys[0] === central && !("source" in named)) {
      const number = (parts[central] ?? "").trim();
      // A bare number stays as it was written.
      const isPlain = units.length === 0 && !isList && /^[+-]?\d+(\.\d+)?([eE][+-]?\d+)?$/.test(number);
      shown = isPlain ? number : writeValue(written(central, number));
    } else {
      shown = writeValue({ ...Object.fromEntries(keys.map((key) => [key, written(key, parts[key] ?? "")])), ...named });
    }
    fillSource();
    write(shown);
  };

  const clear = () => {
    shown = undefined;
    write("");
  };

  const isWhole = () => Object.values(parts).every((part) => part.trim() !== "");
  const isEmpty = () => Object.values(parts).every((part) => part.trim() === "");

  const fillSource = () => {
    origin.hidden = isForeign || (source.value === "" && (!SOURCED.test(field.key) || isEmpty()));
  };
  source.addEventListener("input", () => isWhole() && commit());

  const listen = (input: HTMLInputElement, key: () => string) => {
    input.addEventListener("input", () => {
      if (isForeign && readValue(input.value) !== undefined) {
        shown = input.value;
        write(shown);
        return;
      }
      // What is no TOML is a quantity as one types it.
      if (isForeign) become(central, input.value);
      parts[key()] = input.value;
      const typed = units.length > 0 ? splitUnit(input.value)?.unit : undefined;
      if (typed && units.includes(typed)) {
        unit = typed;
        fillUnits();
      }
      // A range is written once it has all of its numbers.
      if (isWhole()) commit();
    });
    input.addEventListener("change", () => {
      if (isForeign ? input.value.trim() === "" : isEmpty()) clear();
      const typed = isForeign || key() === "within" ? undefined : splitUnit(input.value);
      if (typed && (typed.unit === "" || units.includes(typed.unit))) {
        input.value = typed.number;
        parts[key()] = typed.number;
      }
    });
  };
  // A range of which a number is missing is not in the case, which is said once one turns to something else.
  const whole = h("div", { class: "quantity" });
  whole.addEventListener("focusout", (event) => {
    if (!whole.contains(event.relatedTarget as Node | null) && !isForeign && !isWhole() && !isEmpty()) complain(words.incomplete);
  });
  whole.append(h("div", { class: "number-line" }, main, select, modes), range, origin);
  // The first of the range's numbers stands where a plain number would.
  const firstKey = () => Object.keys(parts)[0] ?? central;
  listen(main, firstKey);

  const fillRange = () => {
    const [, ...others] = Object.keys(parts);
    inputs.clear();
    range.replaceChildren(
      ...others.map((key) => {
        const input = h("input", {
          type: "text",
          inputmode: "decimal",
          class: "number short",
          "aria-label": `${nameOf(field.key)}: ${words.rangeKey[key] ?? key}`,
          value: parts[key] ?? "",
        });
        inputs.set(key, input);
        listen(input, () => key);
        return h("span", { class: "range-part" }, h("span", { "aria-hidden": "true" }, words.rangeSign[key] ?? key), input,
          key === "within" ? h("span", {}, "%") : null);
      }),
    );
    range.hidden = others.length === 0;
  };

  const modeNow = (): string =>
    allowed.find(([mode]) => keysOf(mode).join() === Object.keys(parts).join())?.[0] ??
    (Object.keys(parts).length <= 1 ? "exact" : "other");

  const fillModes = () => {
    const now = modeNow();
    modes.replaceChildren(
      ...allowed.map(([mode]) => h("option", { value: mode }, words.modes[mode] ?? mode)),
      ...(now === "other" ? [h("option", { value: "other" }, words.modes.other ?? "")] : []),
    );
    modes.value = now;
    modes.hidden = field.range !== true || isForeign;
  };

  /** A plain number in place of what only the text can show. */
  const become = (key: string, number: string) => {
    isForeign = false;
    parts = { [key]: number };
    main.classList.remove("raw");
    fillUnits();
    fillModes();
  };

  modes.addEventListener("change", () => {
    if (modes.value === "other") return;
    const before = parts[central] ?? parts.mode ?? main.value;
    const keys = keysOf(modes.value);
    const next: Record<string, string> = {};
    // The number that was there stays, as the first of two limits where the range has no other place for it.
    const kept = [central, "mode"].find((key) => keys.includes(key)) ?? keys[0] ?? central;
    for (const key of keys.length > 0 ? keys : [central]) {
      next[key] = parts[key] ?? (key === kept ? before : key === "confidence" ? "0.95" : "");
    }
    parts = next;
    main.value = parts[firstKey()] ?? "";
    main.setAttribute("aria-label", keys.length > 0 ? `${nameOf(field.key)}: ${words.rangeKey[firstKey()] ?? firstKey()}` : nameOf(field.key));
    fillRange();
    if (isWhole()) commit();
    else [...inputs.values()].find((input) => input.value === "")?.focus();
  });

  select.addEventListener("change", () => {
    const next = select.value;
    const before = unit;
    unit = next;
    isChosen = true;
    for (const [key, number] of Object.entries(parts)) {
      if (key === "within" || key === "confidence" || number.trim() === "") continue;
      // Each number of a list by itself.
      const converted = number.split(/([\s,;]+)/).map((piece, place) => {
        if (place % 2 === 1 || piece === "") return piece;
        return splitUnit(engine.convert(`${piece} ${before}`, next) ?? piece)?.number ?? piece;
      });
      parts[key] = converted.join("");
    }
    main.value = parts[firstKey()] ?? "";
    fillRange();
    commit();
  });

  /** Takes a value of the file apart; false where it has another form. */
  const take = (value: Value | undefined, given: string): boolean => {
    const found: Record<string, string> = {};
    const unitsFound = new Set<string>();
    const unitOf: Record<string, string> = {};
    const one = (key: string, inner: Value): boolean => {
      if (Array.isArray(inner)) {
        if (!inner.every((entry) => typeof entry === "number" || typeof entry === "string")) return false;
        const pieces = inner.map((entry) => (typeof entry === "number" ? { number: String(entry), unit: "" } : splitUnit(entry)));
        if (pieces.some((piece) => piece === undefined)) return false;
        for (const piece of pieces) if (piece) unitsFound.add(piece.unit);
        found[key] = pieces.map((piece) => piece?.number).join(" ");
        return isList;
      }
      if (typeof inner === "number") {
        found[key] = key === central && Number(given) === inner ? given : String(inner);
        return true;
      }
      if (typeof inner !== "string") return false;
      if (key === "within") {
        found[key] = inner.replace(/\s*%\s*$/, "");
        return true;
      }
      const split = splitUnit(inner);
      if (!split) return false;
      found[key] = split.number;
      if (key !== "confidence") {
        unitsFound.add(split.unit);
        unitOf[key] = split.unit;
      }
      return true;
    };
    const isTable = typeof value === "object" && !Array.isArray(value);
    if (value === undefined || (isTable && field.range !== true)) return false;
    const { source: named = "", ...numbers } = isTable ? value : { [central]: value };
    const keys = Object.keys(numbers);
    if (typeof named !== "string" || keys.length === 0 || !keys.every((key) => key in words.rangeKey)) return false;
    if (!Object.entries(numbers).every(([key, inner]) => one(key, inner))) return false;
    if (unitsFound.size > 1) {
      // "1.9 m" with a deviation of "10 cm": all of them in the unit of the first.
      const [first = ""] = unitsFound;
      for (const [key, of] of Object.entries(unitOf)) {
        // Of a list each number would have to be converted: it stands as it is written.
        const number = of === first ? found[key] : splitUnit(engine.convert(`${found[key] ?? ""} ${of}`, first) ?? "")?.number;
        if (number === undefined || isList) return false;
        found[key] = number;
      }
    }
    parts = found;
    source.value = named;
    [unit = unit] = [...unitsFound].filter(Boolean);
    return true;
  };

  return {
    elements: [whole],
    show: (given) => {
      if (given === shown && given !== undefined) return;
      if (given === undefined && isBusy(main, source, ...inputs.values())) return;
      shown = given;
      isForeign = false;
      source.value = "";
      if (given === undefined) {
        parts = {};
        if (!isChosen) unit = usualUnit();
      } else if (!take(readValue(given), given)) {
        isForeign = true;
        parts = { [central]: given.replaceAll(/\s*\n\s*/g, " ") };
      } else isChosen = false;
      const now = parts[firstKey()] ?? "";
      if (main.value !== now) main.value = now;
      main.classList.toggle("raw", isForeign);
      fillUnits();
      select.hidden ||= isForeign;
      fillRange();
      fillModes();
      fillSource();
      complain(null);
    },
  };
}

const CONTROLS: Partial<Record<Field["kind"], (asked: Asked) => Control>> = {
  quantity,
  quantities: quantity,
  number: quantity,
  numbers: quantity,
  integer: quantity,
  "angle-or-hour": quantity,
  choice,
  flag,
  text,
};
