// The text of the case: its editor, which holds the one history of all changes, from the text, the form and the
// mouse alike.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyField, historyKeymap, isolateHistory, redo, redoDepth, undo, undoDepth } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, bracketMatching, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { type Diagnostic, diagnosticCount, lintGutter, setDiagnostics } from "@codemirror/lint";
import { Compartment, EditorState, Transaction } from "@codemirror/state";
import {
  EditorView,
  drawSelection,
  highlightActiveLine,
  highlightSpecialChars,
  hoverTooltip,
  keymap,
  lineNumbers,
} from "@codemirror/view";
import { tags } from "@lezer/highlight";

import { completions, keyAt } from "./completion.js";
import { h } from "./dom.js";
import type { Problem } from "./engine.js";
import { meaningOf } from "./keys.js";
import { texts } from "./texts/en.js";

const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--text-quiet)" },
  { tag: tags.string, color: "var(--code-string)" },
  { tag: [tags.number, tags.bool, tags.atom], color: "var(--code-number)" },
  { tag: [tags.propertyName, tags.definition(tags.propertyName)], color: "var(--code-key)" },
  { tag: [tags.heading, tags.bracket], color: "var(--code-table)" },
]);

const help = hoverTooltip((view, position) => {
  const key = keyAt(view.state, position);
  const words = key && meaningOf(key);
  if (!key || !words) return null;
  const line = view.state.doc.lineAt(position);
  const create = () => ({ dom: h("div", { class: "hover-help" }, words) });
  return { pos: line.from + (line.text.length - line.text.trimStart().length), above: true, create };
});

export class Editor {
  readonly view: EditorView;
  /** As it was when a drag began, with its history. */
  private before: EditorState | null = null;
  private readonly locked = new Compartment();

  constructor(
    parent: Element,
    private readonly changed: () => void,
  ) {
    this.view = new EditorView({ parent, state: this.fresh("") });
  }

  /** The text with the history of another state, or without any. */
  private fresh(text: string, from?: EditorState): EditorState {
    return EditorState.create({
      doc: text,
      ...(from ? { selection: from.selection } : {}),
      extensions: [
        from ? historyField.init(() => from.field(historyField)) : [],
        lineNumbers(),
        highlightSpecialChars(),
        // A handle that is moved by an arrow key makes a step each time.
        history({ minDepth: 1000 }),
        this.locked.of([]),
        drawSelection(),
        EditorState.allowMultipleSelections.of(true),
        bracketMatching(),
        closeBrackets(),
        autocompletion({ override: [completions], icons: false }),
        highlightActiveLine(),
        StreamLanguage.define(toml),
        syntaxHighlighting(colours),
        lintGutter(),
        help,
        // Tab moves on to the next element of the page, as everywhere else.
        keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...historyKeymap, ...completionKeymap]),
        EditorView.contentAttributes.of({ "aria-label": texts.editor.label, spellcheck: "false", tabindex: "0" }),
        EditorView.updateListener.of((update) => {
          if (update.docChanged) this.changed();
        }),
      ],
    });
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  /** Another file: nothing of the one before can be undone into it. */
  open(text: string): void {
    this.before = null;
    this.view.setState(this.fresh(text));
    this.changed();
  }

  /** A change by the form: one step of the history where it follows closely on one at the same place. */
  write(text: string): void {
    this.dispatch(text, true);
  }

  /** A change that is a step of the history by itself. */
  step(text: string): void {
    this.dispatch(text, true, true);
  }

  /**
   * What a drag has made of the text so far. It becomes a step of the history when the drag ends: until then
   * nobody else changes the text.
   */
  preview(text: string): void {
    if (this.before === null) {
      this.before = this.view.state;
      this.view.dispatch({ effects: this.locked.reconfigure(EditorState.readOnly.of(true)) });
    }
    this.dispatch(text, false);
  }

  /**
   * Ends a drag: all of it is one step of the history. The history goes on from where the drag began: changes that
   * it does not know would move the places of its own steps, until they are written where they do not belong.
   */
  settle(keep: boolean): void {
    if (this.before === null) return;
    const after = this.text;
    const { scrollTop, scrollLeft } = this.view.scrollDOM;
    this.view.setState(this.fresh(this.before.doc.toString(), this.before));
    this.view.scrollDOM.scrollTo(scrollLeft, scrollTop);
    this.before = null;
    if (keep) this.step(after);
    this.changed();
  }

  /** A change without the name of an event: one that is named as no typing would always be a step by itself. */
  private dispatch(text: string, inHistory: boolean, alone = false): void {
    const change = difference(this.text, text);
    if (!change) return;
    const annotations = [Transaction.addToHistory.of(inHistory), ...(alone ? [isolateHistory.of("full")] : [])];
    this.view.dispatch({ changes: change, annotations });
  }

  undo(): void {
    undo(this.view);
  }

  redo(): void {
    redo(this.view);
  }

  get can(): { undo: boolean; redo: boolean } {
    return { undo: undoDepth(this.view.state) > 0, redo: redoDepth(this.view.state) > 0 };
  }

  /** Marks the places of problems. */
  mark(problems: Problem[]): void {
    if (problems.length === 0 && diagnosticCount(this.view.state) === 0) return;
    const length = this.view.state.doc.length;
    const diagnostics = problems.map((problem): Diagnostic => {
      const from = Math.min(problem.from, length);
      const message = [problem.title, problem.help].filter(Boolean).join("\n");
      return { from, to: Math.min(Math.max(problem.to, from), length), severity: "error", message };
    });
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
  }

  /** Puts the cursor on a place and shows it. */
  select(from: number, to: number): void {
    const length = this.view.state.doc.length;
    const selection = { anchor: Math.min(from, length), head: Math.min(to, length) };
    this.view.dispatch({ selection, effects: EditorView.scrollIntoView(selection.anchor, { y: "center" }) });
    this.view.focus();
  }
}

/** The one change that makes the second text of the first, as small as can be. */
function difference(before: string, after: string): { from: number; to: number; insert: string } | null {
  if (before === after) return null;
  const shorter = Math.min(before.length, after.length);
  let from = 0;
  while (from < shorter && before[from] === after[from]) from += 1;
  let behind = 0;
  while (behind < shorter - from && before[before.length - 1 - behind] === after[after.length - 1 - behind]) behind += 1;
  return { from, to: before.length - behind, insert: after.slice(from, after.length - behind) };
}
