// Terminal: a command line with history, completion and help, and everything that goes over the wire.

import { css, html, nothing } from "lit";
import { reason } from "../api/client.ts";
import type { Answer, CommandInfo, Traffic } from "../api/contract.ts";
import type { LiveEvent } from "../state/live.ts";
import { about, proposals } from "../terminal/complete.ts";
import { History } from "../terminal/history.ts";
import { csv, filtered, type Filter } from "../terminal/traffic.ts";
import { save } from "../tools/files.ts";
import { base } from "../ui/styles.ts";
import { Tab } from "./tab.ts";

/** Answers that are kept, and lines of traffic that are drawn. */
const MAX_ANSWERS = 500;
const MAX_DRAWN = 200;

/** A line that was sent and what came back; no answer yet, or the reason why there is none. */
interface Exchange {
  line: string;
  answer: Answer | null;
  problem: string | null;
}

class Terminal extends Tab {
  static override properties = {
    ...Tab.properties,
    typed: { state: true },
    exchanges: { state: true },
    hex: { state: true },
    filter: { state: true },
    paused: { state: true },
  };
  declare typed: string;
  declare exchanges: Exchange[];
  declare hex: boolean;
  declare filter: Filter;
  /** The traffic as it was when it was paused. */
  declare paused: Traffic[] | null;

  protected override readonly watches: readonly LiveEvent[] = ["traffic"];
  #history: History | null = null;
  /** What Tab goes round in, and where it is. */
  #round: { names: string[]; at: number } | null = null;

  static override styles = [
    base,
    css`
      .row > select {
        width: auto;
        max-width: 100%;
      }
      .columns {
        display: grid;
        grid-template-columns: minmax(0, 1fr) minmax(0, 1fr);
        gap: var(--gap);
      }
      .panel {
        display: flex;
        flex-direction: column;
        gap: 8px;
        height: calc(100dvh - 150px);
        min-height: 420px;
      }
      .log,
      .table {
        flex: 1 1 0;
        min-height: 0;
        overflow: auto;
        border: 1px solid var(--line);
        border-radius: var(--radius);
        background: var(--bg);
      }
      .log {
        padding: 8px 10px;
        font-family: var(--mono);
        font-size: 13px;
        overflow-wrap: anywhere;
      }
      .log .sent {
        color: var(--accent);
        margin-top: 4px;
      }
      .log .more {
        color: var(--muted);
        padding-left: 2ch;
      }
      .log .reply {
        padding-left: 2ch;
        white-space: pre-wrap;
      }
      .help {
        max-height: 220px;
        overflow: auto;
        border: 1px solid var(--line);
        border-radius: var(--radius);
      }
      .help button {
        display: grid;
        grid-template-columns: minmax(0, 3fr) minmax(0, 5fr) minmax(0, 2fr) 4em;
        gap: 10px;
        width: 100%;
        min-height: 26px;
        font-size: 13px;
        font-weight: 400;
        text-align: left;
        white-space: normal;
      }
      .line input {
        flex: 1 1 12em;
        font-family: var(--mono);
      }
      .table table {
        table-layout: fixed;
        font-family: var(--mono);
        font-size: 12px;
      }
      .table th {
        position: sticky;
        top: 0;
        background: var(--panel);
      }
      .table td {
        padding: 1px 8px;
        overflow-wrap: anywhere;
      }
      .table .out {
        color: var(--accent);
      }
      .at {
        width: 84px;
      }
      .way {
        width: 42px;
      }
      input.filter {
        width: auto;
        flex: 1 1 10em;
      }
      @media (max-width: 900px) {
        .columns {
          grid-template-columns: minmax(0, 1fr);
        }
        .panel {
          height: 70dvh;
        }
      }
    `,
  ];

  constructor() {
    super();
    this.typed = "";
    this.exchanges = [];
    this.hex = false;
    this.filter = { words: "", direction: "both", polled: false };
    this.paused = null;
  }

  get #key(): string {
    return `terminal ${this.device.name}`;
  }

  get #lines(): History {
    this.#history ??= new History(JSON.parse(sessionStorage.getItem(this.#key) ?? "[]") as string[]);
    return this.#history;
  }

  async #send(event: Event): Promise<void> {
    event.preventDefault();
    const line = this.typed.trim();
    if (line === "") return;
    this.#lines.add(line);
    sessionStorage.setItem(this.#key, JSON.stringify(this.#lines.lines));
    this.#type("");
    const exchange: Exchange = { line, answer: null, problem: null };
    this.exchanges = [...this.exchanges, exchange].slice(-MAX_ANSWERS);
    try {
      exchange.answer = await this.api.terminal(this.device.name, line);
    } catch (error) {
      exchange.problem = reason(error);
    }
    this.requestUpdate();
  }

  #type(line: string): void {
    this.typed = line;
    this.#round = null;
  }

  #keyDown(event: KeyboardEvent): void {
    if (event.key === "ArrowUp" || event.key === "ArrowDown") {
      const line = event.key === "ArrowUp" ? this.#lines.older(this.typed) : this.#lines.newer();
      if (line !== null) this.#type(line);
      event.preventDefault();
    } else if (event.key === "Tab" && this.#turn(event.shiftKey ? -1 : 1)) {
      event.preventDefault();
    }
  }

  /** Puts the next proposal in; false if there is none and Tab may do what it always does. */
  #turn(by: number): boolean {
    const round = this.#round ?? { names: this.#names(), at: by > 0 ? -1 : 0 };
    if (round.names.length === 0 || (round.names.length === 1 && round.names[0] === this.typed)) return false;
    round.at = (round.at + by + round.names.length) % round.names.length;
    this.typed = round.names[round.at] ?? "";
    this.#round = round;
    return true;
  }

  #names(): string[] {
    return [...new Set(proposals(this.catalog.commands, this.typed).map(({ name }) => name))];
  }

  #pick(command: CommandInfo): void {
    this.#type(command.name);
    this.renderRoot.querySelector<HTMLInputElement>("#line")?.focus();
  }

  override updated(): void {
    this.#follow(".log");
    if (this.paused === null) this.#follow(".table");
  }

  /** Keeps the end of a list in sight, unless somebody scrolled away from it. */
  #follow(selector: string): void {
    const list = this.renderRoot.querySelector<HTMLElement>(selector);
    if (!list || list.dataset["away"] === "true") return;
    list.scrollTop = list.scrollHeight;
  }

  #scrolled(event: Event): void {
    const list = event.currentTarget as HTMLElement;
    list.dataset["away"] = String(list.scrollHeight - list.scrollTop - list.clientHeight > 24);
  }

  override render() {
    return html`<div class="columns">${this.#commands()} ${this.#traffic()}</div>`;
  }

  #commands() {
    const tmcl = this.catalog.language === "tmcl";
    return html`
      <section class="panel" aria-label="Command line">
        <div class="row">
          <h2 class="grow">Command line</h2>
          <label class="line"><input type="checkbox" .checked=${this.hex} @change=${this.#toggleHex} />bytes</label>
          <button class="small" @click=${() => (this.exchanges = [])}>Clear</button>
        </div>
        <div class="log" role="log" aria-label="Answers" tabindex="0" @scroll=${this.#scrolled}>
          ${this.exchanges.length === 0
            ? html`<p class="muted">
                ${tmcl ? "Commands as in direct mode: GAP 1, 0. Or nine bytes in hex." : "Commands as on the wire: PX."}
                Arrow keys bring back earlier lines, Tab completes.
              </p>`
            : this.exchanges.map((exchange) => this.#exchange(exchange))}
        </div>
        <div id="help" class="help" role="group" aria-label="Help" ?hidden=${this.typed === ""}>${this.#help()}</div>
        <form class="row line" @submit=${this.#send}>
          <input
            id="line"
            aria-label="Command"
            aria-describedby="help"
            placeholder=${tmcl ? "GAP 1, 0" : "PX"}
            autocomplete="off"
            autocapitalize="characters"
            spellcheck="false"
            maxlength="256"
            .value=${this.typed}
            @input=${(event: InputEvent) => this.#type((event.target as HTMLInputElement).value)}
            @keydown=${this.#keyDown}
          />
          <button class="primary" ?disabled=${!this.reachable}>Send</button>
        </form>
      </section>
    `;
  }

  #toggleHex(event: Event): void {
    this.hex = (event.target as HTMLInputElement).checked;
  }

  #exchange({ line, answer, problem }: Exchange) {
    return html`
      <div class="sent">&gt; ${line}</div>
      ${problem !== null ? html`<div class="reply error-text">${problem}</div>` : nothing}
      ${answer === null
        ? nothing
        : html`
            <div class="reply ${answer.ok ? "" : "error-text"}">${answer.reply}</div>
            ${answer.text !== answer.reply && answer.text !== "" ? html`<div class="more">${answer.text}</div>` : nothing}
            ${this.hex
              ? html`<div class="more">→ ${answer.hex_request}</div>
                  <div class="more">← ${answer.hex_reply}</div>`
              : nothing}
          `}
    `;
  }

  #help() {
    const proposed = proposals(this.catalog.commands, this.typed);
    const commands = proposed.length > 0 ? proposed : about(this.catalog.commands, this.typed);
    if (commands.length === 0) return nothing;
    return commands.map(
      (command) => html`
        <button class="plain" @click=${() => this.#pick(command)}>
          <code>${command.syntax}</code>
          <span>${command.text}${command.unit ? html` <span class="muted">[${command.unit}]</span>` : nothing}</span>
          <code class="muted">${command.example}</code>
          <span class="muted">${command.section}</span>
        </button>
      `,
    );
  }

  #traffic() {
    const shown = filtered(this.paused ?? this.live.traffic, this.filter);
    const drawn = shown.slice(-MAX_DRAWN);
    return html`
      <section class="panel" aria-label="Traffic">
        <div class="row">
          <h2 class="grow">Traffic</h2>
          <button class="small" aria-pressed=${this.paused !== null} @click=${this.#pause}>Pause</button>
          <button class="small" @click=${this.#clear}>Clear</button>
          <button class="small" ?disabled=${shown.length === 0} @click=${() => this.#export(shown)}>Export</button>
        </div>
        <div class="row">
          <input
            class="filter"
            type="search"
            aria-label="Filter"
            placeholder="Filter: words, hex, -without"
            spellcheck="false"
            .value=${this.filter.words}
            @input=${(event: InputEvent) => this.#set({ words: (event.target as HTMLInputElement).value })}
          />
          <select aria-label="Direction" @change=${this.#direction}>
            <option value="both">both ways</option>
            <option value="out">requests</option>
            <option value="in">replies</option>
          </select>
          <label class="line" title="What the page asks to see what the controller is doing">
            <input type="checkbox" .checked=${this.filter.polled}
              @change=${(event: Event) => this.#set({ polled: (event.target as HTMLInputElement).checked })} />polling</label>
          <span class="muted">${shown.length} lines</span>
        </div>
        <div class="table" tabindex="0" role="region" aria-label="Lines of traffic" @scroll=${this.#scrolled}>
          <table aria-label="Requests and replies">
            <thead>
              <tr>
                <th class="at number">s</th>
                <th class="way"></th>
                <th>Bytes</th>
                <th>Words</th>
              </tr>
            </thead>
            <tbody>
              ${drawn.map(
                ({ at, out, hex, text }) => html`
                  <tr class=${out ? "out" : "in"}>
                    <td class="number">${at.toFixed(3)}</td>
                    <td><span aria-hidden="true">${out ? "→" : "←"}</span
                      ><span class="visually-hidden">${out ? "request" : "reply"}</span></td>
                    <td>${hex}</td>
                    <td>${text}</td>
                  </tr>
                `,
              )}
            </tbody>
          </table>
        </div>
      </section>
    `;
  }

  #set(filter: Partial<Filter>): void {
    this.filter = { ...this.filter, ...filter };
  }

  #direction(event: Event): void {
    this.#set({ direction: (event.target as HTMLSelectElement).value as Filter["direction"] });
  }

  #pause(): void {
    this.paused = this.paused === null ? this.live.traffic : null;
  }

  #clear(): void {
    if (this.paused !== null) this.paused = [];
    this.live.clearTraffic();
  }

  #export(traffic: readonly Traffic[]): void {
    save(`${this.device.name}-traffic.csv`, csv(traffic), "text/csv");
  }
}
customElements.define("pt-terminal", Terminal);
