import { createBuffer, Program, type GL } from "./gl";
import linesFragment from "./lines.frag.glsl";
import linesVertex from "./lines.vert.glsl";

type Uniforms = Record<string, number | boolean | readonly number[] | Float32Array | Int32Array>;
type Point = ArrayLike<number>;

const kFloats = 9; // position and width of both ends, colour in four bytes

/** Straight lines with widths, gathered anew for every frame. Widths in metres, or in pixels if negative. */
export class LineList {
    private data = new Float32Array(kFloats * 4 * 256);
    private bytes = new Uint8ClampedArray(this.data.buffer);
    count = 0;

    clear(): void {
        this.count = 0;
    }

    /** `colour`: sRGB and opacity, 0 … 1. */
    line(a: Point, b: Point, widthA: number, widthB: number, colour: readonly number[]): void {
        const at = this.count * 4 * kFloats;
        if (at + 4 * kFloats > this.data.length) {
            const larger = new Float32Array(2 * this.data.length);
            larger.set(this.data);
            this.data = larger;
            this.bytes = new Uint8ClampedArray(larger.buffer);
        }
        for (let corner = 0; corner < 4; ++corner) {
            const i = at + corner * kFloats,
                d = this.data;
            d[i] = a[0];
            d[i + 1] = a[1];
            d[i + 2] = a[2];
            d[i + 3] = widthA;
            d[i + 4] = b[0];
            d[i + 5] = b[1];
            d[i + 6] = b[2];
            d[i + 7] = widthB;
            for (let c = 0; c < 4; ++c) this.bytes[4 * (i + 8) + c] = 255 * colour[c];
        }
        ++this.count;
    }

    dot(p: Point, width: number, colour: readonly number[]): void {
        this.line(p, p, width, width, colour);
    }

    /** A shaft and a head, from `a` to `b`; widths in pixels. */
    arrow(a: Point, b: Point, pixels: number, headShare: number, colour: readonly number[]): void {
        const neck = [0, 1, 2].map((i) => b[i] + (a[i] - b[i]) * headShare);
        this.line(a, neck, -pixels, -pixels, colour);
        this.line(neck, b, -4 * pixels, -0.01, colour);
    }

    get values(): Float32Array {
        return this.data.subarray(0, this.count * 4 * kFloats);
    }
}

/** Draws line lists. */
export class LineLayer {
    private readonly program: Program;
    private readonly array: WebGLVertexArrayObject;
    private readonly vertices: WebGLBuffer;
    private room = 0; // lines that there are indices for
    private count = 0;

    constructor(private readonly gl: GL) {
        this.program = new Program(gl, linesVertex, linesFragment);
        this.array = gl.createVertexArray()!;
        gl.bindVertexArray(this.array);
        this.vertices = createBuffer(gl, gl.ARRAY_BUFFER, 0, gl.DYNAMIC_DRAW);
        const bytes = 4 * kFloats;
        for (const [index, type, normalised, offset] of [
            [0, gl.FLOAT, false, 0],
            [1, gl.FLOAT, false, 16],
            [2, gl.UNSIGNED_BYTE, true, 32],
        ] as const) {
            gl.enableVertexAttribArray(index);
            gl.vertexAttribPointer(index, 4, type, normalised, bytes, offset);
        }
        createBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, 0, gl.STATIC_DRAW);
        gl.bindVertexArray(null);
    }

    upload(lines: LineList): void {
        const gl = this.gl;
        gl.bindBuffer(gl.ARRAY_BUFFER, this.vertices);
        gl.bufferData(gl.ARRAY_BUFFER, lines.values, gl.DYNAMIC_DRAW);
        this.count = lines.count;
        if (this.count <= this.room) return;
        this.room = Math.max(2 * this.room, this.count);
        const indices = new Uint32Array(6 * this.room);
        for (let i = 0; i < this.room; ++i) indices.set([0, 1, 2, 2, 1, 3].map((c) => 4 * i + c), 6 * i);
        gl.bindVertexArray(this.array);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
        gl.bindVertexArray(null);
    }

    draw(uniforms: Uniforms): void {
        if (this.count === 0) return;
        const gl = this.gl;
        this.program.use(uniforms);
        gl.bindVertexArray(this.array);
        gl.drawElements(gl.TRIANGLES, 6 * this.count, gl.UNSIGNED_INT, 0);
        gl.bindVertexArray(null);
    }
}
