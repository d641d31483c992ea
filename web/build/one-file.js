// Makes one file of what Vite bundles: script, style and engine stand in the page, which therefore works from
// a disk without a server. The script is packed, and a short one unpacks it; both are allowed by their hashes, and the policy forbids
// every connection.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gunzipSync, gzipSync } from "node:zlib";

import { gzipAsync } from "@gfx/zopfli";
import { transformWithOxc } from "vite";

const WEB = dirname(dirname(fileURLToPath(import.meta.url)));
const ENGINE = join(WEB, "pkg", "deltav_web_bg.wasm");

// `--strip-debug` and the producers are size; what follows them the engine was compiled with: it is allowed, not asked. `-Os` takes four
// minutes, most of them in one pass, saves 2 %, and computes no quicker.
const OPTIMISE = [
  "-O1",
  "--strip-debug",
  "--strip-producers",
  "--enable-simd",
  "--enable-bulk-memory",
  "--enable-nontrapping-float-to-int",
  "--enable-sign-ext",
  "--enable-mutable-globals",
  "--enable-reference-types",
  "--enable-multivalue",
];

const sha256 = (data, encoding) => createHash("sha256").update(data).digest(encoding);

// More rounds than five save no kilobyte.
const PACK = { numiterations: 5 };

/** The engine after wasm-opt, packed, which takes half a minute: kept under the hash of what went in. */
async function packedEngine() {
  if (!existsSync(ENGINE)) {
    throw new Error(`${ENGINE} is missing: run \`cargo run -p xtask -- web\` in the folder above`);
  }
  const bytes = readFileSync(ENGINE);
  const cache = join(WEB, "node_modules", ".cache", "deltav");
  const key = sha256(JSON.stringify([OPTIMISE, PACK, sha256(bytes, "hex")]), "hex");
  const packed = join(cache, `${key}.wasm.gz`);
  if (!existsSync(packed)) {
    mkdirSync(cache, { recursive: true });
    const part = join(cache, `${key}.${process.pid}`);
    execFileSync(join(WEB, "node_modules", ".bin", "wasm-opt"), [...OPTIMISE, ENGINE, "-o", part], { stdio: "inherit" });
    writeFileSync(`${part}.gz`, await gzipAsync(readFileSync(part), PACK));
    renameSync(`${part}.gz`, packed);
    rmSync(part);
  }
  return readFileSync(packed);
}

/** The licences of the packages whose code is in the page, each text once. */
function licences(modules) {
  const packages = new Set();
  for (const id of modules) {
    const name = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(id)?.[1];
    if (name) packages.add(name);
  }
  const texts = new Map();
  for (const name of [...packages].sort()) {
    const folder = join(WEB, "node_modules", name);
    const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
    if (!file) throw new Error(`the package ${name} has no licence file`);
    const text = readFileSync(join(folder, file), "utf8").trim();
    texts.set(text, [...(texts.get(text) ?? []), `${name} ${version} (${license})`]);
  }
  return [...texts].map(([text, names]) => `${names.join("\n")}\n\n${text}`).join("\n\n----\n\n");
}

// The digits of `packed.ts`: 91 letters that stand for themselves in a page, of which two hold 13 bits. Base64 would be a twelfth longer.
const DIGITS = [...Array(94).keys()].map((place) => String.fromCharCode(33 + place)).filter((letter) => !'"&<'.includes(letter));

/** Bytes as a text of these digits; how many there are is said apart. */
export function packedText(bytes) {
  const letters = [];
  let [held, bits] = [0, 0];
  const put = (number) => letters.push(DIGITS[number % 91], DIGITS[Math.floor(number / 91)]);
  for (const byte of bytes) {
    held |= byte << bits;
    bits += 8;
    if (bits < 13) continue;
    put(held & 8191);
    held >>= 13;
    bits -= 13;
  }
  if (bits > 0) put(held);
  return letters.join("");
}

const packedPart = (id, bytes) => `<script type="application/octet-stream" id="${id}" data-bytes="${bytes.length}">${packedText(bytes)}</script>`;

/**
 * The script that unpacks the other one and runs it. That one is gone from the page before it runs: a report that can be asked is the page
 * as it was loaded.
 */
async function loader() {
  const source = (file) => readFileSync(join(WEB, "src", file), "utf8");
  const { code } = await transformWithOxc(source("packed.ts"), "packed.ts", { sourcemap: false });
  const unpack = code.replace("export function", "function").replaceAll(/^\s*\/[/*].*\n/gm, "");
  const [, broken] = /^ {2}broken: ("[^"\n]+"),$/m.exec(source("texts/en.ts"));
  return `
${unpack.trim()}
try {
    const packed = document.getElementById("deltav-script");
    const bytes = unpack(packed.textContent, Number(packed.dataset.bytes));
    const script = document.createElement("script");
    script.type = "module";
    script.textContent = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
    document.head.append(script);
    script.remove();
} catch (error) {
    document.body.prepend(${broken} + " " + error);
}
`;
}

/** A text that cannot end the element around it. */
const inert = (text) => text.replaceAll("<", "\\u003c");

export function oneFile() {
  return {
    name: "one-file",
    enforce: "post",
    async generateBundle(_, bundle) {
      const files = Object.values(bundle);
      const script = files.find((file) => file.type === "chunk" && file.isEntry);
      const style = files.find((file) => file.type === "asset" && file.fileName.endsWith(".css"));
      const page = files.find((file) => file.type === "asset" && file.fileName.endsWith(".html"));
      for (const name of Object.keys(bundle)) delete bundle[name];

      const code = script.code.trim();
      const start = await loader();
      const allowed = [start, code].map((text) => `'sha256-${sha256(text, "base64")}'`).join(" ");
      const engine = await packedEngine();
      const policy = [
        "default-src 'none'",
        "connect-src 'none'",
        `script-src ${allowed} 'wasm-unsafe-eval'`,
        "style-src 'unsafe-inline'",
        "img-src data: blob:",
        "worker-src blob:",
        "base-uri 'none'",
        "form-action 'none'",
      ].join("; ");
      const notices = { packages: licences(Object.keys(script.modules)) };
      const parts = {
        policy: `<meta http-equiv="Content-Security-Policy" content="${policy}">`,
        engine: `<meta name="deltav-engine" content="${sha256(gunzipSync(engine), "hex")}">`,
        data: [
          `<script type="application/json" id="deltav-licences">${inert(JSON.stringify(notices))}</script>`,
          packedPart("deltav-engine", engine),
          packedPart("deltav-script", gzipSync(code, { level: 9 })),
        ].join("\n"),
      };
      const html = String(page.source)
        .replace(/\s*<link rel="stylesheet"[^>]*>/g, "")
        .replace(/\s*<script type="module"[^>]*><\/script>/g, "")
        .replace(/<!-- (policy|engine|data) -->/g, (_, name) => parts[name])
        // The functions keep `$` in code and style as it is.
        .replace("</head>", () => `<style>${String(style.source).trim()}</style>\n</head>`)
        .replace("</body>", () => `<script type="module">${start}</script>\n</body>`)
        .trim();
      this.emitFile({ type: "asset", fileName: "deltav.html", source: html });
    },
  };
}
