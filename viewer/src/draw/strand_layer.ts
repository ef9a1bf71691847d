import { type Hair, type HairFrame, type StrandDesc } from "../hair/hair";
import { drawingOrder, layOutStrands } from "../hair/strand_layout";
import { makeRecipes, type StrandRecipes } from "../hair/strand_recipes";
import { hasWavesOrCurls, StrandWaves, wavesAmplitude } from "../hair/strand_waves";
import { bindTextures, createBuffer, Program, RecordTexture, Unit, type GL } from "./gl";
import discardFragment from "./discard.frag.glsl";
import strandPointsVertex from "./strand_points.vert.glsl";
import strandsFragment from "./strands.frag.glsl";
import strandsVertex from "./strands.vert.glsl";

type Uniforms = Record<string, number | boolean | readonly number[] | Float32Array | Int32Array>;

const kPlaceBytes = 16,
    kWispBytes = 16;

/** The strands, made in the vertex shader from the frame's cross-sections and what is random about each. */
export class StrandLayer {
    private readonly program: Program;
    private readonly shares: RecordTexture;
    private readonly waveTexture: RecordTexture;
    private readonly array: WebGLVertexArrayObject;
    private places: WebGLBuffer | null = null;
    private wisps: WebGLBuffer | null = null;
    private recipes: StrandRecipes | null = null;
    private waves: StrandWaves | null = null;
    private desc: StrandDesc | null = null;

    constructor(private readonly gl: GL) {
        this.program = new Program(gl, strandsVertex, strandsFragment);
        this.shares = new RecordTexture(gl, gl.RGBA16UI, gl.RGBA_INTEGER, gl.UNSIGNED_SHORT, 11);
        this.waveTexture = new RecordTexture(gl, gl.RGBA32F, gl.RGBA, gl.FLOAT, 10);
        this.array = gl.createVertexArray()!;
    }

    get count(): number {
        return this.recipes?.strand.length ?? 0;
    }

    /** Makes the recipes of `desc.count` strands. */
    setHair(hair: Hair, desc: StrandDesc): void {
        const layout = layOutStrands(hair, desc.count);
        const recipes = makeRecipes(hair, desc, layout, drawingOrder(layout));
        this.recipes = recipes;
        this.desc = desc;
        this.waves = hasWavesOrCurls(desc) ? new StrandWaves(hair, desc) : null;
        this.shares.upload(recipes.shares);
        if (!this.waves) this.waveTexture.upload(new Float32Array(4));

        const gl = this.gl;
        for (const buffer of [this.places, this.wisps]) gl.deleteBuffer(buffer);
        this.places = createBuffer(gl, gl.ARRAY_BUFFER, recipes.place, gl.STATIC_DRAW);
        this.wisps = createBuffer(gl, gl.ARRAY_BUFFER, wispRecords(hair, recipes), gl.STATIC_DRAW);
    }

    setFrame(frame: HairFrame): void {
        if (this.waves) this.waveTexture.upload(this.waves.at(frame));
    }

    /** Draws the strands in slots first … first + count − 1 with `vertices` places each, as ribbons or as lines of a pixel. */
    draw(first: number, count: number, vertices: number, ribbons: boolean, uniforms: Uniforms): void {
        const gl = this.gl;
        this.bind();
        this.program.use({ ...this.uniforms(), ...uniforms, uVertices: vertices, uRibbon: ribbons, uRoughness: 0.28, uTilt: 0.06 });
        gl.bindVertexArray(this.array);
        this.pointAttributes(first, 1);
        if (ribbons) gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 2 * vertices, count);
        else gl.drawArraysInstanced(gl.LINE_STRIP, 0, vertices, count);
        gl.bindVertexArray(null);
    }

    /**
     * Points of strands as the shader makes them, read back by transform feedback: for testing. `strands` are numbers of strands,
     * `parameters(end)` the places p on a strand that ends at `end`.
     */
    readBack(strands: number[], parameters: (end: number, wisp: number) => number[], uniforms: Uniforms): Float32Array {
        const gl = this.gl,
            recipes = this.recipes!;
        const slotOf = new Map(Array.from(recipes.strand, (strand, slot) => [strand, slot]));
        const slots = strands.map((strand) => slotOf.get(strand)!);
        const all = slots.map((slot) => parameters(recipes.place[4 * slot + 2], recipes.wisp[slot]));
        const total = all.reduce((n, p) => n + p.length, 0);
        const out = createBuffer(gl, gl.TRANSFORM_FEEDBACK_BUFFER, 12 * total, gl.STREAM_READ);
        const parameter = createBuffer(gl, gl.ARRAY_BUFFER, new Float32Array(all.flat()), gl.STREAM_DRAW);
        gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, null);
        const array = gl.createVertexArray();
        const feedback = gl.createTransformFeedback();
        const program = new Program(gl, strandPointsVertex, discardFragment, ["vPosition"]);
        this.bind();
        program.use({ ...this.uniforms(), ...uniforms });
        gl.bindVertexArray(array);
        gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, feedback);
        gl.enable(gl.RASTERIZER_DISCARD);
        let begin = 0;
        slots.forEach((slot, i) => {
            const count = all[i].length;
            this.pointAttributes(slot, count); // all vertices of this strand see one record
            gl.bindBuffer(gl.ARRAY_BUFFER, parameter);
            gl.enableVertexAttribArray(2);
            gl.vertexAttribPointer(2, 1, gl.FLOAT, false, 4, 4 * begin);
            gl.bindBufferRange(gl.TRANSFORM_FEEDBACK_BUFFER, 0, out, 12 * begin, 12 * count);
            gl.beginTransformFeedback(gl.POINTS);
            gl.drawArraysInstanced(gl.POINTS, 0, count, 1);
            gl.endTransformFeedback();
            begin += count;
        });
        gl.disable(gl.RASTERIZER_DISCARD);
        gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
        gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, null);
        gl.bindVertexArray(null);
        const points = new Float32Array(3 * total);
        gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, out);
        gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, points);
        gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, null);
        gl.deleteBuffer(out);
        gl.deleteBuffer(parameter);
        gl.deleteVertexArray(array);
        gl.deleteTransformFeedback(feedback);
        return points;
    }

    private bind(): void {
        bindTextures(
            this.gl,
            this.gl.TEXTURE_2D,
            [Unit.shares, this.shares.handle],
            [Unit.waves, this.waveTexture.handle],
        );
    }

    private uniforms(): Uniforms {
        return {
            uShares: Unit.shares,
            uWaves: Unit.waves,
            uJitter: this.desc!.jitter,
            uWaveAmplitude: wavesAmplitude(this.desc!),
            uWavesOrCurls: this.waves !== null,
        };
    }

    /** Attributes 0 and 1 from slot `first` on, a record every `divisor` instances. */
    private pointAttributes(first: number, divisor: number): void {
        const gl = this.gl;
        gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 4, gl.FLOAT, false, kPlaceBytes, kPlaceBytes * first);
        gl.vertexAttribDivisor(0, divisor);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.wisps);
        gl.enableVertexAttribArray(1);
        gl.vertexAttribIPointer(1, 4, gl.UNSIGNED_INT, kWispBytes, kWispBytes * first);
        gl.vertexAttribDivisor(1, divisor);
    }
}

/** Per slot: the wisp's first section, how many more it has, the strand's first share, the wisp. */
function wispRecords(hair: Hair, recipes: StrandRecipes): Uint32Array {
    const records = new Uint32Array(4 * recipes.strand.length);
    recipes.wisp.forEach((wisp, slot) => {
        const first = hair.firstSection[wisp];
        records.set([first, hair.firstSection[wisp + 1] - first - 1, recipes.firstShare[slot], wisp], 4 * slot);
    });
    return records;
}

/** [m²] The shadow that a metre of each wisp throws: its strands' mean diameter times their number. */
export function shadowPerLength(hair: Hair, desc: StrandDesc, widthScale: number): Float32Array {
    const layout = layOutStrands(hair, desc.count);
    const width = 0.5 * (desc.rootWidth + desc.tipWidth) * widthScale;
    return Float32Array.from({ length: hair.wisps }, (_, w) => (layout.firstStrand[w + 1] - layout.firstStrand[w]) * width);
}

