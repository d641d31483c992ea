import "./style.css";

// It takes its mark out of the page before `live.js` copies that.
import "./book.js";
import { App } from "./app.js";
import * as engine from "./engine.js";
// It takes the page as it was loaded, so it is here before anything is added.
import "./live.js";
import { texts } from "./texts/en.js";

/** The next picture is on the screen. */
const painted = (): Promise<void> => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));

try {
  const started = engine.start();
  const app = new App(document.body);
  await started;
  app.begin();
  performance.mark("deltav-answer");
  await painted();
  app.showRest();
  document.body.classList.add("ready");
  performance.mark("deltav-ready");
} catch (error) {
  const words = document.createElement("p");
  words.setAttribute("role", "alert");
  words.textContent = `${texts.broken} ${String(error)}`;
  document.body.prepend(words);
}
