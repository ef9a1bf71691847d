// The live page of `mane live`: the solver in a browser, against the native one.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { openPage } from "./browser.mjs";

const kScript = new URL("./live_script.txt", import.meta.url);

export async function tests({ mane, browser, folder, project }) {
    const run = (command, ...args) => execFileSync(command, args, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
    if (/without its live page/.test(await complaintOf(() => run(mane, "live", "-o", "live.html")))) {
        console.log("skipped: live: mane was built without emscripten");
        return process.env.CI === "true" ? [["live page", () => assert.fail("mane was built without emscripten")]] : [];
    }
    const long = join(project, "scenes/long.toml");

    /** Opens a page with few strands, since software WebGL is slow. */
    async function open(url) {
        const opened = await openPage(browser, url, { width: 900, height: 620 });
        await opened.page.waitForFunction(() => window.mane?.frames?.newest, null, { timeout: 40_000 });
        await opened.page.evaluate(() => window.mane.look.set({ strands: 1500 }));
        return opened;
    }
    /** A halted page at the first frame of its scene. */
    async function halt(page) {
        await page.evaluate(() => {
            window.mane.setRunning(false);
            window.mane.restart();
        });
        await page.waitForFunction(() => window.mane.frames?.newest?.index === 0);
    }
    const file = (name) => pathToFileURL(join(folder, name)).href;

    let shared; // one page for most tests: to start one takes longer than they do
    /** The page from a disk, halted with `long` just opened. It must not complain nor ask for anything. */
    async function fromDisk(work) {
        shared ??= await open(file("live.html"));
        const { page, complaints } = shared;
        await page.evaluate((text) => {
            document.querySelector(".message")?.remove();
            window.mane.setRunning(false);
            window.mane.hand.tool = "turn";
            window.mane.open({ name: `long.toml`, text, files: [] });
        }, readFileSync(long, "utf8"));
        await hash(page);
        await page.waitForFunction(() => window.mane.world.name === "long.toml" && window.mane.frames?.newest?.index === 0);
        const note = await work(page);
        assert.deepEqual(complaints, []);
        return note;
    }
    /** A page of its own. */
    async function alone(url, work) {
        const { page, complaints, close } = await open(url);
        try {
            await halt(page);
            return { note: await work(page), complaints };
        } finally {
            await close();
        }
    }

    const hash = (page) => page.evaluate(() => window.mane.stateHash());
    const scene = (page) => page.evaluate(() => window.mane.link.ask("scene"));
    const advance = async (page, frames) => {
        await page.evaluate((n) => window.mane.step(n), frames);
        await hash(page); // behind it
    };
    /** The newest frame, in the world; and where the head is. */
    const frame = (page) =>
        page.evaluate(() => {
            const { newest } = window.mane.frames;
            const { headBone } = window.mane.world.bodies[0];
            const position = Array.from(newest.position, (x, i) => x + newest.origin[i % 3]);
            const { rotation, position: bones } = newest.bodies[0];
            return {
                index: newest.index, time: newest.time, position,
                head: { rotation: [...rotation.slice(4 * headBone, 4 * headBone + 4)], position: [...bones.slice(3 * headBone, 3 * headBone + 3)] },
            };
        });
    const farthest = (a, b) => a.reduce((most, x, i) => Math.max(most, Math.abs(x - b[i])), 0);
    const value = async (page, key) => new RegExp(`^${key.split(".")[1]} = (.*)$`, "m").exec((await scene(page)).split(`[${key.split(".")[0]}]\n`)[1])[1];
    /** Types a value into a field's text, as a person does. */
    async function type(page, key, text) {
        await page.evaluate((key) => (document.querySelector(`.field[data-key="${key}"]`).closest("details").open = true), key);
        const input = page.locator(`.field[data-key="${key}"] .value`).first();
        await input.fill(text);
        await input.press("Enter");
        await input.blur();
        await hash(page);
    }
    const drop = (page, name, content) =>
        page.evaluate(([name, content]) => {
            const files = new DataTransfer();
            files.items.add(new File([content], name));
            window.dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true, bubbles: true }));
        }, [name, content]);
    const message = async (page) => (await page.locator(".message p").first().innerText({ timeout: 20_000 })).trim();
    /** From the middle of the picture, where the head is. */
    async function drag(page, dx, dy) {
        const box = await page.locator("#stage canvas").boundingBox();
        const [x, y] = [box.x + box.width / 2, box.y + box.height * 0.4];
        await page.mouse.move(x, y);
        await page.mouse.down();
        for (let i = 1; i <= 4; ++i) await page.mouse.move(x + (dx * i) / 4, y + (dy * i) / 4);
        await page.mouse.up();
        await hash(page);
    }

    /** Does in a page what the script says; gives the hashes. */
    async function obey(page, script) {
        const hashes = [];
        for (const line of script.split("\n").filter((l) => l && !l.startsWith("#"))) {
            const [what, rest = ""] = line.split(/ (.*)/s);
            const n = rest.split(" ").map(Number);
            const request = {
                advance: () => ({ kind: "advance", frames: n[0] }),
                set: () => ({ kind: "set", settings: [{ key: rest.split("=")[0], value: rest.slice(rest.indexOf("=") + 1) }] }),
                rates: () => ({ kind: "rates", preset: rest }),
                hold: () => ({ kind: "hold", hold: { position: n.slice(0, 3), yaw: n[3], pitch: n[4], roll: n[5] } }),
                teleport: () => ({ kind: "teleport", by: n }),
                pin: () => ({ kind: "pin", section: n[0], position: n.slice(1) }),
                release: () => ({ kind: "release", section: n[0] }),
                restart: () => ({ kind: "restart" }),
            }[what];
            if (what === "hash") hashes.push(await hash(page));
            else await page.evaluate((r) => window.mane.link.send(r), request());
        }
        return hashes;
    }
    const nativeHashes = () => run(process.env.MANE_LIVE_SCRIPT, long, kScript.pathname).trim().split("\n");
    const simulatedHash = (scene, frames) => {
        run(mane, "simulate", scene, "-o", "twin.mane", "--frames", String(frames), "--stats", "twin.json");
        return JSON.parse(readFileSync(join(folder, "twin.json"), "utf8")).state_hash;
    };

    return [
        ["live page runs from a disk: hair moves, no error, no request", () =>
            fromDisk(async (page) => {
                const before = await frame(page);
                await page.getByRole("button", { name: "Shake" }).click();
                await page.evaluate(() => window.mane.setRunning(true));
                await page.waitForFunction((time) => window.mane.frames.newest.time > time + 0.5, before.time, { timeout: 40_000 });
                const after = await frame(page);
                assert(farthest(before.position, after.position) > 1e-3, "nothing has moved");
                return `frame ${before.index} to ${after.index}`;
            })],

        ["live state is the native one, bit for bit, whatever is changed, led, teleported and pinned", () =>
            fromDisk(async (page) => {
                const expected = nativeHashes();
                assert.deepEqual(await obey(page, readFileSync(kScript, "utf8")), expected);
                assert(new Set(expected).size === expected.length, "the script changes nothing");
                return `${expected.length} hashes, last ${expected.at(-1)}`;
            })],

        ["live run is the one of mane simulate, and its scene as TOML gives it again", () =>
            fromDisk(async (page) => {
                const frames = 5;
                await type(page, "schedule.preroll", "0.25");
                await type(page, "skeleton.bending_length", "8 cm");
                await type(page, "air.drag", "4");
                await page.evaluate(() => window.mane.restart());
                await advance(page, 6 + frames - 1);
                await page.context().grantPermissions(["clipboard-read", "clipboard-write"]).catch(() => {});
                await page.getByRole("button", { name: "Copy TOML" }).click();
                await page.getByRole("button", { name: "Copied" }).waitFor();
                writeFileSync(join(folder, "copied.toml"), await page.evaluate(() => navigator.clipboard.readText()));
                assert.match(readFileSync(join(folder, "copied.toml"), "utf8"), /bending_length = 0\.08\n/);
                const expected = simulatedHash("copied.toml", frames);
                assert.equal(await hash(page), expected);
                return expected;
            })],

        ["live parameters: sliders, typed units, undo, redo, reset; refused values leave all as it was", () =>
            fromDisk(async (page) => {
                const wind = page.getByLabel("air.wind x", { exact: true });
                await wind.evaluate((slider) => {
                    for (const way of [0.6, 0.7, 0.8]) {
                        slider.value = String(way);
                        slider.dispatchEvent(new Event("input"));
                    }
                    slider.dispatchEvent(new Event("change"));
                });
                assert.equal(await value(page, "air.wind"), "[6.0, 0.0, 0.0]");
                await type(page, "wisps.friction", "25");
                await type(page, "skeleton.bending_length", "75 mm");
                assert.equal(await value(page, "skeleton.bending_length"), "0.075");
                const key = async (name) => {
                    await page.keyboard.press(name);
                    await hash(page);
                };
                await page.locator("#stage canvas").focus();
                await key("z");
                await key("z");
                assert.equal(await value(page, "wisps.friction"), "10.0");
                await key("z"); // one pull of the slider is one step
                assert.equal(await value(page, "air.wind"), "[0.0, 0.0, 0.0]");
                await key("y");
                assert.equal(await value(page, "air.wind"), "[6.0, 0.0, 0.0]");
                await page.getByRole("button", { name: "Reset", exact: true }).click();
                assert.equal(await value(page, "air.wind"), "[0.0, 0.0, 0.0]");
                const before = await scene(page);
                await type(page, "skeleton.strain", "0.0001"); // no explicit step is stable with this
                assert.match(await page.locator(".notice").innerText(), /strain|stable/);
                await type(page, "air.drag", "3 apples");
                assert.match(await page.locator(".notice").innerText(), /air\.drag: found "3 apples", expected a number/);
                assert.equal(await scene(page), before);
                await page.getByPlaceholder("Find a parameter").fill("jitter");
                assert.deepEqual(await page.locator(".field:visible .name").allInnerTexts(), ["jitter", "length jitter"]);
                await page.getByPlaceholder("Find a parameter").fill("");
            })],

        ["live hair answers to gravity, and to nothing that says the same again", () =>
            fromDisk(async (page) => {
                await advance(page, 2);
                await type(page, "air.drag", "3");
                await advance(page, 4);
                const [same, plain] = [await hash(page), await frame(page)];
                await page.evaluate(() => window.mane.restart());
                await advance(page, 6);
                assert.equal(await hash(page), same);
                await page.evaluate(() => window.mane.restart());
                await page.evaluate(() => window.mane.link.send({ kind: "set", settings: [{ key: "simulation.gravity", value: "[0, 5, 0]" }] }));
                await advance(page, 6);
                const lifted = await frame(page);
                const mean = ({ position }) => position.reduce((sum, x, i) => sum + (i % 3 === 1 ? x : 0), 0) / (position.length / 3);
                assert(mean(lifted) > mean(plain) + 0.01, "hair does not rise");
            })],

        ["live head: turned and moved by mouse and keys, at ease again", () =>
            fromDisk(async (page) => {
                const still = await frame(page);
                await drag(page, 80, 0);
                await advance(page, 10);
                const turned = await frame(page);
                const angle = 2 * Math.asin(Math.abs(turned.head.rotation[1]));
                assert(Math.abs(angle - 0.64) < 0.03, `the head is turned by ${angle}, expected 80 × 0.008 rad`);
                await page.getByRole("button", { name: "Move", exact: true }).click();
                await drag(page, 0, -60);
                await page.locator("#stage canvas").focus();
                await page.keyboard.press("q");
                await advance(page, 10);
                const moved = await frame(page);
                assert(farthest(moved.position, turned.position) > 0.03, "the head has not moved");
                assert(Math.abs(moved.head.rotation[2]) > 0.04, "the head does not lean");
                await page.getByRole("button", { name: "At ease" }).click();
                await advance(page, 10);
                assert(farthest((await frame(page)).head.rotation, still.head.rotation) < 2e-2, "the head does not come back");
            })],

        ["live hair: pulled, pinned and released", () =>
            fromDisk(async (page) => {
                await page.getByRole("button", { name: "Pull hair" }).click();
                // The skeleton point that is seen nearest to the middle.
                const tip = await page.evaluate(() => {
                    const { world: { hair }, frames: { newest: { position, origin } }, view: { canvas, camera } } = window.mane;
                    const box = canvas.getBoundingClientRect();
                    const clip = camera.clip([0, 0, 0], canvas.width, canvas.height);
                    const seen = (s) => {
                        const p = [0, 1, 2].map((i) => position[3 * s + i] + origin[i]);
                        const at = (row) => clip[row] * p[0] + clip[4 + row] * p[1] + clip[8 + row] * p[2] + clip[12 + row];
                        const [x, y] = [at(0) / at(3), at(1) / at(3)];
                        return { far: Math.hypot(x, y), x: box.x + ((1 + x) / 2) * box.width, y: box.y + ((1 - y) / 2) * box.height };
                    };
                    const ends = Array.from(hair.firstSection.slice(1), (end) => seen(end - 2));
                    return ends.reduce((best, one) => (one.far < best.far ? one : best));
                });
                await page.mouse.move(tip.x, tip.y);
                await page.mouse.down();
                for (let i = 1; i <= 5; ++i) await page.mouse.move(tip.x + 8 * i, tip.y - 10 * i);
                await page.mouse.up();
                const pins = () => page.evaluate(() => [...window.mane.hand.pins]);
                const [[section, place], ...others] = await pins();
                assert.equal(others.length, 0);
                const distance = async () => {
                    const { position } = await frame(page);
                    return Math.hypot(...[0, 1, 2].map((i) => position[3 * section + i] - place[i]));
                };
                await advance(page, 8);
                assert((await distance()) < 1e-5, `the pinned point is ${await distance()} m away`);
                await page.mouse.click(tip.x + 40, tip.y - 50);
                assert.equal((await pins()).length, 0);
                await advance(page, 8);
                assert((await distance()) > 0.01, "the point was not released");
            })],

        ["live teleport is no shock: hair stays on the head as it was", () =>
            fromDisk(async (page) => {
                await advance(page, 8);
                const before = await frame(page);
                await page.getByRole("button", { name: "Teleport" }).click();
                await hash(page);
                const there = await frame(page);
                const expected = before.position.map((x, i) => x + [1, 0, -0.5][i % 3]);
                assert(farthest(there.position, expected) < 2e-5, `off by ${farthest(there.position, expected)} m`);
                await advance(page, 1);
                const speed = farthest((await frame(page)).position, there.position) * 24;
                assert(speed < 1.5, `hair moves at ${speed} m/s`);
            })],

        ["live pause, single step, restart", () =>
            fromDisk(async (page) => {
                const index = async () => (await frame(page)).index;
                await page.getByTitle("one frame on").click();
                await hash(page);
                assert.equal(await index(), 1);
                await page.keyboard.press(".");
                await hash(page);
                assert.equal(await index(), 2);
                await page.getByTitle("run or pause").click();
                await page.waitForFunction(() => window.mane.frames.newest.index > 4, null, { timeout: 20_000 });
                await page.keyboard.press(" ");
                await hash(page);
                const halted = await index();
                await page.waitForTimeout(250);
                assert.equal(await index(), halted);
                await page.keyboard.press("r");
                await page.waitForFunction(() => window.mane.frames.newest?.index === 0);
            })],

        ["live files: scenes, clips, and readable messages for what is none", () =>
            fromDisk(async (page) => {
                await drop(page, "broken.toml", "[style]\nwisps = 20\nlenght = 3\n");
                assert.match(await message(page), /^broken\.toml:3: unknown key style\.lenght/);
                await page.getByRole("button", { name: "Close" }).click();
                await drop(page, "broken.bvh", "HIERARCHY\nROOT Hips\n{\nOFFSET 0 zero 0\n");
                assert.match(await message(page), /broken\.bvh:4: "zero", expected an offset as a finite number/);
                await page.getByRole("button", { name: "Close" }).click();
                await drop(page, "picture.png", "\u0089PNG");
                assert.match(await message(page), /picture\.png: expected a scene \(\.toml\), a clip \(\.bvh\)/);
                await page.getByRole("button", { name: "Close" }).click();
                await drop(page, "few.toml", "[style]\nwisps = 20\n");
                await page.waitForFunction(() => window.mane.world.name === "few.toml", null, { timeout: 20_000 });
                assert.equal(await page.evaluate(() => window.mane.world.hair.wisps), 20);
                await drop(page, "nod.bvh", nod());
                await advance(page, 24);
                assert.match(await scene(page), /clip = "\/nod\.bvh"/);
                assert(Math.abs((await frame(page)).head.rotation[0]) > 0.05, "the clip does not move the head");
                await page.getByRole("button", { name: "Medium" }).click();
                await page.waitForFunction(() => window.mane.world.name === "medium.toml", null, { timeout: 20_000 });
            })],

        ["live page with a scene of one's own takes along what it names", async () => {
            writeFileSync(join(folder, "nod.bvh"), nod());
            writeFileSync(join(folder, "own.toml"), '[style]\nwisps = 12\n[motion]\nclip = "nod.bvh"\nunit = 0.01\n');
            run(mane, "live", "own.toml", "--set", "air.drag=5", "-o", "own.html");
            const { note, complaints } = await alone(file("own.html"), async (page) => {
                assert.equal(await value(page, "air.drag"), "5.0");
                await advance(page, 30);
                assert(Math.abs((await frame(page)).head.rotation[0]) > 0.05, "the clip does not move the head");
            });
            assert.deepEqual(complaints, []);
            return note;
        }],

        ["live meter: long at paper rates on one thread", async () => {
            run(mane, "live", long, "--rates", "paper", "-o", "paper.html");
            const { note } = await alone(file("paper.html"), async (page) => {
                await page.evaluate(() => (document.querySelector("#stage canvas").style.display = "none"));
                await advance(page, 120); // compilers of browsers take their time
                return page.evaluate(() => `${window.mane.speed.toFixed(1)} × real time, ${document.querySelector(".meter").innerText.replaceAll("\n", ", ")}`);
            });
            return note;
        }],

        ["live server isolates the page: threads, shared memory, the same bits", async () => {
            const server = spawn(mane, ["live", "--serve", "--port", "0"], { stdio: ["ignore", "pipe", "inherit"] });
            try {
                const address = await new Promise((resolve) => server.stdout.on("data", (text) => resolve(String(text).split(" ")[0])));
                const { note, complaints } = await alone(`${address}?threads=2`, async (page) => {
                    assert(await page.evaluate(() => crossOriginIsolated && window.mane.world.shared instanceof SharedArrayBuffer));
                    const script = readFileSync(kScript, "utf8").split("teleport")[0]; // as many steps as it takes for threads to meet
                    const hashes = await obey(page, `${script}\nhash`);
                    assert.deepEqual(hashes.slice(0, 2), nativeHashes().slice(0, 2));
                    return page.locator(".facts").innerText();
                });
                assert.deepEqual(complaints.filter((c) => !c.startsWith(`request: ${address}solver_threads.`)), []);
                assert.match(note, /2 threads/);
                return note;
            } finally {
                server.kill();
            }
        }],

        ["live folder for any web server", () => {
            run(mane, "live", "-o", "site/");
            const files = readdirSync(join(folder, "site")).sort();
            assert.deepEqual(files, ["README.txt", "_headers", "index.html", "solver_threads.js", "solver_threads.wasm", "solver_threads.worker.js"]);
            assert.match(readFileSync(join(folder, "site/README.txt"), "utf8"), /Cross-Origin-Embedder-Policy: require-corp/);
        }],
    ];
}

async function complaintOf(work) {
    try {
        work();
        return "";
    } catch (error) {
        return String(error.stderr ?? error);
    }
}

/** A person of 170 units who nods: a clip in centimetres. */
function nod() {
    const joint = (name, offset, inner) => `JOINT ${name}\n{\nOFFSET 0 ${offset} 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n${inner}}\n`;
    const end = "End Site\n{\nOFFSET 0 18 0\n}\n";
    const trunk = joint("Spine", 15, joint("Spine1", 25, joint("Neck", 15, joint("Head", 10, end))));
    const leg = "JOINT LeftFoot\n{\nOFFSET 0 -92 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 0 10\n}\n}\n";
    const frames = Array.from({ length: 120 }, (_, i) => `0 92 0 ${"0 0 0 ".repeat(4)}0 ${25 * Math.sin(i / 8)} 0 ${"0 0 0"}`);
    return `HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n${trunk}${leg}}\nMOTION\nFrames: 120\nFrame Time: 0.033333\n${frames.join("\n")}\n`;
}
