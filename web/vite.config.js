import { defineConfig } from "vite";

import { oneFile } from "./build/one-file.js";

export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    modulePreload: false,
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    cssCodeSplit: false,
    reportCompressedSize: false,
  },
  worker: { format: "iife" },
  plugins: [oneFile()],
});
