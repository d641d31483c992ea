// Small helpers to build a page.

export type Child = Node | string | number | false | null | undefined | Child[];

type Value = string | number | boolean | null | undefined | ((event: never) => void);

/**
 * An element: `on…` attributes are listeners, `true` is an attribute without value, and nothing comes of
 * `false`, `null` and `undefined`. Children that are texts stay texts.
 */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, Value> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  set(element, attributes);
  append(element, children);
  return element;
}

/** The same for a part of a drawing. */
export function s<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, Value> = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  set(element, attributes);
  append(element, children);
  return element;
}

function set(element: Element, attributes: Record<string, Value>): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === null || value === undefined) continue;
    if (typeof value === "function") element.addEventListener(name.slice(2), value as EventListener);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
}

function append(element: Element, children: Child[]): void {
  for (const child of children) {
    if (Array.isArray(child)) append(element, child);
    else if (child instanceof Node) element.append(child);
    else if (typeof child === "string" || typeof child === "number") element.append(String(child));
  }
}

/** Markup that the engine wrote, in which it escaped what others wrote. */
export function markup(element: Element, html: string): void {
  element.innerHTML = html;
}

/** Shows a dialog over the page, until it is closed or something beside it is pressed. */
export function showDialog(dialog: HTMLDialogElement): void {
  dialog.addEventListener("close", () => dialog.remove());
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  document.body.append(dialog);
  dialog.showModal();
}

let ids = 0;

/** An identifier that no other element has. */
export function unique(prefix: string): string {
  ids += 1;
  return `${prefix}-${ids}`;
}

/** Saves a file where the browser saves downloads. */
export function download(name: string, content: BlobPart, type: string): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = h("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/** Runs a function at most once for each picture that the screen shows, with the newest argument. */
export function eachFrame<T>(run: (argument: T) => void): ((argument: T) => void) & { flush(): void } {
  let waiting: { argument: T } | null = null;
  let frame = 0;
  const flush = () => {
    cancelAnimationFrame(frame);
    frame = 0;
    const now = waiting;
    waiting = null;
    if (now) run(now.argument);
  };
  const ask = (argument: T) => {
    waiting = { argument };
    frame ||= requestAnimationFrame(flush);
  };
  return Object.assign(ask, { flush });
}

/** Calls a function once nothing has asked for it for a while. */
export function afterPause(milliseconds: number, run: () => void): { ask(): void; cancel(): void } {
  let timer = 0;
  const cancel = () => clearTimeout(timer);
  return {
    cancel,
    ask: () => {
      cancel();
      timer = window.setTimeout(run, milliseconds);
    },
  };
}
