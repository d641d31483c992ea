// What takes long, away from the page: samples and estimates. The page ends it by ending the worker.
import { Run, initSync } from "../pkg/deltav_web.js";
import type { FromWorker, ToWorker } from "./runs.js";

/** How many samples are told before the rest, where there are more. */
const FIRST = 100_000;

const say = (message: FromWorker): void => self.postMessage(message);

let ran: Run | null = null;

self.addEventListener("message", ({ data }: MessageEvent<ToWorker>) => {
  if ("file" in data) {
    const content = ran ? { html: () => ran?.html(), json: () => ran?.json(), csv: () => ran?.samples(), txt: () => ran?.text() }[data.file]() : "";
    say({ kind: "file", content: content ?? "" });
    return;
  }
  const { module, job } = data;
  initSync({ module });
  let last = 0;
  const progress = (counted: string, done: number, total: number): boolean => {
    const now = performance.now();
    if (now - last > 50) {
      last = now;
      say({ kind: "progress", counted, done, total });
    }
    return true;
  };
  try {
    const run = new Run();
    ran = run;
    // Of many samples some are told first: who ends the run has these.
    const { samples = 0 } = job.options;
    const first = samples > FIRST ? [{ ...job.options, samples: FIRST }] : [];
    for (const options of [...first, job.options]) {
      const begun = performance.now();
      const given = [job.text, job.name, job.units, JSON.stringify(options), progress] as const;
      const answer = job.kind === "uncertainty" ? run.uncertainty(...given) : run.estimate(...given);
      const isLast = options === job.options;
      say({ kind: "answer", answer, milliseconds: performance.now() - begun, isLast });
      say({ kind: "pictures", pictures: run.pictures(), isLast });
    }
  } catch (error) {
    say({ kind: "failed", message: String(error) });
  }
});
