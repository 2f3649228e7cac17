// The page under development: Vite serves it, and /board is joined to a message board that runs.
//   node dev/serve.mjs [BOARD_PORT] [PAGE_PORT]
// With --built the built page is served as it is, with the policy that the program sends.
import { createConnection } from "node:net";
import { createReadStream, existsSync } from "node:fs";
import { createServer as createHttp } from "node:http";
import { basename, dirname, extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { WebSocketServer } from "ws";

const page = dirname(dirname(fileURLToPath(import.meta.url)));
const kinds = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };
const policy = "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; object-src 'none'";

/** Joins each WebSocket at /board to a connection of its own. */
function joinBoard(server, boardPort) {
  const sockets = new WebSocketServer({ noServer: true, handleProtocols: () => "ortung.board.1" });
  server.on("upgrade", (request, socket, head) => {
    if (!request.url.endsWith("/board")) return;
    sockets.handleUpgrade(request, socket, head, (client) => {
      const board = createConnection({ host: "127.0.0.1", port: boardPort() });
      board.on("data", (bytes) => client.send(bytes, { binary: true }));
      board.on("close", () => client.close());
      board.on("error", () => client.close());
      client.on("message", (bytes) => board.write(bytes));
      client.on("close", () => board.destroy());
    });
  });
}

/** @returns the port on which the built page is served */
export async function serveBuilt(boardPort, port = 0) {
  const built = join(page, "..", "built");
  const server = createHttp((request, response) => {
    const name = basename(new URL(request.url, "http://page").pathname) || "index.html";
    const file = join(built, name);
    if (!existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { "content-type": kinds[extname(name)] ?? "text/plain", "content-security-policy": policy });
    createReadStream(file).pipe(response);
  });
  joinBoard(server, boardPort);
  await new Promise((resolve) => server.listen(port, "127.0.0.1", resolve));
  return { port: server.address().port, close: () => server.close() };
}

async function main() {
  const numbers = process.argv.slice(2).filter((word) => /^\d+$/.test(word)).map(Number);
  const [boardPort = 7777, pagePort = 5173] = numbers;
  if (process.argv.includes("--built")) {
    const { port } = await serveBuilt(() => boardPort, pagePort);
    console.log(`http://127.0.0.1:${port}/`);
    return;
  }
  const { createServer } = await import("vite");
  const vite = await createServer({ root: page, server: { port: pagePort, host: "127.0.0.1" } });
  await vite.listen();
  joinBoard(vite.httpServer, () => boardPort);
  console.log(`http://127.0.0.1:${pagePort}/`);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await main();
