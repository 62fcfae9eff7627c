import { defineConfig } from "vite";

// The server to which the development server passes the interface on; `npm run dev` is for work on the page
// alone, `pulsetrain serve` has the built page inside.
const server = process.env["PULSETRAIN_URL"] ?? "http://127.0.0.1:8340";

export default defineConfig({
  build: {
    target: "es2023",
    // The content security policy has neither inline scripts nor data: URLs.
    assetsInlineLimit: 0,
    modulePreload: false,
    chunkSizeWarningLimit: 700,
    reportCompressedSize: false,
  },
  server: { proxy: { "/api": { target: server, ws: true } } },
});
