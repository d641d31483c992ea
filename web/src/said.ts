// What the engine says of a case, in words of the page: a key is the name of its field, what is to be written is code.
import { type Child, h } from "./dom.js";
import { type Problem, sentence } from "./engine.js";
import { fieldOf, groupOf, nameOf } from "./keys.js";
import { texts } from "./texts/en.js";
import { readValue } from "./toml.js";

/** A sentence of the engine, in which backticks stand around keys and texts of the file. */
export const said = (words: string): Child[] =>
  words.split("`").map((part, place, parts): Child => {
    // A last backtick without another one is a letter as any other.
    if (place % 2 === 0) return part;
    if (place === parts.length - 1) return `\`${part}`;
    const key = part.replace(/\[\d+\]$/, "");
    return fieldOf(key) || groupOf(key) ? h("b", { class: "key", title: part }, nameOf(key)) : h("code", {}, part);
  });

/** A problem in two sentences, what is wrong and what to write, for who fills in a form and sees no quotes. */
export function inForm({ title, help }: Problem, raw = ""): string[] {
  const plain = /^write \S+ = (\S+) without quotes$/.exec(help ?? "")?.[1];
  const typed = readValue(raw);
  if (plain !== undefined && typeof typed === "string") return texts.form.notPlain(typed, plain);
  return [title, help].filter((words) => words !== null).map(sentence);
}
