import addFragment from "./add.frag.glsl";
import { bindTextures, Program, Unit, type GL } from "./gl";
import type { Vec3 } from "./matrix";
import presentFragment from "./present.frag.glsl";
import screenVertex from "./screen.vert.glsl";

/**
 * Where light adds up. A picture is the mean of several passes, each with a part of the strands, drawn so much wider that they
 * cover as all do, and with the image moved by a part of a pixel: so a strand thinner than a pixel covers its share of it, and
 * nothing has to be sorted (Cook et al. 2007, "Stochastic simplification of aggregate detail").
 */
export class Film {
    private readonly add: Program;
    private readonly present: Program;
    private readonly pass: WebGLFramebuffer;
    private readonly sum: WebGLFramebuffer;
    private readonly passColour: WebGLTexture;
    private readonly sumColour: WebGLTexture;
    private readonly depth: WebGLRenderbuffer;
    private readonly empty: WebGLVertexArrayObject;
    private width = 0;
    private height = 0;
    /** Passes in the sum. */
    passes = 0;

    constructor(private readonly gl: GL) {
        if (!gl.getExtension("EXT_color_buffer_float") && !gl.getExtension("EXT_color_buffer_half_float"))
            throw new Error("this browser's WebGL cannot draw into floating-point pictures (EXT_color_buffer_float)");
        this.add = new Program(gl, screenVertex, addFragment);
        this.present = new Program(gl, screenVertex, presentFragment);
        this.pass = gl.createFramebuffer()!;
        this.sum = gl.createFramebuffer()!;
        this.passColour = gl.createTexture()!;
        this.sumColour = gl.createTexture()!;
        this.depth = gl.createRenderbuffer()!;
        this.empty = gl.createVertexArray()!;
    }

    resize(width: number, height: number): void {
        if (width === this.width && height === this.height) return;
        const gl = this.gl;
        [this.width, this.height] = [width, height];
        gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
        gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
        for (const [framebuffer, colour] of [
            [this.pass, this.passColour],
            [this.sum, this.sumColour],
        ]) {
            gl.bindTexture(gl.TEXTURE_2D, colour);
            gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, width, height, 0, gl.RGBA, gl.HALF_FLOAT, null);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
            gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
            gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, colour, 0);
        }
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.pass);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, this.depth);
        this.passes = 0;
    }

    restart(): void {
        this.passes = 0;
    }

    /** What is drawn next goes into this pass. */
    beginPass(): void {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.pass);
        gl.viewport(0, 0, this.width, this.height);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    }
    resumePass(): void {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.pass);
        gl.viewport(0, 0, this.width, this.height);
    }

    /** Adds the pass to the sum. */
    endPass(): void {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.sum);
        if (this.passes === 0) {
            gl.clearColor(0, 0, 0, 0);
            gl.clear(gl.COLOR_BUFFER_BIT);
        }
        gl.disable(gl.DEPTH_TEST);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE);
        bindTextures(gl, gl.TEXTURE_2D, [Unit.picture, this.passColour]);
        this.add.use({ uPicture: Unit.picture });
        this.drawScreen();
        gl.disable(gl.BLEND);
        ++this.passes;
    }

    /** Shows the mean of the passes, or the unfinished first one. */
    show(background: { middle: Vec3; rim: Vec3; transparent: boolean }): void {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.viewport(0, 0, this.width, this.height);
        gl.disable(gl.DEPTH_TEST);
        gl.disable(gl.BLEND);
        bindTextures(gl, gl.TEXTURE_2D, [Unit.picture, this.passes ? this.sumColour : this.passColour]);
        this.present.use({
            uPicture: Unit.picture,
            uShare: 1 / Math.max(this.passes, 1),
            uBackgroundMiddle: background.middle,
            uBackgroundRim: background.rim,
            uTransparent: background.transparent,
            uViewport: [this.width, this.height],
        });
        this.drawScreen();
    }

    private drawScreen(): void {
        this.gl.bindVertexArray(this.empty);
        this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
    }
}
