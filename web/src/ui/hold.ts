// A button that acts while it is held, by pointer or by the space bar: `begin` when it is pressed, `end` when it is
// let go, and also when the pointer or the focus is lost, the window is left, or the page is hidden.

import { LitElement, css, html } from "lit";
import { base } from "./styles.ts";

class Hold extends LitElement {
  static override properties = {
    disabled: { type: Boolean },
    label: { type: String },
    held: { state: true },
  };
  declare disabled: boolean;
  declare label: string;
  declare held: boolean;

  static override styles = [
    base,
    css`
      button {
        width: 100%;
        min-height: 38px;
        font-size: 15px;
        touch-action: none;
        -webkit-touch-callout: none;
      }
      button[aria-pressed="true"] {
        background: var(--accent);
        color: var(--on-accent);
      }
    `,
  ];

  readonly #leave = () => this.#end();
  readonly #hide = () => {
    if (document.hidden) this.#end();
  };

  constructor() {
    super();
    this.disabled = false;
    this.label = "";
    this.held = false;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    window.addEventListener("blur", this.#leave);
    window.addEventListener("pagehide", this.#leave);
    document.addEventListener("visibilitychange", this.#hide);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#end();
    window.removeEventListener("blur", this.#leave);
    window.removeEventListener("pagehide", this.#leave);
    document.removeEventListener("visibilitychange", this.#hide);
  }

  override updated(): void {
    if (this.disabled) this.#end();
  }

  override render() {
    return html`
      <button
        ?disabled=${this.disabled}
        aria-label=${this.label}
        aria-pressed=${this.held}
        @pointerdown=${this.#press}
        @pointerup=${this.#leave}
        @pointercancel=${this.#leave}
        @lostpointercapture=${this.#leave}
        @contextmenu=${(event: Event) => event.preventDefault()}
        @keydown=${this.#keyDown}
        @keyup=${this.#keyUp}
        @blur=${this.#leave}
      ><slot></slot></button>
    `;
  }

  #press(event: PointerEvent): void {
    if (event.button !== 0) return;
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    this.#begin();
  }

  #keyDown(event: KeyboardEvent): void {
    if (event.key === "Escape") this.#end();
    if (event.key !== " " && event.key !== "Enter") return;
    event.preventDefault();
    if (!event.repeat) this.#begin();
  }

  #keyUp(event: KeyboardEvent): void {
    if (event.key === " " || event.key === "Enter") this.#end();
  }

  #begin(): void {
    if (this.held || this.disabled) return;
    this.held = true;
    this.dispatchEvent(new Event("begin"));
  }

  #end(): void {
    if (!this.held) return;
    this.held = false;
    this.dispatchEvent(new Event("end"));
  }
}
customElements.define("pt-hold", Hold);
