import { defineConfig } from "vite";

// The server sends a strict Content-Security-Policy, so nothing may be inlined.
export default defineConfig({
  base: "/",
  build: {
    outDir: "../src/shapewright/studio/page",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 900,
  },
});
