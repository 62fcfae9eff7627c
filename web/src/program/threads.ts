// The programs that a controller runs at once: their states, the lines at which they are, and their buttons.

import { LitElement, css, html, nothing } from "lit";
import type { ProgramStatus } from "../api/contract.ts";
import { base } from "../ui/styles.ts";

/** What a button asks for. */
export type Command = "run" | "stop" | "pause" | "continue" | "reset";

/** Which program, and what it is to do. */
export class ThreadEvent extends Event {
  readonly program: number;
  readonly command: Command;

  constructor(program: number, command: Command) {
    super("thread");
    this.program = program;
    this.command = command;
  }
}

const STATES: Record<ProgramStatus["state"], string> = { idle: "", running: "ok", paused: "warn", error: "error" };

/** `<pt-threads>`: dispatches `ThreadEvent`s. */
class Threads extends LitElement {
  static override properties = {
    programs: { attribute: false },
    lines: { attribute: false },
    held: { attribute: false },
    usable: { type: Boolean },
    resets: { type: Boolean },
  };
  declare programs: readonly ProgramStatus[];
  /** The line of the source at which each is, where that is known. */
  declare lines: readonly (number | null)[];
  /** The program that is held at a breakpoint. */
  declare held: number | null;
  declare usable: boolean;
  /** Whether a stopped program can be put to its beginning. */
  declare resets: boolean;

  static override styles = [
    base,
    css`
      th,
      td {
        vertical-align: middle;
      }
      .line {
        min-width: 9em;
      }
      @media (max-width: 600px) {
        .line {
          min-width: 0;
        }
        th,
        td {
          padding: 3px 4px;
        }
      }
    `,
  ];

  constructor() {
    super();
    this.programs = [];
    this.lines = [];
    this.held = null;
    this.usable = false;
    this.resets = false;
  }

  override render() {
    return html`
      <table aria-label="Programs">
        <tbody>
          ${this.programs.map((program, number) => this.#row(program, number))}
        </tbody>
      </table>
    `;
  }

  #row({ state, counter }: ProgramStatus, number: number) {
    const line = this.lines[number] ?? null;
    const name = this.programs.length > 1 ? `Program ${number}` : "Program";
    const held = this.held === number;
    const button = (command: Command, text: string, enabled: boolean, look = "") => html`
      <button
        class="small ${look}"
        aria-label="${text} ${name}"
        ?disabled=${!this.usable || !enabled}
        @click=${() => this.dispatchEvent(new ThreadEvent(number, command))}
      >
        ${text}
      </button>
    `;
    return html`
      <tr>
        <th scope="row">${name}</th>
        <td><span class="badge ${held ? "warn" : STATES[state]}">${held ? "held" : state}</span></td>
        <td class="line muted">${state === "idle" && !held ? nothing : line === null ? `address ${counter}` : `line ${line}`}</td>
        <td>
          <span class="row">
            ${button("run", "Run", state === "idle" || state === "error", "primary")}
            ${button("pause", "Pause", state === "running")} ${button("continue", "Continue", state === "paused")}
            ${button("stop", "Stop", state !== "idle")}
            ${this.resets ? button("reset", "Reset", state !== "running") : nothing}
          </span>
        </td>
      </tr>
    `;
  }
}
customElements.define("pt-threads", Threads);
