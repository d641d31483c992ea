// What can stand at a place of the text: the keys of the table above it, and the words of a choice.
import type { Completion, CompletionContext, CompletionResult } from "@codemirror/autocomplete";
import type { EditorState } from "@codemirror/state";

import { h } from "./dom.js";
import { fieldOf, groupOf, groups, meaningOf } from "./keys.js";

/** The table in which a line stands. */
function tableAbove(state: EditorState, line: number): string {
  for (let number = line; number >= 1; number -= 1) {
    const header = /^\s*\[\[?\s*([^\]]+?)\s*\]/.exec(state.doc.line(number).text);
    if (header) return (header[1] ?? "").replaceAll(/\s/g, "");
  }
  return "";
}

const join = (table: string, name: string): string => (table === "" ? name : `${table}.${name}`);

/** The key of the line at a place of the text. */
export function keyAt(state: EditorState, position: number): string | undefined {
  const line = state.doc.lineAt(position);
  const header = /^\s*\[\[?\s*([^\]]+?)\s*\]/.exec(line.text);
  if (header) return header[1]?.replaceAll(/\s/g, "");
  const name = /^\s*([A-Za-z0-9_.-]+)\s*=/.exec(line.text)?.[1];
  return name && join(tableAbove(state, line.number), name);
}

function information(key: string): { info: () => HTMLElement } {
  return { info: () => h("div", { class: "hover-help" }, meaningOf(key)) };
}

export function completions(context: CompletionContext): CompletionResult | null {
  const line = context.state.doc.lineAt(context.pos);
  const before = line.text.slice(0, context.pos - line.from);

  const header = /^\s*\[\[?([A-Za-z0-9_.-]*)$/.exec(before);
  if (header) {
    const options = groups().map((group) => ({ label: group.key, ...information(group.key) }));
    return { from: context.pos - (header[1]?.length ?? 0), options };
  }

  const key = /^\s*([A-Za-z0-9_.-]*)$/.exec(before);
  if (key) {
    if (!context.explicit && key[1] === "") return null;
    const table = tableAbove(context.state, line.number);
    const group = groupOf(table);
    if (!group) return null;
    const option = (entry: { key: string }, apply: string): Completion => ({
      label: entry.key.slice(table === "" ? 0 : table.length + 1),
      apply: entry.key.slice(table === "" ? 0 : table.length + 1) + apply,
      ...information(entry.key),
    });
    const options = group.fields.map((field) => option(field, " = ")).concat(group.groups.map((inner) => option(inner, " = ")));
    return { from: context.pos - (key[1]?.length ?? 0), options };
  }

  const choice = /^\s*([A-Za-z0-9_.-]+)\s*=\s*("?)([^"]*)$/.exec(before);
  if (choice) {
    const field = fieldOf(join(tableAbove(context.state, line.number), choice[1] ?? ""));
    const quoted = choice[2] === '"';
    if (field?.choices.length) {
      const from = context.pos - (choice[3]?.length ?? 0);
      return { from, options: field.choices.map((label) => ({ label, apply: quoted ? label : `"${label}"` })) };
    }
    const unit = quoted && /^[-+−\d.\s]*\d\s*([^\d\s]*)$/.exec(choice[3] ?? "");
    if (unit && field?.units.length) {
      return { from: context.pos - (unit[1]?.length ?? 0), options: field.units.map((label) => ({ label })) };
    }
  }
  return null;
}
