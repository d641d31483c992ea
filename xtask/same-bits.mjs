// Compares the engine in WebAssembly with the program, byte for byte:
// node xtask/same-bits.mjs FOLDER_OF_THE_ENGINE PROGRAM CASE...

import { createHash } from "node:crypto";
import { execFile } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, program, ...cases] = process.argv.slice(2);
const engine = await import(pathToFileURL(resolve(folder, "deltav_web.js")));
engine.initSync({ module: readFileSync(join(folder, "deltav_web_bg.wasm")) });

/** What the program writes, and whether it has an answer. */
function run(...options) {
    return new Promise(done => {
        execFile(program, options, { maxBuffer: 1 << 30 }, (error, out, errors) => done({ ok: !error, out, errors }));
    });
}

let compared = 0;
const differing = [];
const expect = (what, ours, theirs) => {
    compared += 1;
    if (ours !== theirs) {
        const at = [...ours].findIndex((letter, i) => letter !== theirs[i]);
        const near = text => JSON.stringify(text.slice(Math.max(at - 40, 0), at + 60));
        differing.push(`${what}: at ${at} ${near(ours)}, and the program has ${near(theirs)}`);
    }
};

// Messages of the program name the file by its path, and stand behind "error: ".
const said = text => text.trim().replace(/^error: /, "");

// Where the program names a command, the page says what it does.
const commands = {
    "the reconstruction": "reconstruct",
    "the impact from given speeds": "impact",
    "the motion to rest": "motion",
    "the answer from the damage alone": "crush",
    "the comparison of the laws": "compare",
    "the sensitivity": "sensitivity",
    "the estimate": "estimate",
    "the avoidability": "avoid",
    "\"New case…\"": "new",
};
// The page has no texts that these commands would print.
const withoutPointers = text => text.replaceAll(/; `deltav explain [a-z ]+` says more| \(see `deltav explain class`\)/g, "");
const withCommands = text =>
    Object.entries(commands).reduce((text, [words, name]) => text.replaceAll(words, `\`deltav ${name}\``), text);

// The engine answers at once, and weighs all the evidence where it is asked for an estimate.
const exactly = command => (command === "reconstruct" ? ["--exact"] : []);
const answers = { reconstruct: 0, impact: 0, motion: 0, crush: 0, compare: 0, sensitivity: 0, recorder: 0 };
let reports = 0;
for (const path of cases) {
    const text = readFileSync(path, "utf8");
    for (const command of Object.keys(answers)) {
        const ours = JSON.parse(engine.answer(text, command, "", path));
        const theirs = await run(command, path, ...exactly(command), "--format", "json");
        expect(`${command} ${path}, whether there is an answer`, String(ours.ok), String(theirs.ok));
        if (ours.ok && theirs.ok) {
            answers[command] += 1;
            expect(`${command} ${path}`, ours.json, theirs.out);
        } else {
            expect(`${command} ${path}, why not`, withCommands(said(ours.message ?? "")), withoutPointers(said(theirs.errors)));
        }
    }
    // The report has the text, the drawings, the samples and their intervals.
    const ours = JSON.parse(engine.report(text, path, "", ""));
    if (ours.ok) {
        const command = JSON.parse(engine.answer(text, "", "", path)).command;
        const theirs = await run(command, path, ...exactly(command), "--format", "html");
        if (!/site_plan\s*=/.test(text)) {
            reports += 1;
            expect(`report on ${path}`, ours.html, theirs.out);
        }
    }
}

// 100,000 samples, each with all of its numbers.
const uncertain = cases.find(path => path.endsWith("sae-980025-uncertain.toml"));
const scratch = mkdtempSync(join(tmpdir(), "deltav-same-bits-"));
const sampled = join(scratch, "samples.csv");
const theirs = await run("uncertainty", uncertain, "--samples", "100000", "--format", "json", "--samples-out", sampled);
const digest = text => createHash("sha256").update(text).digest("hex");
const session = new engine.Run();
const options = JSON.stringify({ samples: 100000 });
session.ask("uncertainty", readFileSync(uncertain, "utf8"), uncertain, "", options, () => true);
expect("the uncertainty of the example", session.json(), theirs.out);
const samples = session.samples();
expect("its samples", digest(samples), digest(readFileSync(sampled)));
expect("their number", String(samples.trimEnd().split("\n").length - 1), "100000");
rmSync(scratch, { recursive: true });

// An estimate with few particles.
const evidence = cases.find(path => path.endsWith("fixtures/estimate.toml"));
const few = ["--particles", "128", "--no-pieces"];
const drawn = await run("estimate", evidence, ...few, "--format", "json");
session.ask("estimate", readFileSync(evidence, "utf8"), evidence, "", '{"particles": 128, "pieces": false}', () => true);
expect("an estimate", session.json(), drawn.out);

// Whether it was avoidable: the numbers, and the report with its diagrams.
let avoided = 0;
for (const path of cases.filter(path => /^\[avoid\]/m.test(readFileSync(path, "utf8")))) {
    const ours = JSON.parse(session.ask("avoid", readFileSync(path, "utf8"), path, "", "", () => true));
    const theirs = await run("avoid", path, "--format", "json");
    expect(`avoid ${path}, whether there is an answer`, String(ours.ok), String(theirs.ok));
    if (!ours.ok || !theirs.ok) continue;
    avoided += 1;
    expect(`avoid ${path}`, session.json(), theirs.out);
    expect(`report on avoid ${path}`, JSON.parse(session.html()).html, (await run("avoid", path, "--format", "html")).out);
}

const counts = Object.entries(answers).map(([command, count]) => `${command} ${count}`).join(", ");
console.log(`${compared} texts of ${cases.length} cases compared; with an answer: ${counts}; reports: ${reports}; avoidability: ${avoided}`);
console.log(`SHA-256 of the 100,000 samples: ${digest(samples)}`);
if (differing.length > 0 || Object.values(answers).some(count => count === 0) || reports === 0 || avoided === 0) {
    console.error(differing.join("\n"));
    console.error(`${differing.length} differ`);
    process.exit(1);
}
