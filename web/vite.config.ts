import { defineConfig } from "vite";

// The page is served by the studio alone, under /: python/punctura/studio/page is what the wheel carries.
export default defineConfig({
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
});
