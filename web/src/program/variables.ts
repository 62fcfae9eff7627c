// The variables of programs: their values, what has just changed, and a field for each.

import { LitElement, css, html, nothing, type PropertyValues } from "lit";
import { repeat } from "lit/directives/repeat.js";
import type { Api } from "../api/client.ts";
import type { Value } from "../api/contract.ts";
import { parseWhole } from "../state/format.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";

/** Between two looks while a program runs. */
const LOOK_MS = 500;
/** How long a change is marked while programs run. */
const MARKED_MS = 2000;

/** V2 comes before V10. */
const order = new Intl.Collator("en", { numeric: true });

/** `<pt-variables>`: reads them while it is `shown`, often while something is `running`, and when `moment` changes. */
class Variables extends LitElement {
  static override properties = {
    api: { attribute: false },
    name: { type: String },
    shown: { type: Boolean },
    running: { type: Boolean },
    usable: { type: Boolean },
    moment: { attribute: false },
    values: { state: true },
    only: { state: true },
  };
  declare api: Api;
  declare name: string;
  declare shown: boolean;
  declare running: boolean;
  declare usable: boolean;
  /** Whatever it is, a change of it is a reason to look anew. */
  declare moment: unknown;
  declare values: Record<string, Value>;
  /** Whether zeros are left out. */
  declare only: boolean;

  /** When each variable was last seen to change, and from what. */
  readonly #changed = new Map<string, { at: number; from: Value }>();
  #timer = 0;
  #asking = false;

  static override styles = [
    base,
    css`
      .list {
        max-height: 62dvh;
        overflow: auto;
      }
      td {
        padding: 1px 6px;
      }
      td input {
        min-width: 7em;
        min-height: 24px;
        text-align: right;
        font-variant-numeric: tabular-nums;
      }
      tr.changed {
        background: var(--warn-bg);
      }
      .from {
        color: var(--warn);
        font-size: 12px;
        text-align: right;
        white-space: nowrap;
      }
    `,
  ];

  constructor() {
    super();
    this.name = "";
    this.shown = false;
    this.running = false;
    this.usable = false;
    this.moment = null;
    this.values = {};
    this.only = false;
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.#timer);
  }

  override updated(changed: PropertyValues): void {
    if (["shown", "running", "moment"].some((name) => changed.has(name))) this.#soon(0);
  }

  #soon(ms: number): void {
    clearTimeout(this.#timer);
    if (this.shown && this.isConnected) this.#timer = window.setTimeout(() => void this.#look(), ms);
  }

  async #look(): Promise<void> {
    if (this.#asking || !this.shown) return;
    this.#asking = true;
    try {
      this.#take(await this.api.variables(this.name));
      if (this.moment === null && (this.running || this.#changed.size > 0)) this.#soon(LOOK_MS);
    } catch {
      // The banner says that the device is lost; when it is back, something else asks.
      this.#soon(4 * LOOK_MS);
    } finally {
      this.#asking = false;
    }
  }

  #take(values: Record<string, Value>): void {
    const now = performance.now();
    const changed = Object.entries(values).flatMap(([id, value]) => {
      const from = this.values[id];
      return from === undefined || from === value ? [] : [[id, { at: now, from }] as const];
    });
    // What a step has changed stays marked until another one changes something.
    const held = this.moment !== null;
    for (const [id, { at }] of this.#changed) {
      if (held ? changed.length > 0 : now - at > MARKED_MS) this.#changed.delete(id);
    }
    for (const [id, change] of changed) this.#changed.set(id, change);
    this.values = values;
  }

  async #set(id: string, field: HTMLInputElement): Promise<void> {
    const value = parseWhole(field.value);
    if (value === null) {
      say(`${id}: whole numbers only.`, "error");
      field.value = String(this.values[id] ?? "");
      return;
    }
    if (value !== this.values[id]) await attempt(() => this.api.setParameter(this.name, id, value));
    this.#soon(0);
  }

  override render() {
    const shown = Object.entries(this.values)
      .filter(([id, value]) => !this.only || value !== 0 || this.#changed.has(id))
      .sort(([a], [b]) => order.compare(a, b));
    return html`
      <div class="row">
        <h2 class="grow">Variables</h2>
        <label class="line">
          <input
            type="checkbox"
            .checked=${this.only}
            @change=${(event: Event) => (this.only = (event.target as HTMLInputElement).checked)}
          />not zero
        </label>
        <button class="small" @click=${() => this.#soon(0)}>Read</button>
      </div>
      <div class="list">
        <table aria-label="Variables">
          <tbody>
            ${repeat(shown, ([id]) => id, ([id, value]) => this.#row(id, value))}
          </tbody>
        </table>
        ${shown.length === 0 ? html`<p class="muted">${this.only ? "All are zero." : nothing}</p>` : nothing}
      </div>
    `;
  }

  #row(id: string, value: Value) {
    const change = this.#changed.get(id);
    return html`
      <tr class=${change ? "changed" : ""}>
        <td><code>${id}</code></td>
        <td class="from">${change ? html`<span title="before">${change.from} →</span>` : nothing}</td>
        <td>
          <input
            aria-label=${id}
            autocomplete="off"
            .value=${String(value)}
            ?readonly=${!this.usable}
            @change=${(event: Event) => this.#set(id, event.target as HTMLInputElement)}
          />
        </td>
      </tr>
    `;
  }
}
customElements.define("pt-variables", Variables);
