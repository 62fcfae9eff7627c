// A dialog, and the question whether one is sure.

import { LitElement, css, html, render } from "lit";
import { base } from "./styles.ts";

/** The window's event that asks for a stop: what lies below a dialog cannot be clicked. */
export const STOP = "stop-motion";

/** `<pt-dialog heading="..." open>` with its content in the default slot and its buttons in slot `actions`. */
class Dialog extends LitElement {
  static override properties = {
    heading: { type: String },
    open: { type: Boolean, reflect: true },
    wide: { type: Boolean, reflect: true },
  };
  declare heading: string;
  declare open: boolean;
  declare wide: boolean;

  static override styles = [
    base,
    css`
      :host {
        display: contents;
      }
      dialog {
        width: min(480px, calc(100vw - 24px));
        max-height: calc(100dvh - 40px);
        padding: 0;
        border: 1px solid var(--strong-line);
        border-radius: 10px;
        background: var(--panel);
        color: var(--text);
        box-shadow: 0 12px 48px rgb(0 0 0 / 0.4);
      }
      :host([wide]) dialog {
        width: min(820px, calc(100vw - 24px));
      }
      dialog::backdrop {
        background: rgb(8 12 16 / 0.55);
      }
      header {
        display: flex;
        align-items: center;
        gap: 8px;
        padding: 12px 10px 12px 16px;
        border-bottom: 1px solid var(--line);
      }
      header h2 {
        flex: 1;
        font-size: 15px;
      }
      .body {
        padding: 14px 16px;
      }
      footer {
        display: flex;
        justify-content: flex-end;
        gap: 8px;
        padding: 0 16px 14px;
      }
    `,
  ];

  constructor() {
    super();
    this.heading = "";
    this.open = false;
    this.wide = false;
  }

  override updated(): void {
    const dialog = this.renderRoot.querySelector("dialog")!;
    if (this.open && !dialog.open) dialog.showModal();
    if (!this.open && dialog.open) dialog.close();
  }

  override render() {
    return html`
      <dialog aria-labelledby="heading" @close=${this.#closed}>
        <header>
          <h2 id="heading">${this.heading}</h2>
          <button class="stop small" type="button" @click=${() => window.dispatchEvent(new Event(STOP))}>■ STOP</button>
          <button class="plain small" aria-label="Close" @click=${() => (this.open = false)}>✕</button>
        </header>
        <div class="body"><slot></slot></div>
        <footer><slot name="actions"></slot></footer>
      </dialog>
    `;
  }

  #closed(): void {
    this.open = false;
    this.dispatchEvent(new Event("close"));
  }
}
customElements.define("pt-dialog", Dialog);

declare global {
  interface HTMLElementTagNameMap {
    "pt-dialog": Dialog;
  }
}

/** Asks; true if the user agreed. */
export function confirm(question: { heading: string; text: unknown; yes: string; danger?: boolean }): Promise<boolean> {
  return new Promise((resolve) => {
    const host = document.createElement("pt-confirm");
    Object.assign(host, { question, answer: resolve });
    document.body.append(host);
  });
}

class Confirm extends LitElement {
  declare question: { heading: string; text: unknown; yes: string; danger?: boolean };
  declare answer: (agreed: boolean) => void;
  static override styles = base;
  #agreed = false;

  override render() {
    const { heading, text, yes, danger } = this.question;
    return html`
      <pt-dialog .heading=${heading} .open=${true} @close=${this.#closed}>
        <p>${text}</p>
        <button slot="actions" @click=${() => this.#finish(false)}>Cancel</button>
        <button slot="actions" class=${danger ? "danger" : "primary"} autofocus @click=${() => this.#finish(true)}>
          ${yes}
        </button>
      </pt-dialog>
    `;
  }

  #finish(agreed: boolean): void {
    this.#agreed = agreed;
    this.renderRoot.querySelector("pt-dialog")!.open = false;
  }

  #closed(): void {
    this.answer(this.#agreed);
    render(null, this.renderRoot as ShadowRoot);
    this.remove();
  }
}
customElements.define("pt-confirm", Confirm);
