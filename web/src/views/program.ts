// Program: the editor, the compiler, the controller's program memory, and the programs that run.

import { css, html, nothing, type PropertyValues } from "lit";
import { createRef, ref } from "lit/directives/ref.js";
import type { Compiled, Diagnostic } from "../api/contract.ts";
import { type Draft, keep, load } from "../program/draft.ts";
import { Editor, EXTENSIONS } from "../program/editor.ts";
import { examples } from "../program/examples.ts";
import { addressOf, breakable, lineAt } from "../program/lines.ts";
import type { Present } from "../program/present.ts";
import type { ThreadEvent } from "../program/threads.ts";
import type { LiveEvent } from "../state/live.ts";
import { open, save } from "../tools/files.ts";
import { confirm } from "../ui/dialog.ts";
import { base } from "../ui/styles.ts";
import { attempt, say } from "../ui/toast.ts";
import "../program/threads.ts";
import "../program/variables.ts";
import { Tab } from "./tab.ts";

/** The longest source that is opened. */
const MAX_BYTES = 256 * 1024;
/** After the last key until the draft is kept. */
const KEEP_MS = 500;
/** Steps a second of an animation. */
const PACES = [1, 2, 5, 10];

/** What is shown below the editor. */
type Below = "messages" | "listing" | "symbols";

class Program extends Tab {
  static override properties = {
    ...Tab.properties,
    name: { state: true },
    compiled: { state: true },
    below: { state: true },
    busy: { state: true },
    server: { state: true },
    stale: { state: true },
    pace: { state: true },
    animated: { state: true },
  };
  /** The file's name. */
  declare name: string;
  /** What the compiler last said. */
  declare compiled: Compiled | null;
  declare below: Below;
  declare busy: string | null;
  /** Whether the language server is there. */
  declare server: boolean;
  /** Whether the text is another than the controller's. */
  declare stale: boolean;
  declare pace: number;
  /** Whether steps are made by themselves. */
  declare animated: boolean;

  protected override readonly watches: readonly LiveEvent[] = ["status", "debug"];
  readonly #place = createRef<HTMLElement>();
  #editor: Editor | null = null;
  /** What the controller has in its memory, as far as this page knows, and how it was compiled. */
  #downloaded: string | null = null;
  #loaded: Compiled | null = null;
  #keeping = 0;
  #stepping = 0;
  /** Of the breakpoints last sent, and of the lines last marked. */
  #sent = "";
  #marked = "";

  static override styles = [
    base,
    css`
      .row > select {
        width: auto;
        max-width: 100%;
      }
      .columns {
        display: grid;
        grid-template-columns: minmax(0, 1fr) 300px;
        gap: var(--gap);
        align-items: start;
      }
      .editor {
        height: max(300px, calc(100dvh - 480px));
        border: 1px solid var(--line);
        border-radius: var(--radius);
        overflow: hidden;
      }
      input.file {
        width: 13em;
      }
      .below {
        height: 150px;
        overflow: auto;
      }
      .below pre {
        margin: 0;
        font-family: var(--mono);
        font-size: 12.5px;
      }
      .below button.message {
        display: flex;
        justify-content: flex-start;
        width: 100%;
        white-space: normal;
        text-align: left;
        font-weight: 400;
      }
      @media (max-width: 900px) {
        .columns {
          grid-template-columns: minmax(0, 1fr);
        }
        .editor {
          height: 55dvh;
        }
      }
    `,
  ];

  constructor() {
    super();
    this.name = "";
    this.compiled = null;
    this.below = "messages";
    this.busy = null;
    this.server = false;
    this.stale = true;
    this.pace = 2;
    this.animated = false;
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.#keeping);
    clearTimeout(this.#stepping);
    this.#editor?.close();
    this.#editor = null;
  }

  override willUpdate(changed: PropertyValues): void {
    super.willUpdate(changed);
    if (this.animated && !this.active) this.animated = false;
  }

  override firstUpdated(): void {
    const draft = load(this.device.name) ?? { name: this.#untitled, text: "", downloaded: null };
    this.name = draft.name;
    this.#downloaded = draft.downloaded;
    this.#editor = new Editor(this.#place.value!, this.catalog, draft.text, {
      socket: () => this.api.socket("/api/lsp", { model: this.device.model }),
      changed: () => this.#changed(),
      toggle: this.#virtual ? (line) => this.#toggle(line) : null,
      server: (up) => (this.server = up),
    });
    this.#compare();
    void this.#reload();
  }

  override updated(): void {
    this.#show();
    if (!this.animated) clearTimeout(this.#stepping);
  }

  get #untitled(): string {
    return `program${EXTENSIONS[this.catalog.language]}`;
  }

  get #virtual(): boolean {
    return this.device.kind === "virtual";
  }

  /** Whether a program can be made to execute a single line: a virtual one always, of the others TMCL. */
  get #steps(): boolean {
    return this.#virtual || this.catalog.language === "tmcl";
  }

  /** Compiles what the controller was last given, to know its lines again. */
  async #reload(): Promise<void> {
    const text = this.#downloaded;
    if (text === null) return;
    const compiled = await this.api.compile(this.device.name, text).catch(() => null);
    if (this.#downloaded !== text || this.#loaded !== null) return;
    this.#loaded = compiled;
    this.#adopt();
  }

  /** The breakpoints that the device has become those of the editor, if it is its text. */
  #adopt(): void {
    const lines = this.#lines;
    if (lines === null || this.#editor === null) return;
    const held = this.live.debug.breakpoints.map((address) => lineAt(lines, address));
    this.#editor.breakpoints = [...this.#editor.breakpoints, ...held.filter((line) => line !== null)];
    this.requestUpdate();
  }

  // The text

  get #text(): string {
    return this.#editor?.text ?? "";
  }

  #changed(): void {
    this.#compare();
    clearTimeout(this.#keeping);
    this.#keeping = window.setTimeout(() => this.#keep(), KEEP_MS);
  }

  #compare(): void {
    this.stale = this.#text !== this.#downloaded;
  }

  #keep(): void {
    const draft: Draft = { name: this.name, text: this.#text, downloaded: this.#downloaded };
    keep(this.device.name, draft);
  }

  #put(name: string, text: string): void {
    if (this.#editor === null) return;
    this.#editor.text = text;
    this.#editor.breakpoints = [];
    this.name = name;
    this.compiled = null;
    this.#keep();
    void this.#sendBreakpoints();
  }

  async #open(): Promise<void> {
    await attempt(async () => {
      const opened = await open(this.catalog.language === "tmcl" ? ".tmc,.txt" : ".prg,.txt", MAX_BYTES);
      if (opened !== null) this.#put(opened.name, opened.text.replaceAll("\r\n", "\n"));
    });
  }

  #example(event: Event): void {
    const select = event.target as HTMLSelectElement;
    const example = examples(this.device.model).find(({ name }) => name === select.value);
    select.value = "";
    if (example) this.#put(example.name, example.text);
  }

  /** A name of the same file with another end. */
  #named(extension: string): string {
    return this.name.replace(/(\.[^.]*)?$/, extension);
  }

  // The compiler and the controller's memory

  async #work(name: string, work: () => Promise<void>): Promise<void> {
    if (this.busy !== null) return;
    this.busy = name;
    await attempt(work);
    this.busy = null;
  }

  #compile(): Promise<void> {
    return this.#work("Compiling…", async () => {
      this.#told(await this.api.compile(this.device.name, this.#text));
    });
  }

  /** Shows what the compiler says; true if the program is right. */
  #told(compiled: Compiled, quietly = false): boolean {
    this.compiled = compiled;
    const errors = compiled.diagnostics.filter(({ is_error }) => is_error).length;
    if (!compiled.ok) {
      this.below = "messages";
      say(errors === 1 ? "1 error" : `${errors} errors`, "error");
    } else if (!quietly) {
      say(`Compiled: ${this.#size(compiled.size)}`);
    }
    return compiled.ok;
  }

  #size(size: number): string {
    const what = this.catalog.language === "tmcl" ? "commands" : "lines";
    return `${size} of ${this.catalog.program_capacity} ${what}`;
  }

  #download(): Promise<void> {
    return this.#work("Downloading…", async () => {
      const text = this.#text;
      // Errors are shown as the compiler gives them, before anything is sent to the controller.
      if (!this.#told(await this.api.compile(this.device.name, text), true)) return;
      const compiled = await this.api.download(this.device.name, text);
      if (!this.#told(compiled, true)) return;
      this.#has(text, compiled);
      say(`Downloaded: ${this.#size(compiled.size)}`);
    });
  }

  /** The controller has this program now. */
  #has(text: string | null, compiled: Compiled | null): void {
    this.#downloaded = text;
    this.#loaded = compiled;
    this.#compare();
    this.#keep();
    void this.#sendBreakpoints();
  }

  async #upload(): Promise<void> {
    if (this.#text.trim() !== "" && this.stale) {
      const agreed = await confirm({
        heading: "Upload?",
        text: "The controller's program takes the place of the text in the editor.",
        yes: "Upload",
      });
      if (!agreed) return;
    }
    await this.#work("Uploading…", async () => {
      const { source } = await this.api.upload(this.device.name);
      this.#put(this.#untitled, source);
      const compiled = await this.api.compile(this.device.name, source);
      this.compiled = compiled;
      this.#has(source, compiled);
      say("Uploaded");
    });
  }

  async #clear(): Promise<void> {
    const agreed = await confirm({
      heading: "Clear the program memory?",
      text: `The program in ${this.device.name} is gone then. The text in the editor stays.`,
      yes: "Clear",
      danger: true,
    });
    if (!agreed) return;
    await this.#work("Clearing…", async () => {
      await this.api.download(this.device.name, "");
      this.#has(null, null);
      say("Program memory cleared");
    });
  }

  // The programs that run

  async #thread(event: ThreadEvent): Promise<void> {
    await attempt(() => this.api.program(this.device.name, event.program, event.command));
  }

  /** Addresses and lines of the text in the editor, if the controller has it. */
  get #lines(): Compiled["lines"] | null {
    return this.stale || this.#loaded === null ? null : this.#loaded.lines;
  }

  /** Marks the lines at which programs are. */
  #show(): void {
    if (this.#editor === null) return;
    const present = this.#present();
    const mark = JSON.stringify(present);
    if (mark === this.#marked) return;
    this.#marked = mark;
    this.#editor.present = present;
  }

  #present(): Present[] {
    const lines = this.#lines;
    if (lines === null) return [];
    const { held } = this.live.debug;
    const list: Present[] = [];
    this.live.status?.programs.forEach(({ state, counter }, program) => {
      const isHeld = held?.program === program;
      const line = lineAt(lines, isHeld ? held.address : counter);
      if (line === null || (state === "idle" && !isHeld)) return;
      list.push({ line, kind: isHeld || state === "paused" ? "held" : state === "error" ? "error" : "running" });
    });
    return list;
  }

  #toggle(line: number): void {
    if (this.#editor === null) return;
    const lines = this.#lines;
    const at = lines === null ? line : breakable(lines, line);
    if (at === null) return;
    const set = this.#editor.breakpoints;
    this.#editor.breakpoints = set.includes(at) ? set.filter((other) => other !== at) : [...set, at];
    void this.#sendBreakpoints();
    this.requestUpdate();
  }

  /** Tells the device where to hold. Lines of a text that it does not have are told when it has it. */
  async #sendBreakpoints(): Promise<void> {
    const lines = this.#lines;
    if (!this.#virtual || this.#editor === null) return;
    const addresses = lines === null ? [] : this.#editor.breakpoints.map((line) => addressOf(lines, line));
    const wanted = addresses.filter((address) => address !== null);
    if (JSON.stringify(wanted) === this.#sent) return;
    this.#sent = JSON.stringify(wanted);
    await attempt(() => this.api.setBreakpoints(this.device.name, wanted));
  }

  #debug(what: "continue" | "step" | "pause"): Promise<boolean> {
    this.animated = false;
    return attempt(() => this.api.debug(this.device.name, what));
  }

  /** A single line. A program that runs is held at its next line first. */
  async #step(): Promise<void> {
    const { name } = this.device;
    await attempt(async () => {
      if (!this.#virtual) await this.api.program(name, 0, "step");
      else await this.api.debug(name, this.live.debug.held === null ? "pause" : "step");
    });
  }

  #animate(): void {
    this.animated = !this.animated;
    if (this.animated) void this.#tick();
  }

  async #tick(): Promise<void> {
    if (!this.animated || !this.isConnected) return;
    await this.#step();
    this.#stepping = window.setTimeout(() => void this.#tick(), 1000 / this.pace);
  }

  override render() {
    const programs = this.live.status?.programs ?? [];
    const lines = this.#lines;
    const running = programs.some(({ state }) => state === "running");
    const { held } = this.live.debug;
    return html`
      <div class="columns">
        <div class="stack">
          ${this.#fileBar()}
          <div class="editor" ${ref(this.#place)}></div>
          <section class="panel stack" aria-label="Run">
            <pt-threads
              .programs=${programs}
              .lines=${programs.map(({ counter }) => (lines === null ? null : lineAt(lines, counter)))}
              .held=${held?.program ?? null}
              .usable=${this.usable}
              .resets=${this.catalog.language === "tmcl"}
              @thread=${this.#thread}
            ></pt-threads>
            ${this.#steps ? this.#debugBar() : nothing}
          </section>
          ${this.#belowBar()}
        </div>
        <section class="panel" aria-label="Variables">
          <pt-variables
            .api=${this.api}
            .name=${this.device.name}
            .shown=${this.active && this.reachable}
            .running=${running}
            .usable=${this.usable}
            .moment=${held === null ? null : `${held.program} ${held.address} ${this.live.status?.seconds ?? 0}`}
          ></pt-variables>
        </section>
      </div>
    `;
  }

  #fileBar() {
    const ready = this.busy === null && this.reachable;
    const list = examples(this.device.model);
    return html`
      <div class="panel stack">
        <div class="row">
          <input
            class="file"
            aria-label="Name of the file"
            spellcheck="false"
            .value=${this.name}
            @change=${(event: Event) => {
              this.name = (event.target as HTMLInputElement).value || this.#untitled;
              this.#keep();
            }}
          />
          <button @click=${() => this.#put(this.#untitled, "")}>New</button>
          <button @click=${() => this.#open()}>Open</button>
          <button @click=${() => save(this.name, this.#text)}>Save</button>
          <select aria-label="Examples" @change=${this.#example}>
            <option value="">Examples…</option>
            ${list.map(({ name }) => html`<option value=${name}>${name}</option>`)}
          </select>
          <span class="grow"></span>
          <span class="badge ${this.server ? "ok" : "warn"}">${this.server ? "checked as you type" : "no checker"}</span>
        </div>
        <div class="row">
          <button ?disabled=${!this.server} title="Shift-Alt-F" @click=${() => this.#editor?.format()}>Format</button>
          <button ?disabled=${!ready} @click=${() => this.#compile()}>Compile</button>
          <button class="primary" ?disabled=${!ready || !this.usable} @click=${() => this.#download()}>Download</button>
          <button ?disabled=${!ready} @click=${() => this.#upload()}>Upload</button>
          <button class="danger" ?disabled=${!ready || !this.usable} @click=${() => this.#clear()}>Clear memory</button>
          <span role="status">${this.busy ?? nothing}</span>
          <span class="grow"></span>
          <span class="badge ${this.stale ? "warn" : "ok"}">
            ${this.stale ? "not what the controller has" : "as in the controller"}
          </span>
        </div>
      </div>
    `;
  }

  #debugBar() {
    const { held } = this.live.debug;
    return html`
      <div class="row" role="group" aria-label="Debugger">
        <button class="small" ?disabled=${!this.usable} @click=${() => this.#step()}>Step</button>
        ${this.#virtual
          ? html`
              <button class="small" ?disabled=${!this.usable || held !== null} @click=${() => this.#debug("pause")}>
                Hold
              </button>
              <button class="small" ?disabled=${!this.usable || held === null} @click=${() => this.#debug("continue")}>
                Go on
              </button>
            `
          : nothing}
        <button class="small" aria-pressed=${this.animated} ?disabled=${!this.usable} @click=${() => this.#animate()}>
          Animate
        </button>
        <select
          aria-label="Lines a second"
          @change=${(event: Event) => (this.pace = Number((event.target as HTMLSelectElement).value))}
        >
          ${PACES.map((pace) => html`<option value=${pace} ?selected=${pace === this.pace}>${pace} lines/s</option>`)}
        </select>
        ${this.#virtual
          ? html`<span class="muted">
              ${held === null ? "Click left of a line number, or F9, for a breakpoint." : "Held: the controller's time stands still."}
            </span>`
          : nothing}
      </div>
    `;
  }

  #belowBar() {
    const { compiled } = this;
    const tab = (below: Below, title: string) => html`
      <button class="small" aria-pressed=${this.below === below} @click=${() => (this.below = below)}>${title}</button>
    `;
    const text = this.below === "listing" ? compiled?.listing : this.below === "symbols" ? compiled?.symbols : undefined;
    return html`
      <section class="panel stack" aria-label="Compiler">
        <div class="row">
          ${tab("messages", `Messages${compiled ? ` ${compiled.diagnostics.length}` : ""}`)} ${tab("listing", "Listing")}
          ${tab("symbols", "Symbols")}
          <span class="grow"></span>
          ${compiled ? html`<span class="muted">${this.#size(compiled.size)}</span>` : nothing}
          ${text
            ? html`<button class="small" @click=${() => save(this.#named(this.below === "listing" ? ".lst" : ".sym"), text)}>
                Save
              </button>`
            : nothing}
        </div>
        <div class="below" tabindex="0" role="region" aria-label="Output of the compiler">
          ${compiled === null
            ? html`<p class="muted">Nothing was compiled yet.</p>`
            : this.below === "messages"
              ? this.#messages(compiled.diagnostics)
              : html`<pre>${text}</pre>`}
        </div>
      </section>
    `;
  }

  #messages(diagnostics: readonly Diagnostic[]) {
    if (diagnostics.length === 0) return html`<p class="muted">No errors and no warnings.</p>`;
    return diagnostics.map(
      ({ line, column, message, is_error }) => html`
        <button class="plain small message" @click=${() => this.#editor?.goTo(line, column)}>
          <span class="badge ${is_error ? "error" : "warn"}">${is_error ? "error" : "warning"}</span>
          <span class="muted">${line}:${column}</span> ${message}
        </button>
      `,
    );
  }
}
customElements.define("pt-program", Program);
