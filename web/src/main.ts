import "./style.css";

import { App } from "./app.js";
import * as engine from "./engine.js";
// It takes the page as it was loaded, so it is here before anything is added.
import "./live.js";
import { texts } from "./texts/en.js";

try {
  await engine.start();
  new App(document.body);
  document.body.classList.add("ready");
  performance.mark("deltav-ready");
} catch (error) {
  const words = document.createElement("p");
  words.setAttribute("role", "alert");
  words.textContent = `${texts.broken} ${String(error)}`;
  document.body.prepend(words);
}
