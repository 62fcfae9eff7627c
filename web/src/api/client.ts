// The server's interface: one object with a method a route. It carries the token and the control lease.

import type {
  Action,
  Answer,
  Catalog,
  Compiled,
  Found,
  Lease,
  Machine,
  MovedSwitches,
  Status,
  Summary,
  Value,
} from "./contract.ts";

/** What still goes out when the page is being closed: above all, stops. */
const LAST_WORDS = /^\/api\/(lease|devices\/[^/]+\/(stop|act))$/;

/** A request that did not do what it should: the server's own sentence, or that it cannot be reached. */
export class ApiError extends Error {
  /** The HTTP status; 0 if nobody answered. */
  readonly status: number;
  /** Who has control, if that is why. */
  readonly holder: string | null;

  constructor(status: number, message: string, holder: string | null = null) {
    super(message);
    this.status = status;
    this.holder = holder;
  }
}

/** What `say` shows of anything that was thrown. */
export function reason(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

const REQUEST_TIMEOUT_MS = 10_000;

/** What everybody may send, whoever has control. */
const FREE = /^\/api\/(lease|find|devices\/[^/]+\/(stop|program\/compile))$/;

/** A fault that waits or is active, as `GET .../faults` lists it: its number, and the keys that it was given. */
export type Fault = { id: number } & Record<string, unknown>;

/** A kind of faults: the keys that it needs and those that it may have. */
export interface FaultKind {
  name: string;
  text: string;
  needs: string[];
  may: string[];
  lasts: boolean;
}

export class Api extends EventTarget {
  /** The newest lease if this page has control. */
  lease: string | null = null;
  /** Called before a request that changes something and that needs control. */
  beforeChange: (() => Promise<void>) | null = null;
  readonly #token: string;

  constructor(token: string) {
    super();
    this.#token = token;
  }

  /** Whether there is a token at all; the server alone knows whether it is right. */
  get hasToken(): boolean {
    return this.#token !== "";
  }

  // Devices

  devices(): Promise<Summary[]> {
    return this.get("/api/devices");
  }
  catalog(model: string): Promise<Catalog> {
    return this.get(`/api/models/${encodeURIComponent(model)}`);
  }
  addBench(bench: string): Promise<Summary[]> {
    return this.send("POST", "/api/devices", { bench });
  }
  addReal(real: { name: string; model: string; link: string; address?: number }): Promise<Summary[]> {
    return this.send("POST", "/api/devices", { real });
  }
  remove(name: string): Promise<void> {
    return this.send("DELETE", this.path(name));
  }
  serialPorts(): Promise<string[]> {
    return this.get("/api/serial-ports");
  }
  find(link: string): Promise<Found[]> {
    return this.send("POST", "/api/find", { link }, 120_000);
  }

  // One device

  status(name: string): Promise<Status> {
    return this.get(this.path(name, "status"));
  }
  act(name: string, action: Action): Promise<void> {
    return this.send("POST", this.path(name, "act"), action);
  }
  /** Stops every axis of a device; whoever is authenticated may. */
  stop(name: string): Promise<void> {
    return this.send("POST", this.path(name, "stop"));
  }
  terminal(name: string, line: string): Promise<Answer> {
    return this.send("POST", this.path(name, "terminal"), { line });
  }
  parameters(name: string): Promise<Record<string, Value>> {
    return this.get(this.path(name, "parameters"), 60_000);
  }
  parameter(name: string, id: string): Promise<Value> {
    return this.get(this.path(name, "parameters", id));
  }
  setParameter(name: string, id: string, value: Value): Promise<void> {
    return this.send("PUT", this.path(name, "parameters", id), value);
  }
  storeParameters(name: string): Promise<void> {
    return this.send("POST", this.path(name, "parameters", "store"));
  }
  restoreFactory(name: string): Promise<void> {
    return this.send("POST", this.path(name, "parameters", "restore"));
  }
  variables(name: string): Promise<Record<string, Value>> {
    return this.get(this.path(name, "variables"));
  }

  // Programs

  compile(name: string, source: string): Promise<Compiled> {
    return this.send("POST", this.path(name, "program", "compile"), { source });
  }
  download(name: string, source: string): Promise<Compiled> {
    return this.send("PUT", this.path(name, "program"), { source }, 60_000);
  }
  upload(name: string): Promise<{ source: string }> {
    return this.get(this.path(name, "program"), 60_000);
  }
  program(
    name: string,
    number: number,
    what: "run" | "stop" | "pause" | "continue" | "step" | "reset",
  ): Promise<void> {
    return this.send("POST", this.path(name, "programs", String(number)), { do: what });
  }
  setBreakpoints(name: string, breakpoints: number[]): Promise<void> {
    return this.send("PUT", this.path(name, "debug"), { breakpoints });
  }
  debug(name: string, what: "continue" | "step" | "pause"): Promise<void> {
    return this.send("POST", this.path(name, "debug"), { do: what });
  }

  // The machine behind a virtual device

  machine(name: string): Promise<Machine> {
    return this.get(this.path(name, "machine"));
  }
  moveSwitches(name: string, moved: MovedSwitches): Promise<void> {
    return this.send("PATCH", this.path(name, "machine"), moved);
  }
  pin(name: string, pin: string): Promise<boolean | number> {
    return this.get(this.path(name, "pins", pin));
  }
  drivePin(name: string, pin: string, value: boolean | number): Promise<void> {
    return this.send("PUT", this.path(name, "pins", pin), value);
  }
  releasePin(name: string, pin: string): Promise<void> {
    return this.send("DELETE", this.path(name, "pins", pin));
  }
  setLoad(name: string, axis: string, load: number): Promise<void> {
    return this.send("PUT", this.path(name, "axes", axis, "load"), load);
  }
  push(name: string, axis: string, pulses: number): Promise<void> {
    return this.send("POST", this.path(name, "axes", axis, "push"), pulses);
  }
  lose(name: string, axis: string, pulses: number): Promise<void> {
    return this.send("POST", this.path(name, "axes", axis, "lose"), pulses);
  }
  turnPulser(name: string, axis: string, counts: number): Promise<void> {
    return this.send("POST", this.path(name, "mpg", axis), counts);
  }
  powerCycle(name: string): Promise<void> {
    return this.send("POST", this.path(name, "power-cycle"));
  }
  powerCut(name: string): Promise<void> {
    return this.send("POST", this.path(name, "power-cut"));
  }
  faultKinds(): Promise<FaultKind[]> {
    return this.get("/api/faults");
  }
  faults(name: string): Promise<Fault[]> {
    return this.get(this.path(name, "faults"));
  }
  addFault(name: string, fault: Record<string, unknown>): Promise<{ id: number }> {
    return this.send("POST", this.path(name, "faults"), fault);
  }
  clearFault(name: string, id: number): Promise<void> {
    return this.send("DELETE", this.path(name, "faults", String(id)));
  }
  clearFaults(name: string): Promise<void> {
    return this.send("DELETE", this.path(name, "faults"));
  }

  // Control

  leaseState(): Promise<Lease> {
    return this.get("/api/lease");
  }
  takeLease(name: string, force: boolean): Promise<{ lease: string; seconds: number }> {
    return this.send("POST", "/api/lease", { name, force });
  }
  renewLease(): Promise<void> {
    return this.send("PUT", "/api/lease");
  }
  dropLease(): Promise<void> {
    return this.send("DELETE", "/api/lease");
  }

  // Plumbing

  /** `/api/devices/NAME/...`, each part escaped. */
  path(name: string, ...rest: string[]): string {
    return ["/api/devices", name, ...rest].map((part, n) => (n === 0 ? part : encodeURIComponent(part))).join("/");
  }

  /** A WebSocket of the server. A browser's WebSocket cannot send headers, so the token stands in its address. */
  socket(path: string, query: Record<string, string> = {}): WebSocket {
    const url = new URL(path, location.href);
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    url.search = new URLSearchParams({ ...query, token: this.#token }).toString();
    return new WebSocket(url);
  }

  get<T>(path: string, timeout_ms = REQUEST_TIMEOUT_MS): Promise<T> {
    return this.#request("GET", path, undefined, timeout_ms);
  }

  async send<T>(method: string, path: string, body?: unknown, timeout_ms = REQUEST_TIMEOUT_MS): Promise<T> {
    if (this.lease === null && !FREE.test(path)) await this.beforeChange?.();
    return this.#request(method, path, body, timeout_ms);
  }

  async #request<T>(method: string, path: string, body: unknown, timeout_ms: number): Promise<T> {
    const headers: Record<string, string> = { Authorization: `Bearer ${this.#token}` };
    if (body !== undefined) headers["Content-Type"] = "application/json";
    if (this.lease !== null) headers["Control-Lease"] = this.lease;
    let response: Response;
    try {
      response = await fetch(path, {
        method,
        headers,
        body: body === undefined ? null : JSON.stringify(body),
        signal: AbortSignal.timeout(timeout_ms),
        keepalive: LAST_WORDS.test(path),
        cache: "no-store",
      });
    } catch (error) {
      const late = error instanceof DOMException && error.name === "TimeoutError";
      throw new ApiError(0, late ? "The server did not answer in time." : "The server cannot be reached.");
    }
    if (!response.ok) throw await this.#failure(response);
    const text = await response.text();
    return (text === "" ? undefined : JSON.parse(text)) as T;
  }

  async #failure(response: Response): Promise<ApiError> {
    let message = `${response.status} ${response.statusText}`;
    let holder: string | null = null;
    try {
      const body = (await response.json()) as { error?: string; holder?: string };
      if (body.error) message = body.error;
      holder = body.holder ?? null;
    } catch {
      // Not one of our answers: the status has to do.
    }
    const error = new ApiError(response.status, message, holder);
    if (response.status === 401) this.dispatchEvent(new Event("unauthorized"));
    if (response.status === 423) this.dispatchEvent(new CustomEvent("locked", { detail: holder }));
    return error;
  }
}
