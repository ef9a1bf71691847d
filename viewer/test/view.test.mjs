// The playing page of `mane view`.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { cpus, loadavg } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { openPage } from "./browser.mjs";
import { readHair } from "./hair_file.mjs";
import { perceptualDifference } from "./perceptual.mjs";

const kFrames = 26;
const kMeanDifference = 1.0, // ΔE; 1 is about what an eye tells apart side by side
    kWorstDifference = 6;

export async function tests({ mane, browser, folder, project, renew }) {
    const run = (...args) => execFileSync(mane, args, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
    /** A run of a style as a page; made once. */
    function page(name, style, ...options) {
        const file = join(folder, `${name}.html`);
        if (!existsSync(file)) {
            run("simulate", join(project, `scenes/${style}.toml`), "-o", `${name}.mane`, "--frames", String(kFrames), "--set", "motion.shake=50", "--set", "motion.shake_rate=1.2", ...options);
            run("view", `${name}.mane`, "-o", file);
        }
        return file;
    }
    const recorded = () => page("recorded", "long", "--record");
    const wavy = () => page("wavy", "long", "--set", "strands.waves=7", "--set", "strands.wave_amplitude=0.25", "--set", "strands.curls=3");

    /** Opens a page, runs `work(page)` and expects that the page did not complain. Its stage is small: software WebGL is slow. */
    async function within(file, work, { width, height, stage = [260, 240] } = {}) {
        const { page, complaints, close } = await openPage(browser, pathToFileURL(file).href, width && { width, height });
        try {
            await page.waitForFunction(() => window.mane);
            if (stage) {
                await page.evaluate(() => (window.mane.view.rounds = 1)); // the same picture on fast machines

                await page.addStyleTag({
                    content: `#stage { position: fixed !important; inset: 50px auto auto 0; width: ${stage[0]}px; height: ${stage[1]}px; z-index: 5 }
                        #stage .views { position: fixed !important; left: 280px; top: 60px; width: 250px } #stage .hud { position: fixed !important; left: 280px; bottom: auto; top: 170px }`,
                });
                await page.waitForFunction((w) => window.mane.view.canvas.width === w, stage[0]);
            }
            const note = await work(page);
            assert.deepEqual(complaints, []);
            return note;
        } finally {
            await close();
        }
    }
    const settled = (page) => page.waitForFunction(() => window.mane.settled, null, { timeout: 40_000 });
    const few = (page) => page.evaluate(() => window.mane.panel.set({ strands: 1500, width: 12 })); // software WebGL is slow
    const frame = (page) => page.evaluate(() => window.mane.player.frame);
    /** Changes a slider by its label, as a hand does. */
    const slide = (page, label, place) =>
        page.getByLabel(label, { exact: true }).evaluate((input, share) => {
            input.value = String(Number(input.min) + share * (Number(input.max) - Number(input.min)));
            input.dispatchEvent(new Event("input"));
        }, place);
    const stage = (page) => page.locator("#stage canvas").screenshot();
    const key = (page, name) => page.keyboard.press(name);

    const lastStage = new WeakMap(); // of a page, as long as nothing else has changed it
    async function different(page, what, change) {
        await settled(page);
        const before = lastStage.get(page) ?? (await stage(page));
        await change();
        await settled(page);
        const after = await stage(page);
        lastStage.set(page, after);
        const { worst } = await perceptualDifference(page, before, after);
        assert(worst > 4, `${what} changes nothing that can be seen: ΔE ${worst.toFixed(1)} in the worst place`);
    }

    /** Largest distance [m] between strands in the page and those of `mane extract`. */
    async function strandsDiffer(file, cache, at) {
        const count = 3000;
        run("extract", cache, "--frame", String(at), "--layer", "strands", "--strands", String(count), "--samples", "4", "-o", "strands.hair");
        const all = readHair(join(folder, "strands.hair"));
        const strands = Array.from({ length: 300 }, (_, i) => 10 * i);
        return within(file, (page) =>
            page.evaluate(async ({ count, at, strands, vertices, expected }) => {
                const { view, panel, run } = window.mane;
                panel.set({ strands: count });
                view.setFrame(run.frame(at));
                let next = 0;
                // Every quarter of a segment, and the end.
                const points = view.readBack(strands, (end) => {
                    const n = vertices[next++];
                    return Array.from({ length: n }, (_, i) => (i + 1 < n ? i / 4 : end));
                });
                const origin = run.frame(at).origin;
                let worst = 0;
                for (let i = 0; i < points.length; i += 3)
                    worst = Math.max(worst, Math.hypot(...[0, 1, 2].map((a) => points[i + a] + origin[a] - expected[i + a])));
                return worst;
            }, {
                count, at, strands,
                vertices: strands.map((s) => all[s].length / 3),
                expected: strands.flatMap((s) => all[s]),
            }));
    }

    /** A page whose data was changed by `damage(text)`; what it says. */
    async function messageOf(name, damage) {
        const html = readFileSync(recorded(), "utf8");
        const [whole, data] = /id="run">([^<]*)</.exec(html);
        const file = join(folder, `${name}.html`);
        writeFileSync(file, html.replace(whole, () => `id="run">${damage(data)}<`));
        const { page, complaints, close } = await openPage(browser, pathToFileURL(file).href);
        try {
            const text = await page.locator(".message").innerText({ timeout: 10_000 });
            assert.deepEqual(complaints, []);
            return text;
        } finally {
            await close();
        }
    }

    return [
        ["view: bytes of a page", async () => {
            const bytes = statSync(recorded()).size;
            const whole = (bytes / kFrames) * 264;
            assert(whole < 20e6, `264 frames with contacts would take ${whole} bytes`);
            return `${(bytes / 1e6).toFixed(2)} MB for ${kFrames} frames of long with contacts`;
        }],
        ["view: strands are those of mane extract", async () => {
            const worst = await strandsDiffer(recorded(), "recorded.mane", 17);
            assert(worst < 3e-6, `${worst} m`);
            return `at most ${(1e6 * worst).toFixed(2)} µm apart`;
        }],
        ["view: so are wavy and curly ones", async () => {
            const worst = await strandsDiffer(wavy(), "wavy.mane", 17);
            assert(worst < 3e-6, `${worst} m`);
            return `at most ${(1e6 * worst).toFixed(2)} µm apart`;
        }],
        ["view: plays, pauses, steps and loops", () => within(recorded(), async (page) => {
            await few(page);
            await different(page, "another frame", () => page.getByLabel("frame", { exact: true }).fill("20"));
            assert.equal(await frame(page), 20);
            await page.evaluate(() => {
                window.shown = new Set();
                const { view } = window.mane,
                    setFrame = view.setFrame;
                view.setFrame = (f) => {
                    window.shown.add(f.index);
                    setFrame.call(view, f);
                };
            });
            await key(page, " ");
            await page.waitForFunction(() => window.shown.size > 5);
            await page.locator(".play").click();
            const paused = await frame(page);
            await page.waitForTimeout(300);
            assert.equal(await frame(page), paused);
            await key(page, "ArrowRight");
            assert.equal(await frame(page), Math.min(paused + 1, kFrames - 1));
            await key(page, "Home");
            await key(page, "ArrowRight");
            assert.equal(await frame(page), 1);
            await key(page, "ArrowLeft");
            await key(page, "Home");
            assert.equal(await frame(page), 0);
            await page.locator("#loop").click(); // off
            await key(page, "End");
            await key(page, "ArrowLeft");
            await page.getByRole("button", { name: "2×" }).click();
            await key(page, " ");
            await page.waitForFunction((last) => window.mane.player.frame === last && !window.mane.player.playing, kFrames - 1);
            await page.locator("#loop").click(); // on
            await key(page, "ArrowLeft");
            await key(page, " ");
            await page.waitForFunction(() => window.mane.player.frame < 10);
            await key(page, " ");
        })],
        ["view: plays at the speed that it says", () => within(recorded(), async (page) => {
            await few(page);
            await page.evaluate(() => window.mane.panel.set({ layers: { strands: false, skeleton: true, sections: false, envelope: false, character: true } }));
            const passed = async (speed) => {
                await page.getByRole("button", { name: speed, exact: true }).click();
                return page.evaluate(async () => {
                    const { player } = window.mane;
                    player.seek(0);
                    player.playing = true;
                    let seconds = 0;
                    const advance = player.advance;
                    player.advance = function (s) {
                        if (this.playing) seconds += s;
                        advance.call(this, s);
                    };
                    while (player.frame < 6) await new Promise(requestAnimationFrame);
                    player.playing = false;
                    player.advance = advance;
                    return (player.position / 24) / seconds;
                });
            };
            for (const [label, speed] of [["1×", 1], ["½", 0.5], ["2×", 2]]) {
                const found = await passed(label);
                assert(Math.abs(found / speed - 1) < 1e-6, `${label} plays ${found} seconds in one`);
            }
        })],
        ["view: each layer, colour, count and width shows", () => within(recorded(), async (page) => {
            await few(page);
            const press = (name) => () => page.getByRole("button", { name, exact: true }).click();
            await different(page, "the layer strands", () => key(page, "4"));
            await different(page, "the layer character", press("Character"));
            for (const layer of ["Skeleton", "Cross-sections", "Envelope"]) await different(page, `the layer ${layer}`, press(layer));
            for (const digit of ["1", "2", "3", "4"]) await key(page, digit);
            lastStage.delete(page);
            await different(page, "blond", press("blond"));
            await different(page, "colour by wisp", press("By wisp"));
            await different(page, "the width", () => slide(page, "Width", 0.02));
            await different(page, "the count", () => slide(page, "Strands", 0.266));
            assert.match(await page.locator(".hud").innerText(), /of 4,100 strands/);
        })],
        ["view: the camera goes round, near and back to the head", () => within(recorded(), async (page) => {
            await few(page);
            const camera = () => page.evaluate(() => ({ ...window.mane.view.camera }));
            const box = await page.locator("#stage canvas").boundingBox();
            const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
            const first = await camera();
            const drag = async () => {
                await page.mouse.move(x, y);
                await page.mouse.down();
                await page.mouse.move(x + 60, y + 20, { steps: 3 });
                await page.mouse.up();
            };
            await different(page, "a drag", drag);
            const turned = await camera();
            assert(turned.yaw < first.yaw - 0.2 && turned.pitch > first.pitch + 0.05);
            await page.keyboard.down("Shift");
            await drag();
            await page.keyboard.up("Shift");
            assert.notDeepEqual((await camera()).target, turned.target);
            await page.mouse.wheel(0, -300);
            await page.waitForFunction((d) => window.mane.view.camera.distance < 0.9 * d, first.distance);
            await page.getByRole("button", { name: "Three-quarter" }).click();
            const back = await camera();
            assert.deepEqual([back.yaw, back.distance], [first.yaw, first.distance]);
            // The camera follows the head, or it does not.
            const moved = async () => {
                const shows = (index) => page.waitForFunction((i) => window.mane.shownFrame === i, index);
                const before = (await camera()).target;
                await key(page, "End");
                await shows(kFrames - 1);
                const after = (await camera()).target;
                await key(page, "Home");
                await shows(0);
                return Math.hypot(...before.map((c, i) => c - after[i]));
            };
            const following = await moved();
            assert(following > 0.001, `the camera followed by ${following} m`);
            await page.getByRole("button", { name: "Follow" }).click();
            assert.equal(await moved(), 0);
        })],
        ["view: a PNG of the frame", () => within(recorded(), async (page) => {
            await few(page);
            await settled(page);
            const save = async (options) => {
                const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "PNG" }).click(options)]);
                assert.equal(download.suggestedFilename(), "recorded-0000.png");
                return readFileSync(await download.path());
            };
            const png = await save();
            assert.equal(png.subarray(1, 4).toString(), "PNG");
            const size = await page.evaluate(() => [window.mane.view.canvas.width, window.mane.view.canvas.height]);
            assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], size);
            const { mean } = await perceptualDifference(page, png, png);
            assert.equal(mean, 0);
            assert(png.length > 20_000, "an empty picture");
            const cornerOpacity = (bytes) => page.evaluate(async (base64) => {
                const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
                const context = new OffscreenCanvas(1, 1).getContext("2d");
                context.drawImage(image, 0, 0);
                return context.getImageData(0, 0, 1, 1).data[3];
            }, bytes.toString("base64"));
            assert.equal(await cornerOpacity(png), 255);
            assert.equal(await cornerOpacity(await save({ modifiers: ["Shift"] })), 0);
        })],
        ["view: a plot jumps where it is clicked", () => within(recorded(), async (page) => {
            await few(page);
            const names = await page.locator("#plots .plot").evaluateAll((plots) => plots.map((p) => p.dataset.plot));
            assert.deepEqual(names, ["kinetic energy", "contacts", "volume", "deepest penetration", "time per stage"]);
            for (const [i, name] of names.entries()) {
                const area = page.locator(`[data-plot="${name}"] .area`);
                await area.scrollIntoViewIfNeeded();
                const { width, height } = await area.boundingBox();
                const share = 0.15 + 0.15 * i;
                await area.click({ position: { x: share * width, y: height / 2 } });
                assert(Math.abs((await frame(page)) - share * (kFrames - 1)) <= 0.6, `${name} jumped to ${await frame(page)}`);
            }
            await page.getByRole("button", { name: "Plots" }).click();
            assert(await page.locator("#plots").isHidden());
        })],
        ["view: why a wisp moved", () => within(recorded(), async (page) => {
            await few(page);
            await key(page, "End");
            await settled(page);
            const at = await page.evaluate(() => {
                const { clientWidth: w, clientHeight: h } = window.mane.view.canvas;
                for (let y = 0.2; y < 0.8; y += 0.02)
                    for (let x = 0.3; x < 0.7; x += 0.02) {
                        const wisp = window.mane.wispAt(x * w, y * h);
                        if (wisp >= 0) return { x: x * w, y: y * h, wisp };
                    }
            });
            assert(at, "no wisp can be met");
            await different(page, "a selected wisp", () => page.locator("#stage canvas").click({ position: { x: at.x, y: at.y } }));
            assert.match(await page.locator("#wisp").innerText(), new RegExp(`WISP ${at.wisp}\\b`, "i"));
            for (const plot of ["stretch", "radii", "energy"]) await page.locator(`#wisp [data-plot="${plot}"] canvas`).waitFor();

            // What is listed is what was recorded, the strongest first; every one is marked.
            const found = await page.evaluate((wisp) => {
                const { run, view, player } = window.mane;
                const contacts = run.contacts.ofWisp(player.frame, run.hair, wisp);
                return { count: contacts.length, marks: view.marks.count, strengths: contacts.filter((c) => c.kind < 3).map((c) => c.strength) };
            }, at.wisp);
            assert(found.count > 0 && found.marks >= found.count);
            assert.deepEqual(found.strengths, [...found.strengths].sort((a, b) => b - a));
            const groups = page.locator(".contacts details");
            assert.match(await groups.first().innerText(), /(friction|collision|sliding contact|penetration reaction) with .*(N·s|mm)/s);
            const counts = await groups.locator("ul").evaluateAll((lists) => lists.map((l) => l.children.length));
            assert(counts.reduce((a, b) => a + b) >= Math.min(found.count, 40));
            await groups.first().locator("summary").click();
            assert.match(await groups.first().locator("li").first().innerText(), /sections? \d+.*(N·s|mm)/s);

            const link = groups.locator(".go").first();
            const partner = /wisp (\d+)/.exec(await link.getAttribute("title"))[1];
            await link.click();
            assert.match(await page.locator("#wisp").innerText(), new RegExp(`WISP ${partner}\\b`, "i"));
            await key(page, "Escape");
            assert.match(await page.locator("#wisp").innerText(), /Click a wisp/);
            assert.equal(await page.evaluate(() => window.mane.view.marks.count), 0);
            return `wisp ${at.wisp}: ${found.count} contacts`;
        })],
        ["view: says what was not recorded", () => within(wavy(), async (page) => {
            const text = await page.locator("#plots").innerText();
            assert.match(text, /Contacts were not recorded\..*--record/);
            assert.match(text, /Times were not recorded\..*--record/);
            await page.evaluate(() => window.mane.selectWisp(3));
            assert.match(await page.locator("#wisp").innerText(), /contacts were not recorded\..*--record/i);
        })],
        ["view: damaged pages say so", async () => {
            const flipped = (data, share) => {
                const at = Math.floor(data.length * share);
                return data.slice(0, at) + (data[at] === "A" ? "B" : "A") + data.slice(at + 1);
            };
            assert.match(await messageOf("half", (data) => data.slice(0, data.length / 2)), /damaged or was not copied whole/);
            assert.match(await messageOf("bit", (data) => flipped(data, 0.6)), /damaged/);
            assert.match(await messageOf("letters", (data) => `${data.slice(0, 999)}%%%${data.slice(1000)}`), /damaged/);
            assert.match(await messageOf("empty", () => ""), /damaged/);
            const packed = (bytes) => execFileSync(process.execPath, ["-e", "process.stdout.write(require('zlib').deflateSync(require('fs').readFileSync(0)).toString('base64'))"], { input: bytes }).toString();
            assert.match(await messageOf("other", () => packed(Buffer.from("hello, hello, hello"))), /no run of mane/);
            const version = Buffer.concat([Buffer.from("MANEPAGE"), Buffer.from([9, 0, 0, 0, 0, 0, 0, 0])]);
            assert.match(await messageOf("version", () => packed(version)), /version 9/);
        }],
        ["view: what is dropped is shown, or it says why not", () => within(recorded(), async (page) => {
            await few(page);
            const drop = (name, text) => page.evaluate(([name, text]) => {
                const data = new DataTransfer();
                data.items.add(new File([text], name));
                window.dispatchEvent(new DragEvent("drop", { dataTransfer: data }));
            }, [name, text]);
            await drop("long.mane", "no page");
            assert.match(await page.locator(".message").innerText(), /long\.mane is no page of mane.*mane view/s);
            await page.getByRole("button", { name: "Close" }).click();
            await drop("wavy.html", readFileSync(wavy(), "utf8"));
            await page.waitForFunction(() => window.mane.run.title === "wavy");
        })],
        ["view: fixed frames look as approved", async () => {
            const folder = join(project, "viewer/test/approved");
            if (renew) mkdirSync(folder, { recursive: true });
            const notes = [];
            const only = (layers) => ({ layers: { strands: false, skeleton: false, sections: false, envelope: false, character: true, ...layers } });
            const pictures = [
                ["long-strands", recorded(), only({ strands: true }), 90],
                ["long-layers", recorded(), only({ skeleton: true, sections: true }), 40],
                ["long-envelope", recorded(), only({ envelope: true }), 180],
                ["long-curls", wavy(), { colour: [0.72, 0.5, 0.25] }, 0],
            ];
            const compare = async (page, name, look, degrees) => {
                await page.evaluate((look) => {
                    window.mane.panel.set({ strands: 4000, width: 8, ...look });
                    window.mane.seek(20);
                }, look);
                await page.waitForFunction(() => window.mane.shownFrame === 20);
                await page.evaluate((degrees) => window.mane.lookFrom(degrees), degrees);
                await page.waitForTimeout(300);
                await settled(page);
                const picture = await stage(page);
                const approved = join(folder, `${name}.png`);
                if (renew) return writeFileSync(approved, picture);
                const { mean, worst } = await perceptualDifference(page, readFileSync(approved), picture);
                notes.push(`${name} ΔE ${mean.toFixed(2)}, at most ${worst.toFixed(1)}`);
                if (mean > kMeanDifference || worst > kWorstDifference) {
                    const actual = join(process.cwd(), `${name}.actual.png`);
                    writeFileSync(actual, picture);
                    assert.fail(`${notes.at(-1)}: see ${actual}; if it is better, renew the approved one with --renew`);
                }
            };
            for (const file of [recorded(), wavy()])
                await within(file, async (page) => {
                    for (const [name, of, look, degrees] of pictures) if (of === file) await compare(page, name, look, degrees);
                }, { stage: [256, 256] });
            return notes.join("; ");
        }],
        // How long it takes is told, not judged: machines differ, and share their processors (docs/view.md has the figures of one).
        ["view: 10,000 strands at once, then more until all 100,000 are there", async () => {
            const file = recorded();
            const start = performance.now();
            const seconds = () => ((performance.now() - start) / 1000).toFixed(1);
            return within(file, async (page) => {
                await page.waitForFunction(() => window.mane?.shownStrands > 0, null, { timeout: 60_000 });
                const first = seconds();
                const counts = await page.evaluate(async () => {
                    const seen = [window.mane.shownStrands];
                    while (seen.at(-1) < 100_000) {
                        await new Promise(requestAnimationFrame);
                        if (window.mane.shownStrands !== seen.at(-1)) seen.push(window.mane.shownStrands);
                    }
                    return seen;
                });
                assert(counts[0] >= 10_000, `the first picture has ${counts[0]} strands`);
                assert(counts.length > 3 && counts.every((count, i) => i === 0 || count > counts[i - 1]), `pictures of ${counts} strands`);
                return `${counts[0]} after ${first} s, all after ${seconds()} s; load ${loadavg()[0].toFixed(1)} on ${cpus().length} cores`;
            }, { width: 1280, height: 800, stage: null });
        }],
    ];
}
