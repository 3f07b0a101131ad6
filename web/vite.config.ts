import { defineConfig } from "vite";

// The page is served by the studio alone, under /: python/punctura/studio/page is what the wheel carries.
// `vite build --mode static --outDir DIR` makes the page without a server: tools/build_backend/static_page.py.
export default defineConfig(({ mode }) => ({
  plugins: [
    {
      name: "static-entry",
      transformIndexHtml: {
        order: "pre",
        handler: (html) => (mode === "static" ? html.replace("src/main.ts", "src/static.ts") : html),
      },
    },
  ],
  worker: { format: "es" },
  base: "./",
  build: {
    outDir: "../python/punctura/studio/page",
    emptyOutDir: true,
    target: "es2022",
    cssTarget: ["chrome123", "firefox120", "safari17.5"], // the first that know light-dark(), which is left as it is
    chunkSizeWarningLimit: 1500,
    assetsInlineLimit: 0, // nothing inline: the page's content policy forbids it
    modulePreload: { polyfill: false },
  },
  server: { proxy: { "/api": "http://127.0.0.1:8765", "/ws": { target: "ws://127.0.0.1:8765", ws: true } } },
}));
