import { defineConfig } from "vitest/config";

/** Built files have stable names, so that a change of the page is a change of few committed files. */
export default defineConfig({
  base: "./",
  build: {
    outDir: "../built",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    reportCompressedSize: true,
    license: { fileName: "licences.md" },
    rollupOptions: {
      output: {
        entryFileNames: "page.js",
        chunkFileNames: "[name].js",
        assetFileNames: "page[extname]",
      },
    },
  },
  test: { include: ["test/**/*.test.ts"], environment: "node" },
});
