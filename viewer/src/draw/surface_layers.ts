import type { Hair } from "../hair/hair";
import { PosedBody } from "../hair/posed_body";
import { createBuffer, Program, type GL } from "./gl";
import envelopeVertex from "./envelope.vert.glsl";
import surfaceFragment from "./surface.frag.glsl";
import surfaceVertex from "./surface.vert.glsl";

type Uniforms = Record<string, number | boolean | readonly number[] | Float32Array | Int32Array>;

/** A character or an obstacle, skinned. */
export class BodyLayer {
    private readonly array: WebGLVertexArrayObject;
    private readonly positions: WebGLBuffer;
    private readonly normals: WebGLBuffer;

    constructor(
        private readonly gl: GL,
        private readonly program: Program,
        readonly body: PosedBody,
        private readonly colour: readonly number[],
    ) {
        this.array = gl.createVertexArray()!;
        gl.bindVertexArray(this.array);
        this.positions = this.attribute(0, body.vertices);
        this.normals = this.attribute(1, body.normals);
        createBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, body.mesh.triangles, gl.STATIC_DRAW);
        gl.bindVertexArray(null);
    }

    private attribute(index: number, values: Float32Array): WebGLBuffer {
        const gl = this.gl;
        const buffer = createBuffer(gl, gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
        gl.enableVertexAttribArray(index);
        gl.vertexAttribPointer(index, 3, gl.FLOAT, false, 0, 0);
        return buffer;
    }

    /** Takes the body's vertices as they are now. */
    upload(): void {
        const gl = this.gl;
        for (const [buffer, values] of [
            [this.positions, this.body.vertices],
            [this.normals, this.body.normals],
        ] as const) {
            gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
            gl.bufferSubData(gl.ARRAY_BUFFER, 0, values);
        }
    }

    draw(uniforms: Uniforms): void {
        const gl = this.gl;
        this.program.use({ ...uniforms, uColour: this.colour, uOffset: 0.012 });
        gl.bindVertexArray(this.array);
        gl.drawElements(gl.TRIANGLES, this.body.mesh.triangles.length, gl.UNSIGNED_INT, 0);
        gl.bindVertexArray(null);
    }

    delete(): void {
        this.gl.deleteVertexArray(this.array);
        this.gl.deleteBuffer(this.positions);
        this.gl.deleteBuffer(this.normals);
    }
}

export const bodyProgram = (gl: GL): Program => new Program(gl, surfaceVertex, surfaceFragment);

const kRings = 4, // per segment
    kRound = 16; // vertices round a section

/** The envelopes' surface, one colour per wisp, closed at both ends; as `envelope_mesh` of mane/strands.h. */
export class EnvelopeLayer {
    private readonly program: Program;
    private array: WebGLVertexArrayObject | null = null;
    private indices = 0;

    constructor(private readonly gl: GL) {
        this.program = new Program(gl, envelopeVertex, surfaceFragment);
    }

    setHair(hair: Hair): void {
        const gl = this.gl;
        const places: number[] = [],
            onPiece: number[] = [],
            triangles: number[] = [];
        for (let w = 0; w < hair.wisps; ++w) {
            const first = hair.firstSection[w],
                last = hair.firstSection[w + 1] - first - 1;
            const put = (piece: number, t: number, x: number, y: number): number => {
                places.push(first, last, piece, w);
                onPiece.push(t, x, y);
                return onPiece.length / 3 - 1;
            };
            const rings = last * kRings + 1,
                start = onPiece.length / 3;
            for (let i = 0; i < rings; ++i) {
                const piece = Math.min(Math.floor(i / kRings), last - 1);
                for (let j = 0; j < kRound; ++j) {
                    const angle = (2 * Math.PI * j) / kRound;
                    put(piece, i / kRings - piece, Math.cos(angle), Math.sin(angle));
                }
            }
            const root = put(0, 0, 0, 0),
                tip = put(last - 1, 1, 0, 0);
            for (let j = 0; j < kRound; ++j) {
                const a = start + j,
                    b = start + ((j + 1) % kRound),
                    above = (rings - 1) * kRound;
                triangles.push(root, b, a, tip, a + above, b + above);
                for (let i = 0; i + 1 < rings; ++i) {
                    const low = i * kRound,
                        high = low + kRound;
                    triangles.push(a + low, b + low, b + high, a + low, b + high, a + high);
                }
            }
        }
        this.indices = triangles.length;
        gl.deleteVertexArray(this.array);
        this.array = gl.createVertexArray();
        gl.bindVertexArray(this.array);
        createBuffer(gl, gl.ARRAY_BUFFER, Int32Array.from(places), gl.STATIC_DRAW);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribIPointer(0, 4, gl.INT, 0, 0);
        createBuffer(gl, gl.ARRAY_BUFFER, Float32Array.from(onPiece), gl.STATIC_DRAW);
        gl.enableVertexAttribArray(1);
        gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 0, 0);
        createBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(triangles), gl.STATIC_DRAW);
        gl.bindVertexArray(null);
    }

    draw(uniforms: Uniforms): void {
        const gl = this.gl;
        this.program.use({ ...uniforms, uOffset: 0.03 });
        gl.bindVertexArray(this.array);
        gl.drawElements(gl.TRIANGLES, this.indices, gl.UNSIGNED_INT, 0);
        gl.bindVertexArray(null);
    }
}
