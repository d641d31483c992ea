// How much of the drawing is seen: all of it, or a part that the wheel, two fingers, keys and buttons choose. Only what
// is seen changes: what is drawn stays as it is.
import { arrowOf } from "./arrows.js";
import { h } from "./dom.js";
import type { Point } from "./engine.js";
import { texts } from "./texts/en.js";

const words = texts.lens;

/** How many times larger than all of it a part is seen at most. */
const LARGEST = 16;
/** How many times larger one press of a button or key makes it. */
const STEP = 1.5;
/** Of what is seen: so far an arrow key goes. */
const PAN = 0.1;
/** Per pixel of a wheel, and of two fingers on a pad, which a browser tells as a wheel with Ctrl. */
const WHEEL = 0.002;
const PAD = 0.01;
/** (px) of a wheel that counts in lines. */
const LINE = 16;

export interface LensHost {
  /** Shows what is seen now. */
  changed(): void;
  /** Something in the scene is being moved, under which nothing else may move. */
  busy(): boolean;
  /** Two fingers are on the stage: what the first of them began ends. */
  pinched(): void;
}

export class Lens {
  readonly tools = h("div", { class: "lens-tools", role: "group", "aria-label": words.label });
  private readonly said = h("output", { class: "lens-factor" });
  private factor = 1;
  /** Upper left corner of what is seen, in shares of the drawing. */
  private corner: Point = [0, 0];
  /** Where the fingers on the stage are, in its shares. */
  private readonly fingers = new Map<number, Point>();
  /** What began with two fingers, or with a press beside everything: the place that stays under the pointer. */
  private held: { pointer: number | null; at: Point; apart: number; factor: number } | null = null;

  constructor(private readonly stage: HTMLElement, private readonly host: LensHost) {
    const button = (label: string, title: string, run: () => void) =>
      h("button", { type: "button", "aria-label": title, title, onclick: run }, label);
    this.tools.append(this.said,
      button("−", words.smaller, () => this.by(1 / STEP)), button("+", words.larger, () => this.by(STEP)), button(words.fit, words.fitTitle, () => this.reset()));
    stage.addEventListener("wheel", (event) => this.wheeled(event), { passive: false });
    stage.addEventListener("keydown", (event) => this.key(event));
    stage.addEventListener("pointerdown", (event) => this.touched(event), true);
    stage.addEventListener("pointerdown", (event) => this.pressed(event));
    stage.addEventListener("pointermove", (event) => this.moved(event));
    for (const type of ["pointerup", "pointercancel"] as const) stage.addEventListener(type, (event) => this.left(event));
    // Two fingers are for the stage, where one of them may scroll the page.
    stage.addEventListener("touchmove", (event) => event.touches.length > 1 && event.preventDefault(), { passive: false });
  }

  get isWhole(): boolean {
    return this.factor === 1;
  }

  /** A place of the drawing on the stage, both in shares. */
  toStage([x, y]: Point): Point {
    return [(x - this.corner[0]) * this.factor, (y - this.corner[1]) * this.factor];
  }

  toDrawing([x, y]: Point): Point {
    return [this.corner[0] + x / this.factor, this.corner[1] + y / this.factor];
  }

  /** What is seen of a drawing; `factor` larger than all of it. */
  box({ left, top, width, height }: { left: number; top: number; width: number; height: number }): { viewBox: string; factor: number } {
    const { factor, corner: [x, y] } = this;
    return { viewBox: `${left + x * width} ${top + y * height} ${width / factor} ${height / factor}`, factor };
  }

  /** Brings a place of the drawing to the middle, where it is not seen. */
  show(place: Point): void {
    if (this.toStage(place).some((share) => share < 0 || share > 1)) this.put(this.factor, place, [0.5, 0.5]);
  }

  reset(): void {
    this.held = null;
    this.put(1, [0, 0], [0, 0]);
  }

  /** Larger or smaller; what is at this place of the stage stays there. */
  private by(factor: number, at: Point = [0.5, 0.5]): void {
    if (!this.host.busy()) this.put(this.factor * factor, this.toDrawing(at), at);
  }

  /** So large, with a place of the drawing at a place of the stage, as far as no place beside the drawing is seen. */
  private put(factor: number, place: Point, at: Point): void {
    this.factor = Math.min(Math.max(factor, 1), LARGEST);
    // What is all but whole is whole.
    if (this.factor < 1.001) this.factor = 1;
    const [x, y] = [0, 1].map((axis) => {
      const corner = (place[axis] ?? 0) - (at[axis] ?? 0) / this.factor;
      return Math.min(Math.max(corner, 0), 1 - 1 / this.factor);
    });
    this.corner = [x ?? 0, y ?? 0];
    this.said.textContent = this.isWhole ? "" : words.factor(this.factor);
    this.stage.classList.toggle("zoomed", !this.isWhole);
    this.host.changed();
  }

  private share(event: MouseEvent): Point {
    const box = this.stage.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }

  private wheeled(event: WheelEvent): void {
    const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : LINE);
    // A page that can be scrolled that way is scrolled, as long as all of the scene is seen.
    const scrolled = this.stage.closest(".panels")?.scrollTop || document.documentElement.scrollTop;
    if (!event.ctrlKey && this.isWhole && (pixels >= 0 || scrolled > 0)) return;
    event.preventDefault();
    this.by(Math.exp(-pixels * (event.ctrlKey ? PAD : WHEEL)), this.share(event));
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const run: Record<string, () => void> = { "+": () => this.by(STEP), "=": () => this.by(STEP), "-": () => this.by(1 / STEP), "0": () => this.host.busy() || this.reset() };
    const arrow = arrowOf(event);
    if (run[event.key]) run[event.key]?.();
    else if (arrow && event.target === this.stage && !this.isWhole && !this.host.busy()) this.put(this.factor, this.toDrawing([arrow[0] * PAN, -arrow[1] * PAN]), [0, 0]);
    else return;
    event.preventDefault();
  }

  private touched(event: PointerEvent): void {
    if (event.defaultPrevented || event.pointerType !== "touch") return;
    this.fingers.set(event.pointerId, this.share(event));
    const both = this.both();
    if (!both) return;
    event.stopPropagation();
    this.host.pinched();
    this.held = { pointer: null, at: this.toDrawing(both.middle), apart: both.apart, factor: this.factor };
  }

  /** Of two fingers what lies between them. */
  private both(): { middle: Point; apart: number } | null {
    const [one, two] = this.fingers.values();
    if (!one || !two || this.fingers.size > 2) return null;
    const { width, height } = this.stage.getBoundingClientRect();
    const apart = Math.hypot((two[0] - one[0]) * width, (two[1] - one[1]) * height);
    return { middle: [(one[0] + two[0]) / 2, (one[1] + two[1]) / 2], apart: Math.max(apart, 1) };
  }

  /** Beside everything, or with the middle button, what is seen is moved. */
  private pressed(event: PointerEvent): void {
    const isMine = event.button === 1 || (event.button === 0 && !event.defaultPrevented);
    if (!isMine || this.isWhole || this.held || this.host.busy()) return;
    event.preventDefault();
    this.stage.focus({ preventScroll: true });
    this.held = { pointer: event.pointerId, at: this.toDrawing(this.share(event)), apart: 1, factor: this.factor };
    this.stage.setPointerCapture(event.pointerId);
    this.stage.classList.add("panning");
  }

  private moved(event: PointerEvent): void {
    if (this.fingers.has(event.pointerId)) this.fingers.set(event.pointerId, this.share(event));
    const { held } = this;
    if (!held) return;
    const both = this.both();
    if (held.pointer === null && both) this.put((held.factor * both.apart) / held.apart, held.at, both.middle);
    else if (held.pointer === event.pointerId) this.put(held.factor, held.at, this.share(event));
  }

  private left(event: PointerEvent): void {
    const wasFinger = this.fingers.delete(event.pointerId);
    if (!this.held || (this.held.pointer !== event.pointerId && !(wasFinger && this.held.pointer === null))) return;
    this.held = null;
    this.stage.classList.remove("panning");
  }
}
