import type { Hair } from "../hair/hair";
import type { PosedBody } from "../hair/posed_body";
import { bindTextures, Unit, type GL } from "./gl";
import { LightVolume } from "./light_volume";
import { add, cross, normalized, scale, type Vec3 } from "./matrix";

const kRadiance = [3, 2.85, 2.64, 0.77, 0.83, 0.9, 1.5, 1.47, 1.43]; // of key, fill and rim light
const kSkyRadiance = [0.8, 0.86, 0.95];

/** Key, fill and rim light go with the camera's heading, so that hair reads from everywhere. */
function directions(heading: number): Vec3[] {
    const back: Vec3 = [Math.sin(heading), 0, Math.cos(heading)],
        right = cross([0, 1, 0], back);
    const toward = (b: number, r: number, up: number): Vec3 => normalized(add(add(scale(back, b), right, r), [0, up, 0]));
    return [toward(0.8, -0.7, 0.9), toward(0.7, 0.9, 0.2), toward(-0.9, 0.5, 0.8)];
}

/** The lights, and what hair and bodies leave of them, as the shaders read it. */
export class LightRig {
    private readonly texture: WebGLTexture;
    private readonly volume = new LightVolume();
    private heading = NaN; // [rad] that the lights were swept for

    constructor(private readonly gl: GL) {
        this.texture = gl.createTexture()!;
    }

    /** How fine the volume is. */
    get nodes(): number {
        return this.volume.nodes;
    }

    /** Takes another frame; `turn` comes after. */
    fill(hair: Hair, sections: Float32Array, shadow: Float32Array, bodies: readonly PosedBody[], nodes: number): void {
        this.volume.fill(hair, sections, shadow, bodies, nodes);
        this.heading = NaN;
    }

    /** Turns the lights with a camera that heads so [rad]. */
    turn(heading: number): void {
        if (heading === this.heading) return;
        const { gl, volume } = this;
        this.heading = heading;
        volume.light(directions(heading));
        gl.bindTexture(gl.TEXTURE_3D, this.texture);
        gl.texImage3D(gl.TEXTURE_3D, 0, gl.RGBA8, ...volume.size, 0, gl.RGBA, gl.UNSIGNED_BYTE, volume.texels);
        gl.texParameteri(gl.TEXTURE_3D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
        gl.texParameteri(gl.TEXTURE_3D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
        for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R])
            gl.texParameteri(gl.TEXTURE_3D, wrap, gl.CLAMP_TO_EDGE);
    }

    bind(): void {
        bindTextures(this.gl, this.gl.TEXTURE_3D, [Unit.shade, this.texture]);
    }

    uniforms() {
        const { cell, size, low } = this.volume;
        return {
            uShade: Unit.shade,
            uShadeLow: low.map((l) => l - 0.5 * cell), // texels have their values in their middles
            uShadeScale: size.map((n) => 1 / (n * cell)),
            uLightDirection: directions(this.heading).flat(),
            uLightRadiance: kRadiance,
            uSkyRadiance: kSkyRadiance,
        };
    }
}
