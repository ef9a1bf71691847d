import type { BodyMesh, Hair, HairFrame, StrandDesc } from "../hair/hair";
import { PosedBody } from "../hair/posed_body";
import { Sections } from "../hair/section_frames";
import type { OrbitCamera } from "./camera";
import { bindTextures, RecordTexture, Unit, type GL } from "./gl";
import { addCrossSections, addSkeletons } from "./layer_lines";
import { LightRig } from "./light_rig";
import { LineLayer, LineList } from "./lines";
import { kDefaultLook, type Look } from "./look";
import { add, scale, type Vec3 } from "./matrix";
import { shadowPerLength, StrandLayer } from "./strand_layer";
import { BodyLayer, bodyProgram, EnvelopeLayer } from "./surface_layers";

const kClay: Vec3 = [0.52, 0.37, 0.3],
    kObstacle: Vec3 = [0.24, 0.26, 0.28];
const kMostHalfLines = 16; // as envelope.glsl

/** Where the picture is taken from: uniforms of all shaders that place something. */
export type Viewpoint = Record<string, number | readonly number[] | Float32Array>;

/** How a part of the strands is drawn. */
export interface StrandPart {
    first: number; // slots, in the order of drawing
    count: number;
    vertices: number; // of a strand
    wider: number; // [1] than they are, to stand for others
    ribbons: boolean; // else lines of a pixel
    pass: number; // chooses what covers a part of a pixel
}

/** One frame of hair and bodies on the graphics processor, and how each layer of it is drawn. */
export class HairScene {
    private readonly strandLayer: StrandLayer;
    private readonly envelopes: EnvelopeLayer;
    private readonly lines: LineLayer;
    private readonly lineList = new LineList();
    private readonly bodyProgram;
    private readonly sectionTexture: RecordTexture;
    private readonly light: LightRig;
    private readonly halfLines = new Float32Array(2 * (kMostHalfLines + 1));

    private hair: Hair | null = null;
    private bodyLayers: BodyLayer[] = [];
    private shadow: Float32Array = new Float32Array(0);
    private lightIsOld = true;
    private linesAreOld = true;

    frame: HairFrame | null = null;
    look: Look = kDefaultLook;
    /** Of the frame. */
    sections: Sections | null = null;

    constructor(private readonly gl: GL) {
        this.strandLayer = new StrandLayer(gl);
        this.envelopes = new EnvelopeLayer(gl);
        this.lines = new LineLayer(gl);
        this.bodyProgram = bodyProgram(gl);
        this.sectionTexture = new RecordTexture(gl, gl.RGBA32F, gl.RGBA, gl.FLOAT, 10);
        this.light = new LightRig(gl);
    }

    get bodies(): PosedBody[] {
        return this.bodyLayers.map((b) => b.body);
    }
    /** How many strands are to be drawn. */
    get strands(): number {
        return this.look.layers.strands ? this.strandLayer.count : 0;
    }
    /** [m] Mean diameter of a strand. */
    get strandWidth(): number {
        const { rootWidth, tipWidth } = this.hair!.strandDesc;
        return 0.5 * (rootWidth + tipWidth) * this.look.width;
    }

    setHair(hair: Hair, bodies: readonly BodyMesh[]): void {
        const k = hair.envelopePoints;
        if (k > kMostHalfLines) throw new Error(`sections of ${k} envelope points are more than can be drawn, ${kMostHalfLines}`);
        this.hair = hair;
        this.frame = null;
        this.sections = new Sections(hair);
        for (let i = 0; i <= k; ++i) {
            const angle = (2 * Math.PI * (i % k)) / k;
            this.halfLines.set([Math.cos(angle), Math.sin(angle)], 2 * i);
        }
        this.envelopes.setHair(hair);
        for (const body of this.bodyLayers) body.delete();
        this.bodyLayers = bodies.map((b, i) => new BodyLayer(this.gl, this.bodyProgram, new PosedBody(b), i === 0 ? kClay : kObstacle));
        this.makeStrands();
    }

    setFrame(frame: HairFrame): void {
        this.frame = frame;
        this.sections!.update(frame);
        this.sectionTexture.upload(this.sections!.values);
        this.bodyLayers.forEach((layer, i) => {
            layer.body.update(frame.bodies[i], frame.origin);
            layer.upload();
        });
        this.strandLayer.setFrame(frame);
        this.lightIsOld = this.linesAreOld = true;
    }

    setLook(look: Look): void {
        const before = this.look;
        this.look = look;
        this.linesAreOld = true;
        if (!this.hair) return;
        if (look.strands !== before.strands) this.makeStrands();
        else if (look.width !== before.width || look.layers !== before.layers) this.castShadows();
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
        return add(scale(sum, 1 / hair.wisps), [...frame.origin] as Vec3);
    }

    /** What depends on the frame, the look or the camera, before drawing. `nodes`: how fine the light is at least. */
    prepare(camera: OrbitCamera, nodes: number): void {
        const values = this.sections!.values;
        if (this.lightIsOld || nodes > this.light.nodes) this.light.fill(this.hair!, values, this.shadow, this.bodies, nodes);
        this.light.turn(camera.yaw);
        if (this.linesAreOld) {
            const { layers, selectedWisp } = this.look;
            this.lineList.clear();
            if (layers.sections) addCrossSections(this.hair!, values, selectedWisp, this.lineList);
            if (layers.skeleton) addSkeletons(this.hair!, values, selectedWisp, this.lineList);
            this.lines.upload(this.lineList);
        }
        this.lightIsOld = this.linesAreOld = false;
    }

    /** All but the strands. */
    drawSolids(viewpoint: Viewpoint): void {
        const { layers } = this.look,
            uniforms = { ...viewpoint, ...this.uniforms() };
        this.begin();
        this.bodyLayers.forEach((body, i) => {
            if (layers.character || i > 0) body.draw(uniforms);
        });
        if (layers.envelope) this.envelopes.draw(uniforms);
        this.lines.draw({ ...uniforms, uLinear: true });
    }

    drawStrands(part: StrandPart, viewpoint: Viewpoint): void {
        if (part.count <= 0) return;
        const { strandDesc } = this.hair!,
            width = this.look.width * part.wider;
        this.begin();
        this.strandLayer.draw(part.first, part.count, part.vertices, part.ribbons, {
            ...viewpoint,
            ...this.uniforms(),
            uWidth: [strandDesc.rootWidth * width, strandDesc.tipWidth * width],
            uColour: this.look.colour,
            uByWisp: this.look.colourByWisp,
            uPass: part.pass,
        });
    }

    /** Strand points as drawn, for testing: see `StrandLayer.readBack`. */
    readBack(strands: number[], parameters: (end: number, wisp: number) => number[]): Float32Array {
        this.begin();
        return this.strandLayer.readBack(strands, parameters, this.uniforms());
    }

    /** The strands' description with the look's count. */
    private get desc(): StrandDesc {
        return { ...this.hair!.strandDesc, count: this.look.strands };
    }

    private makeStrands(): void {
        this.strandLayer.setHair(this.hair!, this.desc);
        if (this.frame) this.strandLayer.setFrame(this.frame);
        this.castShadows();
    }

    /** Hair throws shadows where it is drawn as strands or envelopes. */
    private castShadows(): void {
        const { layers, width } = this.look;
        this.shadow = shadowPerLength(this.hair!, this.desc, layers.strands || layers.envelope ? width : 0);
        this.lightIsOld = true;
    }

    private begin(): void {
        const gl = this.gl;
        bindTextures(gl, gl.TEXTURE_2D, [Unit.sections, this.sectionTexture.handle]);
        this.light.bind();
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.LEQUAL);
        gl.disable(gl.BLEND);
    }

    private uniforms() {
        return {
            ...this.light.uniforms(),
            uSections: Unit.sections,
            uHalfLines: this.hair!.envelopePoints,
            uHalfLine: this.halfLines,
            uSelected: this.look.selectedWisp,
        };
    }
}
