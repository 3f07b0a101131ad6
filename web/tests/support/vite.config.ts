import { defineConfig } from "vite";

// Builds the page with a made-up run into a folder of its own: vite build -c tests/support/vite.config.ts
export default defineConfig({
  root: new URL(".", import.meta.url).pathname,
  base: "./",
  build: { outDir: "/tmp/punctura-fake-page", emptyOutDir: true, rollupOptions: { input: "page.html" } },
});
