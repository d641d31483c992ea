// Runs in a worker: one at a time for each `Runner`, and each can be ended.
import * as engine from "./engine.js";
import type { Chart, Moved, Problem, Slider, Units } from "./engine.js";
import { texts } from "./texts/en.js";
import Work from "./worker.js?worker&inline";

export interface Job {
  kind: "uncertainty" | "estimate" | "reconstruct" | "avoid";
  text: string;
  name: string;
  units: Units;
  options: { samples?: number; seed?: number; method?: string; indices?: number; particles?: number; prior?: string; above?: string[] };
}

/** The files that a run can be saved as; of its samples or draws `csv`. */
export type FileKind = "html" | "json" | "csv" | "txt";

/** What a file is made with besides: the picture that the case names, and the page that a report is put into. */
export interface With {
  plan?: Uint8Array | undefined;
  page?: string | undefined;
}

/** Where the sliders of an avoidability are, and whether a probability is wanted. */
export interface Move {
  moved: Record<string, number>;
  sampled: boolean;
}

export type ToWorker = { module: WebAssembly.Module; job: Job } | { file: FileKind; besides: With } | { units: Units } | Move;

/** The answer of a run comes before its pictures, which take a while to make. */
export type FromWorker =
  | { kind: "progress"; counted: string; done: number; total: number }
  | { kind: "answer"; answer: string; milliseconds: number; isLast: boolean }
  | { kind: "pictures"; pictures: string; isLast: boolean }
  | { kind: "file"; content: string; refused: string }
  | { kind: "moved"; answer: string; to: Move["moved"]; milliseconds: number }
  | { kind: "failed"; message: string };

export interface Finished {
  ok: true;
  headline: string[];
  html: string;
  /** Of an avoidability. */
  charts?: Chart[];
  sliders?: Slider[];
}

export interface Picture {
  name: string;
  output: string;
  title: string;
  svg: string;
}

export interface Unfinished {
  ok: false;
  message: string;
  problems?: Problem[];
}

/** Is told what a run says, as it says it. */
export interface Listener {
  progress?(counted: string, done: number, total: number): void;
  /** Of many samples some are told first; the last answer is that of all. */
  answer(answer: Finished | Unfinished, milliseconds: number, isLast: boolean): void;
  pictures?(pictures: Picture[]): void;
  /** The engine took these milliseconds. */
  moved?(answer: Moved, to: Move["moved"], milliseconds: number): void;
  /** Somebody has ended the run before it was done. */
  ended?(): void;
}

export class Runner {
  private worker: Worker | null = null;
  private works = false;
  /** A move is being answered; the newest that came since. */
  private moving = false;
  private next: Move | null = null;
  private ended: (() => void) | null = null;
  private waiting: { done: (content: string) => void; failed: (error: Error) => void } | null = null;

  get busy(): boolean {
    return this.works;
  }

  /** Ends what runs, and forgets what has run; nothing is heard of it again. */
  end(): void {
    this.worker?.terminate();
    this.worker = null;
    this.works = false;
    this.moving = false;
    this.next = null;
    this.waiting?.failed(new Error(texts.save.ended));
    this.waiting = null;
    this.ended?.();
    this.ended = null;
  }

  /** A file of what has run; nothing where that was ended. It fails with why there is none. */
  file(kind: FileKind, besides: With = {}): Promise<string> | null {
    const { worker } = this;
    if (!worker || this.works || this.waiting) return null;
    return new Promise((done, failed) => {
      this.waiting = { done, failed };
      worker.postMessage({ file: kind, besides } satisfies ToWorker);
    });
  }

  /** Something has run to its end, and can be told in other units. */
  get hasRun(): boolean {
    return this.worker !== null && !this.works;
  }

  /** Tells what has run once more, in other units: its answer and its pictures. */
  tellIn(units: Units): void {
    this.works = true;
    this.worker?.postMessage({ units } satisfies ToWorker);
  }

  /** Moves the sliders of what has run: each is answered as it comes, or the newest once the one before is. */
  move(move: Move): void {
    if (!this.worker || this.works) return;
    if (this.moving) this.next = move;
    else {
      this.moving = true;
      this.worker.postMessage(move satisfies ToWorker);
    }
  }

  start(job: Job, listener: Listener): void {
    this.end();
    const worker = new Work();
    this.worker = worker;
    this.works = true;
    this.ended = () => listener.ended?.();
    const failed = (message: string) => {
      this.ended = null;
      this.end();
      listener.answer({ ok: false, message }, 0, true);
    };
    worker.addEventListener("message", ({ data }: MessageEvent<FromWorker>) => {
      if (this.worker !== worker) return;
      if (data.kind === "progress") listener.progress?.(data.counted, data.done, data.total);
      else if (data.kind === "failed") failed(data.message);
      else if (data.kind === "answer") listener.answer(JSON.parse(data.answer) as Finished | Unfinished, data.milliseconds, data.isLast);
      else if (data.kind === "file") {
        if (data.refused === "") this.waiting?.done(data.content);
        else this.waiting?.failed(new Error(data.refused));
        this.waiting = null;
      } else if (data.kind === "moved") {
        const { next } = this;
        this.moving = false;
        this.next = null;
        if (next) this.move(next);
        listener.moved?.(JSON.parse(data.answer) as Moved, data.to, data.milliseconds);
      } else {
        if (data.isLast) this.works = false;
        listener.pictures?.(JSON.parse(data.pictures) as Picture[]);
      }
    });
    worker.addEventListener("error", (event) => this.worker === worker && failed(event.message));
    worker.postMessage({ module: engine.module(), job } satisfies ToWorker);
  }
}
