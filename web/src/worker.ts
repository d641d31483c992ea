// What takes long, away from the page: samples and estimates. The page ends it by ending the worker.
import { Run, initSync } from "../pkg/deltav_web.js";
import { type Report, reason } from "./engine.js";
import type { FileKind, FromWorker, ToWorker, With } from "./runs.js";

/** How many samples are told before the rest, where there are more. */
const FIRST = 100_000;

const say = (message: FromWorker): void => self.postMessage(message);

let ran: Run | null = null;

/** A file of a run; throws why there is none. */
function file(run: Run, kind: FileKind, { plan, page }: With): string {
  if (kind !== "html") return { json: () => run.json(), csv: () => run.samples(), txt: () => run.text() }[kind]();
  const made = JSON.parse(page === undefined ? run.html(plan) : run.live(page, plan)) as Report;
  if (!made.ok) throw new Error(reason(made));
  return made.html;
}

/** Says an answer of a run, and then its pictures. */
function tell(run: Run, answer: string, begun: number, isLast: boolean): void {
  say({ kind: "answer", answer, milliseconds: performance.now() - begun, isLast });
  say({ kind: "pictures", pictures: run.pictures(), isLast });
}

self.addEventListener("message", ({ data }: MessageEvent<ToWorker>) => {
  const begun = performance.now();
  if ("file" in data) {
    try {
      say({ kind: "file", content: ran ? file(ran, data.file, data.besides) : "", refused: "" });
    } catch (error) {
      say({ kind: "file", content: "", refused: error instanceof Error ? error.message : String(error) });
    }
    return;
  }
  if ("moved" in data) {
    const answer = ran?.moved(JSON.stringify(data.moved), data.sampled);
    if (answer !== undefined) say({ kind: "moved", answer, to: data.moved, milliseconds: performance.now() - begun });
    return;
  }
  if ("units" in data) {
    if (ran) tell(ran, ran.in_units(data.units), begun, true);
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
    const first = samples > FIRST ? [{ ...job.options, samples: FIRST, indices: undefined }] : [];
    for (const options of [...first, job.options]) {
      const asked = performance.now();
      const answer = run.ask(job.kind, job.text, job.name, job.units, JSON.stringify(options), progress);
      tell(run, answer, asked, options === job.options);
    }
  } catch (error) {
    say({ kind: "failed", message: String(error) });
  }
});
