// What takes long, away from the page: samples and estimates. The page ends it by ending the worker.
import { initSync, run } from "../pkg/deltav_web.js";
import type { FromWorker, ToWorker } from "./runs.js";

const say = (message: FromWorker): void => self.postMessage(message);

self.addEventListener("message", (event: MessageEvent<ToWorker>) => {
  const { module, job } = event.data;
  initSync({ module });
  let last = 0;
  const progress = (done: number, total: number, stage: string): boolean => {
    const now = performance.now();
    if (now - last > 50) {
      last = now;
      say({ kind: "progress", done, total, stage });
    }
    return true;
  };
  try {
    const begun = performance.now();
    const result = run(JSON.stringify(job), progress);
    say({ kind: "result", result, milliseconds: performance.now() - begun });
  } catch (error) {
    say({ kind: "failed", message: String(error) });
  }
});
