// A report that can be asked: this page with a case and its printed report in it.
import { h } from "./dom.js";
import * as engine from "./engine.js";
import { texts } from "./texts/en.js";

const words = texts.live;

export interface Live {
  name: string;
  text: string;
  report_base64: string;
  report_sha256: string;
  engine_sha256: string;
}

const SLOT = /(<script type="application\/json" id="deltav-live">)[^<]*(<\/script>)/;

/** The page as it was loaded, before anything was added to it. */
const page = document.documentElement.outerHTML;

/** The case and report that the page was handed over with. */
export function handedOver(): Live | null {
  return JSON.parse(document.getElementById("deltav-live")?.textContent ?? "null") as Live | null;
}

/** This page with an empty slot, as the file `deltav.html` has it. */
export const emptyPage = (): string => `<!DOCTYPE html>\n${page.replace(SLOT, "$1null$2")}`;

const reportOf = (live: Live): Uint8Array<ArrayBuffer> => engine.bytesOf(live.report_base64);

/** The SHA-256 of the case, as its report prints it; not every report does. */
const caseHash = (live: Live): string | undefined => /SHA-256 of the case file(?:<[^>]*>|\s)*([0-9a-f]{64})/.exec(new TextDecoder().decode(reportOf(live)))?.[1];

/** Whether the case in the page is the one of its report, as far as that says it. */
export async function isOfReport(live: Live): Promise<boolean> {
  const hash = caseHash(live);
  return hash === undefined || hash === (await engine.sha256(new TextEncoder().encode(live.text)));
}

/** The report as it was printed, and whether the hashes hold. */
export function printed(live: Live): HTMLElement {
  const bytes = reportOf(live);
  const ofCase = caseHash(live);
  const frame = h("iframe", {
    class: "printed-report",
    title: words.printed,
    // Nothing in it runs, and nothing of it reaches the page.
    sandbox: "",
    srcdoc: new TextDecoder().decode(bytes),
  });
  const verdict = (label: string, hash: string, holds: Promise<boolean>) => {
    const state = h("span", { class: "verdict" }, words.checking);
    void holds.then((does) => {
      state.textContent = does ? words.holds : words.fails;
      state.classList.add(does ? "good" : "bad");
    });
    return [h("dt", {}, label), h("dd", {}, h("code", { class: "digest" }, hash), " ", state)];
  };
  return h("section", { class: "printed", id: "printed", "aria-label": words.printed },
    h("h2", {}, words.printed),
    h("p", { class: "note" }, words.explain),
    h("dl", { class: "hashes" },
      ...verdict(words.report, live.report_sha256, engine.sha256(bytes).then((hash) => hash === live.report_sha256)),
      ...verdict(words.engine, live.engine_sha256, engine.engineHash().then((hash) => hash === live.engine_sha256)),
      ...(ofCase === undefined ? [] : verdict(words.case, ofCase, isOfReport(live)))),
    frame);
}
