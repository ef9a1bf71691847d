/** The little of WebGL 2 that drawing hair needs. */

export type GL = WebGL2RenderingContext;

type Value = number | boolean | readonly number[] | Float32Array | Int32Array;

/** A pair of shaders; its uniforms are set by name and by the type they have in the shader. */
export class Program {
    readonly handle: WebGLProgram;
    private readonly uniforms = new Map<string, { at: WebGLUniformLocation; type: number }>();

    constructor(
        private readonly gl: GL,
        vertex: string,
        fragment: string,
        feedback: string[] = [],
    ) {
        this.handle = gl.createProgram()!;
        for (const [type, text] of [
            [gl.VERTEX_SHADER, vertex],
            [gl.FRAGMENT_SHADER, fragment],
        ] as const) {
            const shader = gl.createShader(type)!;
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            gl.attachShader(this.handle, shader);
        }
        if (feedback.length) gl.transformFeedbackVaryings(this.handle, feedback, gl.SEPARATE_ATTRIBS);
        gl.linkProgram(this.handle);
    }

    /** Waits until the shaders are compiled. Throws with the compiler's log. */
    private finish(): void {
        const { gl, handle } = this;
        if (!gl.getProgramParameter(handle, gl.LINK_STATUS) && !gl.isContextLost()) {
            const logs = (gl.getAttachedShaders(handle) ?? []).map((s) => gl.getShaderInfoLog(s));
            throw new Error(["a shader does not compile", ...logs, gl.getProgramInfoLog(handle)].join("\n"));
        }
        const count = gl.getProgramParameter(handle, gl.ACTIVE_UNIFORMS) as number;
        for (let i = 0; i < count; ++i) {
            const info = gl.getActiveUniform(handle, i)!;
            const at = gl.getUniformLocation(handle, info.name);
            if (at) this.uniforms.set(info.name.replace(/\[0\]$/, ""), { at, type: info.type });
        }
    }

    /** Makes the program current and sets uniforms; names that its shaders do not use are passed over. */
    use(values: Record<string, Value>): void {
        if (this.uniforms.size === 0) this.finish();
        this.gl.useProgram(this.handle);
        for (const name in values) {
            const uniform = this.uniforms.get(name);
            if (uniform) this.set(uniform.at, uniform.type, values[name]);
        }
    }

    private set(at: WebGLUniformLocation, type: number, value: Value): void {
        const gl = this.gl;
        const list = typeof value === "object" ? value : [Number(value)];
        switch (type) {
            case gl.FLOAT:
                return gl.uniform1fv(at, list);
            case gl.FLOAT_VEC2:
                return gl.uniform2fv(at, list);
            case gl.FLOAT_VEC3:
                return gl.uniform3fv(at, list);
            case gl.FLOAT_MAT4:
                return gl.uniformMatrix4fv(at, false, list);
            default: // whole numbers, truth values and samplers
                return gl.uniform1iv(at, list);
        }
    }
}

/** A long list of records in a texture, `2^log2Width` to a row, read in shaders with texelFetch. */
export class RecordTexture {
    readonly handle: WebGLTexture;
    private rows = 0;

    constructor(
        private readonly gl: GL,
        private readonly internal: number,
        private readonly format: number,
        private readonly type: number,
        private readonly log2Width: number,
    ) {
        this.handle = gl.createTexture()!;
    }

    /** Four numbers a record. */
    upload(values: Float32Array | Uint16Array): void {
        const gl = this.gl,
            width = 1 << this.log2Width;
        const rows = Math.max(Math.ceil(values.length / (4 * width)), 1);
        if (rows > gl.getParameter(gl.MAX_TEXTURE_SIZE))
            throw new Error("there is more hair than this graphics processor's textures hold");
        gl.bindTexture(gl.TEXTURE_2D, this.handle);
        if (rows !== this.rows) {
            gl.texImage2D(gl.TEXTURE_2D, 0, this.internal, width, rows, 0, this.format, this.type, null);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
            this.rows = rows;
        }
        const whole = Math.floor(values.length / (4 * width));
        if (whole > 0) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, whole, this.format, this.type, values);
        const rest = values.length / 4 - whole * width;
        if (rest > 0) {
            const tail = values.subarray(4 * whole * width);
            gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, whole, rest, 1, this.format, this.type, tail);
        }
    }

    delete(): void {
        this.gl.deleteTexture(this.handle);
    }
}

/** Textures bound for a program, by the units that its samplers name. */
export function bindTextures(gl: GL, target: number, ...textures: [unit: number, texture: WebGLTexture][]): void {
    for (const [unit, texture] of textures) {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(target, texture);
    }
    gl.activeTexture(gl.TEXTURE0);
}

/** The texture units, one meaning each throughout. */
export const Unit = { scratch: 0, sections: 1, shares: 2, waves: 3, shade: 4, picture: 5 } as const;

export function createBuffer(gl: GL, target: number, data: AllowSharedBufferSource | number, usage: number): WebGLBuffer {
    const buffer = gl.createBuffer()!;
    gl.bindBuffer(target, buffer);
    if (typeof data === "number") gl.bufferData(target, data, usage);
    else gl.bufferData(target, data, usage);
    return buffer;
}
