// A joystick: a stick for the analog inputs of two axes, which springs back to the middle.

import { css, html, nothing } from "lit";
import type { Catalog, PinInfo } from "../api/contract.ts";
import { routeTo } from "../state/route.ts";
import { Slide } from "../state/slide.ts";
import { base } from "../ui/styles.ts";
import { Tab } from "./tab.ts";

/** From the middle to the end, in pixels. */
const REACH = 56;

/** What the arrow keys do to the stick. */
const KEYS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** The pins of a joystick, across and up. */
export function stick(catalog: Catalog): PinInfo[] {
  const pins = catalog.pins.filter(({ kind, role, low, high }) => kind === "analog" && role === "joystick" && low !== null && high !== null);
  return pins.slice(0, 2);
}

class Joystick extends Tab {
  static override properties = { ...Tab.properties, at: { state: true } };
  /** Where the stick is, -1 to 1 across and up. */
  declare at: [number, number];
  #slides: Slide[] = [];
  #held = false;

  static override styles = [
    base,
    css`
      svg {
        display: block;
        margin: 0 auto;
        touch-action: none;
        cursor: grab;
      }
      .field {
        fill: var(--raised);
        stroke: var(--strong-line);
      }
      .cross {
        stroke: var(--line);
      }
      .stick {
        fill: var(--accent);
      }
      p {
        font-size: 13px;
      }
    `,
  ];

  constructor() {
    super();
    this.at = [0, 0];
  }

  override willUpdate(changed: Map<string, unknown>): void {
    super.willUpdate(changed);
    if (changed.has("catalog")) this.#slides = stick(this.catalog).map(({ name }) => new Slide(this.api, this.device.name, name));
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#letGo();
  }

  override render() {
    const pins = stick(this.catalog);
    const mask = this.catalog.parameters.find(({ group, axis, high }) => group === "Joystick" && axis === null && high === 3);
    const [x, y] = this.at;
    return html`
      <section class="panel stack" aria-label="Joystick">
        <h2>Joystick</h2>
        <p class="muted">${pins.map(({ name, axis }) => `${name}${axis ? ` for ${axis}` : ""}`).join(", ")}. It springs back; arrow keys bend it.
          ${mask ? html`The axes follow where <code>${mask.id}</code> has their bit, as fast and as far as the other parameters
            of “${mask.group}” let them: <a href=${routeTo(this.device.name, "parameters")}>Parameters</a>.` : nothing}</p>
        <svg width="150" height="150" viewBox="-75 -75 150 150" tabindex="0" role="application"
          aria-label="Joystick of ${pins.map(({ name }) => name).join(" and ")}"
          @pointerdown=${this.#grab} @pointermove=${this.#drag} @pointerup=${this.#letGo} @pointercancel=${this.#letGo}
          @keydown=${this.#bend} @keyup=${this.#letGo} @blur=${this.#letGo}>
          <circle class="field" r="72" />
          <line class="cross" x1="-72" x2="72" /><line class="cross" y1="-72" y2="72" />
          <circle class="stick" r="15" cx=${x * REACH} cy=${-y * REACH} />
        </svg>
      </section>
    `;
  }

  #grab(event: PointerEvent): void {
    if (event.button !== 0 || !this.usable) return;
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
    this.#held = true;
    this.#drag(event);
  }

  #drag(event: PointerEvent): void {
    if (!this.#held) return;
    const box = (event.currentTarget as Element).getBoundingClientRect();
    const x = (event.clientX - box.x - box.width / 2) / REACH;
    const y = -(event.clientY - box.y - box.height / 2) / REACH;
    const length = Math.max(1, Math.hypot(x, y));
    this.#set([x / length, y / length]);
  }

  #bend(event: KeyboardEvent): void {
    const to = KEYS[event.key];
    if (!to || !this.usable) return;
    event.preventDefault();
    this.#held = true;
    if (!event.repeat) this.#set(to);
  }

  #set(at: [number, number]): void {
    this.at = at;
    stick(this.catalog).forEach(({ low, high }, n) => {
      this.#slides[n]!.set(Math.round((low! + high!) / 2 + (at[n]! * (high! - low!)) / 2));
    });
  }

  #letGo(): void {
    if (!this.#held) return;
    this.#held = false;
    this.at = [0, 0];
    for (const slide of this.#slides) slide.set(null);
  }
}
customElements.define("pt-joystick", Joystick);
