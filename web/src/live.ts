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

/** The page as it was loaded, before anything was added to it. */
const page = document.documentElement.outerHTML;

const SLOT = /(<script type="application\/json" id="deltav-live">)[^<]*(<\/script>)/;

/** The case and report that the page was handed over with. */
export function handedOver(): Live | null {
  return JSON.parse(document.getElementById("deltav-live")?.textContent ?? "null") as Live | null;
}

const bytesOf = (base64: string): Uint8Array<ArrayBuffer> =>
  Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));

function base64Of(bytes: Uint8Array): string {
  let characters = "";
  for (const byte of bytes) characters += String.fromCharCode(byte);
  return btoa(characters);
}

/** This page with a case and its report in it. */
export async function makeLive(name: string, text: string, report: string): Promise<string> {
  const bytes = new TextEncoder().encode(report);
  const live: Live = {
    name,
    text,
    report_base64: base64Of(bytes),
    report_sha256: await engine.sha256(bytes),
    engine_sha256: await engine.engineHash(),
  };
  // What could end the element is written as an escape of JSON.
  const json = JSON.stringify(live).replaceAll("<", "\\u003c");
  return `<!DOCTYPE html>\n${page.replace(SLOT, (_, open: string, close: string) => open + json + close)}`;
}

/** The report as it was printed, and whether both hashes hold. */
export function printed(live: Live): HTMLElement {
  const bytes = bytesOf(live.report_base64);
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
  return h("section", { class: "printed", "aria-label": words.printed },
    h("h2", {}, words.printed),
    h("p", { class: "note" }, words.explain),
    h("dl", { class: "hashes" },
      ...verdict(words.report, live.report_sha256, engine.sha256(bytes).then((hash) => hash === live.report_sha256)),
      ...verdict(words.engine, live.engine_sha256, engine.engineHash().then((hash) => hash === live.engine_sha256))),
    frame);
}
