// A site plan or a photograph from above beneath the scene. It is a picture and nothing more: no result depends on
// it, and it stays in the page. Where the case names it as its site plan, it lies where the case has it, and what
// moves it here moves it there.
import { h, s } from "./dom.js";
import * as engine from "./engine.js";
import type { Plan, Point, Viewport } from "./engine.js";
import { texts } from "./texts/en.js";

const words = texts.backdrop;

interface Placed {
  /** Width over height of the picture. */
  aspect: number;
  /** Metres of the survey: where its middle lies, and how wide it is. */
  middle: Point;
  width: number;
  /** Degrees, counter-clockwise. */
  angle: number;
}

const radians = (degrees: number): number => (degrees * Math.PI) / 180;

/** From the lower left corner of a picture to its middle. */
function toMiddle({ aspect, width, angle }: Placed): Point {
  const [cos, sin] = [Math.cos(radians(angle)), Math.sin(radians(angle))];
  const [across, up] = [width / 2, width / aspect / 2];
  return [cos * across - sin * up, sin * across + cos * up];
}

export class Backdrop {
  readonly picture = h("img", { class: "backdrop", alt: "", hidden: true });
  readonly tools = h("div", { class: "backdrop-tools" });
  /** The file of the picture. */
  file: { name: string; bytes: Uint8Array } | null = null;
  private placed: Placed | null = null;
  private toShare: ((at: Point) => Point) | null = null;
  /** What the case names. */
  private plan: Plan | null = null;
  private wasKept = false;
  private mode: "off" | "move" | "scale" = "off";
  private marks: Point[] = [];
  private readonly layer = s("svg", { class: "backdrop-marks", viewBox: "0 0 100 100", preserveAspectRatio: "none", "aria-hidden": "true" });
  private readonly input = h("input", { type: "file", accept: "image/png,image/jpeg", hidden: true, "aria-label": words.add });
  private readonly distance = h("input", { type: "text", class: "number", placeholder: "10 m", "aria-label": words.distance });
  private readonly turn = h("input", { type: "number", class: "number short", step: "0.5", "aria-label": words.turn });
  private readonly status = h("p", { class: "hint", role: "status" });

  constructor(
    private readonly stage: HTMLElement,
    private readonly viewport: () => Viewport | null,
    /** Names the picture in the case, or names none. */
    private readonly keepPlan: (plan: Plan | null) => void,
  ) {
    this.input.addEventListener("change", () => {
      const file = this.input.files?.[0];
      if (file) void this.open(file);
      this.input.value = "";
    });
    this.turn.addEventListener("input", () => {
      if (this.placed) this.placed.angle = this.turn.valueAsNumber || 0;
      this.moved();
    });
    this.distance.addEventListener("keydown", (event) => event.key === "Enter" && this.setScale());
    this.stage.append(this.layer);
    this.stage.addEventListener("pointerdown", (event) => this.pressed(event), true);
    this.showTools();
  }

  /** Takes a picture from a file. */
  async open(file: File): Promise<void> {
    if (this.picture.src) URL.revokeObjectURL(this.picture.src);
    this.picture.src = URL.createObjectURL(file);
    try {
      await this.picture.decode();
    } catch {
      this.status.textContent = words.unreadable;
      return;
    }
    this.file = { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
    const view = this.viewport() ?? { left: -10, right: 10, bottom: -8, top: 8 };
    this.placed = {
      aspect: this.picture.naturalWidth / this.picture.naturalHeight,
      middle: [(view.left + view.right) / 2, (view.bottom + view.top) / 2],
      width: view.right - view.left,
      angle: 0,
    };
    this.mode = "off";
    this.status.textContent = "";
    this.follow();
    this.render();
    this.showTools();
  }

  /** Puts the picture where it lies in the drawing; `toShare` takes metres of the survey. */
  place(toShare: (at: Point) => Point, plan: Plan | null): void {
    this.toShare = toShare;
    this.plan = plan;
    this.follow();
    this.render();
  }

  /** Whether the case names this picture. */
  private get isKept(): boolean {
    return this.plan !== null && this.placed !== null && this.file?.name === this.plan.file.split("/").pop();
  }

  /** What the case names lies where the case has it. */
  private follow(): void {
    const { placed, plan, isKept } = this;
    if (isKept && placed && plan) {
      placed.width = plan.width;
      placed.angle = Number(((plan.angle * 180) / Math.PI).toFixed(6));
      const [x, y] = toMiddle(placed);
      placed.middle = [plan.corner[0] + x, plan.corner[1] + y];
      if (document.activeElement !== this.turn) this.turn.value = String(placed.angle);
    }
    if (isKept !== this.wasKept) {
      this.wasKept = isKept;
      this.showTools();
    }
  }

  /** Writes into the case where the picture lies. */
  private keep(): void {
    const { placed, file } = this;
    if (!placed || !file) return;
    const [x, y] = toMiddle(placed);
    const corner: Point = [placed.middle[0] - x, placed.middle[1] - y];
    const name = this.isKept && this.plan ? this.plan.file : file.name;
    this.keepPlan({ file: name, corner, width: placed.width, angle: radians(placed.angle) });
  }

  /** What the case names has been moved. */
  private moved(): void {
    this.render();
    if (this.isKept) this.keep();
  }

  private render(): void {
    const { placed, toShare } = this;
    this.picture.hidden = !placed;
    if (!placed || !toShare) return;
    const [left] = toShare([placed.middle[0] - placed.width / 2, placed.middle[1]]);
    const [right] = toShare([placed.middle[0] + placed.width / 2, placed.middle[1]]);
    const [x, y] = toShare(placed.middle);
    this.picture.style.left = `${x * 100}%`;
    this.picture.style.top = `${y * 100}%`;
    this.picture.style.width = `${(right - left) * 100}%`;
    this.picture.style.transform = `translate(-50%, -50%) rotate(${-placed.angle}deg)`;
    this.layer.replaceChildren(
      ...this.marks.map((at) => {
        const [cx, cy] = toShare(at);
        return s("path", { d: `M${cx * 100 - 1.2} ${cy * 100}h2.4M${cx * 100} ${cy * 100 - 1.5}v3`, class: "mark" });
      }),
    );
  }

  private showTools(): void {
    const add = h("button", { type: "button", class: "quiet", onclick: () => this.input.click() }, this.placed ? words.change : words.add);
    if (!this.placed) {
      this.tools.replaceChildren(add, this.input, this.status);
      return;
    }
    const toggle = (mode: "move" | "scale", label: string) =>
      h("button", { type: "button", class: "quiet", "aria-pressed": String(this.mode === mode), onclick: () => this.enter(this.mode === mode ? "off" : mode) }, label);
    this.turn.value = String(this.placed.angle);
    const strength = h("input", { type: "range", min: "5", max: "100", value: Math.round(Number(this.picture.style.opacity || 0.55) * 100), "aria-label": words.strength });
    strength.addEventListener("input", () => (this.picture.style.opacity = String(strength.valueAsNumber / 100)));
    const remove = () => {
      if (this.isKept) this.keepPlan(null);
      this.placed = null;
      this.file = null;
      this.enter("off");
    };
    const scale = this.mode === "scale" && this.marks.length === 2
      ? h("span", { class: "scale" }, h("label", {}, words.distance, " ", this.distance),
        h("button", { type: "button", onclick: () => this.setScale() }, words.set))
      : null;
    this.tools.replaceChildren(
      add, this.input, toggle("scale", words.scale), toggle("move", words.move),
      h("label", {}, words.turnShort, " ", this.turn, "°"), h("label", {}, words.strengthShort, " ", strength),
      ...(this.isKept ? [] : [h("button", { type: "button", class: "quiet", onclick: () => this.nameIt() }, words.keep)]),
      h("button", { type: "button", class: "quiet", onclick: remove }, words.remove),
      ...(scale ? [scale] : []), this.status,
    );
  }

  private nameIt(): void {
    this.keep();
    // What the case cannot name is said elsewhere.
    if (this.isKept) this.status.textContent = words.kept;
  }

  private enter(mode: "off" | "move" | "scale"): void {
    this.mode = mode;
    this.marks = [];
    this.stage.classList.toggle("placing", mode !== "off");
    this.status.textContent = mode === "scale" ? words.scaleHint : mode === "move" ? words.moveHint : "";
    this.render();
    this.showTools();
  }

  private at(event: PointerEvent): Point | null {
    const view = this.viewport();
    const { toShare } = this;
    if (!view || !toShare) return null;
    const box = this.stage.getBoundingClientRect();
    const share: Point = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    const origin = toShare([0, 0]);
    const one = toShare([1, 1]);
    return [(share[0] - origin[0]) / (one[0] - origin[0]), (share[1] - origin[1]) / (one[1] - origin[1])];
  }

  private pressed(event: PointerEvent): void {
    if (this.mode === "off" || !this.placed) return;
    const at = this.at(event);
    if (!at) return;
    event.preventDefault();
    event.stopPropagation();
    if (this.mode === "scale") {
      this.marks = this.marks.length >= 2 ? [at] : [...this.marks, at];
      this.render();
      this.showTools();
      if (this.marks.length === 2) this.distance.focus();
      return;
    }
    const begun = this.placed.middle;
    const follows = (next: PointerEvent) => {
      const to = this.at(next);
      if (!to || !this.placed) return;
      this.placed.middle = [begun[0] + to[0] - at[0], begun[1] + to[1] - at[1]];
      this.render();
    };
    const ended = () => {
      this.stage.removeEventListener("pointermove", follows);
      window.removeEventListener("pointerup", ended);
      this.moved();
    };
    this.stage.addEventListener("pointermove", follows);
    window.addEventListener("pointerup", ended);
  }

  /** The two marks are as far apart as was said; the first stays where it is. */
  private setScale(): void {
    const [first, second] = this.marks;
    const metres = Number.parseFloat(engine.convert(this.distance.value, "m") ?? "");
    if (!this.placed || !first || !second || !(metres > 0)) {
      this.status.textContent = words.noDistance;
      return;
    }
    const factor = metres / Math.hypot(second[0] - first[0], second[1] - first[1]);
    const { middle } = this.placed;
    this.placed.width *= factor;
    this.placed.middle = [first[0] + factor * (middle[0] - first[0]), first[1] + factor * (middle[1] - first[1])];
    this.enter("off");
    this.moved();
    this.status.textContent = words.scaled;
  }
}
