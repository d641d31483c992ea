// The page: left the case, right the answer. There is one state, the text of the case; all else follows from it.
import { book } from "./book.js";
import { type Child, afterPause, download, eachFrame, h, showDialog } from "./dom.js";
import { forgetDraft, keepDraft, keptDraft } from "./draft.js";
import { Editor } from "./editor.js";
import * as engine from "./engine.js";
import { essence } from "./essence.js";
import type { Command, ExactSolution, Problem, Units } from "./engine.js";
import { Form } from "./form.js";
import { type Live, emptyPage, handedOver, isOfReport, printed } from "./live.js";
import { Avoid, Compare, Drawings, Inputs, Motion, type Panel, Recorder, Results, Run, Sensitivity, warnings } from "./panels.js";
import { type FileKind, type Finished, type Job, type Picture, Runner } from "./runs.js";
import { inForm, said, saidOfText, valueInWords } from "./said.js";
import { SceneView, type Unit } from "./scene.js";
import { Solved } from "./solved.js";
import { Tabs } from "./tabs.js";
import { texts } from "./texts/en.js";
import { readValue } from "./toml.js";

/** (letters) of a result that is no number; what is longer is a sentence. */
const LONGEST = 30;

/** (answers) that are kept, so that who takes a change back has the answer at once. */
const KEPT = 20;

/** An answer that took a while. */
interface Known {
  text: string;
  headline: string[];
  /** Its intervals are those by the ranges of the case, without the errors of the method. */
  isNarrow: boolean;
  /** Of weighed evidence. */
  weighed?: { html: string; plain: Picture[] | null };
}

/** The case that the page begins with. */
function example(): { name: string; text: string } {
  const [first] = engine.templates();
  return { name: `${first?.name ?? "case"}.toml`, text: first?.text_us ?? "" };
}

const timed = (date: Date): string => date.toLocaleString("en-GB", { dateStyle: "long", timeStyle: "short" });

/** The figures of an exact solution, in words. */
function figures({ speeds, delta_v }: ExactSolution): string[] {
  const { speed, deltaV } = texts.answer;
  const of = (both: (string | null)[], words: typeof speed) =>
    both.flatMap((figure, place) => (figure === null ? [] : [words(place + 1, figure)]));
  return [...of(speeds, speed), ...of(delta_v, deltaV)];
}

export class App {
  private readonly editor: Editor;
  private readonly form: Form;
  private readonly scene: SceneView;
  private readonly caseTabs: Tabs;
  private readonly viewTabs: Tabs;
  private readonly panels = new Map<string, Panel>();
  private readonly stale = new Set<string>();
  private readonly solveSoon = eachFrame(() => this.solve());
  private readonly quick = new Runner();
  private readonly rest = afterPause(100, () => this.showRest());
  private readonly interval = afterPause(350, () => this.runInterval());
  private readonly speakSoon = afterPause(800, () => this.speak());
  private solved: Solved | null = null;
  private units: Units = "";
  private asked: Command | "" = "";
  /** An estimate can answer the case. */
  private estimable = false;
  private readonly estimate: Run;
  private readonly uncertainty: Run;
  private readonly avoid: Avoid;
  private saved = "";
  private opened = false;
  /** By question, units, and what of the case the answer depends on. */
  private readonly known = new Map<string, Known>();
  /** What `quick` runs, or has run. */
  private job: Job | null = null;
  /** The question of `job`, as `known` has it. */
  private keyOfJob: string | null = null;
  /** Why evidence could not be weighed. */
  private unweighed: { key: string; message: string } | null = null;
  /** What `completing` runs to have the intervals of the headline in other units. */
  private widening: string | null = null;
  /** A number of the case is a range, as far as this is known. */
  private isRanged: boolean | null = null;
  /** Is told that all the evidence has been weighed, or that it will not be. */
  private whenWeighed: ((done: boolean) => void) | null = null;
  private readonly weighing = h("progress", { max: 1, value: 0, "aria-label": texts.run.progress });
  /** Makes what a report has beside the exact solution. */
  private readonly completing = new Runner();
  private readonly working = h("div", { class: "working", role: "status", hidden: true });

  private readonly name = h("input", { type: "text", class: "file-name", "aria-label": texts.file.name, spellcheck: "false" });
  private readonly unsaved = h("span", { class: "unsaved", title: texts.file.unsaved, hidden: true }, "●");
  private readonly headline = h("div", { class: "headline" });
  private readonly state = h("div", { class: "state" });
  private readonly question = h("select", { id: "question", onchange: () => this.ask() });
  /** Where the book explains how the question is answered. */
  private readonly chapter = h("span");
  private readonly spoken = h("div", { class: "unseen", role: "status", "aria-live": "polite" });
  private readonly undoButton = h("button", { type: "button", class: "icon", "aria-label": texts.file.undo, title: texts.file.undo, onclick: () => this.undo() }, "↶");
  private readonly redoButton = h("button", { type: "button", class: "icon", "aria-label": texts.file.redo, title: texts.file.redo, onclick: () => this.redo() }, "↷");
  private readonly unitsChoice = h("select", { id: "units" }, ...texts.units.map(([value, name]) => h("option", { value }, name)));
  /** The first minute's line; of a draft or of a report that was handed over, that it is one. */
  private readonly welcome = h("aside", { class: "welcome", "aria-label": texts.welcome.label });
  private readonly banner = h("strong");
  private readonly changedSince = h("span", { role: "status" });
  private readonly printHead = h("p", { class: "print-head" });
  private readonly live = handedOver();
  /** What the page had before it was loaded again. */
  private readonly draft = this.live ? null : keptDraft();
  /** The case that was handed over is not that of its report. */
  private isForeign = false;
  private readonly fileInput = h("input", { type: "file", accept: ".toml,text/plain", hidden: true, "aria-label": texts.file.open });

  /** The page without a case. The engine is not needed for it, and starts meanwhile. */
  constructor(parent: HTMLElement) {
    const { live } = this;
    this.form = new Form({
      write: (key, toml) => this.write(key, toml),
      reveal: (key) => this.reveal(key),
    });
    const formPanel = h("div", { class: "panel form-panel" }, this.form.element);
    const textPanel = h("div", { class: "panel text-panel" });
    this.caseTabs = new Tabs(texts.caseTabs.label, [
      { name: "form", title: texts.caseTabs.form, panel: formPanel, shown: () => this.showCase() },
      { name: "text", title: texts.caseTabs.text, panel: textPanel, shown: () => this.showCase() },
    ]);
    this.editor = new Editor(textPanel, () => this.solveSoon(undefined));

    this.scene = new SceneView({
      text: () => this.editor.text,
      draw: () => this.solve(),
      preview: (text) => {
        this.editor.preview(text);
        this.solveSoon.flush();
      },
      write: (text) => this.step(text),
      settle: (keep) => {
        this.editor.settle(keep);
        this.solveSoon.flush();
      },
      refused: (message) => this.message(said(message)),
      value: (key) => valueInWords(this.solved?.check.values[key]?.text),
      unit: () => this.unit(),
      measured: (metres, radians) => this.measured(metres, radians),
    });

    const lead = (key: string) => this.lead(key);
    const save = (kind: FileKind) => void this.saveShown(kind);
    this.uncertainty = new Run("uncertainty", () => undefined, save);
    this.estimate = new Run("estimate", (job, result) => this.learn("estimate", job, { headline: result.headline, isNarrow: false }), save, () => this.isEstimate && this.showHeadline());
    this.panels.set("results", new Results());
    this.panels.set("drawings", new Drawings());
    this.panels.set("motion", new Motion());
    this.panels.set("uncertainty", this.uncertainty);
    this.panels.set("sensitivity", new Sensitivity(lead, save));
    this.panels.set("compare", new Compare(save));
    this.panels.set("estimate", this.estimate);
    this.avoid = new Avoid((job, result) => this.learn("avoid", job, { headline: result.headline, isNarrow: false }), save, (text) => this.step(text));
    this.panels.set("recorder", new Recorder(save, (key, table) => this.paste(key, table)));
    this.panels.set("avoid", this.avoid);
    this.panels.set("inputs", new Inputs());
    const scenePanel = h("div", { class: "panel" }, this.scene.element, book.view("scene"));
    this.viewTabs = new Tabs(texts.viewTabs.label ?? "", [
      { name: "scene", title: texts.viewTabs.scene ?? "", panel: scenePanel, shown: () => this.show("scene") },
      ...[...this.panels].map(([name, panel]) => ({
        name,
        title: texts.viewTabs[name] ?? name,
        panel: h("div", { class: "panel" }, book.view(name), panel.element),
        shown: () => this.show(name),
      })),
    ]);

    parent.append(...this.layout(live));
    this.listen();
  }

  /** Opens the case that the page was handed over with, the draft, or an example. */
  begin(): void {
    if (this.live) this.banner.textContent = texts.live.banner(this.live.name, engine.version(), this.head(engine.check(this.live.text)));
    if (this.live) {
      void isOfReport(this.live).then((is) => {
        this.isForeign = !is;
        this.showChanged(this.editor.text);
      });
    }
    const { draft } = this;
    if (draft) {
      this.unitsChoice.value = draft.units;
      this.units = draft.units;
    }
    const { name, text } = this.live ?? draft ?? example();
    this.open(name, text);
    if (draft) this.saved = draft.saved;
    this.showFileState();
  }

  private layout(live: Live | null): HTMLElement[] {
    const button = (label: string, run: () => void, kind?: string) => h("button", { type: "button", class: kind, onclick: run }, label);
    const units = this.unitsChoice;
    units.addEventListener("change", () => {
      this.units = units.value as Units;
      this.solve();
    });
    const theme = h("select", { id: "theme" }, ...texts.themes.map(([value, name]) => h("option", { value }, name)));
    theme.addEventListener("change", () => (document.documentElement.dataset.theme = theme.value));
    const save = this.menu(texts.save.label, [
      [texts.save.report, () => void this.saveShown("html")],
      [texts.save.live, () => void this.saveLive()],
      [texts.save.print, () => void this.print()],
      [texts.save.printView, () => window.print()],
      [texts.save.json, () => void this.saveShown("json")],
      [texts.save.csv, () => void this.saveShown("csv")],
      [texts.save.text, () => void this.saveShown("txt")],
    ], () => texts.save.of(this.document.title));
    const bar = h("header", { class: "bar" },
      h("h1", { class: "brand" }, h("span", { "aria-hidden": "true" }, "Δ"), "deltav"),
      h("div", { class: "bar-group file" }, this.name, this.unsaved),
      h("div", { class: "bar-group" },
        button(texts.file.new, () => this.chooseTemplate()),
        button(texts.file.open, () => this.fileInput.click()), this.fileInput,
        button(texts.file.save, () => this.saveFile()),
        this.undoButton, this.redoButton),
      h("div", { class: "bar-group" }, save),
      h("div", { class: "bar-group end" },
        h("label", { for: "units" }, texts.unitsLabel), units,
        h("label", { for: "theme" }, texts.themeLabel), theme,
        button(texts.about.open, () => this.about(), "quiet")));
    const answer = h("section", { class: "answer", id: "answer", tabindex: -1, "aria-label": texts.answer.label },
      this.headline,
      h("div", { class: "answer-side" },
        h("div", { class: "question" }, h("label", { for: "question" }, texts.answer.question), this.question, this.chapter),
        this.state));
    // On a narrow page one of the two sides is shown.
    const sides = (["view", "case"] as const).map((side) => {
      const choose = () => {
        document.body.dataset.side = side;
        for (const [one, element] of sides) element.setAttribute("aria-pressed", String(one === side));
      };
      return [side, button(texts.sides[side], choose)] as const;
    });
    sides[0]?.[1].click();
    const close = button(texts.welcome.close, () => this.welcome.remove(), "quiet");
    const { draft } = this;
    if (live) this.welcome.replaceChildren(this.banner, " ", this.changedSince, " ", h("a", { href: "#printed" }, texts.live.toPrinted));
    else if (draft) {
      this.welcome.setAttribute("aria-label", texts.draft.label);
      this.welcome.append(h("span", {}, texts.draft.of(timed(new Date(draft.time)))), h("span", {}, button(texts.draft.afresh, () => this.startAfresh(), "quiet"), close));
    } else this.welcome.append(h("span", {}, h("strong", {}, texts.welcome.what), " ", texts.welcome.first, " ", texts.welcome.local), close);
    const main = h("main", { class: "split" },
      h("div", { class: "sides", role: "group", "aria-label": texts.sides.label }, ...sides.map(([, element]) => element)),
      h("section", { class: "case", "aria-label": texts.caseTabs.label }, this.caseTabs.list, this.caseTabs.panels),
      h("section", { class: "view", id: "views", tabindex: -1, "aria-label": texts.viewTabs.label }, this.viewTabs.list, this.viewTabs.panels));
    document.body.classList.toggle("is-live", live !== null);
    const skip = (to: string, words: string) => h("a", { class: "skip", href: `#${to}` }, words);
    return [skip("answer", texts.skip), skip("views", texts.skipToViews), bar, this.welcome, this.printHead, answer, main, this.working, this.spoken, ...(live ? [printed(live)] : [])];
  }

  /** A menu, headed by what it is about when it opens. */
  private menu(label: string, entries: [string, () => void][], about: () => string): HTMLElement {
    const head = h("p", { class: "hint" });
    const list = h("div", { class: "menu-list" }, head,
      ...entries.map(([name, run]) => h("button", {
        type: "button",
        onclick: () => {
          menu.open = false;
          run();
        },
      }, name)));
    const menu = h("details", { class: "menu" }, h("summary", { class: "button" }, label), list);
    menu.addEventListener("toggle", () => (head.textContent = about()));
    document.addEventListener("click", (event) => {
      if (menu.open && !menu.contains(event.target as Node)) menu.open = false;
    });
    menu.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || !menu.open) return;
      menu.open = false;
      menu.querySelector("summary")?.focus();
    });
    return menu;
  }

  private listen(): void {
    document.addEventListener("keydown", (event) => {
      const isCommand = (event.ctrlKey || event.metaKey) && !event.altKey;
      if (!isCommand || event.defaultPrevented) return;
      const key = event.key.toLowerCase();
      const run: Record<string, () => void> = {
        z: () => (event.shiftKey ? this.redo() : this.undo()),
        y: () => this.redo(),
        s: () => this.saveFile(),
        o: () => this.fileInput.click(),
      };
      const action = run[key];
      // The editor has its own keys for its history.
      if (!action || ("zy".includes(key) && this.editor.view.hasFocus && !this.scene.busy)) return;
      if ("zy".includes(key) && event.target === this.name) return;
      event.preventDefault();
      action();
    });
    // The list of warnings lies over the page, and goes as a menu does.
    const list = () => this.state.querySelector<HTMLDetailsElement>(".warned[open]");
    document.addEventListener("pointerdown", (event) => {
      const open = list();
      if (open && !open.contains(event.target as Node)) open.open = false;
    });
    this.state.addEventListener("keydown", (event) => {
      const open = list();
      if (event.key !== "Escape" || !open) return;
      open.open = false;
      open.querySelector("summary")?.focus();
    });
    window.addEventListener("resize", () => {
      for (const part of [this.headline, this.state]) part.style.minHeight = "";
    });
    window.addEventListener("beforeprint", () => {
      this.printHead.textContent = texts.printHead(this.name.value, engine.version(), timed(new Date()), this.sinceThen());
    });
    this.fileInput.addEventListener("change", () => {
      const file = this.fileInput.files?.[0];
      if (file) void this.openFile(file);
      this.fileInput.value = "";
    });
    document.addEventListener("dragover", (event) => {
      event.preventDefault();
      document.body.classList.add("dropping");
    });
    document.addEventListener("dragleave", (event) => {
      if (!event.relatedTarget) document.body.classList.remove("dropping");
    });
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      document.body.classList.remove("dropping");
      const file = event.dataTransfer?.files[0];
      if (file) void this.openFile(file);
    });
    window.addEventListener("beforeunload", (event) => {
      if (this.editor.text !== this.saved) event.preventDefault();
    });
    this.name.addEventListener("change", () => {
      this.name.value = this.name.value.replaceAll(/[\\/:*?"<>|\p{Cc}]/gu, "").trim() || "case.toml";
      if (!this.name.value.includes(".")) this.name.value += ".toml";
      // What is saved names the file.
      this.solveSoon(undefined);
    });
  }

  // --- the case ---

  /** In a drag, that drag is taken back. */
  private undo(): void {
    if (!this.scene.end(false)) this.editor.undo();
  }

  private redo(): void {
    if (!this.scene.busy) this.editor.redo();
  }

  private write(key: string, toml: string): string | null {
    this.scene.end(true);
    const edited = engine.edit(this.editor.text, key, toml);
    if (edited.ok) this.editor.write(edited.text);
    else this.message(said(edited.message));
    return edited.ok ? null : edited.message;
  }

  /** A change that is a step of the history by itself. */
  private step(text: string): void {
    this.editor.step(text);
    this.solveSoon.flush();
  }

  private paste(key: string, table: string): engine.NoAnswer | null {
    this.scene.end(true);
    const pasted = engine.paste(this.editor.text, key, table);
    if (!pasted.ok) return pasted;
    this.step(pasted.text);
    return null;
  }

  private reveal(key: string): void {
    this.caseTabs.show("text");
    const place = this.solved?.check.values[key];
    if (place) this.editor.select(place.from, place.to);
    else this.editor.view.focus();
  }

  private updateForm(): void {
    const { solved } = this;
    if (!solved || this.caseTabs.shown !== "form") return;
    const { problems } = solved.check;
    // What another question lacks is missing to nobody.
    this.form.update(solved.check, problems.length > 0 || this.isEstimate ? problems : solved.problems);
  }

  /** The form or the text is shown, and each is told of in its words what is wrong. */
  private showCase(): void {
    this.updateForm();
    if (this.solved && !this.solved.look.ok) this.showAnswer();
  }

  /** To the field of a key: in the form where that is shown, in the text otherwise. */
  private lead(key: string): void {
    this.updateForm();
    if (this.caseTabs.shown === "form" && this.form.focus(key)) return;
    this.reveal(key);
  }

  private open(name: string, text: string): void {
    this.name.value = name;
    this.saved = text;
    this.asked = "";
    this.known.clear();
    this.isRanged = null;
    this.estimable = false;
    this.solved = null;
    this.endRuns();
    this.wait(null);
    this.headline.replaceChildren();
    for (const part of [this.headline, this.state]) part.style.minHeight = "";
    this.state.replaceChildren();
    if (!this.live && this.opened) this.welcome.remove();
    this.opened = true;
    this.form.reset();
    this.scene.reset();
    this.editor.open(text);
    this.solveSoon.flush();
    this.leadToView();
  }

  /** To the view that has the answer of the case, where that is not the scene. */
  private leadToView(): void {
    const { look } = this.solved ?? {};
    const own = ["avoid", "recorder"] as const;
    const answer = own.find((view) => look?.ok && !this.isEstimate && look.command === view);
    if (answer) this.viewTabs.show(answer);
    else if (own.some((view) => view === this.viewTabs.shown && !look?.able?.includes(view))) this.viewTabs.show("scene");
  }

  private async openFile(file: File): Promise<void> {
    if (file.type.startsWith("image/")) {
      this.viewTabs.show("scene");
      await this.scene.backdrop.open(file);
      return;
    }
    const bytes = await file.arrayBuffer();
    try {
      const text = new TextDecoder("utf-8", { fatal: true }).decode(bytes);
      if (this.mayDiscard()) this.open(file.name, text);
    } catch {
      this.message(texts.file.unreadable(file.name));
    }
  }

  private mayDiscard(): boolean {
    return this.editor.text === this.saved || window.confirm(texts.file.discard);
  }

  private saveFile(): void {
    this.saved = this.editor.text;
    download(this.name.value, this.saved, "application/toml");
    this.showFileState();
    this.keep();
  }

  /** Keeps the case for a reload. The example needs no keeping, and a report has its own case. */
  private keep(): void {
    if (this.live) return;
    const { text } = this.editor;
    if (text === example().text) forgetDraft();
    else keepDraft({ name: this.name.value, text, saved: this.saved, units: this.units });
  }

  private startAfresh(): void {
    if (!this.mayDiscard()) return;
    const { name, text } = example();
    this.open(name, text);
  }

  private chooseTemplate(): void {
    const isUs = this.solved?.look.units === "us";
    const dialog = h("dialog", { class: "templates", "aria-labelledby": "templates-title" });
    const system = h("select", { id: "template-units" }, ...texts.templates.units.map(([value, name]) => h("option", { value }, name)));
    system.value = isUs ? "us" : "si";
    const cards = engine.templates().map((template) =>
      h("button", {
        type: "button",
        class: "card",
        "data-name": template.name,
        onclick: () => {
          dialog.close();
          if (!this.mayDiscard()) return;
          this.open(`${template.name}.toml`, system.value === "us" ? template.text_us : template.text_si);
        },
      }, template.title, template.text_si === template.text_us ? h("span", { class: "hint" }, ` (${texts.templates.printed})`) : null,
      h("span", { class: "hint purpose" }, said(template.purpose))));
    dialog.append(
      h("h2", { id: "templates-title" }, texts.templates.title),
      h("p", { class: "note" }, texts.templates.explain),
      h("p", {}, h("label", { for: "template-units" }, texts.templates.unitsLabel), " ", system, " ", book.choose()),
      h("div", { class: "cards" }, ...cards),
      h("button", { type: "button", class: "quiet", onclick: () => dialog.close() }, texts.close));
    showDialog(dialog);
  }

  private about(): void {
    const licences = JSON.parse(document.getElementById("deltav-licences")?.textContent ?? "{}") as { packages?: string };
    const dialog = h("dialog", { "aria-labelledby": "about-title" });
    const digest = h("code", { class: "digest" });
    void engine.engineHash().then((hash) => (digest.textContent = hash));
    dialog.append(
      h("h2", { id: "about-title" }, `deltav ${engine.version()}`),
      ...texts.about.paragraphs.map((words) => h("p", {}, words)),
      h("p", {}, texts.about.engine, " ", digest),
      h("p", {}, book.start()),
      h("details", {}, h("summary", {}, texts.about.licences), h("pre", { tabindex: 0 }, licences.packages ?? "")),
      h("button", { type: "button", class: "quiet", onclick: () => dialog.close() }, texts.close));
    showDialog(dialog);
  }

  /** The unit of a length in the drawing. */
  private unit(): Unit {
    const name = (this.units || this.solved?.look.units) === "us" ? "ft" : "m";
    return { name, metres: Number.parseFloat(engine.convert(`1 ${name}`, "m") ?? "") };
  }

  /** What the tape reads, with the units of the drawing and the angles of the file. */
  private measured(metres: number, radians: number): string {
    const unit = this.unit();
    const axes = readValue(this.solved?.check.values["scene.axes"]?.text ?? "");
    const degrees = ((axes === "z-down" ? -radians : radians) * 180) / Math.PI;
    // Neither −0.0° nor −180.0°.
    const rounded = Number(degrees.toFixed(1)) === -180 ? "180.0" : (Number(degrees.toFixed(1)) || 0).toFixed(1);
    return texts.tape.reading(`${(metres / unit.metres).toFixed(2)} ${unit.name}`, rounded.replace("-", "−"));
  }

  // --- the answer ---

  private ask(): void {
    this.asked = this.question.value as Command;
    this.solve();
    if (["estimate", "avoid", "recorder"].includes(this.asked)) this.viewTabs.show(this.asked);
  }

  /** The question is one that only an estimate answers, or the one that was asked. */
  private get isEstimate(): boolean {
    const { solved } = this;
    if (!solved || !this.estimable) return false;
    if (this.asked !== "") return this.asked === "estimate";
    const { look } = solved;
    return !look.ok || look.command === "recorder" || (look.headline.length === 0 && ["crush", "avoid"].includes(look.command));
  }

  /** What is to be seen at once, from one call of the engine. What else is shown follows when the hand rests. */
  private solve(): void {
    const { text } = this.editor;
    const { what, viewport } = this.scene.wanted;
    const isScene = this.viewTabs.shown === "scene";
    const look = engine.look(text, this.asked === "estimate" ? "" : this.asked, this.units, isScene ? what : "none", viewport);
    const before = this.solved;
    const solved = new Solved(text, this.name.value, this.units, look);
    this.solved = solved;
    solved.weighed = this.weighedBefore(solved);
    // What the text can be asked is known at once where it has no other answer; otherwise when the hand rests.
    if (!look.ok || look.headline.length === 0 || look.command === "recorder") this.estimable = this.solved.check.commands.estimate?.able === true;
    this.showQuestion();
    this.showAnswer();
    this.showFileState();
    for (const name of this.panels.keys()) this.stale.add(name);
    if (isScene) this.scene.update(look.scene ?? null, solved.problems.length > 0);
    else this.stale.add("scene");
    // What runs goes on where the answer will be the same, and what has run stays where only the units are others;
    // who waits for a file of it wants that of this text.
    if (!this.job || (this.keyOf(solved) !== this.keyOfJob && !this.hasWeighed(solved))) this.endRuns();
    if (before?.text !== text || before.name !== solved.name || before.units !== solved.units) this.whenWeighed?.(false);
    this.rest.ask();
    this.interval.ask();
    this.speakSoon.ask();
  }

  /** What follows. */
  showRest(): void {
    const { solved } = this;
    // Of a text that has changed since, the rest follows that change.
    if (!solved || solved.text !== this.editor.text) return;
    this.rest.cancel();
    this.editor.mark(solved.problems);
    const isRanged = solved.check.commands.uncertainty?.able === true;
    if (isRanged !== this.isRanged && solved.look.ok) {
      this.isRanged = isRanged;
      this.showHeadline();
    }
    const estimable = solved.check.commands.estimate?.able === true;
    if (estimable !== this.estimable) {
      this.estimable = estimable;
      this.showQuestion();
      // Otherwise the answer is the same, and who is at work in its warnings stays there.
      if (this.asked === "estimate") this.showAnswer();
    }
    this.updateForm();
    this.show(this.viewTabs.shown);
    // Only now: a case that the page could not show would fail again after each reload.
    this.keep();
  }

  /** Brings what is seen up to date. */
  private show(name: string): void {
    if (!this.solved || !this.stale.delete(name)) return;
    if (name === "scene") this.solve();
    else this.panels.get(name)?.refresh(this.solved);
  }

  private showQuestion(): void {
    const { solved, isEstimate } = this;
    if (!solved) return;
    const able = solved.look.able ?? [];
    const command = isEstimate ? "estimate" : solved.command;
    const options = [...able, ...(this.estimable ? ["estimate" as const] : [])];
    if (!options.includes(command)) options.unshift(command);
    this.question.replaceChildren(...options.map((one) => h("option", { value: one }, texts.questions[one] ?? one)));
    this.question.value = command;
    if (this.chapter.dataset.of !== command) this.chapter.replaceChildren(...[book.method(command)].filter((link) => link !== null));
    this.chapter.dataset.of = command;
    this.question.disabled = options.length < 2;
  }

  private showAnswer(): void {
    const { solved } = this;
    if (!solved) return;
    const { look, problems } = solved;
    this.showChanged(solved.text);
    if (!look.ok) {
      if (problems.length > 0) this.showProblems(problems);
      else this.state.replaceChildren(h("p", { class: "error" }, said(look.message)));
      if (this.isEstimate) this.showHeadline();
      else if (this.headline.childNodes.length > 0 && !this.headline.querySelector(".lead, .note")) this.headline.classList.add("stale");
      else this.headline.replaceChildren(h("p", { class: "note" }, texts.answer.none));
      return;
    }
    this.showHeadline();
    // Of an estimate its own report says what is to be doubted.
    if (look.warnings.length === 0 && this.isEstimate) this.state.replaceChildren();
    else if (look.warnings.length === 0) this.state.replaceChildren(h("p", { class: "calm" }, texts.answer.noWarnings));
    else {
      const isOpen = this.state.querySelector("details")?.open ?? false;
      const aside = look.warnings.filter((warning) => warning.aside);
      const own = look.warnings.filter((warning) => !warning.aside);
      const lead = (key: string) => this.lead(key);
      const list = h("details", { class: "warned" },
        h("summary", {}, texts.answer.warnings(own.length, aside.length)),
        h("div", { class: "warned-list" },
          own.length > 0 ? warnings(own, lead) : null,
          aside.length > 0 ? [h("h2", {}, texts.answer.against), warnings(aside, lead)] : null));
      list.open = isOpen;
      this.state.replaceChildren(list);
    }
  }

  /** Of a report that was handed over: whether this is still its case. */
  private showChanged(text: string): void {
    if (!this.live) return;
    const isSame = text === this.live.text;
    this.changedSince.className = this.isForeign ? "error" : "";
    this.changedSince.textContent = this.isForeign ? texts.live.foreign : isSame ? texts.live.unchanged : texts.live.changed;
  }

  private showHeadline(): void {
    const { solved, isEstimate } = this;
    if (!solved || (!isEstimate && !solved.look.ok)) return;
    this.headline.classList.remove("stale");
    const known = this.answerOf(solved);
    if (known) {
      this.showLines(known.headline, true, known.isNarrow ? texts.answer.byRangesAlone : null);
      return;
    }
    if (isEstimate && (this.estimate.busy || !solved.weighs)) {
      this.showLead();
      return;
    }
    if (solved.weighs) {
      if (this.unweighed?.key === this.keyOf(solved)) this.headline.replaceChildren(h("p", { class: "error" }, `${texts.answer.notWeighed} ${this.unweighed.message}`));
      else this.showWeighing(solved);
      return;
    }
    const headline = solved.look.ok ? solved.look.headline : [];
    if (headline.length === 0) {
      const [view, words] = solved.command === "avoid" ? ["avoid", texts.answer.inAvoid] as const : ["results", texts.answer.inResults] as const;
      this.headline.replaceChildren(h("p", { class: "note" }, words),
        h("button", { type: "button", onclick: () => this.viewTabs.show(view) }, texts.viewTabs[view]));
    } else this.showLines(headline, false, solved.command === "reconstruct" && this.isRanged === false ? texts.answer.takenAsExact : null);
  }

  /** That the evidence is being weighed, with the exact solution until that is done. */
  private showWeighing({ exact }: Solved): void {
    if (!this.weighing.isConnected) this.weighing.removeAttribute("value");
    this.headline.replaceChildren(h("div", { class: "note weighing" },
      h("p", {}, texts.answer.weighing), this.weighing,
      exact ? h("p", { class: "aside" }, texts.answer.exact(exact.by), " ", h("strong", {}, figures(exact).join(", "))) : null));
    this.keepRoom();
  }

  /** That the case is one for an estimate, and the way there. */
  private showLead(): void {
    const start = () => {
      this.viewTabs.show("estimate");
      this.estimate.begin();
    };
    if (this.estimate.busy) {
      this.headline.replaceChildren(h("p", { class: "note" }, texts.answer.estimating));
      return;
    }
    this.headline.replaceChildren(h("div", { class: "lead" },
      h("p", {}, texts.answer.byEstimate),
      h("button", { type: "button", class: "primary", onclick: start }, texts.answer.startEstimate)));
  }

  private showLines(lines: string[], interval: boolean, note: { roomy: string; brief: string } | null): void {
    const shown = lines.map((line, place) => {
      const [label, ...rest] = line.split(": ");
      const value = rest.join(": ");
      // That there is no one answer is a sentence.
      if (value === "") return h("p", { class: lines.length > 1 ? "sentence" : "lead" }, line);
      if (/^\D{8}/.test(value) && value.length > LONGEST) return h("p", { class: "sentence" }, line);
      // The first number is the answer; what stands behind it says it in other units, or how well it is known.
      const [, main = value, more = ""] = /^(.*?)((?: \(|[,;] ).*)?$/.exec(value) ?? [];
      return h("div", { class: `result${place === 0 ? " first" : ""}${interval ? " interval" : ""}` },
        h("span", { class: "result-name" }, label ?? ""), h("span", { class: "unseen" }, ": "),
        h("span", { class: "result-value" }, main),
        // What only says the same in another unit is the first to go where there is little room.
        h("span", { class: /^ \([\d.,]+ [^\s%]+\)$/.test(more) ? "result-more again" : "result-more" }, more.replace(/^[,;] |\.$/g, "")));
    });
    // Sentences that follow each other stand beneath each other, in one column.
    const columns: HTMLElement[] = [];
    for (const part of shown) {
      const last = columns.at(-1);
      if (part.tagName === "P" && last?.classList.contains("sentences")) last.append(part);
      else columns.push(part.tagName === "P" && shown.length > 1 ? h("div", { class: "sentences" }, part) : part);
    }
    this.headline.replaceChildren(...columns, ...(note ? [h("p", { class: "note of-interval" }, h("span", { class: "roomy" }, note.roomy), h("span", { class: "brief" }, note.brief))] : []));
    this.keepRoom();
  }

  private keepRoom(): void {
    // The room that the answer has taken stays its own, so that nothing below it moves when a range is computed anew.
    const floor = Number.parseFloat(this.headline.style.minHeight) || 0;
    const { height } = this.headline.getBoundingClientRect();
    if (height > floor) this.headline.style.minHeight = `${height}px`;
  }

  private showProblems(problems: Problem[]): void {
    const [first] = problems;
    if (!first) return;
    const line = this.editor.text.slice(0, first.from).split("\n").length;
    // Of a text that is no TOML the form shows nothing.
    const isForm = this.caseTabs.shown === "form" && Object.keys(this.solved?.check.values ?? {}).length > 0;
    const [what = "", ...help] = isForm ? inForm(first, this.solved?.check.values[first.key ?? ""]?.text) : [first.title, first.help].filter((words) => words !== null).map(engine.sentence);
    // Who is led to the text reads what is to be written there.
    const worded = isForm && first.key ? said : saidOfText;
    const lead = first.key && isForm
      ? h("button", { type: "button", class: "quiet", onclick: () => this.lead(first.key ?? "") }, texts.answer.toField)
      : h("button", {
        type: "button",
        class: "quiet",
        onclick: () => {
          this.caseTabs.show("text");
          this.editor.select(first.from, first.to);
        },
      }, texts.answer.toLine(line));
    this.state.replaceChildren(h("div", { class: "error", tabindex: 0 },
      h("div", { class: "said" },
        h("p", {}, h("strong", {}, worded(what)), " ", worded(help.join(" "))),
        problems.length > 1 ? h("p", {}, texts.answer.andMore(problems.length - 1)) : null),
      lead));
    this.keepRoomOfState();
  }

  /** The room that an error has taken stays its own, so that a field does not move while one types; a narrow page has none to spare. */
  private keepRoomOfState(): void {
    if (this.scene.busy || !window.matchMedia("(min-width: 900px)").matches) return;
    this.state.style.minHeight = `${this.state.getBoundingClientRect().height}px`;
  }

  /** Words of the page, in which names of files stay as they are. */
  private message(...words: Child[]): void {
    this.state.replaceChildren(h("p", { class: "error", role: "alert", tabindex: 0 }, words));
  }

  private speak(): void {
    const { solved } = this;
    if (!solved) return;
    const known = this.isEstimate || solved.weighs ? this.answerOf(solved) : undefined;
    this.spoken.textContent = known?.headline[0] ?? (this.isEstimate ? texts.answer.byEstimate : solved.look.ok ? (solved.look.headline[0] ?? "") : (this.state.textContent ?? ""));
  }

  private showFileState(): void {
    const isSaved = this.editor.text === this.saved;
    this.unsaved.hidden = isSaved;
    document.title = texts.pageTitle(this.name.value, isSaved);
    const { undo, redo } = this.editor.can;
    this.undoButton.disabled = !undo;
    this.redoButton.disabled = !redo;
  }

  // --- what takes a while ---

  private key(command: Command, units: Units, essence: string): string {
    return [command, units, essence].join("\n");
  }

  private keyOf({ command, units, essence }: Solved): string {
    return this.key(command, units, essence);
  }

  /** What is known of a case: in its units, or else in others until it is known in these. */
  private knownOf(solved: Solved, command: Command = solved.command): Known | undefined {
    const units: Units[] = [solved.units, "", "si", "us", "uk"];
    return units.map((one) => this.known.get(this.key(command, one, solved.essence))).find((known) => known !== undefined);
  }

  /** What is known of the question that is asked. */
  private answerOf(solved: Solved): Known | undefined {
    if (!this.isEstimate) return this.knownOf(solved);
    // An estimate with the usual settings is what the weighed evidence gives.
    return this.knownOf(solved, "estimate") ?? (solved.weighs ? this.knownOf(solved) : undefined);
  }

  /** The tables and drawings of weighed evidence that are still those of the case. */
  private weighedBefore(solved: Solved): Solved["weighed"] {
    const known = solved.weighs ? this.known.get(this.keyOf(solved)) : undefined;
    if (!known?.weighed || known.text === solved.text) return known?.weighed ?? null;
    // Title and source head the tables; the title heads the drawings, too.
    const head = /<header>.*?<\/header>/s;
    const now = solved.answer?.ok ? (head.exec(solved.answer.html)?.[0] ?? "") : "";
    const { html, plain } = known.weighed;
    return { html: html.replace(head, () => now), plain: head.exec(html)?.[0] === now ? plain : null };
  }

  /** Keeps an answer, and shows it where it is that of the case. */
  private learn(command: Command, { text, units }: Job, answer: Omit<Known, "text">): void {
    if (answer.headline.length === 0) return;
    const key = this.key(command, units, essence(text));
    const before = this.known.get(key);
    // Of two intervals that of the method, too, is the answer, whichever came last.
    if (before && !before.isNarrow && answer.isNarrow) return;
    this.known.delete(key);
    this.known.set(key, { text, ...answer });
    for (const oldest of [...this.known.keys()].slice(0, -KEPT)) this.known.delete(oldest);
    this.showHeadline();
    if (this.solved?.weighs || command === "estimate") this.speakSoon.ask();
  }

  private endRuns(): void {
    this.quick.end();
    this.job = null;
    this.keyOfJob = null;
    if (this.widening !== null) this.completing.end();
    this.widening = null;
  }

  /**
   * As soon as the hand rests: where the file has ranges, the answer gets its interval; where it has more evidence
   * than an exact solution uses, all of it is weighed, which is the answer.
   */
  private runInterval(): void {
    const { solved } = this;
    if (!solved?.look.ok || (this.isEstimate && !solved.weighs)) return;
    const { weighs, command } = solved;
    if (command === "avoid") this.avoid.refresh(solved);
    if (command === "avoid" || command === "recorder") return;
    const key = this.keyOf(solved);
    if (this.known.has(key) || this.keyOfJob === key) return;
    if (weighs) this.weigh(solved);
    // Ranges move the fullest answer of the case.
    else if (command === solved.look.able[0] && solved.check.commands.uncertainty?.able) {
      if (this.knownOf(solved)?.isNarrow === false) this.widen(solved);
      else this.findInterval(solved);
    }
  }

  private jobOf({ text, name, units }: Solved, kind: Job["kind"]): Job {
    return { kind, text, name, units, options: {} };
  }

  private findInterval(solved: Solved): void {
    const job = this.jobOf(solved, "uncertainty");
    this.job = job;
    this.keyOfJob = this.keyOf(solved);
    this.quick.start(job, {
      answer: (answer) => {
        // Nobody looks at the pictures of an interval.
        this.endRuns();
        if (answer.ok) this.learn(solved.command, job, { headline: answer.headline, isNarrow: true });
      },
    });
  }

  /** All the evidence of this text has been weighed, in these units or in others. */
  private hasWeighed({ text, name }: Solved): boolean {
    const { job } = this;
    return this.quick.hasRun && job?.kind === "reconstruct" && job.text === text && job.name === name;
  }

  private weigh(solved: Solved): void {
    if (this.job && this.hasWeighed(solved)) {
      this.job.units = solved.units;
      this.keyOfJob = this.keyOf(solved);
      this.quick.tellIn(solved.units);
      return;
    }
    const job = this.jobOf(solved, "reconstruct");
    this.job = job;
    this.keyOfJob = this.keyOf(solved);
    let found: Finished | null = null;
    this.weighing.removeAttribute("value");
    this.quick.start(job, {
      progress: (_, done, total) => {
        this.weighing.max = Math.max(total, 1);
        this.weighing.value = done;
      },
      answer: (answer) => {
        if (answer.ok) {
          found = answer;
          this.learn("reconstruct", job, { headline: answer.headline, isNarrow: false });
          return;
        }
        this.quick.end();
        this.unweighed = { key: this.keyOf(solved), message: answer.message };
        this.showHeadline();
        this.whenWeighed?.(false);
      },
      pictures: (plain) => {
        if (found) this.learn("reconstruct", job, { headline: found.headline, isNarrow: false, weighed: { html: found.html, plain } });
        if (this.solved) this.solved.weighed = this.weighedBefore(this.solved);
        for (const name of ["results", "drawings"]) this.stale.add(name);
        if (this.viewTabs.shown !== "scene") this.show(this.viewTabs.shown);
        this.whenWeighed?.(true);
      },
    });
  }

  /** The intervals with the errors of the method, which the headline has in other units. */
  private widen(solved: Solved): void {
    const key = this.keyOf(solved);
    if (this.widening === key || this.completing.busy) return;
    this.widening = key;
    void this.complete(solved, () => undefined).then(() => (this.widening = null));
  }

  // --- what is handed over ---

  /** What of the screen is saved or printed: a view that has an answer of its own, or the answer itself. */
  private get document(): { title: string; view: string } {
    const shown = this.viewTabs.shown;
    const own = ["uncertainty", "estimate", "sensitivity", "compare", "recorder", "avoid"].includes(shown);
    const view = own ? shown : this.isEstimate ? "estimate" : this.solved?.command === "avoid" ? "avoid" : "";
    return { view, title: view === "" ? texts.save.answer : (texts.viewTabs[view] ?? view) };
  }

  /** A file of what is on the screen; nothing where there is no answer of it yet, which is then said. */
  private async shown(kind: FileKind): Promise<string | null> {
    this.solveSoon.flush();
    const { solved, document: { view } } = this;
    if (!solved) return null;
    if (view === "avoid" && kind === "csv") {
      this.message(texts.save.noCsv);
      return null;
    }
    if (view === "uncertainty" || view === "estimate" || view === "avoid") {
      const file = this[view].file(kind, solved.text);
      if (file) return file.catch((error: unknown) => this.refused(error));
      this.message(texts.save.notRun(texts.viewTabs[view] ?? view));
      return null;
    }
    if (view === "" && solved.weighs) return this.weighed(solved, kind);
    if (view === "" && kind === "html") return this.report();
    const command = view === "" ? solved.command : (view as Command);
    if (kind === "html") {
      const made = engine.report(solved.text, this.name.value, command, solved.units);
      if (!made.ok) this.message(said(engine.reason(made)));
      return made.ok ? made.html : null;
    }
    const answer = view === "" ? solved.answer : engine.answer(solved.text, command, solved.units, solved.name);
    if (!answer?.ok) {
      this.message(texts.save.nothing);
      return null;
    }
    const content = { json: answer.json, csv: answer.csv, txt: answer.text }[kind];
    if (content === null) this.message(texts.save.noCsv);
    return content;
  }

  private async saveShown(kind: FileKind): Promise<void> {
    const { view } = this.document;
    const content = await this.shown(kind);
    const types = { html: "text/html", json: "application/json", csv: "text/csv", txt: "text/plain" };
    if (content !== null) download(`${this.stem}${view === "" ? "" : `-${view}`}.${kind}`, content, types[kind]);
  }

  /** Who made the case, and when, as its text says. */
  private head({ values }: engine.Check): { analyst: string; date: string } {
    const [analyst = "", date = ""] = ["report.analyst", "report.date"].map((key) => {
      const given = readValue(values[key]?.text ?? "");
      return typeof given === "string" ? given : "";
    });
    return { analyst, date };
  }

  /** What a print says of the case beside its name: that it is not the one of the file, or not that of the report. */
  private sinceThen(): string {
    const { text } = this.editor;
    if (this.live && text !== this.live.text) return texts.live.changedPrinted;
    return text === this.saved ? "" : texts.file.unsaved;
  }

  private get stem(): string {
    return this.name.value.replace(/\.toml$/, "");
  }

  /** Says why there is no file. */
  private refused(error: unknown): null {
    this.message(said(error instanceof Error ? error.message : String(error)));
    return null;
  }

  /** What is waited for, with a button that ends it; nothing where nothing is. */
  private wait(words: string | null, end: () => void = () => undefined, progress: HTMLElement | null = null): void {
    this.working.hidden = words === null;
    const stop = h("button", { type: "button", class: "quiet", onclick: end }, texts.run.end);
    this.working.replaceChildren(...(words === null ? [] : [h("span", {}, words), ...(progress ? [progress] : []), stop]));
  }

  /** The picture that the case names: a page from the disk may not open it. Where it lies beneath the scene, it is known. */
  private plan(solved: Solved): { plan?: Uint8Array | undefined; missing?: string } {
    const named = readValue(solved.check.values["scene.site_plan.file"]?.text ?? "");
    if (typeof named !== "string") return {};
    const { file } = this.scene.backdrop;
    return file?.name === named.split("/").pop() ? { plan: file?.bytes } : { missing: named };
  }

  /** A file of all the evidence, weighed: as soon as that is done. */
  private async weighed(solved: Solved, kind: FileKind, page?: string): Promise<string | null> {
    const isOfText = () => this.job?.text === solved.text && this.job.name === solved.name && this.job.units === solved.units;
    if (!isOfText() || this.quick.busy) {
      this.whenWeighed?.(false);
      const done = await new Promise<boolean>((resolve) => {
        this.whenWeighed = resolve;
        this.wait(texts.save.whenWeighed, () => resolve(false));
        if (!isOfText()) this.weigh(solved);
      });
      this.whenWeighed = null;
      this.wait(null);
      if (!done) return null;
    }
    const { plan, missing } = this.plan(solved);
    const file = this.quick.file(kind, { plan, page });
    const content = file ? await file.catch((error: unknown) => this.refused(error)) : null;
    if (content === "") this.message(texts.save.noCsv);
    else if (content !== null && kind === "html" && missing !== undefined) this.message(texts.save.noPlan(missing));
    return content === "" ? null : content;
  }

  /** The report, or the page with it; nothing is made where there is no answer. */
  private handover(make: (solved: Solved, name: string, plan?: Uint8Array) => engine.Report): string | null {
    this.solveSoon.flush();
    const { solved } = this;
    if (!solved?.look.ok) {
      this.message(texts.save.nothing);
      return null;
    }
    const { plan, missing } = this.plan(solved);
    const made = make(solved, this.name.value, plan);
    if (!made.ok) {
      this.message(said(engine.reason(made)));
      return null;
    }
    if (missing !== undefined) this.message(texts.save.noPlan(missing));
    return made.html;
  }

  /** As the program makes it: of a reconstruction with ranges it has the errors of the method, which take a while. */
  private async report(): Promise<string | null> {
    const { solved } = this;
    const isQuick = !solved?.look.ok || solved.command !== "reconstruct" || !solved.check.commands.uncertainty?.able;
    if (isQuick) return this.handover(({ text, command, units }, name, plan) => engine.report(text, name, command, units, plan));
    const { missing } = this.plan(solved);
    const bar = h("progress", { max: 1, "aria-label": texts.run.progress });
    this.widening = null;
    this.wait(texts.save.completing, () => this.completing.end(), bar);
    const content = await this.complete(solved, (done, total) => {
      bar.max = Math.max(total, 1);
      bar.value = done;
    });
    // Where another report is waited for by now, that goes on.
    if (!this.completing.busy) this.wait(null);
    if (content !== null && missing !== undefined) this.message(texts.save.noPlan(missing));
    return content;
  }

  /** The report with the errors of the method. What leads it leads the screen, too. */
  private async complete(solved: Solved, progress: (done: number, total: number) => void): Promise<string | null> {
    const { plan } = this.plan(solved);
    const job = this.jobOf(solved, "reconstruct");
    const content = await new Promise<string | null>((resolve) => {
      this.completing.start(job, {
        progress: (_, done, total) => progress(done, total),
        answer: (answer) => {
          if (!answer.ok) end(this.refused(new Error(answer.message)));
        },
        pictures: () => void this.completing.file("html", { plan })?.then(end, (error: unknown) => end(this.refused(error))),
        ended: () => resolve(null),
      });
      const end = (made: string | null) => {
        resolve(made);
        this.completing.end();
      };
    });
    const lead = new DOMParser().parseFromString(content ?? "", "text/html").querySelector("p.answer");
    const headline = [...(lead?.childNodes ?? [])].map((line) => line.textContent ?? "").filter((line) => line.trim() !== "");
    this.learn(solved.command, job, { headline, isNarrow: false });
    return content;
  }

  private async saveLive(): Promise<void> {
    this.solveSoon.flush();
    const { solved } = this;
    if (solved?.look.ok && solved.command === "avoid") {
      const file = this.avoid.file("html", solved.text, { page: emptyPage() });
      if (!file) {
        this.message(texts.save.notRun(texts.viewTabs.avoid ?? ""));
        return;
      }
      download(`${this.stem}-live.html`, await file, "text/html");
      this.sayWhoseItIs(solved);
      return;
    }
    const live = solved?.weighs
      ? await this.weighed(solved, "html", emptyPage())
      : this.handover(({ text, command, units }, name, plan) => engine.live(emptyPage(), text, name, command, units, plan));
    if (live === null || !solved) return;
    download(`${this.stem}-live.html`, live, "text/html");
    this.sayWhoseItIs(solved);
  }

  /** Where the case does not name who hands it over, the report cannot. */
  private sayWhoseItIs(solved: Solved): void {
    if (this.head(solved.check).analyst !== "") return;
    const words = this.plan(solved).missing;
    this.message([...(words === undefined ? [] : [texts.save.noPlan(words)]), texts.save.noAnalyst].join(" "));
  }

  private async print(): Promise<void> {
    const report = await this.shown("html");
    if (report === null) return;
    const frame = h("iframe", { class: "unseen", title: texts.save.print, sandbox: "allow-same-origin allow-modals", srcdoc: report });
    frame.addEventListener("load", () => {
      frame.contentWindow?.addEventListener("afterprint", () => frame.remove());
      frame.contentWindow?.print();
    });
    document.body.append(frame);
  }
}
