// The scene, worked with the mouse or the keyboard: the engine draws it, and says where its handles are. A handle
// that moves asks the engine for the text that has it there; the picture follows from that text.
import { eachFrame, h, markup, s } from "./dom.js";
import * as engine from "./engine.js";
import type { Handle, Plan, Point, Scene, View, Viewport } from "./engine.js";
import { Backdrop } from "./backdrop.js";
import { saveButtons } from "./pictures.js";
import { texts } from "./texts/en.js";

const words = texts.scene;

/** The step of an arrow key: metres, and radians for what turns. */
const STEP = 0.05;
const TURN = Math.PI / 180;

export interface SceneHost {
  text(): string;
  /** Another view is wanted. */
  draw(): void;
  preview(text: string): void;
  /** A change of the text that is whole. */
  write(text: string): void;
  settle(keep: boolean): void;
  refused(message: string): void;
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
  private readonly none = h("p", { class: "note", hidden: true }, words.none);
  private readonly hint = h("p", { class: "hint" }, words.hint);
  private readonly stage = h("div", { class: "stage" });
  readonly backdrop = new Backdrop(this.stage, () => this.surveyed(), (plan) => this.keep(plan));
  readonly element = h("div", { class: "scene" });
  private readonly buttons = new Map<string, HTMLButtonElement>();
  private readonly bodies = new Map<number, SVGPolygonElement>();
  private now: Scene | null = null;
  private box = { width: 1, height: 1 };
  private what: View = "scene";
  private readonly which = h("select", { "aria-label": words.which, onchange: () => this.choose(this.which.value as View) },
    h("option", { value: "scene" }, words.impact), h("option", { value: "motion" }, words.rest));
  private held: Viewport | null = null;
  private dragging: Drag | null = null;
  private readonly move = eachFrame((to: Point) => this.moveTo(to));

  constructor(private readonly host: SceneHost) {
    this.stage.append(this.sheet, this.backdrop.picture, this.overlay, this.knobs);
    const tools = h("div", { class: "scene-tools" }, this.which, this.backdrop.tools, saveButtons("scene", words.title, () => this.now?.svg ?? null));
    this.element.append(this.none, this.stage, tools, this.hint);
    this.stage.addEventListener("pointermove", (event) => this.pointerMoved(event));
    for (const type of ["pointerup", "pointercancel"] as const) {
      this.stage.addEventListener(type, (event) => this.released(event.type === "pointerup"));
    }
    document.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || !this.dragging) return;
      event.preventDefault();
      this.released(false);
    });
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
    this.now = null;
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
    return { what: this.what, viewport: this.held };
  }

  /** Shows the scene of the text as it is now; what cannot be drawn leaves the last picture, dimmed. */
  update(scene: Scene | null): void {
    this.stage.classList.toggle("stale", scene === null);
    this.none.hidden = scene !== null || this.now !== null;
    this.stage.hidden = !this.none.hidden;
    this.hint.hidden = this.stage.hidden;
    if (!scene) return;
    this.now = scene;
    this.which.value = scene.what;
    markup(this.sheet, scene.svg);
    const drawing = this.sheet.querySelector("svg");
    const [, , width = 1, height = 1] = (drawing?.getAttribute("viewBox") ?? "0 0 1 1").split(" ").map(Number);
    this.box = { width, height };
    this.overlay.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.stage.style.aspectRatio = `${width} / ${height}`;
    this.stage.style.setProperty("--aspect", String(width / height));
    const [x, y] = scene.survey;
    this.backdrop.place((at) => this.toShare([at[0] - x, at[1] - y]), scene.plan);
    this.placeBodies(scene);
    this.placeHandles(scene);
  }

  private choose(what: View): void {
    this.what = what;
    this.host.draw();
  }

  /** Scene metres to the share of the drawing's width and height. */
  private toShare([x, y]: Point): Point {
    const { origin, scale } = this.now as Scene;
    return [(origin[0] + scale * x) / this.box.width, (origin[1] - scale * y) / this.box.height];
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
    const x = ((event.clientX - place.left) / place.width) * this.box.width;
    const y = ((event.clientY - place.top) / place.height) * this.box.height;
    return [(x - origin[0]) / scale, (origin[1] - y) / scale];
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
        const [x, y] = this.toShare(at);
        return `${x * this.box.width},${y * this.box.height}`;
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
    if (element instanceof HTMLElement) element.focus({ preventScroll: true });
    const [x, y] = this.toScene(event);
    const offset: Point = [handle.at[0] - x, handle.at[1] - y];
    this.dragging = { text: this.host.text(), handle, offset, moved: false, pointer: event.pointerId, element };
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
    const direction: Record<string, Point> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    const arrow = direction[event.key];
    const handle = this.now?.handles.find((one) => name(one) === id);
    if (!arrow || !handle || !this.now || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    const factor = event.shiftKey ? 5 : event.altKey ? 0.2 : 1;
    const dragged = engine.drag(this.host.text(), handle, this.stepped(handle, arrow, factor));
    if (!dragged.ok) {
      this.host.refused(dragged.message);
      return;
    }
    this.held = this.now.viewport;
    this.host.write(dragged.text);
    this.held = null;
  }

  private stepped(handle: Handle, [right, up]: Point, factor: number): Point {
    const [x, y] = handle.at;
    if (!turns(handle)) return [x + right * STEP * factor, y + up * STEP * factor];
    // Left and up turn counter-clockwise.
    const angle = (up - right) * TURN * factor;
    const [fromX, fromY] = [x - handle.centre[0], y - handle.centre[1]];
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    return [handle.centre[0] + cos * fromX - sin * fromY, handle.centre[1] + sin * fromX + cos * fromY];
  }
}
