// What the engine says of the text as it is now. What is seen at once is there; the rest is asked for when somebody
// looks at it.
import * as engine from "./engine.js";
import { essence } from "./essence.js";
import type { Picture } from "./runs.js";
import type { Answer, Check, Command, Look, NoAnswer, Problem, Refused, Units, Warning } from "./engine.js";

/** An exact solution that is not the answer of its case. */
export interface Aside {
  /** By which part of the evidence. */
  by: string;
  /** Its speeds and their changes, each with the heading of its column. */
  figures: [string, string][];
  /** What speaks against it, as its warnings are worded. */
  against: string;
}

/** Letters and digits alone: the engine sets the same sentence in tables with other signs. */
const plain = (words: string): string => words.replaceAll(/[^\p{L}\p{N}]/gu, "");

export class Solved {
  private checked: Check | undefined;
  private answered: Answer | NoAnswer | undefined;
  private bare: string | undefined;
  private solution: Aside | undefined;
  /** What came of weighing all the evidence, once that is done; without drawings where these have another title. */
  weighed: { html: string; plain: Picture[] | null } | null = null;

  constructor(
    readonly text: string,
    /** Of the file. */
    readonly name: string,
    readonly units: Units,
    readonly look: Look | Refused,
  ) {}

  get command(): Command {
    return this.look.command ?? "reconstruct";
  }

  get problems(): Problem[] {
    return this.look.ok ? [] : this.look.problems;
  }

  /** The case has more evidence than its exact solution uses: all of it, weighed, is the answer. */
  get weighs(): boolean {
    return this.look.ok && this.look.weigh && this.look.command === "reconstruct";
  }

  /** What of the text the answer depends on. */
  get essence(): string {
    return (this.bare ??= essence(this.text));
  }

  /** What the file says, key by key. */
  get check(): Check {
    return (this.checked ??= engine.check(this.text));
  }

  /** The whole answer; nothing where the text is no case. */
  get answer(): Answer | NoAnswer | null {
    if (this.look.command === undefined) return null;
    return (this.answered ??= engine.answer(this.text, this.command, this.units, this.name));
  }

  /** The exact solution of a case whose evidence is weighed. */
  get aside(): Aside {
    if (this.solution) return this.solution;
    const { answer } = this;
    const page = new DOMParser().parseFromString(answer?.ok ? answer.html : "", "text/html");
    const table = [...page.querySelectorAll("table")].find((one) => one.caption?.textContent === "Exact solution");
    const columns = [...(table?.tHead?.rows[0]?.cells ?? [])].map((cell) => cell.textContent);
    const cells = [...(table?.tBodies[0]?.rows[0]?.cells ?? [])].map((cell) => cell.textContent);
    const heading = [...page.querySelectorAll("h2")].find((one) => one.textContent === "Objections to the exact solution");
    const figures = columns.map((column, place): [string, string] => [column, cells[place] ?? ""]).slice(1);
    this.solution = {
      by: cells[0] ?? "",
      figures: figures.filter(([, figure]) => /\d/.test(figure)),
      against: plain(heading?.nextElementSibling?.textContent ?? ""),
    };
    return this.solution;
  }

  /** The warning speaks against the exact solution alone, which is not the answer. */
  isAside({ code, message }: Warning): boolean {
    return this.weighs && this.aside.against.includes(plain(`${code}${message}`));
  }

  /** That the exact solution is not the answer, and why; nothing where it is the answer. */
  get caveat(): string | null {
    if (!this.weighs) return null;
    for (const what of ["momentum", "energy", "scene"]) {
      const drawn = engine.draw(this.text, what, this.units);
      const words = drawn.ok ? /Exact solution by .*, not the answer: .*$/.exec(drawn.description)?.[0] : undefined;
      if (words !== undefined) return words;
    }
    return null;
  }
}
