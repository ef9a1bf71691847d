import type { Hair, HairFrame } from "./hair";
import { sectionCount } from "./hair";

/**
 * The cross-sections of one frame as the shaders read them: per section K + 1 records of four floats, its centre and then the end
 * of each half line relative to it (M7, M8, as src/model/section_frames.cpp).
 */
export class Sections {
    readonly values: Float32Array;
    readonly records: number; // per section
    private readonly cosine: Float64Array;
    private readonly sine: Float64Array;

    constructor(private readonly hair: Hair) {
        const k = hair.envelopePoints;
        this.records = k + 1;
        this.values = new Float32Array(4 * this.records * sectionCount(hair));
        this.cosine = Float64Array.from({ length: k }, (_, i) => Math.cos((2 * Math.PI * i) / k));
        this.sine = Float64Array.from({ length: k }, (_, i) => Math.sin((2 * Math.PI * i) / k));
    }

    update(frame: HairFrame): void {
        for (let w = 0; w < this.hair.wisps; ++w) this.updateWisp(frame, w);
    }

    private updateWisp(frame: HairFrame, w: number): void {
        const x = frame.position,
            first = this.hair.firstSection[w],
            tip = this.hair.firstSection[w + 1] - 1;
        let [tx, ty, tz] = direction(x, first, first + 1);
        let [nx, ny, nz] = [tx, ty, tz];
        let ux = frame.firstAxis[3 * w],
            uy = frame.firstAxis[3 * w + 1],
            uz = frame.firstAxis[3 * w + 2];
        for (let s = first; s <= tip; ++s) {
            if (s > first) {
                const [ax, ay, az] = s < tip ? direction(x, s, s + 1) : [tx, ty, tz];
                // The plane that bisects the two segments; folded back on itself, none does.
                let mx = tx + ax,
                    my = ty + ay,
                    mz = tz + az;
                const l = Math.hypot(mx, my, mz);
                if (l < 1e-3) [mx, my, mz] = [tx, ty, tz];
                else (mx /= l), (my /= l), (mz /= l);
                // The least rotation from the last normal to this one, applied to u.
                const d = Math.max(1 + nx * mx + ny * my + nz * mz, 1e-6),
                    c = (ux * mx + uy * my + uz * mz) / d;
                ux -= (nx + mx) * c;
                uy -= (ny + my) * c;
                uz -= (nz + mz) * c;
                [nx, ny, nz] = [mx, my, mz];
                [tx, ty, tz] = [ax, ay, az];
            }
            const along = ux * nx + uy * ny + uz * nz;
            ux -= nx * along;
            uy -= ny * along;
            uz -= nz * along;
            const l = Math.hypot(ux, uy, uz) || 1;
            (ux /= l), (uy /= l), (uz /= l);
            this.write(frame, s, ux, uy, uz, ny * uz - nz * uy, nz * ux - nx * uz, nx * uy - ny * ux);
        }
    }

    private write(frame: HairFrame, s: number, ux: number, uy: number, uz: number, vx: number, vy: number, vz: number) {
        const k = this.hair.envelopePoints,
            out = this.values;
        let at = 4 * this.records * s;
        out[at] = frame.position[3 * s];
        out[at + 1] = frame.position[3 * s + 1];
        out[at + 2] = frame.position[3 * s + 2];
        for (let i = 0; i < k; ++i) {
            const r = frame.radius[k * s + i],
                c = r * this.cosine[i],
                d = r * this.sine[i];
            at += 4;
            out[at] = ux * c + vx * d;
            out[at + 1] = uy * c + vy * d;
            out[at + 2] = uz * c + vz * d;
        }
    }
}

function direction(x: Float32Array, from: number, to: number): [number, number, number] {
    const a = 3 * from,
        b = 3 * to;
    const dx = x[b] - x[a],
        dy = x[b + 1] - x[a + 1],
        dz = x[b + 2] - x[a + 2];
    const l = Math.max(Math.hypot(dx, dy, dz), 1e-6);
    return [dx / l, dy / l, dz / l];
}
