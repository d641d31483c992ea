// The keys of a case file, as the engine lists them.
import * as engine from "./engine.js";
import type { Field, Group } from "./engine.js";
import { texts } from "./texts/en.js";

/**
 * The order in which one who was at the scene knows things: which vehicles, what size they have, how they were damaged,
 * where they stood, and what was before and after. What is not named here follows, in the order of the engine.
 */
const ORDER: Record<string, string[]> = {
  "": ["vehicle1", "vehicle2", "impact", "scene", "surface", "reconstruct", "avoid", "estimate", "uncertainty", "report"],
  vehicle: [
    "name", "kind", "model_year", "fixed", "mass", "weight", "class", "wheelbase", "length", "width", "track", "cg_to_front", "cg_to_front_axle", "diameter", "deformation_energy", "yaw_inertia", "yaw_radius",
    "crush", "heading", "contact", "position", "sideslip", "speed", "velocity", "yaw_rate", "certain_speed", "before", "after", "recorder",
  ],
  "vehicle.crush": ["side", "width", "depths", "spacing", "offset", "pdof", "ees", "stiffness"],
  "vehicle.crush.stiffness": ["category"],
  "vehicle.after": ["rest", "points", "friction", "drag"],
};

/** Whether a word in place of this table is more usual than its other keys. */
export const isWordUsual = (table: string) => table.endsWith(".stiffness");

/** The entries of a table in that order. */
function ordered<T extends { key: string }>(table: string, entries: T[]): T[] {
  const order = ORDER[table.replace(/^vehicle[12]/, "vehicle")] ?? [];
  const rank = ({ key }: T) => {
    const place = order.indexOf(key.slice(key.lastIndexOf(".") + 1));
    return place < 0 ? order.length : place;
  };
  return [...entries].sort((one, other) => rank(one) - rank(other));
}

let top: Group | undefined;
const byKey = new Map<string, Group>();
const fields = new Map<string, Field>();

/** A key that holds a table is a group of its own, whether it has a header in the file or not. */
function sorted(group: Group): Group {
  const isTable = (field: Field) => field.fields.length > 0 && (field.kind === "table" || field.kind === "choice");
  const tables = group.fields.filter(isTable).map((field): Group => ({ ...field, groups: [] }));
  return {
    ...group,
    fields: ordered(group.key, group.fields.filter((field) => !isTable(field))),
    groups: ordered(group.key, [...tables, ...group.groups]).map(sorted),
  };
}

function read(): Group {
  if (top) return top;
  const list = engine.form();
  const head = list.find((group) => group.key === "") ?? { key: "", title: "", help: "", choices: [], fields: [], groups: [] };
  top = sorted({ ...head, groups: [...head.groups, ...list.filter((group) => group.key !== "")] });
  const walk = (group: Group) => {
    byKey.set(group.key, group);
    for (const field of group.fields) fields.set(field.key, field);
    for (const inner of group.groups) walk(inner);
  };
  walk(top);
  return top;
}

/** What stands above the first table, with all tables in it. */
export const root = (): Group => read();

/** Every table that has a key. */
export function groups(): Group[] {
  read();
  return [...byKey.values()].filter((group) => group.key !== "");
}

export function groupOf(key: string): Group | undefined {
  read();
  return byKey.get(key);
}

export function fieldOf(key: string): Field | undefined {
  read();
  return fields.get(key);
}

/** What a key means, in a sentence or two. */
export function meaningOf(key: string): string | undefined {
  read();
  const entry = fields.get(key) ?? byKey.get(key);
  return entry && [entry.title, entry.help].filter(Boolean).join(". ");
}

/** The last part of a key in words: `yaw_inertia` is `Yaw inertia`, `A` stays `A`. */
export function label(key: string): string {
  const named = texts.labels[key.replace(/^vehicle[12]\./, "")] ?? texts.labels[key.slice(key.lastIndexOf(".") + 1)];
  if (named !== undefined) return named;
  const name = key.slice(key.lastIndexOf(".") + 1);
  // The engine counts the stations as the scene does.
  const station = /^depths\[(\d+)\]$/.exec(name)?.[1];
  if (station !== undefined) return texts.station(station);
  const words = name.replace(/\[(\d+)\]$/, " $1").replaceAll("_", " ").replace(/(\D)(\d)$/, (_, letter: string, digit: string) => (name.length > 2 ? `${letter} ${digit}` : `${letter}${digit}`));
  return words.length > 2 ? (words[0] ?? "").toUpperCase() + words.slice(1) : words;
}

/** A whole key in words: `vehicle1.crush.width` is `Vehicle 1, crush, width`. */
export function nameOf(key: string): string {
  return key.split(".").map((_, place, parts) => {
    const words = label(parts.slice(0, place + 1).join("."));
    // "CG" and "PDOF" stay as they are.
    return place === 0 || words.length <= 2 || /^[A-ZΔ]{2}/.test(words) ? words : (words[0] ?? "").toLowerCase() + words.slice(1);
  }).join(", ");
}
