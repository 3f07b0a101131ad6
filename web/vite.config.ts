import { defineConfig, type Plugin } from "vite";

const SHADERS = /^(?:const|var) ([\w$]+) = ("(?:[^"\\]|\\.)*");$/gm;
const DRAWN = ["meshbasic", "meshlambert", "meshmatcap"].flatMap((name) => [`${name}_vert`, `${name}_frag`]);
const ALWAYS = ["colorspace_pars_fragment", "tonemapping_pars_fragment"]; // three names them outside the shaders
// What no material here asks for: these parts of a shader are nothing but an #ifdef that is false.
const NEVER = new RegExp(
  "^(alphahash|alphamap|aomap|batching|bumpmap|clipping|displacementmap|dithering|emissivemap|envmap|fog|lightmap" +
    "|lightprobes|logdepthbuf|morph|normalmap|shadowmap|skin|specularmap_pars)",
);

/** Leaves out the text of the shaders of three that this page never compiles: a tenth of the first picture's bytes. */
const fewerShaders: Plugin = {
  name: "fewer-shaders",
  apply: "build",
  transform(code, id) {
    if (!id.endsWith("three.module.js")) return null;
    const texts = new Map([...code.matchAll(SHADERS)].map(([, name, text]) => [name!, text!]));
    const list = code.match(/^const ShaderChunk = \{([^}]*)\}/m)?.[1] ?? "";
    const names = new Map([...list.matchAll(/(\w+): ([\w$]+)/g)].map(([, chunk, name]) => [chunk!, name!]));
    const kept = new Set<string>();
    const keep = (chunk: string): void => {
      const name = names.get(chunk);
      if (!name || NEVER.test(chunk) || kept.has(name)) return;
      kept.add(name);
      for (const [, other] of texts.get(name)!.matchAll(/#include <(\w+)>/g)) keep(other!);
    };
    for (const chunk of [...DRAWN, ...ALWAYS]) keep(chunk);
    if (kept.size < 20) this.error("three's shaders have another form; see web/vite.config.ts");
    const chunks = new Set(names.values());
    return code.replace(SHADERS, (all, name) => (chunks.has(name) && !kept.has(name) ? `var ${name} = "";` : all));
  },
};

// The page is served by the studio alone, under /: python/punctura/studio/page is what the wheel carries.
// `vite build --mode static --outDir DIR` makes the page without a server: tools/build_backend/static_page.py.
export default defineConfig(({ mode }) => ({
  plugins: [
    fewerShaders,
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
