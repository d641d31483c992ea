// What the engine says of the case, each in a panel of its own. A panel is brought up to date when it is seen.
import { afterPause, eachFrame, h, markup, s, unique } from "./dom.js";
import * as engine from "./engine.js";
import type { Command } from "./engine.js";
import { label, nameOf } from "./keys.js";
import { inWords, said } from "./said.js";
import { figure } from "./pictures.js";
import { type FileKind, type Finished, type Job, type Picture, Runner, type Unfinished, type With } from "./runs.js";
import type { Solved } from "./solved.js";
import { texts } from "./texts/en.js";

export interface Panel {
  element: HTMLElement;
  refresh(solved: Solved): void;
}

/** Saves what a panel shows. */
export type Save = (kind: FileKind) => void;

/** A row of buttons that save what a panel shows. */
function savers(title: string, kinds: FileKind[], save: Save): HTMLElement {
  const button = (kind: FileKind) => {
    const label = texts.savers.kinds[kind] ?? kind;
    return h("button", { type: "button", class: "quiet", "aria-label": texts.savers.of(title, label), onclick: () => save(kind) }, label);
  };
  return h("div", { class: "savers" }, h("span", {}, texts.savers.label), ...kinds.map(button));
}

const note = (words: string): HTMLElement => h("p", { class: "note" }, said(words));

/** That a view shows an exact solution which is not the answer. */
const caveat = ({ exact }: Solved): HTMLElement[] => (exact ? [h("p", { class: "note caveat" }, said(exact.caveat))] : []);

/** Why a command cannot be done, in the engine's words. */
function cannot(element: HTMLElement, solved: Solved, command: Command): boolean {
  if (solved.check.problems.length > 0) {
    element.replaceChildren(note(texts.panels.problems));
    return true;
  }
  const ability = solved.check.commands[command];
  if (ability && !ability.able) {
    element.replaceChildren(note(ability.why.length > 0 ? ability.why.map(engine.sentence).join("\n") : texts.panels.cannot));
    return true;
  }
  return false;
}

function document_(html: string): HTMLElement {
  const element = h("div", { class: "document" });
  markup(element, html);
  inWords(element);
  // Tables that are wider than the panel are scrolled, by the keyboard as well.
  for (const table of element.querySelectorAll("table")) {
    const title = table.querySelector("caption")?.textContent ?? texts.panels.table;
    const box = h("div", { class: "scrolls", tabindex: 0, role: "group", "aria-label": title });
    table.replaceWith(box);
    box.append(table);
  }
  return element;
}

/** The tables of the answer. */
export class Results implements Panel {
  readonly element = h("div");

  refresh(solved: Solved): void {
    if (solved.command === "avoid") {
      this.element.replaceChildren(note(texts.avoid.elsewhere));
      return;
    }
    if (!solved.answer || !solved.answer.ok) {
      this.element.replaceChildren(note(solved.answer ? engine.reason(solved.answer) : texts.panels.problems));
      return;
    }
    this.element.replaceChildren(document_(solved.weighed?.html ?? solved.answer.html));
  }
}

/** How the file was understood. */
export class Inputs implements Panel {
  readonly element = h("div");

  refresh(solved: Solved): void {
    if (solved.check.problems.length > 0) this.element.replaceChildren(note(texts.panels.problems));
    else this.element.replaceChildren(document_(solved.check.judgement_html));
  }
}

/** All drawings that the case has something for. */
export class Drawings implements Panel {
  readonly element = h("div", { class: "drawings" });

  refresh(solved: Solved): void {
    if (solved.check.problems.length > 0) {
      this.element.replaceChildren(note(texts.panels.problems));
      return;
    }
    const figures: HTMLElement[] = [];
    for (const what of ["damage", "reconciliation", "energy", "momentum", "motion", "motion-curves"]) {
      const drawn = engine.draw(solved.text, what, solved.units);
      if (drawn.ok) figures.push(figure(what, drawn.title, drawn.svg));
    }
    const plain = solved.weighs ? (solved.weighed?.plain ?? []) : ["plain-scene", "plain-motion"].flatMap((what) => {
      const drawn = engine.draw(solved.text, what, solved.units);
      return drawn.ok ? [{ name: what, title: drawn.title, svg: drawn.svg }] : [];
    });
    if (plain.length > 0) figures.push(h("h2", {}, texts.panels.plain), ...plain.map(({ name, title, svg }) => figure(name, title, svg)));
    else if (solved.weighs && !solved.weighed?.plain) figures.push(note(solved.weighed ? texts.panels.plainOld : texts.panels.plainLater));
    this.element.replaceChildren(...(figures.length > 0 ? figures : [note(texts.panels.noDrawings)]));
  }
}

/** The influence of each input, as bars. */
export class Sensitivity implements Panel {
  readonly element = h("div");

  constructor(
    private readonly lead: (key: string) => void,
    private readonly save: Save,
  ) {}

  refresh(solved: Solved): void {
    if (cannot(this.element, solved, "sensitivity")) return;
    const answer = engine.answer(solved.text, "sensitivity", solved.units, solved.name);
    if (!answer.ok) {
      this.element.replaceChildren(note(engine.reason(answer)));
      return;
    }
    const { derivatives } = JSON.parse(answer.json) as {
      derivatives: { output: string; input: string; name?: string; influence: number }[];
    };
    const document = document_(answer.html);
    const first = derivatives[0]?.output;
    const rows = derivatives.filter((row) => row.output === first).slice(0, 16);
    const greatest = Math.max(...rows.map((row) => Math.abs(row.influence)), Number.MIN_VALUE);
    const bars = rows.map((row) => {
      const bar = h("span", { class: row.influence < 0 ? "bar falls" : "bar rises" });
      bar.style.width = `${(50 * Math.abs(row.influence)) / greatest}%`;
      return h("tr", {},
        h("th", { scope: "row" }, h("button", { type: "button", class: "link", title: row.input, onclick: () => this.lead(row.input) }, row.name ?? nameOf(row.input))),
        h("td", { class: "bars", "aria-hidden": "true" }, h("span", { class: "track" }, bar)),
        h("td", { class: "number right" }, `${row.influence < 0 ? "−" : "+"}${(100 * Math.abs(row.influence)).toFixed(2)} %`));
    });
    // The engine names the first output, with its vehicle and its value, above its first table.
    const output = document.querySelector("caption")?.textContent ?? "";
    this.element.replaceChildren(
      savers(texts.viewTabs.sensitivity ?? "", ["html", "json", "txt"], this.save),
      ...caveat(solved),
      h("table", { class: "influence" }, h("caption", {}, texts.sensitivity.caption(output)),
        h("thead", {}, h("tr", {}, h("th", { scope: "col" }, texts.sensitivity.input), h("td"), h("th", { scope: "col", class: "right" }, texts.sensitivity.influence))),
        h("tbody", {}, ...bars)),
      h("details", { class: "more" }, h("summary", {}, texts.sensitivity.tables), document),
    );
  }
}

/** The laws beside each other. */
export class Compare implements Panel {
  readonly element = h("div");

  constructor(private readonly save: Save) {}

  refresh(solved: Solved): void {
    if (cannot(this.element, solved, "compare")) return;
    const answer = engine.answer(solved.text, "compare", solved.units, solved.name);
    if (!answer.ok) this.element.replaceChildren(note(engine.reason(answer)));
    else this.element.replaceChildren(savers(texts.viewTabs.compare ?? "", ["html", "json", "csv", "txt"], this.save), document_(answer.html));
  }
}

/** (rows) as the program takes of itself; each is solved once for every input, and twice more. */
const INDEX_ROWS = 4096;

/** A computation that takes its time, with its progress and a button that ends it. */
export class Run implements Panel {
  readonly element = h("div", { class: "run" });
  private readonly runner = new Runner();
  private readonly samples = h("select", {}, ...[1_000, 10_000, 20_000, 100_000, 1_000_000].map((count) => h("option", { value: count }, count.toLocaleString("en"))));
  private readonly seed = h("input", { type: "number", class: "number short", value: 1, min: 0, step: 1 });
  private readonly method = h("select", {}, ...texts.run.methods.map(([value, name]) => h("option", { value }, name)));
  private readonly indices = h("input", { type: "checkbox" });
  private readonly prior = h("select", {}, ...texts.run.priors.map(([value, name]) => h("option", { value }, name)));
  private readonly particles = h("select", {}, ...[128, 256, 1_024, 4_096].map((count) => h("option", { value: count }, count.toLocaleString("en"))));
  private readonly quantity = h("select", {}, ...texts.run.quantities.map(([value, name]) => h("option", { value }, name)));
  private readonly limit = h("input", { type: "text", class: "number short", placeholder: texts.run.limitExample, "aria-label": texts.run.limit });
  private readonly saving: HTMLElement;
  private readonly start: HTMLButtonElement;
  private readonly end: HTMLButtonElement;
  private readonly bar = h("progress", { max: 1, value: 0, hidden: true, "aria-label": texts.run.progress });
  private readonly status = h("p", { class: "hint", role: "status" });
  private readonly body = h("div");
  private readonly controls: HTMLElement;
  private readonly why = h("div");
  private solved: Solved | null = null;
  private of = "";
  private isAnswer = false;
  private partial = false;

  constructor(
    private readonly kind: "uncertainty" | "estimate",
    private readonly finished: (job: Job, result: Finished) => void,
    save: Save,
    /** A run has begun, or has ended with or without an answer. */
    private readonly changed: () => void = () => undefined,
  ) {
    const words = texts.run[kind];
    this.samples.value = "100000";
    this.start = h("button", { type: "button", class: "primary", onclick: () => this.run() }, words.start);
    this.end = h("button", { type: "button", onclick: () => this.stop(), hidden: true }, texts.run.end);
    this.particles.value = "256";
    const labelled = (words: string, control: HTMLElement) => h("label", {}, words, " ", control);
    const settings = kind === "uncertainty"
      ? [labelled(texts.run.samples, this.samples), labelled(texts.run.method, this.method),
        h("label", { class: "check", title: texts.run.indicesHelp }, this.indices, " ", texts.run.indices)]
      : [labelled(texts.run.prior, this.prior), labelled(texts.run.particles, this.particles),
        h("span", { class: "above" }, labelled(texts.run.above, this.quantity), ` ${texts.run.isAbove} `, this.limit)];
    this.saving = savers(texts.viewTabs[kind] ?? "", ["html", "json", "csv", "txt"], save);
    this.saving.hidden = true;
    this.controls = h("div", { class: "run-controls" },
      ...settings, h("label", {}, texts.run.seed, " ", this.seed), this.start, this.end, this.bar);
    this.element.append(h("p", { class: "note" }, words.what), this.why, this.controls, this.status, this.saving, this.body);
  }

  get busy(): boolean {
    return !this.end.hidden;
  }

  /** Starts the run, unless it runs already. */
  begin(): void {
    if (!this.runner.busy && !this.controls.hidden) this.run();
  }

  /** A file of the answer that is shown; nothing where there is none of this text. */
  file(kind: FileKind, text: string): Promise<string> | null {
    return this.of === text && !this.partial ? this.runner.file(kind) : null;
  }

  refresh(solved: Solved): void {
    this.solved = solved;
    const isUnable = cannot(this.why, solved, this.kind);
    if (!isUnable) this.why.replaceChildren();
    this.controls.hidden = isUnable;
    if (this.of !== "" && this.of !== solved.text) {
      this.body.classList.add("stale");
      if (!this.runner.busy) this.status.textContent = texts.run.old;
    } else this.body.classList.remove("stale");
  }

  private stop(): void {
    this.runner.end();
    this.idle(this.partial ? texts.run.endedWithSome : texts.run.ended);
  }

  private idle(words: string): void {
    this.status.textContent = words;
    this.bar.hidden = true;
    this.end.hidden = true;
    this.start.disabled = false;
    this.changed();
  }

  private run(): void {
    const { solved } = this;
    if (!solved) return;
    const options: Job["options"] = { seed: this.seed.valueAsNumber || 0 };
    if (this.kind === "uncertainty") {
      options.samples = Number(this.samples.value);
      options.method = this.method.value;
      if (this.indices.checked) options.indices = INDEX_ROWS;
    } else {
      options.particles = Number(this.particles.value);
      if (this.prior.value !== "") options.prior = this.prior.value;
      if (this.limit.value.trim() !== "") options.above = [`${this.quantity.value} ${this.limit.value.trim()}`];
    }
    const job: Job = { kind: this.kind, text: solved.text, name: solved.name, units: solved.units, options };
    this.bar.removeAttribute("value");
    this.bar.hidden = false;
    this.end.hidden = false;
    this.start.disabled = true;
    this.partial = false;
    this.saving.hidden = true;
    this.status.textContent = texts.run.running;
    this.changed();
    this.runner.start(job, {
      progress: (counted, done, total) => {
        this.bar.max = Math.max(total, 1);
        this.bar.value = done;
        this.status.textContent = texts.run.done(counted, done, total);
      },
      answer: (answer, milliseconds, isLast) => {
        this.show(answer);
        this.of = job.text;
        this.partial = !isLast;
        if (!isLast) return;
        this.idle(answer.ok ? texts.run.took(milliseconds) : "");
        this.element.dataset.milliseconds = String(milliseconds);
        if (answer.ok) this.finished(job, answer);
        this.isAnswer = answer.ok;
        if (this.solved) this.refresh(this.solved);
      },
      pictures: (pictures) => {
        this.draw(pictures);
        this.saving.hidden = !this.isAnswer || this.runner.busy;
      },
    });
  }

  private show(answer: Finished | Unfinished): void {
    this.body.replaceChildren(answer.ok ? document_(answer.html) : note(answer.message));
  }

  private draw(pictures: Picture[]): void {
    this.body.append(...pictures.map(({ name, output, title, svg }) => figure(`${name}-${output}`, title, svg)));
  }
}

/** A slider for a number of the case, in the unit of the case. */
class NumberSlider {
  private readonly input = h("input", { type: "range", id: unique("slider") });
  private readonly shown = h("output", { for: this.input.id });
  readonly element: HTMLElement;
  private slider: engine.Slider | null = null;

  constructor(readonly key: string, label: string, changed: () => void) {
    this.input.dataset.slider = key;
    this.element = h("div", { class: "slider" }, h("label", { for: this.input.id }, label), this.input, this.shown);
    this.input.addEventListener("input", () => {
      this.say();
      changed();
    });
  }

  /** Stands where the case has its number; hidden where the case has none. */
  set(slider: engine.Slider | undefined): void {
    this.slider = slider ?? null;
    this.element.hidden = !slider;
    if (!slider) return;
    for (const [name, value] of [["min", slider.least], ["max", slider.most], ["step", slider.step]] as const) this.input.setAttribute(name, String(value));
    this.input.value = String(slider.value);
    this.say();
  }

  /** Where it stands; nothing where that is where the case has it. */
  get moved(): number | null {
    const { slider, input } = this;
    if (!slider || Math.abs(input.valueAsNumber - slider.value) < slider.step / 2) return null;
    return Number(input.valueAsNumber.toFixed(6));
  }

  private say(): void {
    const words = `${Number(this.input.valueAsNumber.toFixed(3))} ${this.slider?.unit ?? ""}`;
    this.shown.textContent = words;
    this.input.setAttribute("aria-valuetext", words);
  }
}

/** Whether it was avoidable. Two sliders ask it for another speed and another reaction time, and leave the case as it is. */
export class Avoid implements Panel {
  readonly element = h("div", { class: "run avoid" });
  private readonly runner = new Runner();
  private readonly why = h("div");
  private readonly sliders = (["avoid.limit", "avoid.reaction_time"] as const).map((key) => new NumberSlider(key, texts.avoid.sliders[key], () => this.slid()));
  private readonly use = h("button", { type: "button", class: "primary", onclick: () => this.useMoved() }, texts.avoid.use);
  private readonly back = h("button", { type: "button", onclick: () => this.takeBack() }, texts.avoid.back);
  private readonly end = h("button", { type: "button", hidden: true, onclick: () => this.stop() }, texts.run.end);
  private readonly bar = h("progress", { max: 1, value: 0, hidden: true, "aria-label": texts.run.progress });
  private readonly status = h("p", { class: "hint", role: "status" });
  /** What is found before there is an answer. */
  private readonly finding = h("span", { class: "hint", hidden: true });
  private readonly what: HTMLElement;
  private readonly saving: HTMLElement;
  private readonly body = h("div");
  private job: Job | null = null;
  private answer: Finished | null = null;
  /** The case with the numbers of the sliders. */
  private moved: string | null = null;
  private readonly move = eachFrame((sampled: boolean) => this.ask(sampled));
  private readonly rest = afterPause(350, () => this.move(true));

  constructor(
    private readonly finished: (job: Job, result: Finished) => void,
    save: Save,
    /** Another text for the case. */
    private readonly write: (text: string) => void,
  ) {
    this.saving = savers(texts.viewTabs.avoid ?? "", ["html", "json", "txt"], save);
    this.what = h("div", { class: "sliders", role: "group", "aria-label": texts.avoid.what },
      ...this.sliders.map(({ element }) => element), h("div", { class: "slider-buttons" }, this.use, this.back, this.status));
    this.element.append(this.why, h("div", { class: "run-controls" }, this.finding, this.bar, this.end), this.saving, this.what, this.body);
    this.show(null);
  }

  /** A file of the answer for this text; nothing where there is none yet. */
  file(kind: FileKind, text: string, besides?: With): Promise<string> | null {
    return this.answer && this.job?.text === text ? this.runner.file(kind, besides) : null;
  }

  refresh(solved: Solved): void {
    const { text, name, units } = solved;
    if (cannot(this.why, solved, "avoid")) {
      this.runner.end();
      this.job = null;
      this.show(null);
      return;
    }
    this.why.replaceChildren();
    if (this.job?.text === text && this.job.name === name && this.job.units === units) return;
    this.body.classList.add("stale");
    this.answer = null;
    const job: Job = { kind: "avoid", text, name, units, options: {} };
    this.job = job;
    this.rest.cancel();
    this.end.hidden = false;
    this.runner.start(job, {
      progress: (counted, done, total) => {
        for (const part of [this.bar, this.finding]) part.hidden = false;
        this.bar.max = Math.max(total, 1);
        this.bar.value = done;
        this.finding.textContent = texts.avoid.finding(texts.run.done(counted, done, total));
      },
      answer: (answer) => {
        if (answer.ok) this.show(answer);
        else {
          this.show(null);
          this.why.replaceChildren(note(engine.reason({ ok: false, message: answer.message, problems: answer.problems ?? [] })));
        }
      },
      // None: but then the files can be asked for.
      pictures: () => this.answer && this.finished(job, this.answer),
      moved: (answer, to, milliseconds) => this.showMoved(answer, to, milliseconds),
    });
  }

  private stop(): void {
    this.runner.end();
    this.show(null);
    this.why.replaceChildren(note(texts.run.ended));
  }

  /** The answer of the case, or that there is none. */
  private show(answer: Finished | null): void {
    this.answer = answer;
    this.moved = null;
    for (const part of [this.bar, this.finding, this.end]) part.hidden = true;
    this.what.hidden = !answer;
    this.saving.hidden = !answer;
    for (const slider of this.sliders) slider.set(answer?.sliders?.find(({ key }) => key === slider.key));
    if (answer) this.draw(answer.html, answer.charts ?? []);
    else this.body.replaceChildren();
    this.showState();
  }

  private draw(html: string, charts: engine.Chart[]): void {
    this.body.classList.remove("stale");
    const figures = charts.map(({ name, title, svg }) => figure(name, title, svg));
    // What moves stands first, so that nothing above it makes it jump.
    const [first, ...others] = figures;
    this.body.replaceChildren(...(first ? [first] : []), document_(html), ...others);
  }

  private get to(): Record<string, number> {
    return Object.fromEntries(this.sliders.flatMap(({ key, moved }) => (moved === null ? [] : [[key, moved]])));
  }

  private slid(): void {
    this.move(false);
    if (this.answer?.charts?.some(({ name }) => name === "chance")) this.rest.ask();
  }

  private ask(sampled: boolean): void {
    if (Object.keys(this.to).length > 0) this.runner.move({ moved: this.to, sampled });
    else if (this.answer) this.show(this.answer);
  }

  private showMoved(answer: engine.Moved, to: Record<string, number>, milliseconds: number): void {
    const begun = performance.now();
    // The sliders may be back by now.
    if (Object.keys(this.to).length === 0) return;
    this.moved = answer.ok ? answer.text : null;
    if (answer.ok) this.draw(answer.html, answer.charts);
    this.showState(answer.ok ? texts.avoid.moved : engine.reason(answer));
    this.element.dataset.milliseconds = String(milliseconds + performance.now() - begun);
    this.element.dataset.shown = JSON.stringify(to);
  }

  private showState(words = ""): void {
    this.use.disabled = this.moved === null;
    this.back.disabled = Object.keys(this.to).length === 0;
    this.status.replaceChildren(h("span", {}, said(words)));
  }

  private useMoved(): void {
    this.rest.cancel();
    if (this.moved !== null) this.write(this.moved);
  }

  private takeBack(): void {
    this.rest.cancel();
    if (this.answer) this.show(this.answer);
  }
}

/** What the recorders say alone, and a box that takes a table as it was copied from a printed report. */
export class Recorder implements Panel {
  readonly element = h("div");
  private readonly body = h("div");
  private readonly box = h("textarea", { id: unique("paste"), rows: 6, spellcheck: "false", placeholder: texts.recorder.example });
  private readonly vehicle = h("select", {}, ...texts.recorder.vehicles.map(([value, name]) => h("option", { value }, name)));
  private readonly table = h("select", {}, ...["pre_crash", "pulse"].map((key) => h("option", { value: key }, label(key))));
  private readonly refused = h("p", { class: "error", role: "alert", hidden: true });
  private readonly paper = h("details", { class: "paste" });

  constructor(
    private readonly save: Save,
    /** Puts a table into the case; why not, where it cannot be read. */
    private readonly paste: (key: string, table: string) => engine.NoAnswer | null,
  ) {
    const button = h("button", { type: "button", class: "primary", onclick: () => this.put() }, texts.recorder.put);
    this.paper.append(h("summary", {}, texts.recorder.paste), h("label", { for: this.box.id, class: "hint" }, texts.recorder.how), this.box,
      h("div", { class: "run-controls" }, h("label", {}, texts.recorder.of, " ", this.vehicle), h("label", {}, texts.recorder.what, " ", this.table), button), this.refused);
    this.element.append(this.paper, this.body);
  }

  refresh(solved: Solved): void {
    const isUnable = cannot(this.body, solved, "recorder");
    if (isUnable) this.paper.open = true;
    if (isUnable) return;
    const answer = engine.answer(solved.text, "recorder", solved.units, solved.name);
    if (!answer.ok) {
      this.body.replaceChildren(note(engine.reason(answer)));
      return;
    }
    this.body.replaceChildren(
      savers(texts.viewTabs.recorder ?? "", ["html", "json", "csv", "txt"], this.save),
      document_(answer.html), ...answer.charts.map(({ name, title, svg }) => figure(name, title, svg)));
  }

  private put(): void {
    const refused = this.paste(`vehicle${this.vehicle.value}.recorder.${this.table.value}`, this.box.value);
    this.refused.hidden = refused === null;
    if (refused) {
      const sentences = refused.problems.flatMap(({ title, help }) => [title, help]).filter((words) => words !== null).map(engine.sentence);
      this.refused.replaceChildren(...(sentences.length > 0 ? sentences : [refused.message]).flatMap((words) => [h("span", {}, said(words)), " "]));
      return;
    }
    this.box.value = "";
    this.paper.open = false;
  }
}

/** The impact, played slowly: both vehicles at equal times before and after it. */
export class Motion implements Panel {
  readonly element = h("div", { class: "motion" });
  private readonly drawing = s("svg", { class: "film", role: "img", "aria-label": texts.motion.label });
  private readonly slider = h("input", { type: "range", min: 0, max: 0, value: 0, step: 1, "aria-label": texts.motion.time });
  private readonly clock = h("output", { class: "clock" });
  private readonly play: HTMLButtonElement;
  private readonly speed = h("select", { "aria-label": texts.motion.pace }, ...texts.motion.paces.map(([value, name]) => h("option", { value }, name)));
  private film: engine.Film | null = null;
  private readonly figures: SVGGElement[] = [];
  private timer = 0;

  constructor() {
    this.play = h("button", { type: "button", class: "primary", onclick: () => (this.timer ? this.stop() : this.run()) }, texts.motion.play);
    this.slider.addEventListener("input", () => {
      this.stop();
      this.showTime();
    });
  }

  refresh(solved: Solved): void {
    this.stop();
    if (solved.check.problems.length > 0) {
      this.element.replaceChildren(note(texts.panels.problems));
      return;
    }
    const film = engine.motion(solved.text, solved.units);
    if (!film.ok) {
      this.element.replaceChildren(note(engine.reason(film)));
      return;
    }
    this.film = film;
    this.slider.max = String(film.frames.length - 1);
    const atImpact = film.frames.findIndex((frame) => frame.time >= 0);
    this.slider.value = String(Math.max(atImpact, 0));
    this.draw(film);
    this.showTime();
    this.element.replaceChildren(
      ...caveat(solved),
      h("div", { class: "paper" }, this.drawing),
      h("div", { class: "player" }, this.play, this.slider, this.clock, h("label", {}, texts.motion.pace, " ", this.speed)),
    );
  }

  private draw(film: engine.Film): void {
    const all = film.frames.flatMap((frame) => frame.bodies.flatMap((body) => body?.outline ?? []));
    const left = Math.min(...all.map(([x]) => x)) - 1;
    const right = Math.max(...all.map(([x]) => x)) + 1;
    const bottom = Math.min(...all.map(([, y]) => y)) - 1;
    const top = Math.max(...all.map(([, y]) => y)) + 1;
    this.drawing.setAttribute("viewBox", `${left} ${-top} ${right - left} ${top - bottom}`);
    this.drawing.style.setProperty("--stroke", String((right - left) / 500));
    this.drawing.replaceChildren();
    this.figures.length = 0;
    for (const vehicle of [0, 1]) {
      const ways = film.frames.flatMap((frame) => frame.bodies[vehicle]?.centre ?? []);
      const way: string[] = [];
      for (let at = 0; at < ways.length; at += 2) way.push(`${ways[at]},${-(ways[at + 1] ?? 0)}`);
      const figure = s("g", { class: `car vehicle-${vehicle + 1}` }, s("polygon"), s("path", { class: "nose" }));
      this.figures.push(figure);
      this.drawing.append(s("polyline", { points: way.join(" "), class: `way vehicle-${vehicle + 1}` }), figure);
    }
  }

  private showTime(): void {
    const { film } = this;
    if (!film) return;
    const frame = film.frames[this.slider.valueAsNumber];
    frame?.bodies.forEach((body, which) => {
      const figure = this.figures[which];
      if (!figure || !body) return;
      figure.firstElementChild?.setAttribute("points", body.outline.map(([x, y]) => `${x},${-y}`).join(" "));
      // A short line from the centre of gravity shows the front.
      const [x, y] = body.centre;
      const [forward, left] = [Math.cos(body.heading), Math.sin(body.heading)];
      figure.lastElementChild?.setAttribute("d", `M${x} ${-y}L${x + 1.6 * forward} ${-(y + 1.6 * left)}`);
    });
    const time = frame?.time ?? 0;
    const words = texts.motion.at(time);
    this.clock.textContent = words;
    this.slider.setAttribute("aria-valuetext", words);
  }

  private run(): void {
    const { film } = this;
    if (!film) return;
    if (this.slider.valueAsNumber >= film.frames.length - 1) this.slider.value = "0";
    this.play.textContent = texts.motion.pause;
    const pace = Number(this.speed.value);
    const begin = film.frames[this.slider.valueAsNumber]?.time ?? 0;
    const begun = performance.now();
    const step = () => {
      const time = begin + ((performance.now() - begun) / 1000) * pace;
      const next = film.frames.findIndex((frame) => frame.time > time);
      this.slider.value = String(next < 0 ? film.frames.length - 1 : Math.max(next - 1, 0));
      this.showTime();
      if (next < 0) this.stop();
      else this.timer = requestAnimationFrame(step);
    };
    this.timer = requestAnimationFrame(step);
  }

  private stop(): void {
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.play.textContent = texts.motion.play;
  }
}

/** The warnings, each with a way to the fields that it is about. */
export function warnings(list: engine.Warning[], lead: (key: string) => void): HTMLElement {
  return h("ul", { class: "warnings" },
    ...list.map((warning) => {
      const explanation = h("div", { class: "help", hidden: true });
      const ask = h("button", {
        type: "button",
        class: "quiet",
        "aria-expanded": "false",
        onclick: () => {
          explanation.hidden = !explanation.hidden;
          ask.setAttribute("aria-expanded", String(!explanation.hidden));
          const words = engine.explain(warning.code);
          if (!("html" in words) || explanation.childNodes.length > 0) return;
          markup(explanation, words.html);
          inWords(explanation);
        },
      }, texts.warnings.explain);
      return h("li", {},
        h("code", {}, warning.code), h("p", {}, said(engine.sentence(warning.message))),
        h("div", { class: "leads" },
          ...(warning.keys ?? (warning.vehicle ? [`vehicle${warning.vehicle}`] : [])).map((key) => h("button", { type: "button", class: "quiet", title: key, onclick: () => lead(key) }, texts.warnings.lead(nameOf(key)))),
          ask),
        explanation);
    }));
}
