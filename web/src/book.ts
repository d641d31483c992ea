// Links into the book, where the page lies in its folder: the release puts a copy there that is marked. A page that lies elsewhere has
// none, for it could not tell whether they lead anywhere.
import chapters from "./chapters.json";
import { h } from "./dom.js";
import { texts } from "./texts/en.js";

const mark = document.querySelector('meta[name="deltav-book"]');
// A report that can be asked is a copy of this page, and lies elsewhere.
mark?.remove();

/** A link to a place of the book that explains something; nothing without the book. */
function link(to: string | undefined, of: string, words = texts.book.more): HTMLElement | null {
  // In a tab of its own: the case stays open here.
  return mark && to !== undefined ? h("a", { class: "book", href: to, target: "_blank", rel: "noopener", "aria-label": texts.book.of(words, of) }, words) : null;
}

/** The chapter of the innermost table or field around a key that has one. */
function chapterOf(key: string): string {
  const places = chapters.keys as Record<string, string>;
  const parts = key.replace(/^vehicle[12]\b/, "vehicle").replaceAll(/\[\d*\]/g, "").split(".");
  for (; parts.length > 0; parts.pop()) {
    const chapter = places[parts.join(".")];
    if (chapter !== undefined) return chapter;
  }
  return places[""] ?? chapters.start;
}

export const book = {
  start: () => link(chapters.start, texts.about.open, texts.book.start),
  choose: () => link(chapters.choose, texts.templates.title, texts.book.choose),
  view: (name: string) => link((chapters.views as Record<string, string>)[name], texts.viewTabs[name] ?? name),
  method: (command: string) => link((chapters.methods as Record<string, string>)[command], texts.questions[command] ?? command, texts.book.method),
  key: (key: string, name: string) => link(chapterOf(key), name),
};
