// Tabs, as the authoring practices for ARIA describe them: one tab stop, arrow keys between tabs.
import { h, unique } from "./dom.js";

export interface Tab {
  name: string;
  title: string;
  panel: HTMLElement;
  /** Called each time the tab is shown. */
  shown?: () => void;
}

export class Tabs {
  readonly list: HTMLElement;
  readonly panels: HTMLElement;
  private readonly buttons = new Map<string, HTMLButtonElement>();
  private now = "";

  constructor(
    label: string,
    private readonly tabs: Tab[],
  ) {
    this.list = h("div", { class: "tabs", role: "tablist", "aria-label": label });
    this.panels = h("div", { class: "panels" });
    for (const tab of tabs) {
      const id = unique("tab");
      const button = h("button", {
        type: "button",
        role: "tab",
        id,
        "aria-controls": `${id}-panel`,
        "data-tab": tab.name,
        onclick: () => this.show(tab.name),
      }, tab.title);
      button.addEventListener("keydown", (event) => this.key(event, tab.name));
      tab.panel.id = `${id}-panel`;
      tab.panel.setAttribute("role", "tabpanel");
      tab.panel.setAttribute("aria-labelledby", id);
      tab.panel.hidden = true;
      this.buttons.set(tab.name, button);
      this.list.append(button);
      this.panels.append(tab.panel);
    }
    this.show(tabs[0]?.name ?? "");
  }

  get shown(): string {
    return this.now;
  }

  show(name: string): void {
    this.now = name;
    for (const tab of this.tabs) {
      const is = tab.name === name;
      tab.panel.hidden = !is;
      const button = this.buttons.get(tab.name);
      button?.setAttribute("aria-selected", String(is));
      if (button) button.tabIndex = is ? 0 : -1;
    }
    this.tabs.find((tab) => tab.name === name)?.shown?.();
  }

  private key(event: KeyboardEvent, name: string): void {
    const place = this.tabs.findIndex((tab) => tab.name === name);
    const to: Record<string, number> = { ArrowLeft: place - 1, ArrowRight: place + 1, Home: 0, End: this.tabs.length - 1 };
    const next = to[event.key];
    if (next === undefined) return;
    event.preventDefault();
    const tab = this.tabs[(next + this.tabs.length) % this.tabs.length];
    if (!tab) return;
    this.show(tab.name);
    this.buttons.get(tab.name)?.focus();
  }
}
