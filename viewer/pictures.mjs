// The pictures of README.md and docs/, taken of pages in a headless browser:
//   node pictures.mjs RUN_FOLDER OUTPUT_FOLDER [NAME…]
// RUN_FOLDER holds short.html, medium.html and long.html, the last with recorded contacts, and live.html of `mane live`.
import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { launch, openPage } from "./test/browser.mjs";

const [runs, output, ...only] = process.argv.slice(2);
if (!output) {
    console.error("usage: node pictures.mjs RUN_FOLDER OUTPUT_FOLDER [NAME…]");
    process.exit(2);
}
const kNone = { strands: false, skeleton: false, sections: false, envelope: false, character: true };
const browser = await launch();
const wanted = (name) => only.length === 0 || only.includes(name);

const settled = (page) => page.waitForFunction(() => window.mane.settled, null, { timeout: 180_000 });

/** Opens a run with a stage of this size and nothing else to be seen. */
async function openStage(run, width, height) {
    const { page, complaints, close } = await openPage(browser, pathToFileURL(resolve(runs, `${run}.html`)).href, { width: 900, height: 900 });
    await page.waitForFunction(() => window.mane);
    await page.evaluate(() => (window.mane.view.rounds = 2));
    await page.addStyleTag({
        content: `#stage { position: fixed !important; inset: 0 auto auto 0; width: ${width}px; height: ${height}px; z-index: 5 } #stage .views, #stage .hud { display: none }`,
    });
    /** A PNG of the hair at a frame, seen from an angle, `near` times as large. */
    const take = async ({ frame, degrees = 40, look = {}, near = 1 }) => {
        await page.evaluate(([frame, look]) => {
            window.mane.panel.set(look);
            window.mane.seek(frame);
        }, [frame, look]);
        await page.waitForFunction(([frame, width]) => window.mane.shownFrame === frame && window.mane.view.canvas.width === width, [frame, width]);
        await page.evaluate(([degrees, near]) => {
            window.mane.lookFrom(degrees);
            window.mane.view.camera.zoom(1 / near);
        }, [degrees, near]);
        await page.waitForTimeout(400);
        await settled(page);
        return page.locator("#stage canvas").screenshot();
    };
    return { take, close: async () => {
        if (complaints.length) throw new Error(complaints.join("\n"));
        await close();
    } };
}

/** Pictures side by side, with a word under each. */
async function writeSheet(name, pictures, width, height) {
    const page = await browser.newPage({ viewport: { width: width * pictures.length, height } });
    const figures = pictures.map(([label, png]) =>
        `<figure><img src="data:image/png;base64,${png.toString("base64")}"><figcaption>${label}</figcaption></figure>`);
    await page.setContent(`<style>body { margin: 0; display: flex; background: #17181b } figure { margin: 0; position: relative; width: ${width}px }
        img { display: block } figcaption { position: absolute; left: 0; right: 0; bottom: 6px; text-align: center; color: #e4e6ea; font: 14px system-ui, "DejaVu Sans", sans-serif; text-shadow: 0 1px 3px #000 }</style>${figures.join("")}`);
    await page.waitForTimeout(200);
    writeFileSync(join(output, name), await page.screenshot());
    await page.close();
    console.log(name);
}

const layers = [
    ["skeleton", { layers: { ...kNone, skeleton: true } }],
    ["cross-sections", { layers: { ...kNone, sections: true, skeleton: true } }],
    ["envelope", { layers: { ...kNone, envelope: true } }],
    ["strands", { layers: { ...kNone, strands: true } }],
];
const strip = [142, 148, 154, 160, 166, 178]; // a bow and a toss

if (wanted("layers.png")) {
    const { take, close } = await openStage("long", 300, 330);
    const pictures = [];
    for (const [label, look] of layers) pictures.push([label, await take({ frame: 118, look, near: 1.25 })]);
    await writeSheet("layers.png", pictures, 300, 330);
    await close();
}
if (wanted("styles.png")) {
    const pictures = [];
    for (const style of ["short", "medium", "long"]) {
        const { take, close } = await openStage(style, 400, 400);
        pictures.push([style, await take({ frame: 112, near: 1.25 })]);
        await close();
    }
    await writeSheet("styles.png", pictures, 400, 400);
}
if (wanted("strip.png")) {
    const { take, close } = await openStage("long", 200, 240);
    const pictures = [];
    for (const frame of strip) pictures.push([`${(frame / 24).toFixed(1)} s`, await take({ frame, degrees: 25 })]);
    await writeSheet("strip.png", pictures, 200, 240);
    await close();
}
if (wanted("view.png")) {
    const { page, close } = await openPage(browser, pathToFileURL(resolve(runs, "long.html")).href, { width: 1280, height: 800 });
    await page.waitForFunction(() => window.mane);
    await page.evaluate(() => window.mane.seek(154));
    await page.waitForFunction(() => window.mane.shownFrame === 154);
    await page.evaluate(() => window.mane.selectWisp(26));
    await page.locator(".contacts summary").first().click();
    await page.mouse.move(400, 300);
    await page.waitForTimeout(400);
    await settled(page);
    writeFileSync(join(output, "view.png"), await page.screenshot());
    console.log("view.png");
    await close();
}
if (wanted("live.png")) {
    const { page, close } = await openPage(browser, pathToFileURL(resolve(runs, "live.html")).href, { width: 1200, height: 760 });
    await page.waitForFunction(() => window.mane?.frames?.newest, null, { timeout: 60_000 });
    await page.evaluate(async () => {
        const { mane } = window;
        const set = (key, value) => mane.link.send({ kind: "set", settings: [{ key, value }] });
        mane.setRunning(false);
        mane.link.send({ kind: "rates", preset: "paper" });
        mane.restart();
        set("air.wind", "[2.5, 0, 1.5]");
        set("motion.shake", "40");
        mane.step(70);
        await mane.stateHash();
        // A lock of hair is held up.
        const tip = mane.world.hair.firstSection[20] - 1;
        const { position, origin } = mane.frames.newest;
        const place = [0.1, 0.12, 0].map((by, i) => position[3 * tip + i] + origin[i] + by);
        mane.hand.pins.set(tip, place);
        mane.link.send({ kind: "pin", section: tip, position: place });
        mane.step(20);
        await mane.stateHash();
    });
    await page.waitForTimeout(400);
    await settled(page);
    writeFileSync(join(output, "live.png"), await page.screenshot());
    console.log("live.png");
    await close();
}
await browser.close();
