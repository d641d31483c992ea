// Runs in a worker: one at a time for each `Runner`, and each can be ended.
import * as engine from "./engine.js";
import type { Problem, Units } from "./engine.js";
import Work from "./worker.js?worker&inline";

export interface Job {
  kind: "uncertainty" | "estimate";
  text: string;
  name: string;
  units: Units;
  options: { samples?: number; seed?: number };
}

export interface ToWorker {
  module: WebAssembly.Module;
  job: Job;
}

export type FromWorker =
  | { kind: "progress"; counted: string; done: number; total: number }
  | { kind: "first" | "result"; result: string; milliseconds: number }
  | { kind: "failed"; message: string };

export interface Finished {
  ok: true;
  headline: string[];
  html: string;
  json: string;
  pictures: { name: string; output: string; title: string; svg: string }[];
}

export interface Unfinished {
  ok: false;
  message: string;
  problems?: Problem[];
}

export interface Outcome {
  finished: Finished | Unfinished;
  milliseconds: number;
}

export class Runner {
  private worker: Worker | null = null;

  get busy(): boolean {
    return this.worker !== null;
  }

  /** Ends what runs; nothing is heard of it again. */
  end(): void {
    this.worker?.terminate();
    this.worker = null;
  }

  start(
    job: Job,
    progress: (counted: string, done: number, total: number) => void,
    done: (outcome: Outcome) => void,
    first?: (result: Finished | Unfinished) => void,
  ): void {
    this.end();
    const worker = new Work();
    this.worker = worker;
    const finish = (outcome: Outcome) => {
      if (this.worker !== worker) return;
      this.end();
      done(outcome);
    };
    worker.addEventListener("message", ({ data }: MessageEvent<FromWorker>) => {
      if (this.worker !== worker) return;
      if (data.kind === "progress") progress(data.counted, data.done, data.total);
      else if (data.kind === "failed") finish({ finished: { ok: false, message: data.message }, milliseconds: 0 });
      else if (data.kind === "first") first?.(JSON.parse(data.result) as Finished | Unfinished);
      else {
        finish({ finished: JSON.parse(data.result) as Finished | Unfinished, milliseconds: data.milliseconds });
      }
    });
    worker.addEventListener("error", (event) => finish({ finished: { ok: false, message: event.message }, milliseconds: 0 }));
    worker.postMessage({ module: engine.module(), job } satisfies ToWorker);
  }
}
