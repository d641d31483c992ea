// A measuring tape over the scene. It measures what is drawn, and is no part of the case.
import { arrowOf, stepped, stepsOf } from "./arrows.js";
import { h, s } from "./dom.js";
import type { Point } from "./engine.js";
import { texts } from "./texts/en.js";

const words = texts.tape;

/** (px) so near to a mark an end takes its place. */
const NEAR = 12;
/** (px) what is drawn shorter was a click. */
const CLICK = 4;
/** A place of the scene that has a name. */
export interface Mark {
  name: string;
  at: Point;
}

export interface TapeHost {
  marks(): Mark[];
  toScene(event: PointerEvent): Point;
  /** Scene metres to the share of the stage. */
  toStage(at: Point): Point;
  /** Brings a place of the scene into what is seen. */
  show(at: Point): void;
  /** Length and direction in words, from one place to the other. */
  measure(from: Point, to: Point): string;
  toggled(): void;
}

/** An end lies on a mark, with which it moves, or somewhere. */
interface End {
  at: Point;
  mark: string | null;
}

export class Tape {
  readonly button: HTMLButtonElement;
  readonly element = h("div", { class: "tape", hidden: true, role: "group", "aria-label": words.label });
  private readonly line = s("svg", { viewBox: "0 0 100 100", preserveAspectRatio: "none", "aria-hidden": "true" });
  private readonly reading = h("output", { class: "tape-reading" });
  private readonly knobs: HTMLButtonElement[];
  isOn = false;
  private ends: [End, End] | null = null;
  /** The end that follows the pointer, and the tape as it was before. */
  private drag: { end: 0 | 1; pointer: number; from: Point; before: [End, End] | null } | null = null;

  constructor(private readonly stage: HTMLElement, private readonly host: TapeHost) {
    this.button = h("button", { type: "button", "aria-pressed": "false", title: words.title, onclick: (event: MouseEvent) => (this.isOn ? this.off() : this.on(event.detail === 0)) }, words.button);
    this.knobs = ([0, 1] as const).map((end) => {
      const knob = h("button", { type: "button", class: "knob tape-end" });
      knob.addEventListener("pointerdown", (event) => this.grasp(event, end));
      knob.addEventListener("keydown", (event) => this.key(event, end));
      knob.addEventListener("focus", () => this.ends && !this.drag && this.host.show(this.ends[end].at));
      return knob;
    });
    this.element.append(this.line, ...this.knobs, this.reading);
    stage.addEventListener("pointerdown", (event) => this.pressed(event));
    stage.addEventListener("pointermove", (event) => this.moved(event));
    for (const type of ["pointerup", "pointercancel"] as const) stage.addEventListener(type, (event) => this.released(event));
  }

  get busy(): boolean {
    return this.drag !== null;
  }

  /** Takes the tape away. */
  off(): void {
    const hadFocus = this.element.contains(document.activeElement);
    this.drag = null;
    this.ends = null;
    this.toggle(false);
    if (hadFocus) this.button.focus();
  }

  /** What was begun with a finger ends: it was one of two. */
  giveUp(): void {
    if (this.drag) this.ends = this.drag.before;
    this.drag = null;
    this.place();
  }

  /** Shows the tape where it lies in the scene as it is now. */
  place(): void {
    const { ends } = this;
    this.element.hidden = !ends;
    if (!ends) return;
    const marks = this.host.marks();
    for (const end of ends) end.at = marks.find(({ name }) => name === end.mark)?.at ?? end.at;
    const [from, to] = ends.map(({ at }) => this.host.toStage(at)) as [Point, Point];
    const path = `M${from[0] * 100} ${from[1] * 100}L${to[0] * 100} ${to[1] * 100}`;
    this.line.replaceChildren(s("path", { d: path, class: "halo" }), s("path", { d: path }));
    this.knobs.forEach((knob, which) => {
      const [x, y] = which === 0 ? from : to;
      knob.style.left = `${x * 100}%`;
      knob.style.top = `${y * 100}%`;
      const label = words.end(which, ends[which]?.mark ?? null);
      knob.setAttribute("aria-label", label);
      knob.title = label;
    });
    this.reading.textContent = this.host.measure(ends[0].at, ends[1].at);
    // Above its middle, and within what is seen.
    const [x, y] = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
    this.reading.style.left = `clamp(6rem, ${x * 100}%, 100% - 6rem)`;
    this.reading.style.top = `clamp(4.5rem, ${y * 100}%, 100%)`;
  }

  /** Where no pointer draws it, it lies between the first two marks, so that there is something to take hold of. */
  private on(byKeyboard: boolean): void {
    const [first, second] = this.host.marks();
    const end = (mark: Mark | undefined, at: Point): End => ({ at: mark?.at ?? at, mark: mark?.name ?? null });
    if (byKeyboard) this.ends = [end(first, [0, 0]), end(second, [first?.at[0] ?? 0, (first?.at[1] ?? 0) + 1])];
    this.toggle(true);
  }

  private toggle(isOn: boolean): void {
    this.isOn = isOn;
    this.button.setAttribute("aria-pressed", String(this.isOn));
    this.stage.classList.toggle("measuring", this.isOn);
    this.place();
    this.host.toggled();
  }

  /** The mark that is near, or the place itself. */
  private snapped(at: Point): End {
    const { width, height } = this.stage.getBoundingClientRect();
    const here = this.host.toStage(at);
    const near = this.host.marks().map((mark) => {
      const [x, y] = this.host.toStage(mark.at);
      return { mark, away: Math.hypot((x - here[0]) * width, (y - here[1]) * height) };
    }).sort((a, b) => a.away - b.away)[0];
    return near && near.away <= NEAR ? { at: near.mark.at, mark: near.mark.name } : { at, mark: null };
  }

  /** A new tape from the place that is pressed. */
  private pressed(event: PointerEvent): void {
    if (!this.isOn || event.button !== 0 || event.defaultPrevented) return;
    event.preventDefault();
    const start = this.snapped(this.host.toScene(event));
    const before = this.ends;
    this.ends = [start, { ...start }];
    this.begin(event, 1, before);
  }

  private grasp(event: PointerEvent, end: 0 | 1): void {
    if (!this.ends || event.button !== 0) return;
    event.preventDefault();
    this.begin(event, end, [{ ...this.ends[0] }, { ...this.ends[1] }]);
    this.knobs[end]?.focus({ preventScroll: true });
  }

  private begin(event: PointerEvent, end: 0 | 1, before: [End, End] | null): void {
    this.drag = { end, pointer: event.pointerId, from: [event.clientX, event.clientY], before };
    this.stage.setPointerCapture(event.pointerId);
  }

  private moved(event: PointerEvent): void {
    if (!this.ends || this.drag?.pointer !== event.pointerId) return;
    this.ends[this.drag.end] = this.snapped(this.host.toScene(event));
    this.place();
  }

  private released(event: PointerEvent): void {
    if (this.drag?.pointer !== event.pointerId) return;
    const { from, before } = this.drag;
    if (Math.hypot(event.clientX - from[0], event.clientY - from[1]) < CLICK) this.ends = before;
    this.drag = null;
    this.place();
  }

  /** An arrow key moves an end; Enter takes it to the next mark. */
  private key(event: KeyboardEvent, which: 0 | 1): void {
    const end = this.ends?.[which];
    const arrow = arrowOf(event);
    if (!end || !this.ends || event.ctrlKey || event.metaKey || !(arrow || event.key === "Enter")) return;
    event.preventDefault();
    const marks = this.host.marks();
    const next = marks[(marks.findIndex(({ name }) => name === end.mark) + 1) % marks.length];
    if (arrow) this.ends[which] = { at: stepped(end.at, arrow, stepsOf(event)), mark: null };
    else if (next) this.ends[which] = { at: next.at, mark: next.name };
    this.host.show(this.ends[which].at);
    this.place();
  }
}
