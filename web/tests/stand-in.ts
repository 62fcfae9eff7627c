// A page from a folder in place of the program's own, while one works on it: what is not in the folder is asked of the
// server behind. Nothing has to be linked anew for a test then.

import { readFile } from "node:fs/promises";
import { type Server, createServer, request } from "node:http";
import { type AddressInfo, connect } from "node:net";
import { extname, join } from "node:path";

const KINDS: Record<string, string> = {
  ".css": "text/css",
  ".html": "text/html",
  ".js": "text/javascript",
  ".svg": "image/svg+xml",
};

/** Serves the folder on `port`, and passes everything else on to `behind`. */
export async function standIn(folder: string, behind: string, port: number): Promise<Server> {
  const to = { host: new URL(`http://${behind}`).hostname, port: Number(new URL(`http://${behind}`).port) };
  const policy = (await fetch(`http://${behind}/`)).headers.get("content-security-policy") ?? "";
  const server = createServer(async (asked, answer) => {
    const path = new URL(asked.url!, "http://page").pathname;
    const file = join(folder, path === "/" ? "index.html" : path);
    const kind = KINDS[extname(file)];
    const text = kind === undefined || path.startsWith("/api/") ? null : await readFile(file).catch(() => null);
    if (text !== null) {
      answer.writeHead(200, { "Content-Type": kind!, "Content-Security-Policy": policy }).end(text);
      return;
    }
    const passed = request({ ...to, method: asked.method!, path: asked.url!, headers: asked.headers }, (reply) => {
      answer.writeHead(reply.statusCode!, reply.headers);
      reply.pipe(answer);
    });
    passed.on("error", () => answer.destroy());
    asked.pipe(passed);
  });
  server.on("upgrade", (asked, socket, first) => {
    const passed = connect(to, () => {
      const headers = asked.rawHeaders.flatMap((text, n) => (n % 2 === 0 ? [`${text}: ${asked.rawHeaders[n + 1]}`] : []));
      passed.write([`GET ${asked.url} HTTP/1.1`, ...headers, "", ""].join("\r\n"));
      passed.write(first);
      socket.pipe(passed).pipe(socket);
    });
    const end = () => void (socket.destroy(), passed.destroy());
    for (const one of [socket, passed]) one.on("error", end).on("close", end);
  });
  await new Promise<void>((resolve) => server.listen(port, "127.0.0.1", resolve));
  return server;
}

/** Where it listens. */
export const portOf = (server: Server): number => (server.address() as AddressInfo).port;
