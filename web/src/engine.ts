// The engine: the only file of the page that calls the WebAssembly. What goes in is the text of a case file, what
// comes out is what the engine says of it. Places are offsets into that text, as JavaScript counts them.
import * as wasm from "../pkg/deltav_web.js";

export type Units = "si" | "us" | "";
export type Command =
  | "reconstruct"
  | "impact"
  | "motion"
  | "crush"
  | "estimate"
  | "uncertainty"
  | "sensitivity"
  | "compare";

export interface Problem {
  from: number;
  to: number;
  line: number | null;
  column: number | null;
  key: string | null;
  title: string;
  help: string | null;
}

export interface Given {
  from: number;
  to: number;
  text: string;
}

export interface Ability {
  able: boolean;
  why: string[];
}

export interface Check {
  problems: Problem[];
  values: Record<string, Given>;
  commands: Partial<Record<Command, Ability>>;
  judgement_html: string;
  units: "si" | "us" | "";
}

export interface Warning {
  code: string;
  message: string;
  vehicle: 1 | 2 | null;
  keys?: string[];
}

export interface Answer {
  ok: true;
  headline: string[];
  html: string;
  text: string;
  json: string;
  csv: string | null;
  warnings: Warning[];
}

export interface NoAnswer {
  ok: false;
  problems: Problem[];
  message: string;
}

export type Kind =
  | "quantity"
  | "quantities"
  | "number"
  | "numbers"
  | "integer"
  | "percent"
  | "choice"
  | "text"
  | "flag"
  | "names"
  | "wheels"
  | "angle-or-hour"
  | "table"
  | "tables"
  | "value";

export interface Field {
  key: string;
  title: string;
  help: string;
  /** What `explain` knows of it. */
  topic?: string | null;
  kind: Kind;
  units: string[];
  choices: string[];
  required: boolean;
  range: boolean;
  /** The keys of a table that can stand in place of a word or a number. */
  fields: Field[];
}

export interface Group {
  key: string;
  title: string;
  help: string;
  topic?: string | null;
  required?: boolean;
  /** Words that can stand in place of the table; none of what stands above the first table. */
  choices?: string[];
  fields: Field[];
  groups: Group[];
}

export type Point = [number, number];

export interface Viewport {
  left: number;
  bottom: number;
  right: number;
  top: number;
}

export interface Handle {
  kind: "body" | "heading" | "contact" | "plane" | "rest" | "rest_heading" | "point" | "station";
  vehicle: 1 | 2 | null;
  index?: number | null;
  at: Point;
  /** About which it turns, if it turns. */
  centre: Point;
  keys: string[];
}

export interface Body {
  vehicle: 1 | 2;
  outline: Point[];
  centre: Point;
  heading: number;
}

export interface Scene {
  ok: true;
  what: "scene" | "motion";
  svg: string;
  title: string;
  viewport: Viewport;
  /** A place of the scene is at `origin[0] + scale x`, `origin[1] − scale y` of the drawing. */
  origin: Point;
  scale: number;
  bodies: (Body | null)[];
  handles: Handle[];
}

export interface Template {
  name: string;
  title: string;
  text_si: string;
  text_us: string;
}

/** The motion of both vehicles at equal times. */
export interface Film {
  ok: true;
  /** Seconds from the impact to the last rest. */
  duration: number;
  /** The time is in seconds since the impact; the outline lies in the scene. */
  frames: { time: number; bodies: ({ outline: Point[]; centre: Point; heading: number } | null)[] }[];
}

export type Report = { ok: true; html: string } | NoAnswer;
export type Edited = { ok: true; text: string } | { ok: false; message: string };
export type Drawn = { ok: true; svg: string; title: string; description: string } | { ok: false; message: string };

export type Explained = { title: string; html: string } | { error: string; nearest: string[] };

let hash: Promise<string> = Promise.resolve("");
let compiled: WebAssembly.Module | undefined;

/** Unpacks, compiles and starts the engine that stands in the page. */
export async function start(): Promise<void> {
  const packed = document.getElementById("deltav-engine")?.textContent ?? "";
  const gzip = Uint8Array.from(atob(packed), (character) => character.charCodeAt(0));
  const bytes = await new Response(new Blob([gzip]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  compiled = await WebAssembly.compile(bytes);
  wasm.initSync({ module: compiled });
  // No answer waits for it.
  hash = sha256(bytes);
}

/** The compiled engine, for a worker. */
export const module = (): WebAssembly.Module => {
  if (!compiled) throw new Error("the engine has not been started");
  return compiled;
};

/** The SHA-256 of the engine. */
export const engineHash = (): Promise<string> => hash;

/** The SHA-256 of bytes, as text. */
export async function sha256(data: BufferSource): Promise<string> {
  const digest = await crypto.subtle.digest("SHA-256", data);
  return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

const read = <T>(json: string): T => JSON.parse(json) as T;

export const version = (): string => wasm.version();
export const templates = (): Template[] => read(wasm.templates());
export const form = (): Group[] => read(wasm.form());
export const explain = (word: string): Explained => read(wasm.explain(word));
export const check = (text: string): Check => read(wasm.check(text));
export const answer = (text: string, command: Command, units: Units, name: string): Answer | NoAnswer =>
  read(wasm.answer(text, command, units, name));
export const scene = (text: string, what: "scene" | "motion" | "", units: Units, viewport: Viewport | null): Scene | NoAnswer =>
  read(wasm.scene(text, what, units, viewport ? JSON.stringify(viewport) : ""));
export const drag = (text: string, handle: Handle, at: Point): { ok: true; text: string } | NoAnswer =>
  read(wasm.drag(text, JSON.stringify(handle), JSON.stringify({ at })));
export const edit = (text: string, key: string, value: string): Edited => read(wasm.edit(text, key, value));
/** A quantity in another unit; nothing where it is none, or not of that unit. */
export const convert = (value: string, unit: string): string | undefined =>
  read<{ text?: string }>(wasm.convert(value, unit)).text;
export const draw = (text: string, what: string, units: Units): Drawn => read(wasm.draw(text, what, units));
export const motion = (text: string, units: Units): Film | NoAnswer =>
  read(wasm.motion(text, units, ""));
export const report = (text: string, name: string, command: Command, units: Units): Report =>
  read(wasm.report(text, name, command, units));
/** A page with a case and its report in its slot, as `--live` of the program makes it. */
export const live = (page: string, text: string, name: string, command: Command, units: Units): Report =>
  read(wasm.live(page, text, name, command, units));

/** What the engine words as a part of a line, as a sentence. */
export const sentence = (words: string): string =>
  `${(words[0] ?? "").toUpperCase()}${words.slice(1)}${/[.!?]$/.test(words) ? "" : "."}`;

/** Why there is no answer, in sentences. */
export const reason = ({ problems, message }: NoAnswer): string =>
  problems.length > 0 ? problems.map(({ title }) => sentence(title)).join("\n") : message;
