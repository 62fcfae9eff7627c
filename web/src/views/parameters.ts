// Parameters: every one of the model's table, with its range, unit, default and meaning.

import { css, html, nothing, type PropertyValues } from "lit";
import { repeat } from "lit/directives/repeat.js";
import { reason } from "../api/client.ts";
import type { ParameterInfo, Value } from "../api/contract.ts";
import { type Change, changes, MAX_BYTES, type ParameterFile, read, write } from "../parameters/file.ts";
import { parse, range, shown } from "../parameters/value.ts";
import { open, save } from "../tools/files.ts";
import { confirm } from "../ui/dialog.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import { Tab } from "./tab.ts";

/** What can be asked to be seen alone. */
type Only = "all" | "changed" | "unstored" | "edited";

/** A file that was opened, and what writing it would change. */
interface Comparison {
  name: string;
  file: ParameterFile;
  changes: Change[];
}

class Parameters extends Tab {
  static override properties = {
    ...Tab.properties,
    values: { state: true },
    words: { state: true },
    group: { state: true },
    only: { state: true },
    busy: { state: true },
    comparison: { state: true },
  };
  /** As they were read last; empty before. */
  declare values: Record<string, Value>;
  declare words: string;
  declare group: string;
  declare only: Only;
  /** What is being done, while it is. */
  declare busy: string | null;
  declare comparison: Comparison | null;

  /** What was typed and not yet written, by id. */
  readonly #edits = new Map<string, string>();
  /** Why something typed was not written. */
  readonly #problems = new Map<string, string>();
  /** Written by this page since it last stored. */
  readonly #unstored = new Set<string>();
  #asked = false;

  static override styles = [
    base,
    css`
      .row > select {
        width: auto;
        max-width: 100%;
      }
      .tools {
        position: sticky;
        top: 46px;
        z-index: 2;
        margin-bottom: var(--gap);
      }
      input[type="search"] {
        flex: 1 1 14em;
        width: auto;
      }
      section {
        margin-bottom: var(--gap);
      }
      h2 {
        margin: 0 0 4px;
        font-size: 15px;
      }
      td {
        vertical-align: top;
      }
      td.value {
        width: 210px;
        white-space: nowrap;
      }
      td.value input {
        width: 130px;
        text-align: right;
        font-variant-numeric: tabular-nums;
      }
      td.value input.text {
        text-align: left;
      }
      td.value .problem {
        white-space: normal;
        font-size: 12px;
      }
      td.id {
        width: 110px;
      }
      td.range {
        width: 150px;
      }
      td.default {
        width: 90px;
      }
      td.marks {
        width: 150px;
      }
      td.section {
        width: 60px;
      }
      tr.edited {
        background: var(--busy-bg);
      }
      .what {
        color: var(--muted);
        font-size: 12.5px;
      }
      .diff {
        max-height: 50dvh;
        overflow: auto;
      }
      @media (max-width: 900px) {
        .wide {
          display: none;
        }
        td.value {
          width: auto;
          white-space: normal;
        }
        .tools {
          position: static;
        }
      }
      @media (max-width: 600px) {
        section thead {
          display: none;
        }
        section tr {
          display: grid;
          grid-template-columns: 1fr auto;
          border-bottom: 1px solid var(--line);
        }
        section td {
          width: auto;
          border: 0;
        }
        td.name,
        td.value {
          grid-column: 1 / 3;
        }
        td.marks {
          grid-area: 1 / 2;
        }
      }
    `,
  ];

  constructor() {
    super();
    this.values = {};
    this.words = "";
    this.group = "";
    this.only = "all";
    this.busy = null;
    this.comparison = null;
  }

  override willUpdate(changed: PropertyValues): void {
    super.willUpdate(changed);
    if (this.active && this.reachable && !this.#asked) {
      this.#asked = true;
      void this.#read();
    }
  }

  /** Does something that takes its time; only one thing at once. */
  async #work(name: string, work: () => Promise<unknown>, done?: string): Promise<boolean> {
    if (this.busy !== null) return false;
    this.busy = name;
    const went = await attempt(work, done);
    this.busy = null;
    return went;
  }

  #read(): Promise<boolean> {
    return this.#work("Reading…", () => this.#fetch());
  }

  async #fetch(): Promise<void> {
    this.values = await this.api.parameters(this.device.name);
  }

  /** Writes some, one after the other, and reads all: what a write changes besides itself is seen too. */
  #write(wanted: ReadonlyMap<ParameterInfo, Value>): Promise<boolean> {
    return this.#work("Writing…", async () => {
      let failed = 0;
      for (const [info, value] of wanted) {
        try {
          await this.api.setParameter(this.device.name, info.id, value);
          this.#edits.delete(info.id);
          this.#problems.delete(info.id);
          if (info.stored) this.#unstored.add(info.id);
        } catch (error) {
          failed += 1;
          this.#edits.set(info.id, shown(info, value));
          this.#problems.set(info.id, reason(error));
        }
      }
      await this.#fetch();
      if (failed > 0) throw new Error(`${failed} of ${wanted.size} parameters were not taken; they are marked.`);
      say(wanted.size === 1 ? "Written" : `${wanted.size} parameters written`);
    });
  }

  #edit(info: ParameterInfo, text: string): void {
    const value = this.values[info.id];
    if (value !== undefined && text === shown(info, value)) this.#forget(info);
    else {
      this.#edits.set(info.id, text);
      const entered = parse(info, text);
      if (entered.ok) this.#problems.delete(info.id);
      else this.#problems.set(info.id, entered.problem);
    }
    this.requestUpdate();
  }

  #forget(info: ParameterInfo): void {
    this.#edits.delete(info.id);
    this.#problems.delete(info.id);
    this.requestUpdate();
  }

  /** What was typed and may be written. */
  #wanted(infos: readonly ParameterInfo[]): Map<ParameterInfo, Value> {
    const wanted = new Map<ParameterInfo, Value>();
    for (const info of infos) {
      const text = this.#edits.get(info.id);
      const entered = text === undefined ? null : parse(info, text);
      if (entered?.ok) wanted.set(info, entered.value);
    }
    return wanted;
  }

  #key(event: KeyboardEvent, info: ParameterInfo): void {
    if (event.key === "Enter") {
      const wanted = this.#wanted([info]);
      if (wanted.size > 0 && this.usable) void this.#write(wanted);
    }
    if (event.key === "Escape") {
      this.#forget(info);
      const value = this.values[info.id];
      (event.target as HTMLInputElement).value = value === undefined ? "" : shown(info, value);
    }
  }

  async #store(): Promise<void> {
    const stored = await this.#work("Storing…", () => this.api.storeParameters(this.device.name), "Stored");
    if (stored) this.#unstored.clear();
    this.requestUpdate();
  }

  async #restore(): Promise<void> {
    const agreed = await confirm({
      heading: "Restore factory settings?",
      text: `Every parameter of ${this.device.name} goes back to its default, stored ones too. This cannot be undone.`,
      yes: "Restore",
      danger: true,
    });
    if (!agreed) return;
    await this.#work(
      "Restoring…",
      async () => {
        await this.api.restoreFactory(this.device.name);
        for (const kept of [this.#edits, this.#problems, this.#unstored]) kept.clear();
        await this.#fetch();
      },
      "Factory settings restored",
    );
  }

  async #save(): Promise<void> {
    await this.#work("Reading…", async () => {
      await this.#fetch();
      const now = new Date();
      const name = `${this.device.name}-${now.toISOString().slice(0, 10)}.json`;
      save(name, write(this.catalog, this.device.name, this.values, now), "application/json");
    });
  }

  async #load(): Promise<void> {
    await attempt(async () => {
      const opened = await open(".json,application/json", MAX_BYTES);
      if (opened === null) return;
      const file = read(this.catalog, opened.text);
      if (typeof file === "string") throw new Error(file);
      await this.#fetch();
      this.comparison = { name: opened.name, file, changes: changes(this.catalog, file.values, this.values) };
    });
  }

  async #take(list: readonly Change[]): Promise<void> {
    this.comparison = null;
    await this.#write(new Map(list.map(({ info, to }) => [info, to])));
  }

  #differs(info: ParameterInfo): boolean {
    const value = this.values[info.id];
    return info.is_setting && info.default !== null && value !== undefined && value !== info.default;
  }

  #visible(): ParameterInfo[] {
    const words = this.words.toLowerCase().split(/\s+/).filter(Boolean);
    return this.catalog.parameters.filter((info) => {
      if (this.group !== "" && groupOf(info) !== this.group) return false;
      if (this.only === "changed" && !this.#differs(info)) return false;
      if (this.only === "unstored" && !this.#unstored.has(info.id)) return false;
      if (this.only === "edited" && !this.#edits.has(info.id)) return false;
      const text = `${info.id} ${info.symbol} ${info.name} ${info.text} ${info.unit} ${groupOf(info)}`.toLowerCase();
      return words.every((word) => text.includes(word));
    });
  }

  override render() {
    const visible = this.#visible();
    const groups = new Map<string, ParameterInfo[]>();
    for (const info of visible) groups.set(groupOf(info), [...(groups.get(groupOf(info)) ?? []), info]);
    return html`
      ${this.#toolbar(visible.length)}
      ${[...groups].map(([group, infos]) => this.#group(group, infos))}
      ${visible.length === 0 ? html`<p class="muted">No parameter fits.</p>` : nothing} ${this.#dialog()}
    `;
  }

  #toolbar(count: number) {
    const wanted = this.#wanted(this.catalog.parameters);
    const idle = this.busy === null && this.reachable;
    const groups = [...new Set(this.catalog.parameters.map(groupOf))];
    return html`
      <div class="panel stack tools">
        <div class="row">
          <input
            type="search"
            aria-label="Search parameters"
            placeholder="Search: number, name, words"
            .value=${this.words}
            @input=${(event: InputEvent) => (this.words = (event.target as HTMLInputElement).value)}
          />
          <select aria-label="Group" @change=${(event: Event) => (this.group = (event.target as HTMLSelectElement).value)}>
            <option value="">all groups</option>
            ${groups.map((group) => html`<option value=${group} ?selected=${group === this.group}>${group}</option>`)}
          </select>
          <select
            aria-label="Which"
            @change=${(event: Event) => (this.only = (event.target as HTMLSelectElement).value as Only)}
          >
            <option value="all">all</option>
            <option value="changed">not default</option>
            <option value="unstored">written, not stored</option>
            <option value="edited">typed, not written</option>
          </select>
          <span class="muted">${count} of ${this.catalog.parameters.length}</span>
          <span role="status">${this.busy ?? nothing}</span>
        </div>
        <div class="row">
          <button ?disabled=${!idle} @click=${() => this.#read()}>Read all</button>
          <button class="primary" ?disabled=${!idle || !this.usable || wanted.size === 0} @click=${() => this.#write(wanted)}>
            Write${wanted.size > 0 ? ` ${wanted.size}` : ""}
          </button>
          <button ?disabled=${!idle} @click=${() => this.#save()}>Save to file</button>
          <button ?disabled=${!idle || !this.usable} @click=${() => this.#load()}>Load from file</button>
          <span class="grow"></span>
          <button ?disabled=${!idle || !this.usable} @click=${() => this.#store()}>
            Store${this.#unstored.size > 0 ? html` <span class="badge warn">${this.#unstored.size}</span>` : nothing}
          </button>
          <button class="danger" ?disabled=${!idle || !this.usable} @click=${() => this.#restore()}>
            Factory settings
          </button>
        </div>
      </div>
    `;
  }

  #group(group: string, infos: readonly ParameterInfo[]) {
    return html`
      <section class="panel" aria-label=${group}>
        <h2>${group}</h2>
        <table aria-label="Parameters, ${group}">
          <thead>
            <tr>
              <th>Number</th>
              <th>Parameter</th>
              <th>Value</th>
              <th class="wide">Range</th>
              <th class="wide">Default</th>
              <th></th>
              <th class="wide">Manual</th>
            </tr>
          </thead>
          <tbody>
            ${repeat(infos, ({ id }) => id, (info) => this.#row(info))}
          </tbody>
        </table>
      </section>
    `;
  }

  #row(info: ParameterInfo) {
    const edit = this.#edits.get(info.id);
    return html`
      <tr class=${edit === undefined ? "" : "edited"}>
        <td class="id"><code>${info.id}</code></td>
        <td class="name">
          ${info.name}
          <div class="what">${info.text}${info.symbol ? html` <code class="wide">${info.symbol}</code>` : nothing}</div>
        </td>
        <td class="value">${this.#field(info, edit)}</td>
        <td class="range wide">${range(info)}</td>
        <td class="default wide">${info.default === null ? nothing : shown(info, info.default)}</td>
        <td class="marks">
          ${this.#differs(info) ? html`<span class="badge busy">not default</span>` : nothing}
          ${this.#unstored.has(info.id) ? html`<span class="badge warn">not stored</span>` : nothing}
          ${info.stored && !this.#unstored.has(info.id)
            ? html`<span class="badge" title="Kept when the power goes, once it is stored">stored</span>`
            : nothing}
        </td>
        <td class="section wide muted">${info.section}</td>
      </tr>
    `;
  }

  #field(info: ParameterInfo, edit: string | undefined) {
    const value = this.values[info.id];
    const text = edit ?? (value === undefined ? "" : shown(info, value));
    const problem = this.#problems.get(info.id);
    const unit = info.unit ? html` <span class="muted">${info.unit}</span>` : nothing;
    if (!info.writable) return html`<span class="mono">${text === "" ? "–" : text}</span>${unit}`;
    return html`
      <input
        class=${info.is_text ? "text" : ""}
        aria-label="${info.name} ${info.id}"
        aria-invalid=${problem === undefined ? "false" : "true"}
        spellcheck="false"
        autocomplete="off"
        placeholder=${info.readable ? "" : "write only"}
        .value=${text}
        ?readonly=${!this.usable}
        @input=${(event: InputEvent) => this.#edit(info, (event.target as HTMLInputElement).value)}
        @keydown=${(event: KeyboardEvent) => this.#key(event, info)}
      />${unit} ${problem === undefined ? nothing : html`<div class="problem error-text" role="alert">${problem}</div>`}
    `;
  }

  #dialog() {
    const { name, file, changes: list } = this.comparison ?? {};
    if (name === undefined || file === undefined || list === undefined) return nothing;
    return html`
      <pt-dialog wide heading="Parameters of ${name}" .open=${true} @close=${() => (this.comparison = null)}>
        <p class="muted">Saved of ${file.device || "a controller"} ${file.date ? `on ${file.date.slice(0, 16).replace("T", " ")} UTC` : ""}.</p>
        <div class="diff">
          ${list.length === 0 ? html`<p>The controller has all of these values already.</p>` : this.#table(list)}
          ${file.problems.map((problem) => html`<p class="warn-text">${problem}</p>`)}
        </div>
        <button slot="actions" @click=${() => (this.comparison = null)}>Cancel</button>
        ${list.length === 0
          ? nothing
          : html`<button slot="actions" class="primary" @click=${() => this.#take(list)}>
              Write ${list.length === 1 ? "1 change" : `${list.length} changes`}
            </button>`}
      </pt-dialog>
    `;
  }

  #table(list: readonly Change[]) {
    return html`
      <table aria-label="Changes">
        <thead>
          <tr>
            <th>Number</th>
            <th>Parameter</th>
            <th class="number">Now</th>
            <th class="number">In the file</th>
            <th>Unit</th>
          </tr>
        </thead>
        <tbody>
          ${list.map(
            ({ info, from, to }) => html`
              <tr>
                <td><code>${info.id}</code></td>
                <td>${info.name}</td>
                <td class="number">${from === undefined ? "–" : shown(info, from)}</td>
                <td class="number"><strong>${shown(info, to)}</strong></td>
                <td class="muted">${info.unit}</td>
              </tr>
            `,
          )}
        </tbody>
      </table>
    `;
  }
}
customElements.define("pt-parameters", Parameters);

/** A heading of the list: the group, and the axis where there are several. */
function groupOf({ group, axis }: ParameterInfo): string {
  return axis === null ? group : `${group} ${axis}`;
}
