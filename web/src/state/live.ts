// What a device says of itself while somebody looks: the newest message of each kind, over one WebSocket that
// comes back by itself.

import type { Api } from "../api/client.ts";
import type { DebugState, LinkState, Live, LiveRequest, Status, Traffic } from "../api/contract.ts";
import { SampleRing } from "./samples.ts";

/** Requests and replies that are kept. */
export const MAX_TRAFFIC = 2000;

const FIRST_RETRY_MS = 250;
const LAST_RETRY_MS = 5000;
/** A server that says nothing for so long is lost; a status comes 15 times a second. */
const SILENCE_MS = 5000;
/** The server ends a jog of which it has heard nothing for three times as long. */
const HOLD_MS = 200;
/** Who draws the traffic hears of it no more often: it is long, and nobody reads faster. */
const TRAFFIC_MS = 250;

/** `live.addEventListener(kind, ...)`: what has just changed. */
export type LiveEvent = "status" | "samples" | "traffic" | "link" | "debug" | "connection";

export class LiveStore extends EventTarget {
  readonly name: string;
  status: Status | null = null;
  link: LinkState = { state: "connecting" };
  debug: DebugState = { held: null, breakpoints: [] };
  readonly samples = new SampleRing();
  /** Oldest first. */
  traffic: Traffic[] = [];
  /** Whether the server is there. */
  connected = false;
  /** When the status came, of `performance.now()`. */
  statusAt = 0;

  readonly #api: Api;
  #socket: WebSocket | null = null;
  #retry_ms = FIRST_RETRY_MS;
  #timer = 0;
  #watchdog = 0;
  #trafficTimer = 0;
  #open = false;
  /** The axes that jog while a button is held. */
  readonly #held = new Set<string>();
  #holding = 0;

  constructor(api: Api, name: string) {
    super();
    this.#api = api;
    this.name = name;
  }

  /** Begins to listen. */
  open(): void {
    if (this.#open) return;
    this.#open = true;
    this.#connect();
  }

  /** Ends listening. */
  close(): void {
    this.#open = false;
    clearTimeout(this.#timer);
    clearTimeout(this.#watchdog);
    clearTimeout(this.#trafficTimer);
    clearInterval(this.#holding);
    this.#socket?.close();
    this.#socket = null;
  }

  /** Says that an axis jogs on until `letGo`; if this page falls silent before, the server stops it. */
  hold(axis: string): void {
    this.#held.add(axis);
    this.#sayHeld();
    this.#holding ||= window.setInterval(() => this.#sayHeld(), HOLD_MS);
  }

  /** The axis jogs no longer. */
  letGo(axis: string): void {
    if (!this.#held.delete(axis)) return;
    this.#sayHeld();
    if (this.#held.size > 0) return;
    clearInterval(this.#holding);
    this.#holding = 0;
  }

  #sayHeld(): void {
    if (this.#socket?.readyState !== WebSocket.OPEN) return;
    const { lease } = this.#api;
    const said: LiveRequest = { type: "hold", axes: [...this.#held], ...(lease === null ? {} : { lease }) };
    this.#socket.send(JSON.stringify(said));
  }

  /** Forgets the traffic. */
  clearTraffic(): void {
    this.traffic = [];
    this.#tell("traffic");
  }

  #connect(): void {
    const socket = this.#api.socket(this.#api.path(this.name, "live"));
    this.#socket = socket;
    socket.onopen = () => {
      this.#retry_ms = FIRST_RETRY_MS;
      this.#setConnected(true);
      this.#watch();
    };
    socket.onmessage = (event: MessageEvent<string>) => {
      this.#watch();
      this.#take(JSON.parse(event.data) as Live);
    };
    socket.onclose = () => this.#lost(socket);
  }

  #lost(socket: WebSocket): void {
    if (socket !== this.#socket) return;
    this.#socket = null;
    socket.onclose = null;
    socket.close();
    clearTimeout(this.#watchdog);
    this.#setConnected(false);
    if (!this.#open) return;
    this.#timer = window.setTimeout(() => this.#connect(), this.#retry_ms);
    this.#retry_ms = Math.min(this.#retry_ms * 2, LAST_RETRY_MS);
  }

  #watch(): void {
    clearTimeout(this.#watchdog);
    const socket = this.#socket;
    if (socket) this.#watchdog = window.setTimeout(() => this.#lost(socket), SILENCE_MS);
  }

  #setConnected(connected: boolean): void {
    if (connected === this.connected) return;
    this.connected = connected;
    this.#tell("connection");
  }

  #take(message: Live): void {
    switch (message.type) {
      case "status":
        this.status = message.status;
        this.statusAt = performance.now();
        break;
      case "samples":
        this.samples.add(message.samples);
        break;
      case "traffic":
        this.traffic = newest(this.traffic.concat(message.traffic));
        this.#trafficTimer ||= window.setTimeout(() => {
          this.#trafficTimer = 0;
          this.#tell("traffic");
        }, TRAFFIC_MS);
        return;
      case "link":
        this.link = message.link;
        break;
      case "debug":
        this.debug = message.debug;
        break;
    }
    this.#tell(message.type);
  }

  #tell(kind: LiveEvent): void {
    this.dispatchEvent(new Event(kind));
  }
}

/** The newest lines. Those that were only polled go first: there are many, and nobody asked for them. */
function newest(traffic: Traffic[]): Traffic[] {
  let surplus = traffic.length - MAX_TRAFFIC;
  if (surplus <= 0) return traffic;
  const kept = traffic.filter(({ polled }) => !polled || surplus-- <= 0);
  return kept.slice(-MAX_TRAFFIC);
}
