import type { BodyMesh, Hair, HairFrame, StrandDesc } from "../hair/hair";
import { PosedBody } from "../hair/posed_body";
import { Sections } from "../hair/section_frames";
import { OrbitCamera } from "./camera";
import { Film } from "./film";
import { bindTextures, RecordTexture, Unit, type GL } from "./gl";
import { addCrossSections, addSkeletons } from "./layer_lines";
import { LightVolume } from "./light_volume";
import { LineLayer, LineList } from "./lines";
import { add, cross, normalized, scale, type Vec3 } from "./matrix";
import { shadowPerLength, StrandLayer } from "./strand_layer";
import { BodyLayer, bodyProgram, EnvelopeLayer } from "./surface_layers";

/** What is drawn, and how. */
export interface Look {
    layers: { strands: boolean; skeleton: boolean; sections: boolean; envelope: boolean; character: boolean };
    strands: number; // on the whole head
    width: number; // [1] of a strand, relative to its own
    colour: Vec3; // linear: light that is left after passing a strand
    colourByWisp: boolean;
    selectedWisp: number; // −1: none
}

export const kDefaultLook: Look = {
    layers: { strands: true, skeleton: false, sections: false, envelope: false, character: true },
    strands: 100_000,
    width: 1,
    colour: [0.36, 0.17, 0.075],
    colourByWisp: false,
    selectedWisp: -1,
};

/** How far the picture is. */
export interface Progress {
    strands: number; // that have been drawn into it
    of: number;
    done: boolean; // nothing is left to do until something changes
}

const kVertices = 32, // of a strand
    kFewVertices = 14, // where the machine is slow and everything moves
    kFirstStrands = 10_000, // a first picture shows at least so many
    kFewest = 400, // strands of a part
    kPassCost = 600, // strands that take as long as all else of a pass
    kFewestMoving = 3000, // of a picture while everything moves, however slow the machine
    kMostPasses = 24,
    kSmoothPasses = 8, // at least, or edges would show steps
    kThinRounds = 3, // where there are few strands
    kFast = 150, // strands per millisecond
    kFastRounds = 4,
    kWidestLine = 1.6, // [pixels] of a strand that is drawn as a line; wider ones are ribbons
    kWidest = 5; // [pixels] of a strand while everything moves
const kFineNodes = 110_000, // of the grid that light is looked up in
    kCoarseNodes = 45_000;
const kClay: Vec3 = [0.52, 0.37, 0.3],
    kObstacle: Vec3 = [0.42, 0.45, 0.48];
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
    private readonly strands: StrandLayer;
    private readonly envelopes: EnvelopeLayer;
    private readonly bodyProgram;
    private readonly lines: LineLayer;
    private readonly markLines: LineLayer;
    private readonly lineList = new LineList();
    private readonly sectionTexture: RecordTexture;
    private readonly shadeTexture: WebGLTexture;
    private readonly light = new LightVolume();

    private hair: Hair | null = null;
    private frame: HairFrame | null = null;
    private sections: Sections | null = null;
    private bodies: BodyLayer[] = [];
    private shadow: Float32Array = new Float32Array(0);
    private look: Look = kDefaultLook;
    private halfLines = new Float32Array(2 * 17);

    private frameIsNew = false; // the sections and the light are of another
    private linesAreNew = false;
    private marksAreNew = false;
    private stale = true; // the picture shows something else
    private heading = NaN; // [rad] of the camera when lights were swept
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
        this.strands = new StrandLayer(gl);
        this.envelopes = new EnvelopeLayer(gl);
        this.bodyProgram = bodyProgram(gl);
        this.lines = new LineLayer(gl);
        this.markLines = new LineLayer(gl);
        this.sectionTexture = new RecordTexture(gl, gl.RGBA32F, gl.RGBA, gl.FLOAT, 10);
        this.shadeTexture = gl.createTexture()!;
    }

    setHair(hair: Hair, bodies: readonly BodyMesh[]): void {
        this.hair = hair;
        this.frame = null;
        this.sections = new Sections(hair);
        const k = hair.envelopePoints;
        if (k > 16) throw new Error(`sections of ${k} envelope points are more than can be drawn, 16`);
        for (let i = 0; i <= k; ++i) {
            const angle = (2 * Math.PI * (i % k)) / k;
            this.halfLines.set([Math.cos(angle), Math.sin(angle)], 2 * i);
        }
        this.envelopes.setHair(hair);
        for (const body of this.bodies) body.delete();
        this.bodies = bodies.map((b, i) => new BodyLayer(this.gl, this.bodyProgram, new PosedBody(b), i === 0 ? kClay : kObstacle));
        this.makeStrands();
    }

    /** The strands' description with the look's count. */
    private get desc(): StrandDesc {
        return { ...this.hair!.strandDesc, count: this.look.strands };
    }

    private makeStrands(): void {
        this.strands.setHair(this.hair!, this.desc);
        if (this.frame) this.strands.setFrame(this.frame);
        this.castShadows();
    }

    /** Hair throws shadows where it is drawn as strands or envelopes. */
    private castShadows(): void {
        const { layers, width } = this.look;
        this.shadow = shadowPerLength(this.hair!, this.desc, layers.strands || layers.envelope ? width : 0);
        this.frameIsNew = true;
        this.touch();
    }

    setFrame(frame: HairFrame): void {
        this.frame = frame;
        this.sections!.update(frame);
        this.bodies.forEach((b, i) => {
            b.body.update(frame.bodies[i], frame.origin);
            b.upload();
        });
        this.sectionTexture.upload(this.sections!.values);
        this.strands.setFrame(frame);
        this.frameIsNew = true;
        this.linesAreNew = true;
        this.touch();
    }

    setLook(look: Look): void {
        const before = this.look;
        this.look = look;
        this.linesAreNew = true;
        this.touch();
        if (!this.hair) return;
        if (look.strands !== before.strands) this.makeStrands();
        else if (look.width !== before.width || look.layers !== before.layers) this.castShadows();
    }

    /** The camera, the canvas or `marks` changed. */
    touch(): void {
        this.stale = true;
        this.marksAreNew = true;
    }

    /** Half line ends and centres of the frame, `records` of four floats per section. */
    get sectionRecords(): Sections {
        return this.sections!;
    }
    get posedBodies(): PosedBody[] {
        return this.bodies.map((b) => b.body);
    }

    /** The middle of the points where the wisps leave the scalp [m], in the world. */
    headCentre(): Vec3 {
        const { hair, frame } = this;
        if (!hair || !frame) return [0, 1.5, 0];
        let sum: Vec3 = [0, 0, 0];
        for (let w = 0; w < hair.wisps; ++w) {
            const at = 3 * (hair.firstSection[w] + 1);
            sum = add(sum, [frame.position[at], frame.position[at + 1], frame.position[at + 2]]);
        }
        return add(scale(sum, 1 / hair.wisps), frame.origin as unknown as Vec3);
    }

    /** Whether the graphics processor still works on what the last `draw` gave it. */
    get busy(): boolean {
        if (!this.flight) return false;
        const { gl, flight } = this;
        if (gl.getSyncParameter(flight.sync, gl.SYNC_STATUS) !== gl.SIGNALED && !gl.isContextLost()) return true;
        const took = Math.max(performance.now() - flight.started, 1);
        if (this.moving) this.affordable *= Math.min(Math.max(this.budget / took, 0.7), 1.3);
        else if (flight.strands > 0) this.speed += 0.5 * (flight.strands / took - this.speed);
        gl.deleteSync(flight.sync);
        this.flight = null;
        return false;
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
        if (!this.frame || this.busy) return this.picture;
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
        this.bindFrame();
        return this.strands.readBack(strands, parameters, this.envelopeUniforms());
    }

    private beginPicture(moving: boolean): void {
        const { canvas, look } = this;
        this.film.resize(Math.max(canvas.width, 1), Math.max(canvas.height, 1));
        this.film.restart();
        this.updateLight(moving ? kCoarseNodes : kFineNodes);
        if (this.linesAreNew) this.updateLines();
        if (this.marksAreNew) this.markLines.upload(this.marks);
        this.linesAreNew = this.marksAreNew = this.stale = false;
        this.moving = moving;
        this.pass = this.slot = 0;
        const count = look.layers.strands ? this.strands.count : 0;
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
        const { rootWidth, tipWidth } = this.hair!.strandDesc;
        const pixel = this.camera.pixel(this.canvas.height) * this.camera.distance;
        return (0.5 * (rootWidth + tipWidth) * this.look.width) / pixel;
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
        const { gl, look } = this;
        this.bindFrame();
        this.film.beginPass();
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.LEQUAL);
        gl.disable(gl.BLEND);
        const uniforms = { ...this.viewUniforms(), ...this.lightUniforms(), ...this.envelopeUniforms() };
        this.bodies.forEach((body, i) => {
            if (look.layers.character || i > 0) body.draw(uniforms);
        });
        if (look.layers.envelope) this.envelopes.draw(uniforms);
        this.lines.draw({ ...uniforms, uLinear: true });
    }

    private drawStrands(first: number, count: number, wider: number, vertices: number): void {
        if (count <= 0) return;
        const { gl, look } = this,
            desc = this.hair!.strandDesc,
            width = look.width * wider;
        this.bindFrame();
        gl.enable(gl.DEPTH_TEST);
        gl.disable(gl.BLEND);
        const ribbons = wider * this.strandPixels() > kWidestLine;
        this.strands.draw(first, count, vertices, ribbons, {
            ...this.viewUniforms(),
            ...this.lightUniforms(),
            ...this.envelopeUniforms(),
            uWidth: [desc.rootWidth * width, desc.tipWidth * width],
            uColour: look.colour,
            uByWisp: look.colourByWisp,
            uPass: this.pass,
        });
    }

    private show(): void {
        this.film.show({ ...kBackground, transparent: false });
        const gl = this.gl;
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
        this.markLines.draw({ ...this.viewUniforms(), uLinear: false });
        gl.disable(gl.BLEND);
    }

    private viewUniforms() {
        const { width, height } = this.canvas;
        const origin = [...this.frame!.origin] as Vec3;
        const shift = [halton(this.pass + 1, 2), halton(this.pass + 1, 3)] as const;
        return {
            uClip: Float32Array.from(this.camera.clip(origin, width, height, shift)),
            uEye: add(this.camera.eye(), origin, -1),
            uPixel: this.camera.pixel(height),
            uViewport: [width, height],
            uSelected: this.look.selectedWisp,
        };
    }

    private envelopeUniforms() {
        return { uSections: Unit.sections, uHalfLines: this.hair!.envelopePoints, uHalfLine: this.halfLines };
    }

    private lightUniforms() {
        const { cell, size, low } = this.light;
        return {
            uShade: Unit.shade,
            uShadeLow: low.map((l) => l - 0.5 * cell),
            uShadeScale: size.map((n) => 1 / (n * cell)),
            uLightDirection: this.lightDirections().flat(),
            uLightRadiance: [3, 2.85, 2.64, 0.77, 0.83, 0.9, 1.5, 1.47, 1.43],
            uSkyRadiance: [0.8, 0.86, 0.95],
        };
    }

    /** Key, fill and rim light go with the camera's heading, so that hair reads from everywhere. */
    private lightDirections(): Vec3[] {
        const yaw = this.camera.yaw;
        const back: Vec3 = [Math.sin(yaw), 0, Math.cos(yaw)],
            right = cross([0, 1, 0], back);
        const toward = (b: number, r: number, up: number): Vec3 => normalized(add(add(scale(back, b), right, r), [0, up, 0]));
        return [toward(0.8, -0.7, 0.9), toward(0.7, 0.9, 0.2), toward(-0.9, 0.5, 0.8)];
    }

    private updateLight(nodes: number): void {
        const { gl, light } = this;
        const fill = this.frameIsNew || nodes > light.nodes;
        if (!fill && this.heading === this.camera.yaw) return;
        if (fill) light.fill(this.hair!, this.sections!.values, this.shadow, this.posedBodies, nodes);
        light.light(this.lightDirections());
        this.frameIsNew = false;
        this.heading = this.camera.yaw;
        gl.bindTexture(gl.TEXTURE_3D, this.shadeTexture);
        gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
        gl.texImage3D(gl.TEXTURE_3D, 0, gl.RGBA8, ...light.size, 0, gl.RGBA, gl.UNSIGNED_BYTE, light.texels);
        gl.texParameteri(gl.TEXTURE_3D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
        gl.texParameteri(gl.TEXTURE_3D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
        for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R])
            gl.texParameteri(gl.TEXTURE_3D, wrap, gl.CLAMP_TO_EDGE);
    }

    private updateLines(): void {
        const { layers, selectedWisp } = this.look,
            values = this.sections!.values;
        this.lineList.clear();
        if (layers.sections) addCrossSections(this.hair!, values, selectedWisp, this.lineList);
        if (layers.skeleton) addSkeletons(this.hair!, values, selectedWisp, this.lineList);
        this.lines.upload(this.lineList);
    }

    private bindFrame(): void {
        const gl = this.gl;
        bindTextures(gl, gl.TEXTURE_2D, [Unit.sections, this.sectionTexture.handle]);
        bindTextures(gl, gl.TEXTURE_3D, [Unit.shade, this.shadeTexture]);
    }
}
