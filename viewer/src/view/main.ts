import { HairView, kDefaultLook, type Look, type Progress } from "../draw/hair_view";
import { add, subtract } from "../draw/matrix";
import { pickWisp } from "../hair/pick";
import { button, choice, toggle } from "../ui/controls";
import { element } from "../ui/dom";
import { icon } from "../ui/icons";
import { aim, headYaw, kViews, look as lookFrom } from "../ui/focus";
import { HairPanel, kLayers } from "../ui/hair_panel";
import { showKeys } from "../ui/keys";
import { showMessage } from "../ui/message";
import { orbitControls } from "../ui/orbit_controls";
import type { Plot } from "../ui/plot";
import { listenForShortcuts, type Shortcut } from "../ui/shortcuts";
import { headPlots } from "./figures";
import { DamagedPage, readPageData, readPageFile, type PageData } from "./page_data";
import { Player } from "./player";
import { Run } from "./run";
import { WispPanel } from "./wisp_panel";

const kStillBudget = 400, // [ms] of one part of a still picture
    kMovingBudget = 40, // of a picture while things move
    kSettle = 250; // [ms] after the camera moved, until the picture is a still one
const kSpeeds: [string, number][] = [["⅒", 0.1], ["¼", 0.25], ["½", 0.5], ["1×", 1], ["2×", 2]];

/** The playing page: a run, its view, and what is around it. */
class ViewPage {
    readonly view: HairView;
    readonly player: Player;
    readonly panel: HairPanel;
    private readonly wispPanel: WispPanel;
    private readonly plots: Plot[];
    private readonly scrub: HTMLInputElement;
    private readonly clock = element("span", { class: "clock" });
    private readonly hud = element("div", { class: "hud" });
    private readonly playButton: HTMLButtonElement;
    private look: Look;
    private following = true;
    private shown = -1; // frame that the view has
    private progress: Progress = { strands: 0, of: 0, done: false };
    private closed = false;
    private readonly stopListening: () => void;
    private movedAt = -Infinity; // [ms] when the camera last moved
    private before = performance.now();

    constructor(
        readonly run: Run,
        app: HTMLElement,
    ) {
        const canvas = element("canvas", { tabIndex: 0, "aria-label": "the hair" });
        this.view = new HairView(canvas);
        canvas.addEventListener("webglcontextlost", () => this.closed ||
            showMessage("The picture was lost", "The graphics processor was reset or ran out of memory. Reload the page; with fewer strands it needs less.", false));
        this.view.setHair(run.hair, run.bodies);
        this.player = new Player(run.frames, run.frameRate);
        this.look = { ...kDefaultLook, strands: run.hair.strandDesc.count };
        this.view.setLook(this.look);
        this.panel = new HairPanel(this.look, (look) => {
            this.look = look;
            this.view.setLook(look);
        });
        this.wispPanel = new WispPanel(run, this.view, (wisp) => this.selectWisp(wisp), (frame) => this.seek(frame));
        this.plots = headPlots(run, (frame) => this.seek(frame));
        this.scrub = element("input", { type: "range", min: "0", max: String(run.frames - 1), step: "1", "aria-label": "frame", title: "frame (← →)" });
        this.scrub.addEventListener("input", () => this.seek(Number(this.scrub.value)));
        this.playButton = button(icon("play"), "play or pause", () => this.togglePlay(), "Space");
        this.playButton.classList.add("play");

        orbitControls(canvas, this.view.camera, () => this.cameraMoved(), (x, y) => this.selectWisp(this.wispAt(x, y)));
        const shortcuts = this.makeShortcuts();
        this.stopListening = listenForShortcuts(shortcuts);
        app.replaceChildren(
            this.header(shortcuts),
            element("div", { id: "stage" }, canvas, this.viewButtons(), this.hud),
            element("aside", { id: "side" }, this.panel.root, this.wispPanel.root),
            this.footer(),
        );
        this.showFrame(0);
        this.lookFrom(40);
        new ResizeObserver(() => this.resize()).observe(canvas);
        this.resize();
        requestAnimationFrame(() => this.tick());
    }

    private header(shortcuts: readonly Shortcut[]): HTMLElement {
        const { run } = this;
        const segments = (run.hair.firstSection[run.hair.wisps] / run.hair.wisps - 2).toFixed(1);
        return element("header", {},
            element("h1", {}, run.title),
            element("span", { class: "facts" },
                `${run.hair.wisps} wisps of ${segments} segments · ${run.frames} frames at ${run.frameRate} Hz · ${run.contacts ? "with" : "without"} recorded contacts`),
            element("span", { class: "space" }),
            button("PNG", "save the picture of this frame; with Shift, without the background", (e) => this.savePicture(e.shiftKey), "p"),
            button("?", "keys", () => showKeys(kPointers, shortcuts), "h"),
        );
    }

    private viewButtons(): HTMLElement {
        return element("div", { class: "views row" },
            ...kViews.map(([label, degrees, key]) => button(label, `see the head from its ${label.toLowerCase()}`, () => this.lookFrom(degrees), key)),
            toggle("Follow", "the camera moves with the head", this.following, (on) => (this.following = on)).root,
        );
    }

    private footer(): HTMLElement {
        const plots = element("div", { id: "plots" }, ...this.plots.map((p) => p.root));
        const loop = toggle("Loop", "begin again at the end", this.player.looping, (on) => (this.player.looping = on), "l");
        loop.root.id = "loop";
        const speed = choice("speed, relative to real time", kSpeeds, 1, (value) => (this.player.speed = value));
        speed.root.id = "speed";
        const showPlots = toggle("Plots", "energy, contacts, volume, penetration and times of the whole head", true, (on) => {
            plots.hidden = !on;
            this.showPlots();
        });
        return element("footer", {},
            element("div", { id: "transport" },
                element("div", { class: "row" },
                    this.playButton,
                    button(icon("back"), "one frame back", () => this.step(-1), "←"),
                    button(icon("on"), "one frame on", () => this.step(1), "→"),
                    this.clock,
                ),
                element("div", { class: "scrub" }, this.scrub, speed.root, loop.root, showPlots.root),
            ),
            plots,
        );
    }

    private makeShortcuts(): Shortcut[] {
        const shortcuts: Shortcut[] = [
            { keys: [" "], label: "play or pause", does: () => this.togglePlay() },
            { keys: ["ArrowLeft"], label: "one frame back", does: () => this.step(-1) },
            { keys: ["ArrowRight"], label: "one frame on", does: () => this.step(1) },
            { keys: ["Home"], label: "first frame", does: () => this.seek(0) },
            { keys: ["End"], label: "last frame", does: () => this.seek(this.run.frames - 1) },
            { keys: ["l"], label: "loop", does: () => document.getElementById("loop")!.click() },
            ...kLayers.map(([layer, label, , key]) => ({ keys: [key], label: `layer: ${label.toLowerCase()}`, does: () => this.panel.toggleLayer(layer) })),
            ...kViews.map(([label, degrees, key]) => ({ keys: [key], label: `view: ${label.toLowerCase()}`, does: () => this.lookFrom(degrees) })),
            { keys: ["p"], label: "save a PNG", does: () => this.savePicture(false) },
            { keys: ["Escape"], label: "no wisp selected", does: () => this.escape() },
            { keys: ["h", "?"], label: "this list", does: () => showKeys(kPointers, shortcuts) },
        ];
        return shortcuts;
    }

    private escape(): void {
        const message = document.querySelector(".message.help");
        if (message) message.remove();
        else this.selectWisp(-1);
    }

    togglePlay(): void {
        this.player.toggle();
        this.showPlaying();
    }
    seek(frame: number): void {
        this.player.seek(frame);
    }
    private step(by: number): void {
        this.player.step(by);
        this.showPlaying();
    }
    private showPlaying(): void {
        this.playButton.replaceChildren(icon(this.player.playing ? "pause" : "play"));
    }

    selectWisp(wisp: number): void {
        this.panel.set({ selectedWisp: wisp });
        this.wispPanel.setWisp(wisp);
        this.wispPanel.show(this.shown);
    }

    /** The wisp seen at a place of the canvas [CSS pixels]. */
    wispAt(x: number, y: number): number {
        const { canvas, camera } = this.view;
        const frame = this.run.frame(this.shown);
        const { eye, direction } = camera.ray(x / canvas.clientWidth, y / canvas.clientHeight, canvas.clientWidth / canvas.clientHeight);
        const origin = [...frame.origin] as [number, number, number];
        return pickWisp(this.run.hair, this.view.sectionRecords.values, this.view.posedBodies, subtract(eye, origin), direction);
    }

    lookFrom(degrees: number): void {
        lookFrom(this.view.camera, this.view.headCentre(), headYaw(this.run.frame(this.shown), this.run.bodies[0]), degrees);
        this.cameraMoved();
    }
    private cameraMoved(): void {
        this.movedAt = performance.now();
        this.view.touch();
    }

    private resize(): void {
        const { canvas } = this.view,
            scale = Math.min(window.devicePixelRatio, 2);
        const width = Math.round(canvas.clientWidth * scale),
            height = Math.round(canvas.clientHeight * scale);
        if (width === canvas.width && height === canvas.height) return;
        Object.assign(canvas, { width, height });
        this.view.touch();
        this.showPlots();
    }

    private showPlots(): void {
        for (const plot of this.plots) plot.show(Math.max(this.shown, 0));
    }

    private showFrame(index: number): void {
        const head = this.view.headCentre(),
            first = this.shown < 0;
        this.view.setFrame(this.run.frame(index));
        this.shown = index;
        if (this.following && !first) {
            const { camera } = this.view;
            camera.target = add(camera.target, subtract(aim(this.view.headCentre()), aim(head)));
        }
        this.scrub.value = String(index);
        this.clock.textContent = `frame ${index} · ${this.run.time[index].toFixed(2)} s`;
        this.showPlots();
        this.wispPanel.show(index);
    }

    get shownFrame(): number {
        return this.shown;
    }
    get shownStrands(): number {
        return this.progress.strands;
    }
    /** Whether the picture is of this frame and this look, and all there is to it. */
    get settled(): boolean {
        return this.view.settled && this.player.frame === this.shown;
    }

    /** Another run takes this one's place. */
    close(): void {
        this.closed = true;
        this.stopListening();
        this.view.delete();
    }

    private tick(): void {
        if (this.closed) return;
        const now = performance.now();
        const wasPlaying = this.player.playing;
        this.player.advance(Math.min(now - this.before, 250) / 1000);
        this.before = now;
        if (wasPlaying !== this.player.playing) this.showPlaying();
        if (!this.view.busy && this.player.frame !== this.shown) this.showFrame(this.player.frame);
        const moving = this.player.playing || now - this.movedAt < kSettle;
        this.progress = this.view.draw(moving ? kMovingBudget : kStillBudget, moving);
        const { strands, of, done } = this.progress;
        this.hud.textContent = of > 0 ? `${strands.toLocaleString("en")} of ${of.toLocaleString("en")} strands${done || moving ? "" : " …"}` : "";
        requestAnimationFrame(() => this.tick());
    }

    private async savePicture(transparent: boolean): Promise<void> {
        try {
            const url = URL.createObjectURL(await this.view.capture(transparent));
            element("a", { href: url, download: `${this.run.title}-${String(this.shown).padStart(4, "0")}.png` }).click();
            setTimeout(() => URL.revokeObjectURL(url), 10_000);
        } catch (error) {
            showMessage("The picture could not be saved", String(error instanceof Error ? error.message : error), true);
        }
    }
}

const kPointers = "Drag to go round the head, with Shift to move across; wheel to come nearer. Click a wisp to see why it moved.";

let shownPage: ViewPage | undefined;

/** Opens a run in the page, or says what is wrong with it. */
async function open(read: () => Promise<PageData>, app: HTMLElement, closable: boolean): Promise<void> {
    try {
        const run = new Run(await read());
        shownPage?.close();
        shownPage = new ViewPage(run, app);
        document.title = `${run.title} · mane`;
        Object.assign(window, { mane: shownPage }); // for tests and the curious
    } catch (error) {
        const damaged = error instanceof DamagedPage || error instanceof RangeError;
        showMessage(damaged ? "This run cannot be shown" : "The page cannot run here", error instanceof Error ? error.message : String(error), closable);
    }
}

const app = document.getElementById("app")!;
window.addEventListener("dragover", (e) => e.preventDefault());
window.addEventListener("drop", (e) => {
    e.preventDefault();
    const file = e.dataTransfer?.files[0];
    if (file) void open(() => readPageFile(file), app, true);
});
void open(readPageData, app, false);
