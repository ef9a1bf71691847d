import type { BodyMesh, Hair, HairFrame } from "../hair/hair";
import type { PosedBody } from "../hair/posed_body";
import type { Sections } from "../hair/section_frames";
import { OrbitCamera } from "./camera";
import { Film } from "./film";
import type { GL } from "./gl";
import { HairScene } from "./hair_scene";
import { LineLayer, LineList } from "./lines";
import type { Look } from "./look";
import { add, type Vec3 } from "./matrix";

export { kDefaultLook, type Look } from "./look";

/** How far the picture is. */
export interface Progress {
    strands: number; // that have been drawn into it
    of: number;
    done: boolean; // nothing is left to do until something changes
}

const kVertices = 32, // of a strand
    kFewVertices = 12, // where the machine is slow and everything moves
    kFirstStrands = 10_000, // a first picture shows at least so many
    kFewest = 400, // strands of a part
    kPassCost = 600, // strands that take as long as all else of a pass
    kFewestMoving = 2000, // of a picture while everything moves, however slow the machine
    kMostPasses = 24,
    kSmoothPasses = 8, // at least, or edges would show steps
    kThinRounds = 3, // where there are few strands
    kFast = 150, // strands per millisecond
    kFastRounds = 4,
    kWidestLine = 1.6, // [pixels] of a strand that is drawn as a line; wider ones are ribbons
    kWidest = 5; // [pixels] of a strand while everything moves
const kFineNodes = 110_000, // of the grid that light is looked up in
    kCoarseNodes = 45_000;
const kBackground = { middle: [0.23, 0.24, 0.26] as Vec3, rim: [0.045, 0.048, 0.055] as Vec3 };

/** Part `n` of a sequence that fills (−½, ½) evenly. */
function halton(n: number, base: number): number {
    let share = 1,
        at = 0;
    for (let i = n; i > 0; i = Math.floor(i / base)) at += (i % base) * (share /= base);
    return at - 0.5;
}

/**
 * Hair on a canvas. It knows nothing of where frames come from: whoever has them calls `setHair` once, `setFrame` for each and
 * `draw` whenever the screen may change. A still picture is drawn in passes, each with a part of the strands, and shown as it
 * grows; while things move a single call draws as many strands as fit in the time.
 */
export class HairView {
    readonly camera = new OrbitCamera();
    /** How often a still picture goes over all strands: more leave less to chance. 0: as hair and machine ask for. */
    rounds = 0;
    /** Drawn over everything, for annotations; call `touch` after changing it. */
    readonly marks = new LineList();

    private readonly gl: GL;
    private readonly film: Film;
    private readonly scene: HairScene;
    private readonly markLines: LineLayer;

    private stale = true; // the picture shows something else
    private pass = 0;
    private slot = 0; // next strand of the pass
    private passes = 1; // that have all strands among them
    private lastPass = 1; // of a still picture
    private moving = false;
    private picture: Progress = { strands: 0, of: 0, done: false };
    private flight: { sync: WebGLSync; strands: number; started: number } | null = null;
    private speed = 10; // strands per millisecond, of still pictures
    private affordable = kFirstStrands; // strands of a picture while everything moves
    private budget = 0; // [ms] of the picture in flight, while everything moves

    constructor(readonly canvas: HTMLCanvasElement) {
        const gl = canvas.getContext("webgl2", { alpha: true, antialias: false, depth: false, powerPreference: "high-performance" });
        if (!gl) throw new Error("this browser has no WebGL 2, which drawing hair needs");
        this.gl = gl;
        this.film = new Film(gl);
        this.scene = new HairScene(gl);
        this.markLines = new LineLayer(gl);
    }

    setHair(hair: Hair, bodies: readonly BodyMesh[]): void {
        this.scene.setHair(hair, bodies);
        this.touch();
    }

    setFrame(frame: HairFrame): void {
        this.scene.setFrame(frame);
        this.touch();
    }

    setLook(look: Look): void {
        this.scene.setLook(look);
        this.touch();
    }

    /** The camera, the canvas or `marks` changed. */
    touch(): void {
        this.stale = true;
    }

    /** Centres and half line ends of the frame. */
    get sectionRecords(): Sections {
        return this.scene.sections!;
    }
    get posedBodies(): PosedBody[] {
        return this.scene.bodies;
    }
    /** The middle of the points where the wisps leave the scalp [m], in the world. */
    headCentre(): Vec3 {
        return this.scene.headCentre();
    }

    /** Whether the graphics processor still works on what the last `draw` gave it. */
    get busy(): boolean {
        this.land();
        return this.flight !== null;
    }

    /** Learns from what the graphics processor has finished how much it manages. */
    private land(): void {
        const { gl, flight } = this;
        if (!flight || (gl.getSyncParameter(flight.sync, gl.SYNC_STATUS) !== gl.SIGNALED && !gl.isContextLost())) return;
        const took = Math.max(performance.now() - flight.started, 1);
        if (this.moving) this.affordable *= Math.min(Math.max(this.budget / took, 0.7), 1.3);
        else if (flight.strands > 0) this.speed += 0.5 * (flight.strands / took - this.speed);
        gl.deleteSync(flight.sync);
        this.flight = null;
    }

    /** Whether the picture shows what it was last told to, whole. */
    get settled(): boolean {
        return !this.stale && !this.moving && this.picture.done && !this.flight;
    }

    /** Gives the graphics processor's memory back; nothing can be drawn any more. */
    delete(): void {
        this.gl.getExtension("WEBGL_lose_context")?.loseContext();
    }

    /**
     * Draws for about `budget` ms, not at all while the graphics processor is busy. `moving`: the next call will show something
     * else, so one picture has to do.
     */
    draw(budget: number, moving = false): Progress {
        if (!this.scene.frame || this.busy) return this.picture;
        if (this.stale || (this.moving && !moving)) this.beginPicture(moving);
        if (!this.picture.done) {
            if (this.moving) this.drawMoving(budget);
            else this.drawPart(budget);
        }
        return this.picture;
    }

    /** The picture now, without annotations. */
    capture(transparent: boolean): Promise<Blob> {
        this.film.show({ ...kBackground, transparent });
        return new Promise((resolve, reject) => {
            this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the picture is too large for this browser"))));
            this.show();
        });
    }

    /** Strand points as drawn, for testing: see `StrandLayer.readBack`. */
    readBack(strands: number[], parameters: (end: number, wisp: number) => number[]): Float32Array {
        return this.scene.readBack(strands, parameters);
    }

    private beginPicture(moving: boolean): void {
        const { canvas, scene } = this;
        this.film.resize(Math.max(canvas.width, 1), Math.max(canvas.height, 1));
        this.film.restart();
        scene.prepare(this.camera, moving ? kCoarseNodes : kFineNodes);
        this.markLines.upload(this.marks);
        this.stale = false;
        this.moving = moving;
        this.pass = this.slot = 0;
        const count = scene.strands;
        // As many passes as make a strand about a pixel wide.
        const wanted = Math.min(Math.max(Math.round(1 / this.strandPixels()), 1), kMostPasses);
        this.affordable = Math.min(Math.max(this.affordable, kFewestMoving), Math.max(count, 1));
        this.passes = moving
            ? Math.max(1, Math.floor((this.affordable * wanted) / Math.max(count, 1)))
            : Math.max(1, Math.min(wanted, Math.ceil(count / kFirstStrands)));
        this.lastPass = this.passes * this.stillRounds(count);
        this.picture = { strands: 0, of: count, done: false };
    }

    /** [pixels] How wide strands are at the target. */
    private strandPixels(): number {
        return this.scene.strandWidth / (this.camera.pixel(this.canvas.height) * this.camera.distance);
    }

    /** One picture of as many strands as the budget allows, in one go. */
    private drawMoving(budget: number): void {
        const count = this.picture.of;
        const perPass = Math.floor(Math.min(this.affordable, count) / this.passes);
        this.budget = budget;
        const wider = Math.min(count / Math.max(perPass, 1), Math.max(kWidest / this.strandPixels(), 1));
        const started = performance.now();
        for (this.pass = 0; this.pass < this.passes; ++this.pass) {
            this.beginPass();
            this.drawStrands(this.pass * perPass, perPass, wider, perPass < 4000 ? kFewVertices : kVertices);
            if (this.passes > 1) this.film.endPass();
        }
        this.picture = { strands: perPass * this.passes, of: count, done: true };
        this.show();
        this.launch(perPass * this.passes, started);
    }

    /** The next part of a still picture, for about `budget` ms; whole passes are shown. */
    private drawPart(budget: number): void {
        const started = performance.now(),
            before = this.pass;
        const least = this.pass === 0 && this.slot === 0 ? kFirstStrands : kFewest;
        let left = Math.max(Math.floor(this.speed * budget), least),
            drawn = 0;
        while (left > 0 && !this.picture.done) {
            const now = this.drawSome(left);
            drawn += now;
            left -= now + kPassCost;
        }
        if (this.pass > before || this.pass === 0) this.show();
        this.launch(drawn, started);
    }

    /** Draws at most `most` strands of the present pass, and ends it behind its last one. How many it drew. */
    private drawSome(most: number): number {
        const count = this.picture.of,
            part = this.pass % this.passes;
        const first = Math.floor((count * part) / this.passes),
            end = Math.floor((count * (part + 1)) / this.passes);
        if (this.slot === 0) this.beginPass();
        else this.film.resumePass();
        const now = Math.min(most, end - first - this.slot);
        this.drawStrands(first + this.slot, now, count / Math.max(end - first, 1), kVertices);
        this.slot += now;
        if (this.pass < this.passes) this.picture.strands += now;
        if (first + this.slot >= end) {
            this.film.endPass();
            this.slot = 0;
            ++this.pass;
        }
        this.picture.done = this.pass >= this.lastPass;
        return now;
    }

    /** So many times over all strands: enough for smooth edges, more where hair is thin or the machine fast. */
    private stillRounds(count: number): number {
        const thin = count > 0 ? Math.min(kFirstStrands / count, kThinRounds) : 1;
        const fast = count > 0 && this.speed > kFast ? kFastRounds : 1;
        return Math.ceil(((this.rounds || Math.max(thin, fast, 1)) * Math.max(kSmoothPasses, this.passes)) / this.passes);
    }

    private launch(strands: number, started: number): void {
        const sync = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        this.gl.flush();
        if (sync) this.flight = { sync, strands, started };
    }

    private beginPass(): void {
        this.film.beginPass();
        this.scene.drawSolids(this.viewpoint());
    }

    private drawStrands(first: number, count: number, wider: number, vertices: number): void {
        const ribbons = wider * this.strandPixels() > kWidestLine;
        this.scene.drawStrands({ first, count, vertices, wider, ribbons, pass: this.pass }, this.viewpoint());
    }

    private show(): void {
        this.film.show({ ...kBackground, transparent: false });
        const gl = this.gl;
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
        this.markLines.draw({ ...this.viewpoint(), uLinear: false });
        gl.disable(gl.BLEND);
    }

    private viewpoint() {
        const { width, height } = this.canvas;
        const origin = [...this.scene.frame!.origin] as Vec3;
        const shift = [halton(this.pass + 1, 2), halton(this.pass + 1, 3)] as const;
        return {
            uClip: Float32Array.from(this.camera.clip(origin, width, height, shift)),
            uEye: add(this.camera.eye(), origin, -1),
            uPixel: this.camera.pixel(height),
            uViewport: [width, height],
        };
    }
}
