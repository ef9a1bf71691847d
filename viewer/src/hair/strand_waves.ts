import type { Hair, HairFrame, StrandDesc } from "./hair";
import { Random } from "./random";

/** The largest displacement by waves, in the disc. */
export const wavesAmplitude = (desc: StrandDesc): number =>
    desc.waves > 0 ? Math.min(Math.max(desc.waveAmplitude, 0), 1) : 0;

export const hasWavesOrCurls = (desc: StrandDesc): boolean => wavesAmplitude(desc) > 0 || desc.curls !== 0;

/** Numbers of one piece of a wisp, the segment from section s to s + 1, for the shader. */
export const kWaveFloats = 8; // phase, its change [rad]; amplitude left at begin, middle, end [1]; direction [rad]; curl, its change [rad]

/**
 * Waves (M18) and curls (M19) of every segment in one frame, as src/strands/waves.cpp has them: phases belong to the material, so
 * a stretched segment keeps its number of waves; its amplitude shrinks by designed length over length.
 */
export class StrandWaves {
    private readonly values: Float32Array;

    constructor(
        private readonly hair: Hair,
        private readonly desc: StrandDesc,
    ) {
        this.values = new Float32Array(kWaveFloats * hair.designedLength.length);
        for (let w = 0; w < hair.wisps; ++w) this.begin(w);
    }

    /** The values in this frame, `kWaveFloats` per section. Overwritten by the next call. */
    at(frame: HairFrame): Float32Array {
        const v = this.values,
            x = frame.position;
        for (let w = 0; w < this.hair.wisps; ++w) {
            const first = this.hair.firstSection[w],
                tip = this.hair.firstSection[w + 1] - 1;
            for (let s = first; s < tip; ++s) {
                const a = 3 * s,
                    b = a + 3;
                const now = Math.hypot(x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]);
                const designed = this.hair.designedLength[s];
                const left = now > designed ? designed / now : 1;
                v[kWaveFloats * s + 2] = v[kWaveFloats * s + 3] = v[kWaveFloats * s + 4] = left;
            }
            for (let s = first + 1; s < tip; ++s) {
                const middle = 0.5 * (v[kWaveFloats * (s - 1) + 3] + v[kWaveFloats * s + 3]);
                v[kWaveFloats * (s - 1) + 4] = v[kWaveFloats * s + 2] = middle;
            }
        }
        return v;
    }

    /** What no frame changes. Both angles are 0 at x₁ before the wave's random part, and so negative from x₀ to x₁. */
    private begin(wisp: number): void {
        const random = new Random(this.hair.seed, wisp);
        const first = this.hair.firstSection[wisp],
            tip = this.hair.firstSection[wisp + 1] - 1;
        let total = 0; // [m] from x₁ on, where hair is seen
        for (let s = first + 1; s < tip; ++s) total += this.hair.designedLength[s];
        const turn = (2 * Math.PI) / Math.max(total, 1e-6);
        const direction = 2 * Math.PI * random.unit(0);
        let phase = 2 * Math.PI * random.unit(1) - turn * this.desc.waves * this.hair.designedLength[first],
            curl = -turn * this.desc.curls * this.hair.designedLength[first];
        for (let s = first; s < tip; ++s) {
            const along = turn * this.hair.designedLength[s];
            const at = kWaveFloats * s;
            this.values[at] = phase;
            this.values[at + 1] = along * this.desc.waves;
            this.values[at + 5] = direction;
            this.values[at + 6] = curl;
            this.values[at + 7] = along * this.desc.curls;
            phase += along * this.desc.waves;
            curl += along * this.desc.curls;
        }
    }
}
