// Adding a controller: a virtual one from a bench file, a real one by serial port or TCP.

import { LitElement, css, html, nothing } from "lit";
import { type Api, reason } from "../api/client.ts";
import type { Found } from "../api/contract.ts";
import { parseWhole } from "../state/format.ts";
import { base } from "../ui/styles.ts";
import { say } from "../ui/toast.ts";

const EXAMPLE = `[[device]]
model = "pmx-2ed"
name = "stage"
listen = ["tcp:127.0.0.1:0"]
[device.axis.X]
negative_limit = -20000
positive_limit = 100000
home = [-200, 0]
`;

class Add extends LitElement {
  static override properties = {
    api: { attribute: false },
    kind: { attribute: false },
    problem: { state: true },
    busy: { state: true },
    models: { state: true },
    ports: { state: true },
    found: { state: true },
    link: { state: true },
    model: { state: true },
  };
  declare api: Api;
  declare kind: "bench" | "real" | null;
  declare problem: string | null;
  declare busy: boolean;
  declare models: { model: string; title: string }[];
  declare ports: string[];
  declare found: Found[] | null;
  declare link: "serial" | "tcp";
  declare model: string;

  static override styles = [
    base,
    css`
      .two {
        display: grid;
        grid-template-columns: 1fr 1fr;
        gap: 10px;
      }
      pre {
        margin: 0;
        white-space: pre-wrap;
        font: 12px/1.5 var(--mono);
      }
    `,
  ];

  constructor() {
    super();
    this.kind = null;
    this.problem = null;
    this.busy = false;
    this.models = [];
    this.ports = [];
    this.found = null;
    this.link = "serial";
    this.model = "";
  }

  override willUpdate(changed: Map<string, unknown>): void {
    if (changed.has("kind") && this.kind !== null) {
      this.problem = null;
      this.found = null;
      if (this.kind === "real") void this.#prepare();
    }
  }

  async #prepare(): Promise<void> {
    try {
      [this.models, this.ports] = await Promise.all([
        this.api.get<{ model: string; title: string }[]>("/api/models"),
        this.api.serialPorts(),
      ]);
      this.model ||= this.models[0]?.model ?? "";
    } catch (error) {
      this.problem = reason(error);
    }
  }

  override render() {
    return html`
      <pt-dialog wide .heading=${"Add virtual controllers"} .open=${this.kind === "bench"} @close=${this.#close}>
        ${this.#bench()}
      </pt-dialog>
      <pt-dialog .heading=${"Connect a real controller"} .open=${this.kind === "real"} @close=${this.#close}>
        ${this.#real()}
      </pt-dialog>
    `;
  }

  #close(): void {
    this.kind = null;
    this.dispatchEvent(new Event("close"));
  }

  #problem() {
    return this.problem ? html`<pre class="error-text" role="alert">${this.problem}</pre>` : nothing;
  }

  #bench() {
    return html`
      <form class="stack" @submit=${this.#addBench}>
        <p class="muted">A bench file says which controllers there are and what machine stands behind their pins.</p>
        <label>Bench file (TOML)
          <textarea name="bench" rows="12" spellcheck="false" required .defaultValue=${EXAMPLE}></textarea>
        </label>
        <label>Or from disk <input type="file" accept=".toml,text/plain" @change=${this.#openFile} /></label>
        ${this.#problem()}
        <div class="row"><span class="grow"></span>
          <button class="primary" ?disabled=${this.busy}>Add</button>
        </div>
      </form>
    `;
  }

  async #openFile(event: Event): Promise<void> {
    const file = (event.target as HTMLInputElement).files?.[0];
    if (!file) return;
    this.renderRoot.querySelector<HTMLTextAreaElement>("textarea[name=bench]")!.value = await file.text();
  }

  async #addBench(event: SubmitEvent): Promise<void> {
    event.preventDefault();
    const bench = String(new FormData(event.target as HTMLFormElement).get("bench"));
    await this.#do(() => this.api.addBench(bench), "Added");
  }

  #real() {
    const tmcl = this.model.startsWith("pd42");
    return html`
      <form class="stack" @submit=${this.#addReal}>
        <div class="two">
          <label>Name <input name="name" type="text" required maxlength="40" value="machine" /></label>
          <label>Model
            <select name="model" @change=${(event: Event) => (this.model = (event.target as HTMLSelectElement).value)}>
              ${this.models.map(({ model, title }) => html`
                <option value=${model} ?selected=${model === this.model}>${title}</option>`)}
            </select>
          </label>
        </div>
        <div class="row" role="radiogroup" aria-label="Way to the controller">
          ${(["serial", "tcp"] as const).map((way) => html`
            <label class="line">
              <input type="radio" name="way" .checked=${this.link === way} @change=${() => (this.link = way)} />
              ${way === "serial" ? "Serial port" : "TCP"}
            </label>`)}
        </div>
        ${this.link === "serial" ? html`
          <div class="two">
            <label>Port
              <input name="port" type="text" list="ports" required placeholder="/dev/ttyUSB0" value=${this.ports[0] ?? ""} />
              <datalist id="ports">${this.ports.map((port) => html`<option value=${port}></option>`)}</datalist>
            </label>
            <label>Bits a second
              <select name="baud">
                ${[9600, 19200, 38400, 57600, 115200].map((baud) => html`<option>${baud}</option>`)}
              </select>
            </label>
          </div>
          <p class="muted">${this.ports.length === 0 ? "The server sees no serial port." : nothing}</p>` : html`
          <label>Host and port <input name="host" type="text" required placeholder="192.168.0.10:4001" /></label>`}
        <div class="row end">
          <label class="grow">${tmcl ? "Module address" : "RS-485 address, empty on a line of its own"}
            <input name="address" type="text" inputmode="numeric" placeholder=${tmcl ? "1" : ""} />
          </label>
          <button type="button" ?disabled=${this.busy} @click=${this.#search}>
            ${this.busy ? "Searching…" : "Search the bus"}
          </button>
        </div>
        ${this.found ? this.#answers(this.found) : nothing}
        ${this.#problem()}
        <div class="row"><span class="grow"></span>
          <button class="primary" ?disabled=${this.busy}>Connect</button>
        </div>
      </form>
    `;
  }

  #answers(found: Found[]) {
    if (found.length === 0) {
      return html`<p role="status">Nothing answered: look at the supply, the wires and the speed of the port.</p>`;
    }
    return html`
      <table aria-label="What answered">
        <thead><tr><th class="number">Address</th><th>Model</th><th>Version</th><th></th></tr></thead>
        <tbody>
          ${found.map((one) => html`
            <tr>
              <td class="number">${one.address}</td><td>${one.model ?? "unknown"}</td><td>${one.version}</td>
              <td><button type="button" class="small" @click=${() => this.#choose(one)}>Use</button></td>
            </tr>`)}
        </tbody>
      </table>
    `;
  }

  #choose(one: Found): void {
    this.renderRoot.querySelector<HTMLInputElement>("input[name=address]")!.value = String(one.address);
    if (one.model) this.model = one.model;
  }

  #linkOf(form: HTMLFormElement): string {
    const data = new FormData(form);
    if (this.link === "tcp") return `tcp:${String(data.get("host")).trim()}`;
    return `serial:${String(data.get("port")).trim()}:${String(data.get("baud"))}`;
  }

  async #search(event: Event): Promise<void> {
    const form = (event.target as HTMLElement).closest("form")!;
    this.busy = true;
    this.problem = null;
    try {
      this.found = await this.api.find(this.#linkOf(form));
    } catch (error) {
      this.problem = reason(error);
    }
    this.busy = false;
  }

  async #addReal(event: SubmitEvent): Promise<void> {
    event.preventDefault();
    const form = event.target as HTMLFormElement;
    const data = new FormData(form);
    const typed = String(data.get("address")).trim();
    const address = typed === "" ? null : parseWhole(typed);
    if (typed !== "" && address === null) {
      this.problem = "The address is a number.";
      return;
    }
    const real = {
      name: String(data.get("name")).trim(),
      model: String(data.get("model")),
      link: this.#linkOf(form),
      ...(address === null ? {} : { address }),
    };
    await this.#do(() => this.api.addReal(real), "Connected");
  }

  async #do(work: () => Promise<unknown>, done: string): Promise<void> {
    this.busy = true;
    this.problem = null;
    try {
      await work();
      say(done);
      this.dispatchEvent(new Event("done"));
    } catch (error) {
      this.problem = reason(error);
    }
    this.busy = false;
  }
}
customElements.define("pt-add", Add);
