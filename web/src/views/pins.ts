// Inputs and outputs: what the controller reads and drives. Inputs of a virtual controller can be pressed.

import { css, html, nothing } from "lit";
import type { PinInfo } from "../api/contract.ts";
import { reading } from "../state/format.ts";
import { Press } from "../state/press.ts";
import { Slide } from "../state/slide.ts";
import { base } from "../ui/styles.ts";
import { attempt } from "../ui/toast.ts";
import { Tab } from "./tab.ts";

class Pins extends Tab {
  static override properties = { ...Tab.properties, keep: { state: true }, driven: { state: true } };
  /** Whether a switch stays pressed until it is clicked again. */
  declare keep: boolean;
  /** What this page drives: analog inputs with their value. */
  declare driven: ReadonlyMap<string, number>;
  protected override readonly watches = ["status"] as const;

  readonly #presses = new Map<string, Press>();
  readonly #slides = new Map<string, Slide>();

  static override styles = [
    base,
    css`
      .tiles {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(104px, 1fr));
        gap: 6px;
      }
      .tile {
        display: flex;
        align-items: center;
        justify-content: flex-start;
        gap: 7px;
        min-height: 34px;
        padding: 2px 9px;
        border: 1px solid var(--line);
        border-radius: var(--radius);
        background: var(--raised);
        overflow: hidden;
        text-align: left;
        touch-action: none;
      }
      button.tile {
        border-color: var(--strong-line);
      }
      .tile i {
        flex: none;
        width: 11px;
        height: 11px;
        border: 2px solid var(--strong-line);
        border-radius: 50%;
      }
      .tile.on i {
        border-color: var(--ok);
        background: var(--ok);
      }
      .tile.on {
        font-weight: 650;
      }
      .tile.driven {
        border-color: var(--accent);
        box-shadow: inset 0 0 0 1px var(--accent);
      }
      .tile small {
        display: block;
        color: var(--muted);
        font-weight: 400;
        font-size: 11px;
        line-height: 12px;
      }
      .tile span {
        line-height: 16px;
      }
      .analog {
        display: grid;
        grid-template-columns: auto minmax(60px, 1fr) auto 34px;
        gap: 6px 10px;
        align-items: center;
      }
      .analog input {
        width: 100%;
        min-width: 0;
      }
      .analog output {
        min-width: 5em;
        text-align: right;
      }
      .sub {
        margin: 2px 0 4px;
      }
    `,
  ];

  constructor() {
    super();
    this.keep = false;
    this.driven = new Map();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    for (const press of this.#presses.values()) press.set(false);
  }

  get #isVirtual(): boolean {
    return this.device.kind === "virtual";
  }

  override render() {
    const { pins } = this.catalog;
    const outputs = this.live.status?.outputs ?? {};
    // A port is what it is set to be.
    const isOutput = (pin: PinInfo) => pin.kind === "output" || (pin.kind === "port" && pin.name in outputs);
    const inputs = pins.filter((pin) => ["input", "index", "port"].includes(pin.kind) && !isOutput(pin));
    const analog = pins.filter((pin) => pin.kind === "analog");
    const driven = pins.filter((pin) => pin.kind === "analog_output");
    return html`
      <section class="panel stack" aria-label="Inputs and outputs">
        <div class="row"><h2 class="grow">Inputs</h2>
          ${this.#isVirtual
            ? html`<label class="line" title="A click presses, another one lets go">
                <input type="checkbox" .checked=${this.keep} @change=${(event: Event) => (this.keep = (event.target as HTMLInputElement).checked)} />
                keep pressed</label>`
            : nothing}
        </div>
        ${this.#groups(inputs)}
        <h2>Outputs</h2>
        <div class="tiles">${pins.filter(isOutput).map((pin) => this.#output(pin))}</div>
        ${analog.length + driven.length > 0
          ? html`<h2>Analog</h2>
              <div class="analog">${analog.map((pin) => this.#analog(pin))} ${driven.map((pin) => this.#analogOutput(pin))}</div>`
          : nothing}
      </section>
    `;
  }

  #groups(inputs: PinInfo[]) {
    const owners = [null, ...this.catalog.axes];
    return owners.map((axis) => {
      const pins = inputs.filter((pin) => this.#owner(pin) === axis);
      if (pins.length === 0) return nothing;
      return html`
        <div>
          ${axis === null ? nothing : html`<h3 class="sub">Axis ${axis}</h3>`}
          <div class="tiles">${pins.map((pin) => this.#input(pin))}</div>
        </div>
      `;
    });
  }

  /** The axis of a pin that has one, also by its name, as of `ALMX`. */
  #owner({ axis, name, kind }: PinInfo): string | null {
    if (axis !== null) return axis;
    const last = name.at(-1) ?? "";
    return kind === "input" && /[A-Z]/.test(last) && name.length > 3 && this.catalog.axes.includes(last) ? last : null;
  }

  /** What the controller says of an input: among its inputs, or as a switch of an axis. */
  #level(pin: PinInfo): boolean | null {
    const value = this.live.status?.inputs[pin.name];
    if (value !== undefined) return value === true || (typeof value === "number" && value !== 0);
    const axis = pin.axis === null ? undefined : this.live.status?.axes[pin.axis];
    if (!axis) return null;
    switch (pin.role) {
      case "negative limit":
        return axis.negative_limit;
      case "positive limit":
        return axis.positive_limit;
      case "home":
        return axis.home;
      case "index":
        return axis.index;
      default:
        return null;
    }
  }

  #input(pin: PinInfo) {
    const level = this.#level(pin);
    const press = this.#presses.get(pin.name);
    const words = `${pin.name}${pin.role ? `, ${pin.role}` : ""}${level === null ? "" : level ? ", on" : ", off"}`;
    const inside = html`<i></i><span>${pin.name} ${pin.role ? html`<small>${pin.role}</small>` : nothing}</span>`;
    const looks = `tile ${level ? "on" : ""} ${press?.pressed ? "driven" : ""}`;
    if (!this.#isVirtual) return html`<div class=${looks} role="img" aria-label=${words} title=${words}>${inside}</div>`;
    const end = () => {
      if (!this.keep) this.#press(pin.name, false);
    };
    return html`
      <button class=${looks} title=${words} aria-label=${words} aria-pressed=${press?.pressed ?? false} ?disabled=${!this.usable}
        @pointerdown=${(event: PointerEvent) => {
          if (event.button !== 0) return;
          if (!this.keep) (event.currentTarget as Element).setPointerCapture(event.pointerId);
          this.#press(pin.name, !this.keep || !press?.pressed);
        }}
        @pointerup=${end} @pointercancel=${end} @blur=${end} @contextmenu=${(event: Event) => event.preventDefault()}
        @keydown=${(event: KeyboardEvent) => {
          if (event.repeat || (event.key !== " " && event.key !== "Enter")) return;
          event.preventDefault();
          this.#press(pin.name, !this.keep || !press?.pressed);
        }}
        @keyup=${end}>${inside}</button>
    `;
  }

  #press(pin: string, pressed: boolean): void {
    const press = this.#presses.get(pin) ?? new Press(this.api, this.device.name, pin);
    this.#presses.set(pin, press);
    press.set(pressed);
    this.requestUpdate();
  }

  #output(pin: PinInfo) {
    const value = this.live.status?.outputs[pin.name];
    const on = value === true || (typeof value === "number" && value !== 0);
    const known = value !== undefined && this.catalog.actions.includes("output");
    return html`
      <button class="tile ${on ? "on" : ""}" role="switch" aria-checked=${on} ?disabled=${!this.usable || !known}
        title="${pin.name}${pin.role ? `, ${pin.role}` : ""}: ${known ? (on ? "on" : "off") : "cannot be set from here"}"
        @click=${() => attempt(() => this.api.act(this.device.name, { do: "output", name: pin.name, value: !on }))}>
        <i></i><span>${pin.name} ${pin.role ? html`<small>${pin.role}</small>` : nothing}</span>
      </button>
    `;
  }

  #analog(pin: PinInfo) {
    const read = this.live.status?.inputs[pin.name];
    const shown = typeof read === "number" ? read : (this.driven.get(pin.name) ?? null);
    const slides = this.#isVirtual && pin.low !== null && pin.high !== null;
    return html`
      <span>${pin.name} <small class="muted">${pin.role}</small></span>
      ${slides
        ? html`<input type="range" min=${pin.low!} max=${pin.high!} step=${pin.high! - pin.low! > 200 ? 1 : 0.1} ?disabled=${!this.usable}
            aria-label="${pin.name}${pin.role ? `, ${pin.role}` : ""}" .value=${String(this.driven.get(pin.name) ?? shown ?? pin.low)}
            @input=${(event: Event) => this.#slide(pin.name, Number((event.target as HTMLInputElement).value))} />`
        : html`<span></span>`}
      <output>${reading(shown)} ${pin.unit}</output>
      ${slides
        ? html`<button class="small plain" ?disabled=${!this.driven.has(pin.name)} title="Give it back to the machine"
            aria-label="Give ${pin.name} back to the machine" @click=${() => this.#release(pin.name)}>✕</button>`
        : html`<span></span>`}
    `;
  }

  #slide(pin: string, value: number): void {
    this.driven = new Map(this.driven).set(pin, value);
    this.#slider(pin).set(value);
  }

  #release(pin: string): void {
    const driven = new Map(this.driven);
    driven.delete(pin);
    this.driven = driven;
    this.#slider(pin).set(null);
  }

  #slider(pin: string): Slide {
    const slide = this.#slides.get(pin) ?? new Slide(this.api, this.device.name, pin);
    this.#slides.set(pin, slide);
    return slide;
  }

  #analogOutput(pin: PinInfo) {
    const value = this.live.status?.outputs[pin.name];
    const shown = typeof value === "number" ? value : null;
    return html`
      <span>${pin.name} <small class="muted">${pin.role}</small></span>
      <input type="range" min=${pin.low ?? 0} max=${pin.high ?? 100} step="1" aria-label=${pin.name} ?disabled=${!this.usable}
        .value=${String(shown ?? 0)}
        @change=${(event: Event) => attempt(() => this.api.act(this.device.name, {
          do: "output",
          name: pin.name,
          value: Number((event.target as HTMLInputElement).value),
        }))} />
      <output>${reading(shown)} ${pin.unit}</output><span></span>
    `;
  }
}
customElements.define("pt-pins", Pins);
