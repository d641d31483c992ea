// What the engine says of the text as it is now. What is seen at once is there; the rest is asked for when somebody
// looks at it.
import * as engine from "./engine.js";
import { essence } from "./essence.js";
import type { Picture } from "./runs.js";
import type { Answer, Check, Command, ExactSolution, Look, NoAnswer, Problem, Refused, Units } from "./engine.js";

export class Solved {
  private checked: Check | undefined;
  private answered: Answer | NoAnswer | undefined;
  private bare: string | undefined;
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

  /** The exact solution of a case that has more evidence than this uses; nothing where it is the answer. */
  get exact(): ExactSolution | null {
    return this.look.ok ? this.look.exact : null;
  }

  /** All the evidence, weighed, is the answer. */
  get weighs(): boolean {
    return this.exact !== null;
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
}
