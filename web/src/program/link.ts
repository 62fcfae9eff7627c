// The language server over a WebSocket: a text frame is a message. It comes back by itself.

import type { LSPClient, Transport } from "@codemirror/lsp-client";

const FIRST_RETRY_MS = 500;
const LAST_RETRY_MS = 10_000;

/** Keeps a client connected until it is closed. */
export class Link {
  readonly #client: LSPClient;
  readonly #open: () => WebSocket;
  readonly #changed: (up: boolean) => void;
  #socket: WebSocket | null = null;
  #retry_ms = FIRST_RETRY_MS;
  #timer = 0;

  constructor(client: LSPClient, open: () => WebSocket, changed: (up: boolean) => void) {
    this.#client = client;
    this.#open = open;
    this.#changed = changed;
    this.#connect();
  }

  close(): void {
    clearTimeout(this.#timer);
    const socket = this.#socket;
    this.#socket = null;
    socket?.close();
    this.#client.disconnect();
  }

  #connect(): void {
    const socket = this.#open();
    this.#socket = socket;
    let handlers: ((message: string) => void)[] = [];
    const transport: Transport = {
      send(message) {
        if (socket.readyState !== WebSocket.OPEN) throw new Error("The language server is not connected.");
        socket.send(message);
      },
      subscribe: (handler) => void handlers.push(handler),
      unsubscribe: (handler) => void (handlers = handlers.filter((other) => other !== handler)),
    };
    socket.onmessage = (event: MessageEvent<string>) => {
      for (const handler of handlers) handler(event.data);
    };
    socket.onopen = () => {
      this.#retry_ms = FIRST_RETRY_MS;
      this.#client.connect(transport);
      this.#client.initializing.then(() => this.#changed(true), () => socket.close());
    };
    socket.onclose = () => {
      if (socket !== this.#socket) return;
      this.#client.disconnect();
      this.#changed(false);
      this.#timer = window.setTimeout(() => this.#connect(), this.#retry_ms);
      this.#retry_ms = Math.min(this.#retry_ms * 2, LAST_RETRY_MS);
    };
  }
}
