// Builds the pages: node build.mjs OUTPUT_FOLDER [PAGE…]. A page is a folder of src/ with a main.ts, a page.html and a page.css (and
// a worker.ts, if it has a worker); script and style go into the HTML, so that one file opens from a disk without a network.
import { build } from "esbuild";
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [output, ...named] = process.argv.slice(2);
if (!output) {
    console.error("usage: node build.mjs OUTPUT_FOLDER [PAGE…]");
    process.exit(2);
}
const isPage = (name) => existsSync(join(here, "src", name, "page.html"));
const pages = named.length ? named : readdirSync(join(here, "src")).filter(isPage);

/** `#include "name.glsl"` of the shader's own folder, once per shader. */
const shaders = {
    name: "glsl",
    setup({ onLoad }) {
        onLoad({ filter: /\.glsl$/ }, ({ path }) => {
            const seen = new Set();
            const files = [];
            const read = (file) => {
                if (seen.has(file)) return "";
                seen.add(file);
                files.push(file);
                const text = readFileSync(file, "utf8");
                return text.replace(/^#include "(.+)"$/gm, (_, name) => read(join(dirname(file), name)));
            };
            return { contents: read(path), loader: "text", watchFiles: files };
        });
    },
};

async function bundle(entry, format) {
    const result = await build({
        entryPoints: [entry],
        bundle: true,
        write: false,
        minify: true,
        format,
        target: "es2022",
        charset: "utf8",
        outdir: output,
        loader: { ".svg": "text", ".toml": "text" },
        plugins: [shaders],
        logLevel: "warning",
    });
    return result.outputFiles[0].text.trim();
}

mkdirSync(output, { recursive: true });
for (const page of pages) {
    const folder = join(here, "src", page);
    const parts = {
        style: `<style>\n${await bundle(join(folder, "page.css"))}\n</style>`,
        script: `<script type="module">\n${await bundle(join(folder, "main.ts"), "esm")}\n</script>`,
    };
    // A worker's script, as text: from a disk only what the page holds itself can be started.
    const worker = join(folder, "worker.ts");
    if (existsSync(worker)) parts.worker = `<script type="text/plain" id="worker">\n${await bundle(worker, "iife")}\n</script>`;
    const html = readFileSync(join(folder, "page.html"), "utf8");
    const whole = html.replace(/<!-- (style|script|worker) -->/g, (_, part) => parts[part]);
    writeFileSync(join(output, `${page}.html`), whole);
    console.log(`${page}.html  ${(whole.length / 1000).toFixed(0)} kB`);
}
