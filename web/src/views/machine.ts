// The machine behind a virtual controller, drawn to scale: a stage on its rail, or a shaft that goes round, with its
// switches. A switch that is dragged to the carriage is pressed, as by hand, and springs back when it is let go.

import { html, nothing, svg } from "lit";
import { reason } from "../api/client.ts";
import type { Machine, MachineAxis } from "../api/contract.ts";
import { count } from "../state/format.ts";
import { Press } from "../state/press.ts";
import { base } from "../ui/styles.ts";
import { attempt } from "../ui/toast.ts";
import "./by-hand.ts";
import { type Lane, type SwitchRole, arc, around, covers, lane, mount, mountAt, touches } from "./machine-geometry.ts";
import { machineStyles } from "./machine-styles.ts";
import { Tab } from "./tab.ts";

const ASK_MS = 80;
/** The part of the way to where the shaft is that the drawing goes in a frame: it hides that it is asked in steps. */
const EASE = 0.35;
const HEIGHT = 88;
const RAIL = 38;
const ROUND = 172;
const RADIUS = 48;
/** Index marks nearer to each other than this, in pixels, are not drawn. */
const MARK_GAP = 5;

const ROLES: SwitchRole[] = ["negative limit", "home", "positive limit"];
const LABELS: Record<SwitchRole, string> = { "negative limit": "−L", home: "H", "positive limit": "+L" };

interface Drag {
  axis: string;
  role: SwitchRole;
  /** Where the pointer holds the switch, in pulses. */
  at: number;
  /** `null` if the switch itself is moved. */
  press: Press | null;
}

class MachineView extends Tab {
  static override properties = {
    ...Tab.properties,
    machine: { state: true },
    width: { state: true },
    drag: { state: true },
    problem: { state: true },
    mounting: { state: true },
  };
  declare machine: Machine | null;
  declare width: number;
  declare drag: Drag | null;
  declare problem: string | null;
  /** Whether switches are mounted elsewhere when they are dragged, and not pressed. */
  declare mounting: boolean;
  protected override readonly watches = ["status"] as const;

  #timer = 0;
  #frame = 0;
  readonly #drawn = new Map<string, number>();
  readonly #size = new ResizeObserver(([entry]) => {
    if (entry && entry.contentRect.width > 0) this.width = entry.contentRect.width;
  });

  static override styles = [base, machineStyles];

  constructor() {
    super();
    this.machine = null;
    this.width = 600;
    this.drag = null;
    this.problem = null;
    this.mounting = false;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    void this.#ask();
    this.#animate();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.#timer);
    cancelAnimationFrame(this.#frame);
    this.#size.disconnect();
    this.#drop();
  }

  override firstUpdated(): void {
    this.#size.observe(this);
  }

  async #ask(): Promise<void> {
    if (this.active && !document.hidden) {
      try {
        this.machine = await this.api.machine(this.device.name);
        this.problem = null;
        this.#follow();
      } catch (error) {
        this.problem = reason(error);
      }
    }
    if (this.isConnected) this.#timer = window.setTimeout(() => void this.#ask(), this.problem ? 1000 : ASK_MS);
  }

  /** Presses or lets go the switch that is held, as the carriage comes and goes; what it does there by itself stays. */
  #follow(): void {
    const { drag } = this;
    const axis = drag && this.machine?.axes[drag.axis];
    if (drag?.press && axis) drag.press.set(covers(axis, drag.role, drag.at) !== touches(axis, drag.role));
  }

  /** Moves the carriages of the drawing after the shafts. */
  #animate(): void {
    this.#frame = requestAnimationFrame(() => {
      this.#animate();
      if (!this.active || !this.machine) return;
      for (const [name, axis] of Object.entries(this.machine.axes)) {
        const before = this.#drawn.get(name) ?? axis.shaft;
        const rest = axis.shaft - before;
        const now = Math.abs(rest) < 0.5 ? axis.shaft : before + rest * EASE;
        this.#drawn.set(name, now);
        const group = this.renderRoot.querySelector(`[data-shaft="${name}"]`);
        group?.setAttribute("transform", this.#placeOf(axis, now));
      }
    });
  }

  #placeOf(axis: MachineAxis, shaft: number): string {
    if (axis.circumference !== null) return `rotate(${(around(axis, shaft) * 360).toFixed(2)})`;
    return `translate(${lane(axis, this.width).x(shaft).toFixed(2)} 0)`;
  }

  override render() {
    if (!this.machine) {
      return html`<section class="panel"><h2>Machine</h2>
        <p class=${this.problem ? "error-text" : "muted"}>${this.problem ?? "Loading…"}</p></section>`;
    }
    return html`
      <section class="panel stack" aria-label="Machine">
        <div class="row"><h2>Machine</h2>
          <span class="muted grow">${this.mounting
            ? "Drag a switch to where it is to be, or move it with the arrow keys; with Shift in small steps."
            : "Drag a switch to the carriage to press it, or hold the space bar on it."}</span>
          <button class="small" aria-pressed=${this.mounting} ?disabled=${!this.usable}
            @click=${() => (this.mounting = !this.mounting)}>Move switches</button>
        </div>
        <div>
          ${this.#inOrder().map(([name, axis]) => html`
            <div class="axis">
              <div class="row head"><strong>${name}</strong>
                <span class="muted">shaft ${count(axis.shaft)} · counter ${count(this.live.status?.axes[name]?.position)}
                  ${axis.index_every ? `· an index mark every ${count(axis.index_every)}` : nothing}
                  ${axis.backlash ? `· backlash ${count(axis.backlash)}` : nothing}</span>
              </div>
              ${axis.circumference === null ? this.#stage(name, axis) : this.#shaft(name, axis)}
              <pt-by-hand .axis=${name} .load=${axis.load} ${this.given()}></pt-by-hand>
            </div>`)}
        </div>
      </section>
    `;
  }

  /** The axes in the order of the controller, not of the alphabet. */
  #inOrder(): [string, MachineAxis][] {
    return this.catalog.axes.flatMap((name) => {
      const axis = this.machine?.axes[name];
      return axis ? [[name, axis] as [string, MachineAxis]] : [];
    });
  }

  #stage(name: string, axis: MachineAxis) {
    const scale = lane(axis, this.width);
    const slack = axis.backlash * scale.perPulse;
    return html`
      <svg viewBox="0 0 ${this.width} ${HEIGHT}" height=${HEIGHT} role="group"
        aria-label="Stage of axis ${name}, from ${axis.negative_limit ?? "no limit"} to ${axis.positive_limit ?? "no limit"}">
        <line class="rail" x1=${scale.margin} x2=${this.width - scale.margin} y1=${RAIL} y2=${RAIL} />
        ${this.#marks(axis, scale)}
        ${axis.home
          ? svg`<rect class="home" x=${scale.x(axis.home[0])} y=${RAIL - 3} height="6" rx="1"
              width=${Math.max(3, scale.x(axis.home[1]) - scale.x(axis.home[0]))} />`
          : nothing}
        <g data-shaft=${name} transform=${this.#placeOf(axis, this.#drawn.get(name) ?? axis.shaft)}>
          ${slack >= 1 ? svg`<rect class="slack" x=${-14 - slack / 2} y=${RAIL - 30} width=${28 + slack} height="24" rx="4" />` : nothing}
          <rect class="carriage" x="-14" y=${RAIL - 30} width="28" height="24" rx="4" />
          <path class="carriage" d="M -5 ${RAIL - 7} L 5 ${RAIL - 7} L 0 ${RAIL - 1} Z" />
        </g>
        ${ROLES.map((role) => this.#switch(name, axis, role, scale))}
      </svg>
    `;
  }

  #marks(axis: MachineAxis, scale: Lane) {
    const every = axis.index_every;
    if (!every || every * scale.perPulse < MARK_GAP) return nothing;
    const first = Math.ceil(scale.low / every);
    const marks = Math.floor(scale.high / every) - first + 1;
    return Array.from({ length: marks }, (_, n) => {
      const x = scale.x((first + n) * every);
      return svg`<line class="mark" x1=${x} x2=${x} y1=${RAIL + 4} y2=${RAIL + 10} />`;
    });
  }

  #shaft(name: string, axis: MachineAxis) {
    const { width } = this;
    const every = axis.index_every ?? 0;
    const marks = every > 0 ? Math.min(360, Math.floor(axis.circumference! / every)) : 0;
    return html`
      <svg viewBox="${-width / 2} ${-ROUND / 2} ${width} ${ROUND}" height=${ROUND} role="group"
        aria-label="Shaft of axis ${name}, ${axis.circumference} to the turn">
        <circle class="rail" r=${RADIUS} />
        ${Array.from({ length: marks }, (_, n) =>
          svg`<line class="mark" transform="rotate(${around(axis, n * every) * 360})" y1=${-RADIUS + 5} y2=${-RADIUS + 11} />`)}
        ${axis.home ? svg`<path class="home-arc" d=${arc(axis, axis.home, RADIUS)} />` : nothing}
        <g data-shaft=${name} transform=${this.#placeOf(axis, this.#drawn.get(name) ?? axis.shaft)}>
          <line class="hand" y1="8" y2=${-RADIUS + 7} /><circle class="carriage" r="7" />
        </g>
        ${ROLES.map((role) => this.#roundSwitch(name, axis, role))}
        <text x=${RADIUS + 44} y="4">${count(axis.circumference)} a turn</text>
      </svg>
    `;
  }

  /** A switch at its place, or where it is dragged to. */
  #switch(name: string, axis: MachineAxis, role: SwitchRole, scale: Lane) {
    const own = mount(axis, role);
    if (own === null || !this.#pin(name, role)) return nothing;
    const dragged = this.#dragged(name, role);
    const x = scale.x(dragged ?? own);
    // One that is held to the carriage is not where it is mounted.
    const place = this.mounting ? Math.round(dragged ?? own) : dragged === null ? own : null;
    return this.#body(name, role, `translate(${x} ${RAIL + 24})`, (event) => scale.pulse(this.#pointerX(event)), svg`
      <path class="body" d="M 0 -20 L 5 -12 L 15 -12 L 15 10 L -15 10 L -15 -12 L -5 -12 Z" />
      <text y="4">${LABELS[role]}</text>`, place === null ? nothing : svg`<text y="24">${count(place)}</text>`);
  }

  #roundSwitch(name: string, axis: MachineAxis, role: SwitchRole) {
    const own = mount(axis, role);
    if (own === null || !this.#pin(name, role)) return nothing;
    const turn = around(axis, this.#dragged(name, role) ?? own) * 2 * Math.PI;
    const place = `translate(${Math.sin(turn) * (RADIUS + 18)} ${-Math.cos(turn) * (RADIUS + 18)})`;
    const toPulse = (event: PointerEvent) => {
      const box = (event.currentTarget as SVGElement).ownerSVGElement!.getBoundingClientRect();
      const angle = Math.atan2(event.clientX - box.x - box.width / 2, -(event.clientY - box.y - box.height / 2));
      return (angle / (2 * Math.PI)) * axis.circumference!;
    };
    return this.#body(name, role, place, toPulse, svg`<circle class="body" r="12" /><text y="4">${LABELS[role]}</text>`, nothing);
  }

  #body(name: string, role: SwitchRole, place: string, toPulse: (event: PointerEvent) => number, body: unknown, label: unknown) {
    const on = this.#isOn(name, role);
    const hold = (event: KeyboardEvent) => {
      if (this.mounting) {
        if (event.type === "keydown") this.#nudge(event, name, role);
        return;
      }
      if (event.key !== " " && event.key !== "Enter") return;
      event.preventDefault();
      if (event.repeat) return;
      if (event.type === "keydown") this.#pressKey(name, role);
      else this.#drop();
    };
    return svg`
      <g class="switch ${on ? "on" : ""} ${role === "home" ? "" : "limit"}" transform=${place} tabindex="0" role="button"
        aria-label="${role} switch of ${name}, ${on ? "on" : "off"}" aria-pressed=${on ? "true" : "false"}
        @pointerdown=${(event: PointerEvent) => this.#grab(event, name, role, toPulse(event))}
        @pointermove=${(event: PointerEvent) => this.#move(name, role, () => toPulse(event))}
        @pointerup=${() => this.#drop()} @pointercancel=${() => this.#drop()} @lostpointercapture=${() => this.#drop()}
        @keydown=${hold} @keyup=${hold} @blur=${() => this.#drop()}>
        <rect class="hit" x="-23" y="-20" width="46" height="46" />${body} ${label}
      </g>
    `;
  }

  #pointerX(event: PointerEvent): number {
    return event.clientX - (event.currentTarget as SVGElement).ownerSVGElement!.getBoundingClientRect().x;
  }

  #dragged(name: string, role: SwitchRole): number | null {
    const { drag } = this;
    return drag?.axis === name && drag.role === role ? drag.at : null;
  }

  #pin(axis: string, role: SwitchRole): string | null {
    return this.catalog.pins.find((pin) => pin.axis === axis && pin.role === role)?.name ?? null;
  }

  #isOn(name: string, role: SwitchRole): boolean {
    const status = this.live.status?.axes[name];
    const on = { "negative limit": status?.negative_limit, "positive limit": status?.positive_limit, home: status?.home }[role];
    return on ?? false;
  }

  #grab(event: PointerEvent, axis: string, role: SwitchRole, at: number): void {
    const pin = this.#pin(axis, role);
    if (event.button !== 0 || !pin || !this.usable) return;
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
    this.drag = { axis, role, at, press: this.mounting ? null : new Press(this.api, this.device.name, pin) };
    this.#follow();
  }

  #move(axis: string, role: SwitchRole, at: () => number): void {
    if (this.#dragged(axis, role) === null) return;
    this.drag = { ...this.drag!, at: at() };
    this.#follow();
  }

  #pressKey(axis: string, role: SwitchRole): void {
    const pin = this.#pin(axis, role);
    const shaft = this.machine?.axes[axis]?.shaft;
    if (!pin || shaft === undefined || !this.usable) return;
    this.drag = { axis, role, at: shaft, press: new Press(this.api, this.device.name, pin) };
    this.#follow();
  }

  #drop(): void {
    const { drag } = this;
    this.drag = null;
    if (drag?.press) drag.press.set(false);
    else if (drag) void this.#mount(drag.axis, drag.role, drag.at);
  }

  /** An arrow key moves a switch by a hundredth of the rail or of a turn, with Shift by a hundredth of that. */
  #nudge(event: KeyboardEvent, name: string, role: SwitchRole): void {
    const axis = this.machine?.axes[name];
    const own = axis && mount(axis, role);
    const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (!axis || own === null || own === undefined || way === undefined || !this.usable) return;
    event.preventDefault();
    const { low, high } = lane(axis, this.width);
    const step = (axis.circumference ?? high - low) / (event.shiftKey ? 10_000 : 100);
    void this.#mount(name, role, own + way * Math.max(1, Math.round(step)));
  }

  async #mount(name: string, role: SwitchRole, at: number): Promise<void> {
    const axis = this.machine?.axes[name];
    if (!axis) return;
    await attempt(() => this.api.moveSwitches(this.device.name, { axis: name, ...mountAt(axis, role, at) }));
    this.machine = await this.api.machine(this.device.name).catch(() => this.machine);
  }
}
customElements.define("pt-machine", MachineView);
