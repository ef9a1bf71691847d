// Tests of the pages in a real browser: node run.mjs MANE [--renew] [--only WORDS]. MANE is the command, which writes the pages.
// --renew writes the approved pictures anew, to be looked at and committed.
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { findBrowser, launch } from "./browser.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const [mane, ...options] = process.argv.slice(2);
if (!mane) {
    console.error("usage: node run.mjs MANE [--renew] [--only WORDS]");
    process.exit(2);
}
if (!findBrowser()) {
    console.log("skipped: viewer: chromium is missing");
    process.exit(process.env.CI === "true" ? 1 : 0);
}

const only = options.includes("--only") ? options[options.indexOf("--only") + 1] : "";
const folder = mkdtempSync(join(tmpdir(), "mane-viewer-"));
const browser = await launch();
let failed = 0;
try {
    const context = { mane: resolve(mane), browser, folder, project: resolve(here, "../.."), renew: options.includes("--renew") };
    for (const file of readdirSync(here).filter((f) => f.endsWith(".test.mjs")).sort()) {
        const { tests } = await import(pathToFileURL(join(here, file)));
        for (const [name, test] of await tests(context)) {
            if (!name.includes(only)) continue;
            const start = performance.now();
            try {
                const note = await test();
                console.log(`script test passed: ${name}${note ? `: ${note}` : ""}  [${((performance.now() - start) / 1000).toFixed(1)} s]`);
            } catch (error) {
                ++failed;
                console.log(`script test FAILED: ${name}: ERROR ${error.stack ?? error}`);
            }
        }
    }
} finally {
    await browser.close();
    rmSync(folder, { recursive: true, force: true });
}
process.exit(failed ? 1 : 0);
