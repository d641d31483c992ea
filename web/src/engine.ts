// The engine: the only file of the page that calls the WebAssembly. What goes in is the text of a case file, what
// comes out is what the engine says of it. Places are offsets into that text, as JavaScript counts them.
import * as wasm from "../pkg/deltav_web.js";
import { unpack } from "./packed.js";

export type Units = "si" | "us" | "uk" | "";
export type Command =
  | "reconstruct"
  | "impact"
  | "motion"
  | "crush"
  | "estimate"
  | "uncertainty"
  | "sensitivity"
  | "compare"
  | "recorder"
  | "avoid";

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
  units: "si" | "us" | "uk" | "";
}

export interface Warning {
  code: string;
  message: string;
  vehicle: 1 | 2 | null;
  keys?: string[];
  /** It concerns only an exact solution that is not the answer. */
  aside: boolean;
}

/** An exact solution that is not the answer of its case: the case has more evidence than it uses. */
export interface ExactSolution {
  /** The part of the evidence that it uses. */
  by: string;
  /** Of each vehicle; nothing of one that does not move. */
  speeds: [string | null, string | null];
  delta_v: [string | null, string | null];
  /** That it is not the answer, and why. */
  caveat: string;
}

/** A chart that stands beside the tables of an answer. */
export interface Chart {
  name: string;
  title: string;
  svg: string;
}

/** A number that a slider moves, in the unit in which the case has it. */
export interface Slider {
  key: string;
  unit: string;
  value: number;
  least: number;
  most: number;
  step: number;
}

/** An avoidability with its sliders moved, and the case that has these numbers. */
export type Moved = { ok: true; text: string; headline: string[]; html: string; charts: Chart[] } | NoAnswer;

export interface Answer {
  ok: true;
  headline: string[];
  html: string;
  charts: Chart[];
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
  /** Where the impulse acts. */
  contact: Point | null;
  bodies: (Body | null)[];
  handles: Handle[];
  /** What a place of the scene is short of its place in the survey. */
  survey: Point;
  /** The site plan that the case names. */
  plan: Plan | null;
}

/** A picture of the scene from above: its lower left corner in metres of the survey, and radians from the x axis to its lower edge. */
export interface Plan {
  file: string;
  corner: Point;
  width: number;
  angle: number;
}

/** The plan view at the impact, or the way to rest; the empty one is what the case has. */
export type View = "scene" | "motion" | "" | "none";

/** What is seen first of a case. */
export interface Look {
  ok: true;
  command: Command;
  /** What the case can be asked, the fullest answer first. */
  able: Command[];
  units: "si" | "us" | "uk";
  headline: string[];
  /** The exact solution if it is not the answer, which is then that of an estimate. */
  exact: ExactSolution | null;
  warnings: Warning[];
  scene: Scene | null;
}

/** Why there is none. Of a text that is no case the rest cannot be known. */
export type Refused = NoAnswer & Partial<Pick<Look, "command" | "able" | "units" | "scene">>;

export interface Template {
  name: string;
  title: string;
  /** What it is for. */
  purpose: string;
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
export type Edited = { ok: true; text: string } | NoAnswer;
export type Drawn = { ok: true; svg: string; title: string; description: string } | { ok: false; message: string };

export type Explained = { title: string; html: string } | { error: string; nearest: string[] };

let compiled: WebAssembly.Module | undefined;
let hash: Promise<string> | undefined;

/** The engine that stands in the page, as it comes out of its wrapping. */
function unpacked(): Response {
  const packed = document.getElementById("deltav-engine");
  const stream = new Blob([unpack(packed?.textContent ?? "", Number(packed?.dataset.bytes))]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream, { headers: { "content-type": "application/wasm" } });
}

/** Compiles the engine that stands in the page while it is unpacked, and starts it. */
export async function start(): Promise<void> {
  compiled = await WebAssembly.compileStreaming(unpacked());
  wasm.initSync({ module: compiled });
}

/** The compiled engine, for a worker. */
export const module = (): WebAssembly.Module => {
  if (!compiled) throw new Error("the engine has not been started");
  return compiled;
};

/** The SHA-256 of the engine. It is unpacked once more: no answer waits for it. */
export const engineHash = (): Promise<string> => (hash ??= unpacked().arrayBuffer().then(sha256));

/** The bytes of a text in base64; browsers before 2025 have no function of their own for it. */
export function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const { fromBase64 } = Uint8Array as { fromBase64?: (text: string) => Uint8Array<ArrayBuffer> };
  if (fromBase64) return fromBase64.call(Uint8Array, base64);
  const binary = atob(base64);
  const bytes = new Uint8Array(binary.length);
  for (let at = 0; at < binary.length; at += 1) bytes[at] = binary.charCodeAt(at);
  return bytes;
}

/** The SHA-256 of bytes, as text. */
export async function sha256(data: BufferSource): Promise<string> {
  const digest = await crypto.subtle.digest("SHA-256", data);
  return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

const read = <T>(json: string): T => JSON.parse(json) as T;

export const version = (): string => wasm.version();
let offered: Template[] | undefined;
export const templates = (): Template[] => (offered ??= read<Template[]>(wasm.templates()));
export const form = (): Group[] => read(wasm.form());
export const explain = (word: string): Explained => read(wasm.explain(word));
export const check = (text: string): Check => read(wasm.check(text));
export const look = (text: string, command: Command | "", units: Units, what: View, viewport: Viewport | null): Look | Refused =>
  read(wasm.look(text, command, units, what, viewport ? JSON.stringify(viewport) : ""));
export const answer = (text: string, command: Command, units: Units, name: string): Answer | NoAnswer =>
  read(wasm.answer(text, command, units, name));
export const drag = (text: string, handle: Handle, at: Point): { ok: true; text: string } | NoAnswer =>
  read(wasm.drag(text, JSON.stringify(handle), JSON.stringify({ at })));
export const keepPlan = (text: string, plan: Plan): { ok: true; text: string } | NoAnswer =>
  read(wasm.keep_plan(text, JSON.stringify(plan)));
/** A table of a recorder, as it was copied, in a key of the text. */
export const paste = (text: string, key: string, table: string): Edited => read(wasm.paste(text, key, table));
export const edit = (text: string, key: string, value: string): Edited => read(wasm.edit(text, key, value));
/** A quantity in another unit; nothing where it is none, or not of that unit. */
export const convert = (value: string, unit: string): string | undefined =>
  read<{ text?: string }>(wasm.convert(value, unit)).text;
export const draw = (text: string, what: string, units: Units): Drawn => read(wasm.draw(text, what, units));
export const motion = (text: string, units: Units): Film | NoAnswer =>
  read(wasm.motion(text, units, ""));
export const report = (text: string, name: string, command: Command, units: Units, plan?: Uint8Array): Report =>
  read(wasm.report(text, name, command, units, plan));
/** A page with a case and its report in its slot, as `--live` of the program makes it. */
export const live = (page: string, text: string, name: string, command: Command, units: Units, plan?: Uint8Array): Report =>
  read(wasm.live(page, text, name, command, units, plan));

/** What the engine words as a part of a line, as a sentence. */
export const sentence = (words: string): string =>
  `${(words[0] ?? "").toUpperCase()}${words.slice(1)}${/[.!?]$/.test(words) ? "" : "."}`;

/** Why there is no answer, in sentences. */
export const reason = ({ problems, message }: NoAnswer): string =>
  problems.length > 0 ? problems.map(({ title }) => sentence(title)).join("\n") : message;
