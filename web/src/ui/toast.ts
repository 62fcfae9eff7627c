// Short messages at the edge of the page: polite to screen readers when they inform, assertive when something
// went wrong.

import { LitElement, css, html } from "lit";
import { repeat } from "lit/directives/repeat.js";
import { reason } from "../api/client.ts";
import { base } from "./styles.ts";

type Kind = "info" | "error";
interface Toast {
  id: number;
  kind: Kind;
  text: string;
}

const SHOWN_MS = { info: 4000, error: 9000 };
const MAX_SHOWN = 4;

const bus = new EventTarget();
let next = 1;

/** Shows a message. */
export function say(text: string, kind: Kind = "info"): void {
  bus.dispatchEvent(new CustomEvent<Toast>("toast", { detail: { id: next++, kind, text } }));
}

/** Does something that may fail, and says why it did. True if it went well. */
export async function attempt(work: () => Promise<unknown>, done?: string): Promise<boolean> {
  try {
    await work();
    if (done) say(done);
    return true;
  } catch (error) {
    say(reason(error), "error");
    return false;
  }
}

class Toasts extends LitElement {
  static override properties = { shown: { state: true } };
  declare shown: Toast[];

  static override styles = [
    base,
    css`
      :host {
        position: fixed;
        z-index: 30;
        right: 12px;
        bottom: 12px;
        width: min(420px, calc(100vw - 24px));
        pointer-events: none;
      }
      .toast {
        display: flex;
        gap: 8px;
        align-items: flex-start;
        margin-top: 8px;
        padding: 9px 10px 9px 13px;
        border: 1px solid var(--strong-line);
        border-left: 4px solid var(--accent);
        border-radius: var(--radius);
        background: var(--panel);
        box-shadow: 0 4px 18px rgb(0 0 0 / 0.25);
        pointer-events: auto;
        overflow-wrap: anywhere;
      }
      .error {
        border-left-color: var(--error);
      }
      .toast span {
        flex: 1;
      }
      @media (max-width: 700px) {
        :host {
          bottom: 70px;
        }
      }
    `,
  ];

  constructor() {
    super();
    this.shown = [];
    bus.addEventListener("toast", (event) => this.#add((event as CustomEvent<Toast>).detail));
  }

  #add(toast: Toast): void {
    const others = this.shown.filter((other) => other.text !== toast.text);
    this.shown = [...others, toast].slice(-MAX_SHOWN);
    window.setTimeout(() => this.#remove(toast.id), SHOWN_MS[toast.kind]);
  }

  #remove(id: number): void {
    this.shown = this.shown.filter((toast) => toast.id !== id);
  }

  override render() {
    return html`
      <div role="status" aria-live="polite">${this.#list("info")}</div>
      <div role="alert" aria-live="assertive">${this.#list("error")}</div>
    `;
  }

  #list(kind: Kind) {
    return repeat(
      this.shown.filter((toast) => toast.kind === kind),
      (toast) => toast.id,
      (toast) => html`
        <div class="toast ${kind}">
          <span>${kind === "error" ? html`<strong>Error:</strong> ` : ""}${toast.text}</span>
          <button class="plain small" aria-label="Dismiss" @click=${() => this.#remove(toast.id)}>✕</button>
        </div>
      `,
    );
  }
}
customElements.define("pt-toasts", Toasts);
