// What the engine says of a case, in words of the page: a key is the name of its field, a command of the program the
// view that does the same, and what is to be written the field with its value.
import { type Child, h, markup, showDialog } from "./dom.js";
import { type Problem, explain, sentence } from "./engine.js";
import { fieldOf, groupOf, groups, label, nameOf, root } from "./keys.js";
import { texts } from "./texts/en.js";
import { type Value, readValue } from "./toml.js";

const words = texts.said;

/** A sentence of the engine, in which backticks stand around keys and texts of the file. */
export const said = (sentences: string): Child[] =>
  sentences.split("`").map((part, place, parts): Child => {
    // A last backtick without another one is a letter as any other.
    if (place === parts.length - 1 && place % 2 === 1) return `\`${part}`;
    return place % 2 === 0 ? plain(part) : (code(part) ?? h("code", {}, part));
  });

/** The same, for who works in the text of the file: what is to be written stays as it is to be written. */
export const saidOfText = (sentences: string): Child[] =>
  sentences.split("`").map((part, place, parts): Child => {
    if (place === parts.length - 1 && place % 2 === 1) return `\`${part}`;
    return place % 2 === 0 ? part : h("code", {}, part);
  });

/** A problem in two sentences, what is wrong and what to write, for who fills in a form and sees no quotes. */
export function inForm({ title, help }: Problem, raw = ""): string[] {
  const plainNumber = /^write \S+ = (\S+) without quotes$/.exec(help ?? "")?.[1];
  const typed = readValue(raw);
  if (plainNumber !== undefined && typeof typed === "string") return texts.form.notPlain(typed, plainNumber);
  return [title, help && toFill(help)].filter((words) => words !== null).map(sentence);
}

/** What is to be given, as fields to fill in: the engine's numbers are examples. */
function toFill(help: string): string {
  const example = (key: string, value: string) => {
    const read = readValue(value);
    return texts.form.forExample(`\`${key}\``, typeof read === "string" ? read : typeof read === "object" ? `\`${value}\`` : value);
  };
  const [line, key, value] = /^add a line such as (\w+) = ("[^"]*"|[^\s;"]+)/.exec(help) ?? [];
  if (line !== undefined && key !== undefined && value !== undefined) return `${texts.form.fillIn} ${example(key, value)}${help.slice(line.length)}`;
  if (!help.startsWith("give `")) return help;
  return help
    .replaceAll(/`(\w+) = ([^`]+)`(?= or\b)/g, (_, key: string, value: string) => `${example(key, value)},`)
    .replaceAll(/`(\w+) = ([^`]+)`/g, (_, key: string, value: string) => example(key, value))
    .replace(/^give /, `${texts.form.fillIn} `);
}

/** Markup of the engine in words of the page. */
export function inWords(element: HTMLElement): void {
  for (const head of element.querySelectorAll("th")) {
    const view = words.commands[head.textContent];
    if (view !== undefined && head.scope === "row") head.textContent = capital(view);
  }
  for (const given of element.querySelectorAll("code, pre")) {
    const text = given.textContent.trim();
    const isBlock = given.tagName === "PRE";
    if (!isBlock && given.parentElement?.tagName === "PRE") continue;
    const child = isBlock && !text.startsWith("deltav ") ? null : code(text);
    if (child === null) continue;
    const before = given.previousSibling?.textContent ?? "";
    const begins = /^\s*$|[.!?]\s*$/.test(before) && given.parentElement?.tagName !== "TD";
    if (typeof child === "string") given.replaceWith(isBlock ? h("p", {}, capital(child)) : begins ? capital(child) : child);
    else given.replaceWith(child);
  }
  const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
  const found: Text[] = [];
  while (walker.nextNode()) found.push(walker.currentNode as Text);
  for (const text of found) {
    if (text.parentElement?.closest("code, pre, button, svg")) continue;
    const said = plain(text.data);
    if (said !== text.data) text.data = said;
  }
}

const capital = (text: string): string => (text[0] ?? "").toUpperCase() + text.slice(1);

/** A whole key. */
const PATH = String.raw`(?:vehicle[12]|impact|reconstruct|scene|surface|report|avoid)(?:\.[A-Za-z_]\w*(?:\[\d+\])?)+`;

/** What stands in no quotes. */
function plain(text: string): string {
  return text
    .replaceAll(/ \(deltav explain [\w-]+\)/g, "")
    .replaceAll(/for --what ([a-z, -]+)/g, (_, what: string) => `for ${what.replaceAll("-", " ")}`)
    .replaceAll(/\b([a-z_]\w*) = (\{[^{}]*\}|"[^"]*")/g, (all, key: string, value: string) => (parts().has(key) ? `${within(key)}: ${valued(value)}` : all))
    .replaceAll(/\{ [a-z_]\w* = (?:[^{}]|\{[^{}]*\})*\}/g, valued)
    .replaceAll(/(?:a table )?\[((?:vehicle[12]|impact|reconstruct|scene|surface|report|avoid)[.\w]*)\]/g, (_, key: string) => `“${nameOf(key)}”`)
    .replaceAll(/\b(?:crush_plane|locked_together|energy_basis)\b/g, within)
    .replaceAll(new RegExp(`"(${PATH})"|\\b(${PATH})`, "g"), (_, quoted?: string, bare?: string) => nameOf(quoted ?? bare ?? ""));
}

/** What stands in quotes: a command, a key, or what is to be written; nothing where it is none of these. */
function code(text: string): string | HTMLElement | null {
  const topic = /^deltav explain (.+)$/s.exec(text)?.[1]?.replaceAll(/\s+/g, " ");
  if (topic === "CODE") return words.whatItMeans;
  if (topic !== undefined) {
    if (!("html" in explain(topic))) return words.explanation(topic);
    return h("button", { type: "button", class: "link", onclick: () => showTopic(topic) }, words.explanation(topic));
  }
  const command = /^(?:deltav )?([a-z]+)\b(.*)$/s.exec(text);
  if (command && (text.startsWith("deltav ") || command[2] === "")) {
    const drawn = /--what\s+(scene|motion)$/.exec(command[2] ?? "")?.[1];
    const view = drawn === undefined ? words.commands[command[1] ?? ""] : words.drawn[drawn];
    if (view !== undefined && (text.startsWith("deltav ") || isView(text))) return view;
  }
  const option = /^--([a-z-]+)/.exec(text)?.[1];
  if (option !== undefined) return words.options[option] ?? null;
  if (text.startsWith("{")) return valued(text);
  const named = keyed(text);
  if (named !== null) return named;
  const table = /^\[([\w.]+)\]$/.exec(text)?.[1];
  if (table !== undefined) return groupOf(table) || fieldOf(table) ? h("b", { class: "key", title: table }, nameOf(table)) : null;
  const [, key = "", value = ""] = /^([a-z_A-Z][\w.]*)\s*=\s*(.+)$/s.exec(text) ?? [];
  const name = key === "" ? null : keyed(key);
  return name && h("span", { title: text }, name, ": ", valued(value));
}

/** A word that is a view, and no key. */
const isView = (word: string): boolean => ["uncertainty", "sensitivity", "estimate", "compare"].includes(word);

/** A key by its name: a whole one, or one of which the sentence says where it stands. */
function keyed(key: string): HTMLElement | null {
  const whole = key.replaceAll(/\[\d+\]/g, "");
  const title = { class: "key", title: key };
  if (fieldOf(whole) || groupOf(whole) || new RegExp(`^${PATH}$`).test(key)) return h("b", title, nameOf(key));
  if (!/^[A-Za-z_]\w*$/.test(key) || !parts().has(key)) return null;
  return h("b", title, within(key));
}

/** A key within a sentence. "CG" and "PDOF" stay as they are. */
function within(key: string): string {
  const name = label(key);
  return /^[A-ZΔ]{2}|^.$/.test(name) ? name : (name[0] ?? "").toLowerCase() + name.slice(1);
}

let last: Set<string> | undefined;

/** The last parts of all keys. */
function parts(): Set<string> {
  if (last) return last;
  last = new Set<string>();
  const add = (key: string) => last?.add(key.slice(key.lastIndexOf(".") + 1));
  for (const group of [root(), ...groups()]) {
    if (group.key !== "") add(group.key);
    for (const field of group.fields) {
      add(field.key);
      for (const inner of field.fields) add(inner.key);
    }
  }
  return last;
}

/** A value as it is to be written, in words; with its signs left out where it is only sketched. */
function valued(text: string): string {
  const read = readValue(text);
  return read === undefined ? text.replaceAll(/[{}[\]"]|(?= =) =/g, "").replaceAll(/ {2,}/g, " ").trim() : shown(read);
}

/** The value of a key in words; empty where it has none. */
export const valueInWords = (raw: string | undefined): string => (raw === undefined ? "" : valued(raw));

/** A value as a form shows it. */
function shown(value: Value): string {
  if (typeof value === "boolean") return value ? texts.form.yes : texts.form.no;
  if (Array.isArray(value)) return value.map(shown).join(", ");
  if (typeof value === "object") return Object.entries(value).map(([key, inner]) => `${within(key)} ${shown(inner)}`).join(", ");
  const key = typeof value === "string" && (fieldOf(value) ? nameOf(value) : value);
  return key === false ? String(value) : key;
}

/** What the glossary says of a topic, over the page. */
function showTopic(topic: string): void {
  const explained = explain(topic);
  if (!("html" in explained)) return;
  const page = h("div", { class: "help" });
  markup(page, explained.html);
  inWords(page);
  const dialog = h("dialog", { "aria-label": explained.title });
  dialog.append(page, h("button", { type: "button", class: "quiet", onclick: () => dialog.close() }, texts.close));
  showDialog(dialog);
}
