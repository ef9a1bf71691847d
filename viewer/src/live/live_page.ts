/** The live page: hair that is simulated while one looks at it, and everything around it. */
import { HairView, kDefaultLook, type Look } from "../draw/hair_view";
import { add, subtract, type Vec3 } from "../draw/matrix";
import type { HairFrame, StrandDesc } from "../hair/hair";
import { button, choice, toggle, type Control } from "../ui/controls";
import { element } from "../ui/dom";
import { headYaw, kViews, look as lookFrom } from "../ui/focus";
import { HairPanel, kLayers } from "../ui/hair_panel";
import { icon } from "../ui/icons";
import { showMessage } from "../ui/message";
import { orbitControls } from "../ui/orbit_controls";
import { listenForShortcuts, type Shortcut } from "../ui/shortcuts";
import { FrameBlend } from "./blend";
import { acceptDrops, readDropped } from "./files";
import { fieldsOf } from "./fields";
import { Hand, kAtEase, type Tool } from "./hand";
import { showKeys } from "./keys";
import { SolverLink } from "./link";
import { Meter } from "./meter";
import { kMotionNames, motionOf, motionSettings } from "./motions";
import { Parameters } from "./parameters";
import type { Answer, SceneFile, SolverSource, WorldDescription } from "./protocol";

export interface Style {
    label: string;
    name: string;
    text: string;
}
type Scene = Omit<Style, "label"> & { files: SceneFile[] };
type AnswerOf<Kind extends Answer["kind"]> = Extract<Answer, { kind: Kind }>;

const kStillBudget = 120, // [ms] of one part of a still picture
    kMovingBudget = 25, // of a picture while things move
    kSettle = 250; // [ms] after the last move until the picture is a still one
const kTeleport: Vec3 = [1, 0, -0.5]; // [m]
const kTools: [label: string, tool: Tool][] = [["Turn", "turn"], ["Move", "move"], ["Pull hair", "pull"]];
export class LivePage {
    private readonly view: HairView;
    private readonly link: SolverLink;
    private readonly hand: Hand;
    private readonly meter = new Meter();
    private readonly look: HairPanel;
    private readonly side = element("aside", { id: "side" });
    private readonly facts = element("span", { class: "facts" });
    private readonly clock = element("span", { class: "clock" });
    private readonly hud = element("div", { class: "hud" });
    private readonly runButton = button(icon("pause"), "run or pause", () => this.setRunning(!this.running), "Space");
    private readonly tools: Control<Tool>;
    private readonly styleChoice: Control<string>;
    private readonly motionChoice: Control<string>;
    private readonly shortcuts: Shortcut[];
    private parameters: Parameters | null = null;
    private world: WorldDescription | null = null;
    private frames: FrameBlend | null = null;
    private currentLook: Look = kDefaultLook;
    private threads = 1;
    private opening = false; // a scene is on its way
    private running = true;
    private away = false; // teleported
    private drawn = false; // all of the picture
    private following = true;
    private head: Vec3 | null = null; // [m] its middle in the frame that is shown
    private movedAt = -Infinity; // [ms] when something last moved
    private simulated = 0; // [s] at the newest frame

    constructor(
        app: HTMLElement,
        worker: string,
        source: SolverSource,
        styles: Style[],
        private readonly first: Scene,
    ) {
        const canvas = element("canvas", { tabIndex: 0, "aria-label": "the hair" });
        this.view = new HairView(canvas);
        this.view.setLook(this.currentLook);
        this.look = new HairPanel(this.currentLook, (look) => this.view.setLook((this.currentLook = look)));
        this.hand = new Hand(this.view, () => this.heldHair(), {
            hold: (hold) => this.link.send({ kind: "hold", hold }),
            pin: (section, position) => this.link.send({ kind: "pin", section, position }),
            release: (section) => this.link.send({ kind: "release", section }),
            pinsChanged: () => this.showPins(),
        });
        orbitControls(canvas, this.view.camera, () => this.moved(), () => {});
        this.tools = choice("what a drag on the character does; beside it, it moves the camera", kTools, this.hand.tool, (tool) => (this.hand.tool = tool));
        this.styleChoice = choice("a style of the paper", styles.map((style) => [style.label, style.name]), "", (name) =>
            this.open({ ...styles.find((style) => style.name === name)!, files: [] }));
        this.motionChoice = choice("what moves the character, beside your hand", kMotionNames.map((name) => [name, name]), "", (name) =>
            this.parameters?.set(motionSettings(name)));
        this.shortcuts = this.makeShortcuts();
        listenForShortcuts(this.shortcuts);
        app.replaceChildren(this.header(), this.stage(canvas), this.side, this.footer());
        acceptDrops(
            (above) => document.body.classList.toggle("dropping", above),
            (files) => void this.takeFiles(files),
        );
        this.link = SolverLink.start(worker, source, {
            started: (answer) => this.started(answer),
            world: (answer) => this.takeWorld(answer),
            values: (answer) => this.takeValues(answer),
            frame: (answer) => this.takeFrame(answer),
            error: (answer) => this.failed(answer),
        });
        new ResizeObserver(() => this.resize()).observe(canvas);
        this.resize();
        requestAnimationFrame(() => this.tick());
    }

    /** The state's hash, or the scene as TOML, behind all that was asked for before. */
    async ask(what: "hash" | "scene"): Promise<string> {
        await this.parameters?.idle();
        return this.link.ask(what);
    }

    /** Whether the picture shows the newest frame, with all its strands. */
    get settled(): boolean {
        return this.drawn && !this.view.busy;
    }

    /** How many times faster than real time, as the meter shows it. */
    get speed(): number {
        return this.meter.times(1 / this.world!.frameRate);
    }

    open(scene: Scene): void {
        this.opening = true;
        this.link.send({ kind: "open", ...scene });
    }

    setRunning(running: boolean): void {
        this.running = running;
        this.runButton.replaceChildren(icon(running ? "pause" : "play"));
        this.link.send({ kind: "run", running });
    }

    step(frames = 1): void {
        this.setRunning(false);
        this.link.send({ kind: "advance", frames });
    }

    restart(): void {
        this.link.send({ kind: "restart" });
    }

    /** There and, the next time, back. */
    teleport(): void {
        this.away = !this.away;
        this.link.send({ kind: "teleport", by: this.away ? kTeleport : [-kTeleport[0], -kTeleport[1], -kTeleport[2]] });
    }
    releaseAll(): void {
        this.hand.releaseAll();
        this.link.send({ kind: "release", section: "all" });
        this.showPins();
    }

    private started({ schema, stages, threads }: AnswerOf<"started">): void {
        this.meter.setStages(stages);
        this.threads = threads;
        this.parameters = new Parameters(fieldsOf(schema), {
            set: (settings) => this.link.send({ kind: "set", settings }),
            scene: () => this.link.ask("scene"),
            rates: (preset) => this.link.send({ kind: "rates", preset }),
        });
        this.side.replaceChildren(this.parameters.root, this.look.root);
        this.link.send({ kind: "run", running: this.running });
        this.open(this.first);
    }
    private takeWorld({ world, values }: AnswerOf<"world">): void {
        const opened = this.opening;
        this.opening = false;
        this.world = world;
        this.frames = new FrameBlend(world, (place) =>
            this.link.send({ kind: "give-back", world: world.number, place }, place.buffer ? [place.buffer] : []),
        );
        this.hand.releaseAll();
        this.hand.hold = kAtEase;
        this.away = false;
        this.meter.clear();
        this.view.setHair(world.hair, world.bodies);
        this.parameters!.show(values, opened);
        this.showChoices(values);
        this.showFacts();
        for (const warning of world.warnings) this.say(warning);
    }

    private takeValues({ values, frameRate, strandDesc }: AnswerOf<"values">): void {
        this.world!.frameRate = frameRate;
        this.parameters!.show(values, false);
        this.showChoices(values);
        this.drawAs(strandDesc);
    }

    private drawAs(strandDesc: StrandDesc): void {
        const { hair, bodies } = this.world!;
        if (JSON.stringify(strandDesc) === JSON.stringify(hair.strandDesc)) return;
        this.world!.hair = { ...hair, strandDesc };
        this.view.setHair(this.world!.hair, bodies);
        const newest = this.frames!.newest;
        if (newest) this.view.setFrame(newest);
    }

    private takeFrame({ world, index, place, costs }: AnswerOf<"frame">): void {
        if (world !== this.world?.number) return;
        this.frames!.push(index, place, performance.now());
        this.simulated = this.frames!.newest!.time;
        this.moved();
        for (const cost of costs) this.meter.add(cost);
        if (index % 6 === 0 || !this.running) this.meter.show(1 / this.world.frameRate);
    }

    private failed({ message, request }: AnswerOf<"error">): void {
        if (request === "start") return showMessage("The solver cannot run here", message, false);
        if (request === "open") this.opening = false;
        if (request === "open" || request === "clip") return showMessage("This file cannot be used", message, true);
        if (request === "set" || request === "rates") this.parameters!.refuse();
        if (request === "advance") this.setRunning(false);
        this.say(message);
    }

    private async takeFiles(files: File[]): Promise<void> {
        try {
            const { scene, clip, others } = await readDropped(files);
            if (scene) this.open({ ...scene, files: others });
            if (clip) this.link.send({ kind: "clip", file: clip });
        } catch (error) {
            showMessage("This file cannot be used", error instanceof Error ? error.message : String(error), true);
        }
    }

    private showChoices(values: Record<string, string>): void {
        this.motionChoice.set(motionOf(values));
        this.styleChoice.set(this.world!.name);
    }

    /** Also of hair that stands still. */
    private showPins(): void {
        if (this.frames?.newest) this.hand.mark(this.frames.newest);
        this.moved();
    }

    private heldHair() {
        const frame = this.frames?.newest;
        return this.world && frame ? { hair: this.world.hair, frame } : null;
    }

    private header(): HTMLElement {
        const chooser = element("input", { type: "file", multiple: true, accept: ".toml,.bvh,.obj", hidden: true });
        chooser.addEventListener("change", () => void this.takeFiles([...(chooser.files ?? [])]));
        return element("header", {},
            element("h1", {}, "mane live"),
            this.styleChoice.root,
            button("Open …", "a scene (.toml) with what it names, or a clip (.bvh): or drop them on the page", () => chooser.click()),
            chooser,
            this.facts,
            element("span", { class: "space" }),
            button("PNG", "save the picture", () => void this.savePicture(), "p"),
            button("?", "keys", () => showKeys(this.shortcuts), "h"),
        );
    }

    private stage(canvas: HTMLCanvasElement): HTMLElement {
        const follow = toggle("Follow", "the camera moves with the head", this.following, (on) => (this.following = on));
        return element("div", { id: "stage" },
            canvas,
            element("div", { class: "views row" }, ...kViews.map(([label, degrees, key]) =>
                button(label, `see the head from its ${label.toLowerCase()}`, () => this.lookFrom(degrees), key)), follow.root),
            element("div", { class: "tools row" }, this.tools.root,
                button("At ease", "the hand lets go of the head", () => this.hand.setHold(kAtEase), "0"),
                button("Release hair", "let go of all pinned points", () => this.releaseAll(), "Esc")),
            this.meter.root,
            this.hud,
            element("div", { class: "notices", role: "status" }),
            element("div", { class: "drop" }, "a scene (.toml) or a clip (.bvh)"),
        );
    }

    private footer(): HTMLElement {
        this.runButton.classList.add("play");
        return element("footer", {},
            this.runButton,
            button(icon("on"), "one frame on", () => this.step(), "."),
            button(icon("again"), "again from the first frame", () => this.restart(), "r"),
            button("Teleport", "elsewhere at once, and back: the hair comes along as it is", () => this.teleport(), "x"),
            element("span", { class: "label" }, "Motion"),
            this.motionChoice.root,
            element("span", { class: "space" }),
            this.clock,
        );
    }

    private makeShortcuts(): Shortcut[] {
        const angle = 0.15; // [rad]
        return [
            { keys: [" "], label: "run or pause", does: () => this.setRunning(!this.running) },
            { keys: ["."], label: "one frame on", does: () => this.step() },
            { keys: ["r"], label: "again from the first frame", does: () => this.restart() },
            { keys: ["x"], label: "teleport", does: () => this.teleport() },
            { keys: ["ArrowLeft"], label: "turn the head right", does: () => this.hand.nudge({ yaw: -angle }) },
            { keys: ["ArrowRight"], label: "turn the head left", does: () => this.hand.nudge({ yaw: angle }) },
            { keys: ["ArrowUp"], label: "look up", does: () => this.hand.nudge({ pitch: -angle }) },
            { keys: ["ArrowDown"], label: "look down", does: () => this.hand.nudge({ pitch: angle }) },
            { keys: ["q"], label: "lean right", does: () => this.hand.nudge({ roll: angle }) },
            { keys: ["e"], label: "lean left", does: () => this.hand.nudge({ roll: -angle }) },
            ...([["a", [-0.05, 0, 0], "right"], ["d", [0.05, 0, 0], "left"], ["w", [0, 0.05, 0], "up"], ["s", [0, -0.05, 0], "down"]] as const).map(
                ([key, position, where]): Shortcut => ({ keys: [key], label: `move ${where}`, does: () => this.hand.nudge({ position: [...position] }) }),
            ),
            { keys: ["0"], label: "the hand lets go of the head", does: () => this.hand.setHold(kAtEase) },
            { keys: ["Escape"], label: "let go of all pinned hair", does: () => this.escape() },
            { keys: ["z"], label: "take a change back", does: () => this.parameters?.undo() },
            { keys: ["y"], label: "and make it again", does: () => this.parameters?.redo() },
            ...kLayers.map(([layer, label, , key]) => ({ keys: [key], label: `layer: ${label.toLowerCase()}`, does: () => this.look.toggleLayer(layer) })),
            ...kViews.map(([label, degrees, key]) => ({ keys: [key], label: `view: ${label.toLowerCase()}`, does: () => this.lookFrom(degrees) })),
            { keys: ["p"], label: "save a PNG", does: () => void this.savePicture() },
            { keys: ["h", "?"], label: "this list", does: () => showKeys(this.shortcuts) },
        ];
    }

    private escape(): void {
        const message = document.querySelector(".message.help");
        if (message) message.remove();
        else this.releaseAll();
    }

    private lookFrom(degrees: number): void {
        const frame = this.frames?.newest;
        if (!frame) return;
        lookFrom(this.view.camera, this.view.headCentre(), headYaw(frame, this.world!.bodies[0]), degrees);
        this.moved();
    }

    private moved(): void {
        this.movedAt = performance.now();
        this.view.touch();
    }

    private resize(): void {
        const { canvas } = this.view,
            scale = Math.min(devicePixelRatio, 2);
        const width = Math.round(canvas.clientWidth * scale),
            height = Math.round(canvas.clientHeight * scale);
        if (width === canvas.width && height === canvas.height) return;
        Object.assign(canvas, { width, height });
        this.view.touch();
    }

    private tick(): void {
        requestAnimationFrame(() => this.tick());
        const now = performance.now();
        if (!this.frames || this.view.busy) return;
        const frame = this.frames.at(now, !this.running);
        if (frame) this.showFrame(frame);
        const moving = now - this.movedAt < kSettle;
        const progress = this.view.draw(moving ? kMovingBudget : kStillBudget, moving);
        this.drawn = !moving && progress.done;
        this.hud.textContent =
            progress.of > 0 ? `${progress.strands.toLocaleString("en")} of ${progress.of.toLocaleString("en")} strands${progress.done || moving ? "" : " …"}` : "";
    }

    private showFrame(frame: HairFrame): void {
        this.view.setFrame(frame);
        this.hand.mark(frame);
        const before = this.head,
            { camera } = this.view;
        this.head = this.view.headCentre();
        if (!before) this.lookFrom(40);
        else if (this.following) camera.target = add(camera.target, subtract(this.head, before));
        this.clock.textContent = `frame ${frame.index} · ${frame.time.toFixed(2)} s`;
    }

    private showFacts(): void {
        const { hair, name, instructionSet } = this.world!;
        const segments = (hair.firstSection[hair.wisps] / hair.wisps - 2).toFixed(1);
        const threads = this.threads === 1 ? "one thread" : `${this.threads} threads`;
        this.facts.textContent = `${name} · ${hair.wisps} wisps of ${segments} segments · ${instructionSet}, ${threads}`;
        document.title = `${name} · mane live`;
    }

    /** A line that goes away by itself. */
    private say(text: string): void {
        const notice = element("p", { class: "notice", role: "alert" }, text);
        document.querySelector(".notices")!.replaceChildren(notice);
        setTimeout(() => notice.remove(), 12_000);
    }

    private async savePicture(): Promise<void> {
        const url = URL.createObjectURL(await this.view.capture(false));
        element("a", { href: url, download: `${this.world?.name ?? "hair"}-${this.simulated.toFixed(2)}.png` }).click();
        setTimeout(() => URL.revokeObjectURL(url), 10_000);
    }
}
