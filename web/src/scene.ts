// The scene, worked with the mouse or the keyboard: the engine draws it, and says where its handles are. A handle
// that moves asks the engine for the text that has it there; the picture follows from that text.
import { eachFrame, h, markup, s } from "./dom.js";
import * as engine from "./engine.js";
import type { Handle, Plan, Point, Scene, View, Viewport } from "./engine.js";
import { arrowOf, stepped, stepsOf } from "./arrows.js";
import { Backdrop } from "./backdrop.js";
import { Lens } from "./lens.js";
import { saveButtons } from "./pictures.js";
import { type Mark, Tape } from "./tape.js";
import { texts } from "./texts/en.js";

const words = texts.scene;

/** (rad) of an arrow key, for what turns. */
const TURN = Math.PI / 180;

/** (px) letters of a part that is seen larger grow to this height, and no further. */
const LETTERS = 12;
/** The same of the drawing, in its own units. */
const DRAWN_LETTERS = 13;

/** Lengths that a scale may have, in its unit. */
const LENGTHS = [50, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1];
/** Of the width of what is seen: so long a scale is at most. */
const LONGEST = 0.3;

/** A unit of length. */
export interface Unit {
  name: string;
  metres: number;
}

export interface SceneHost {
  text(): string;
  /** Another view is wanted. */
  draw(): void;
  preview(text: string): void;
  /** A change of the text that is whole. */
  write(text: string): void;
  settle(keep: boolean): void;
  refused(message: string): void;
  /** What the case has for a key, in words. */
  value(key: string): string;
  unit(): Unit;
  /** A length and a direction in words: in the units of the answer, and as the case counts angles. */
  measured(metres: number, radians: number): string;
}

const name = (handle: Handle): string => `${handle.kind}-${handle.vehicle ?? 0}-${handle.index ?? 0}`;
const turns = (handle: Handle): boolean => ["heading", "plane", "rest_heading"].includes(handle.kind);

interface Drag {
  /** The text and the handle when the drag began: each place is applied to these, so that nothing adds up. */
  text: string;
  handle: Handle;
  /** From the pointer to the handle, so that it does not jump. */
  offset: Point;
  moved: boolean;
  pointer: number;
  element: HTMLElement | SVGElement;
}

export class SceneView {
  private readonly sheet = h("div", { class: "sheet" });
  private readonly overlay = s("svg", { class: "overlay", "aria-hidden": "true" });
  private readonly knobs = h("div", { class: "knobs", role: "group", "aria-label": words.handles });
  private readonly none = h("p", { class: "note", hidden: true });
  /** Where a handle stands that an arrow key has moved, for who does not see it. */
  private readonly told = h("div", { class: "unseen", role: "status" });
  private readonly hint = h("p", { class: "hint" }, words.hint);
  private readonly stage = h("div", { class: "stage", tabindex: 0, role: "group", "aria-label": words.stage });
  /** The scale of a part that is seen larger: that of the drawing may lie beside it. */
  private readonly bar = h("div", { class: "scale-bar", hidden: true });
  private readonly board = h("div", { class: "board" }, this.stage);
  readonly backdrop = new Backdrop(this.stage, () => this.surveyed(), (plan) => this.keep(plan));
  readonly element = h("div", { class: "scene" });
  private readonly buttons = new Map<string, HTMLButtonElement>();
  private readonly bodies = new Map<number, SVGPolygonElement>();
  private now: Scene | null = null;
  /** Of the drawing: a third line of its heading stands above 0. */
  private box = { left: 0, top: 0, width: 1, height: 1 };
  private what: View = "scene";
  private readonly which = h("select", { "aria-label": words.which, onchange: () => this.choose(this.which.value as View) },
    h("option", { value: "scene" }, words.impact), h("option", { value: "motion" }, words.rest));
  private held: Viewport | null = null;
  private readonly tape = new Tape(this.stage, {
    marks: () => this.marks(),
    toScene: (event) => this.toScene(event),
    toStage: (at) => this.toShare(at),
    show: (at) => this.lens.show(this.inDrawing(at)),
    measure: ([x, y], [toX, toY]) => this.host.measured(Math.hypot(toX - x, toY - y), Math.atan2(toY - y, toX - x)),
    toggled: () => (this.hint.textContent = this.tape.isOn ? texts.tape.hint : words.hint),
  });
  private readonly lens = new Lens(this.stage, {
    changed: () => this.looked(),
    busy: () => this.busy || this.tape.busy,
    pinched: () => {
      this.released(false);
      this.tape.giveUp();
    },
  });
  /** The scene was drawn while a part of it was seen, and keeps its place for that. */
  private isFramed = false;
  private dragging: Drag | null = null;
  private readonly move = eachFrame((to: Point) => this.moveTo(to));

  constructor(private readonly host: SceneHost) {
    this.stage.append(this.sheet, this.backdrop.picture, this.overlay, this.bar, this.knobs, this.tape.element);
    this.lens.tools.append(this.tape.button);
    this.board.prepend(this.lens.tools);
    const tools = h("div", { class: "scene-tools" }, this.which, this.backdrop.tools, saveButtons("scene", words.title, () => this.now?.svg ?? null));
    this.element.append(this.none, this.board, tools, this.hint, this.told);
    this.stage.addEventListener("pointermove", (event) => this.pointerMoved(event));
    for (const type of ["pointerup", "pointercancel"] as const) {
      this.stage.addEventListener(type, (event) => this.released(event.type === "pointerup"));
    }
    document.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || event.defaultPrevented) return;
      // Where Escape means something else, it does not mean the tape.
      const isHere = !(event.target as HTMLElement).closest("dialog, details[open], input, select, textarea, .cm-editor");
      if (this.dragging) this.released(false);
      else if (this.tape.isOn && isHere) this.tape.off();
      else return;
      event.preventDefault();
    });
    this.knobs.addEventListener("focusin", (event) => !this.dragging && this.showHandle((event.target as HTMLElement).dataset.handle ?? ""));
  }

  /** Ends a drag that goes on, before something else changes the text; false where there is none. */
  end(keep: boolean): boolean {
    const was = this.dragging !== null;
    this.released(keep);
    return was;
  }

  /** Another case: nothing of the one before stays. */
  reset(): void {
    this.end(false);
    this.tape.off();
    this.isFramed = false;
    this.now = null;
    this.lens.reset();
    this.sheet.replaceChildren();
    for (const element of [...this.buttons.values(), ...this.bodies.values()]) element.remove();
    this.buttons.clear();
    this.bodies.clear();
  }

  get busy(): boolean {
    return this.dragging !== null;
  }

  /** Of the two plan views the one that was chosen, and what of it holds still. */
  get wanted(): { what: View; viewport: Viewport | null } {
    return { what: this.what, viewport: this.held ?? (this.lens.isWhole ? null : (this.now?.viewport ?? null)) };
  }

  /** Shows the scene of the text as it is now; what cannot be drawn leaves the last picture, dimmed. */
  update(scene: Scene | null, hasError: boolean): void {
    this.stage.classList.toggle("stale", scene === null);
    this.none.hidden = scene !== null || this.now !== null;
    this.none.textContent = hasError ? words.error : words.none;
    this.board.hidden = !this.none.hidden;
    this.hint.hidden = this.board.hidden;
    if (!scene) return;
    const isOther = this.now !== null && this.now.what !== scene.what;
    this.isFramed = !this.lens.isWhole;
    this.now = scene;
    // The other plan view is seen whole, and has places of its own.
    if (isOther) {
      this.tape.off();
      this.lens.reset();
    }
    this.which.value = scene.what;
    markup(this.sheet, scene.svg);
    const drawing = this.sheet.querySelector("svg");
    const [left = 0, top = 0, width = 1, height = 1] = (drawing?.getAttribute("viewBox") ?? "0 0 1 1").split(" ").map(Number);
    this.box = { left, top, width, height };
    this.stage.style.aspectRatio = `${width} / ${height}`;
    this.board.style.setProperty("--aspect", String(width / height));
    this.place(scene);
  }

  /** Another part is seen. */
  private looked(): void {
    if (!this.now) return;
    if (this.lens.isWhole && this.isFramed) {
      this.isFramed = false;
      this.host.draw();
    } else this.place(this.now);
  }

  /** Puts the drawing, and all that lies over it, where it is seen. */
  private place(scene: Scene): void {
    const { width } = this.box;
    const { viewBox, factor } = this.lens.box(this.box);
    for (const drawing of [this.sheet.querySelector("svg"), this.overlay]) drawing?.setAttribute("viewBox", viewBox);
    const grown = (DRAWN_LETTERS * this.stage.clientWidth * factor) / width;
    this.stage.style.setProperty("--letters", String(Math.min(1, Math.max(LETTERS / grown, 1 / factor))));
    this.showScale((scene.scale * factor) / width);
    const [x, y] = scene.survey;
    this.backdrop.place((at) => this.toShare([at[0] - x, at[1] - y]), scene.plan);
    this.placeBodies(scene);
    this.placeHandles(scene);
    this.tape.place();
  }

  /** `share` of the stage is one metre. */
  private showScale(share: number): void {
    const { name: unit, metres } = this.host.unit();
    const length = LENGTHS.find((one) => one * metres * share <= LONGEST);
    this.bar.hidden = this.lens.isWhole || length === undefined;
    if (length === undefined) return;
    this.bar.textContent = `${length} ${unit}`;
    this.bar.style.width = `${length * metres * share * 100}%`;
  }

  /** What a tape holds to. */
  private marks(): Mark[] {
    const { contact, bodies = [], handles = [] } = this.now ?? {};
    return [
      ...bodies.flatMap((body) => (body ? [{ name: texts.tape.cg(body.vehicle), at: body.centre }] : [])),
      ...(contact ? [{ name: texts.tape.contact, at: contact }] : []),
      ...handles.filter(({ kind }) => ["rest", "point", "station"].includes(kind)).map((handle) => ({ name: words.handle(handle), at: handle.at })),
    ];
  }

  private showHandle(id: string): void {
    const handle = this.now?.handles.find((one) => name(one) === id);
    if (handle) this.lens.show(this.inDrawing(handle.at));
  }

  private choose(what: View): void {
    this.what = what;
    this.isFramed = false;
    this.lens.reset();
    this.host.draw();
  }

  /** Scene metres to the share of what is seen. */
  private toShare(at: Point): Point {
    return this.lens.toStage(this.inDrawing(at));
  }

  /** Scene metres to the share of the drawing's width and height. */
  private inDrawing([x, y]: Point): Point {
    const { origin, scale } = this.now as Scene;
    const { left, top, width, height } = this.box;
    return [(origin[0] + scale * x - left) / width, (origin[1] - scale * y - top) / height];
  }

  /** What is seen, in places of the survey: the impact is drawn in places of its own. */
  private surveyed(): Viewport | null {
    if (!this.now) return null;
    const { viewport: { left, right, bottom, top }, survey: [x, y] } = this.now;
    return { left: left + x, right: right + x, bottom: bottom + y, top: top + y };
  }

  private keep(plan: Plan | null): void {
    const text = this.host.text();
    const kept = plan ? engine.keepPlan(text, plan) : engine.edit(text, "scene.site_plan", "");
    if (kept.ok) this.host.write(kept.text);
    else this.host.refused(engine.reason(kept));
  }

  private toScene(event: PointerEvent): Point {
    const { origin, scale } = this.now as Scene;
    const place = this.stage.getBoundingClientRect();
    const [x, y] = this.lens.toDrawing([(event.clientX - place.left) / place.width, (event.clientY - place.top) / place.height]);
    const { left, top, width, height } = this.box;
    return [(left + x * width - origin[0]) / scale, (origin[1] - top - y * height) / scale];
  }

  private placeBodies(scene: Scene): void {
    for (const body of scene.bodies) {
      if (!body) continue;
      let polygon = this.bodies.get(body.vehicle);
      if (!polygon) {
        polygon = s("polygon", { class: "body-grip" }, s("title", {}, words.body(body.vehicle)));
        const grip = polygon;
        grip.addEventListener("pointerdown", (event) => {
          const handle = this.now?.handles.find((one) => one.kind === "body" && one.vehicle === body.vehicle);
          if (handle) this.grasp(event, handle, grip);
        });
        this.bodies.set(body.vehicle, grip);
        this.overlay.append(grip);
      }
      const corners = body.outline.map((at) => {
        const [x, y] = this.inDrawing(at);
        const { left, top, width, height } = this.box;
        return `${left + x * width},${top + y * height}`;
      });
      polygon.setAttribute("points", corners.join(" "));
    }
    for (const [vehicle, polygon] of this.bodies) {
      if (scene.bodies.some((body) => body?.vehicle === vehicle)) continue;
      polygon.remove();
      this.bodies.delete(vehicle);
    }
  }

  private placeHandles(scene: Scene): void {
    const left = new Set(this.buttons.keys());
    for (const handle of scene.handles) {
      const id = name(handle);
      left.delete(id);
      let button = this.buttons.get(id);
      if (!button) {
        button = h("button", { type: "button", class: `knob ${handle.kind} vehicle-${handle.vehicle ?? 0}`, "data-handle": id });
        const knob = button;
        knob.addEventListener("pointerdown", (event) => {
          const current = this.now?.handles.find((one) => name(one) === id);
          if (current) this.grasp(event, current, knob);
        });
        knob.addEventListener("keydown", (event) => this.key(event, id));
        this.buttons.set(id, knob);
        this.knobs.append(knob);
      }
      const label = words.handle(handle);
      button.setAttribute("aria-label", label);
      button.title = label;
      const [x, y] = this.toShare(handle.at);
      button.style.left = `${x * 100}%`;
      button.style.top = `${y * 100}%`;
    }
    for (const id of left) {
      this.buttons.get(id)?.remove();
      this.buttons.delete(id);
    }
  }

  private grasp(event: PointerEvent, handle: Handle, element: HTMLElement | SVGElement): void {
    if (event.button !== 0 || !this.now) return;
    event.preventDefault();
    const [x, y] = this.toScene(event);
    const offset: Point = [handle.at[0] - x, handle.at[1] - y];
    this.dragging = { text: this.host.text(), handle, offset, moved: false, pointer: event.pointerId, element };
    if (element instanceof HTMLElement) element.focus({ preventScroll: true });
    this.held = this.now.viewport;
    element.setPointerCapture(event.pointerId);
    this.stage.classList.add("dragging");
  }

  private pointerMoved(event: PointerEvent): void {
    if (!this.dragging || event.pointerId !== this.dragging.pointer) return;
    const [x, y] = this.toScene(event);
    this.move([x + this.dragging.offset[0], y + this.dragging.offset[1]]);
  }

  private moveTo(to: Point): void {
    const { dragging } = this;
    if (!dragging) return;
    const begun = performance.now();
    const dragged = engine.drag(dragging.text, dragging.handle, to);
    if (!dragged.ok) {
      this.host.refused(dragged.message);
      return;
    }
    dragging.moved = true;
    this.host.preview(dragged.text);
    performance.measure("deltav-drag", { start: begun });
  }

  private released(keep: boolean): void {
    if (!this.dragging) return;
    this.move.flush();
    const { moved, element, pointer } = this.dragging;
    this.dragging = null;
    this.stage.classList.remove("dragging");
    if (element.hasPointerCapture(pointer)) element.releasePointerCapture(pointer);
    this.held = null;
    if (moved) this.host.settle(keep);
  }

  /** An arrow key moves a handle, or turns what turns. */
  private key(event: KeyboardEvent, id: string): void {
    const arrow = arrowOf(event);
    const handle = this.now?.handles.find((one) => name(one) === id);
    if (!arrow || !handle || !this.now || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    const dragged = engine.drag(this.host.text(), handle, this.stepped(handle, arrow, stepsOf(event)));
    if (!dragged.ok) {
      this.host.refused(dragged.message);
      return;
    }
    this.held = this.now.viewport;
    this.host.write(dragged.text);
    this.held = null;
    this.showHandle(id);
    this.told.textContent = words.moved(handle, handle.keys.map((key) => this.host.value(key)));
  }

  private stepped(handle: Handle, arrow: Point, steps: number): Point {
    if (!turns(handle)) return stepped(handle.at, arrow, steps);
    // Left and up turn counter-clockwise.
    const [[x, y], [right, up]] = [handle.at, arrow];
    const angle = (up - right) * TURN * steps;
    const [fromX, fromY] = [x - handle.centre[0], y - handle.centre[1]];
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    return [handle.centre[0] + cos * fromX - sin * fromY, handle.centre[1] + sin * fromX + cos * fromY];
  }
}
