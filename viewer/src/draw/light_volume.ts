import type { Hair } from "../hair/hair";
import type { PosedBody } from "../hair/posed_body";
import { normalized, type Vec3 } from "./matrix";

const kMeanSine = 0.785; // of the angle between strand and light, over all directions: π/4
const kSkinDepth = 3; // optical depth across the surface of a body
const kCoded = 4; // a texel holds e^(−depth/4): depths to 20 in 8 bits

/** To the faces of a cube and four of its upper corners; brighter above. */
const kSky: { direction: Vec3; weight: number }[] = [
    [0, 1, 0], [1, 0, 0], [-1, 0, 0], [0, 0, 1], [0, 0, -1], [0, -1, 0],
].map(([x, y, z]) => ({ direction: normalized([x, y, z]), weight: (0.6 + 0.4 * y) / 3.6 }));

/**
 * What hair and body leave of each light and of the sky, on the nodes of a grid: a model of src/picture/shadow_volume.cpp that
 * takes the hair from its cross-sections and not from strands. A shadow ray per strand would cost a hundred times as much.
 */
export class LightVolume {
    readonly size: [number, number, number] = [2, 2, 2];
    readonly low: Vec3 = [0, 0, 0];
    cell = 0.01;
    /** About how many the grid has. */
    nodes = 0;
    /** Four bytes a node: e^(−depth/4) of three lights, and the share of the sky that is seen. */
    texels = new Uint8Array(0);

    private density = new Float32Array(0);
    private depth = new Float32Array(0);
    private sky = new Float32Array(0);

    /** The hair's density in a frame: `records` as in `Sections`, `area` [m²] of shadow that a metre of each wisp throws. */
    fill(hair: Hair, sections: Float32Array, shadow: Float32Array, bodies: readonly PosedBody[], nodes: number): void {
        this.nodes = nodes;
        this.enclose(hair, sections, bodies[0]);
        this.density.fill(0);
        for (let w = 0; w < hair.wisps; ++w) this.addWisp(hair, sections, w, shadow[w]);
        if (bodies[0]) this.addBody(bodies[0]);
        this.seeSky();
    }

    /** Sweeps the three lights; `fill` comes before. */
    light(directions: readonly Vec3[]): void {
        const texels = this.texels,
            depth = this.depth;
        directions.forEach((direction, i) => {
            this.sweep(direction);
            for (let n = 0; n < depth.length; ++n) texels[4 * n + i] = 255 * Math.exp(-depth[n] / kCoded) + 0.5;
        });
        for (let n = 0; n < depth.length; ++n) texels[4 * n + 3] = 255 * this.sky[n] + 0.5;
    }

    private enclose(hair: Hair, sections: Float32Array, body: PosedBody | undefined): void {
        const low: Vec3 = [1e9, 1e9, 1e9],
            high: Vec3 = [-1e9, -1e9, -1e9];
        const include = (points: Float32Array, step: number, margin: number) => {
            for (let i = 0; i < points.length; i += step)
                for (let a = 0; a < 3; ++a) {
                    low[a] = Math.min(low[a], points[i + a] - margin);
                    high[a] = Math.max(high[a], points[i + a] + margin);
                }
        };
        include(sections, 4 * (hair.envelopePoints + 1), 0.03);
        if (body) include(body.vertices, 3, 0);
        const volume = low.reduce((v, l, a) => v * (high[a] - l + 0.04), 1);
        this.cell = Math.cbrt(volume / this.nodes);
        for (let a = 0; a < 3; ++a) {
            this.low[a] = low[a] - 2 * this.cell;
            this.size[a] = Math.ceil((high[a] - low[a]) / this.cell) + 5;
        }
        const nodes = this.size[0] * this.size[1] * this.size[2];
        if (this.density.length !== nodes) {
            this.density = new Float32Array(nodes);
            this.depth = new Float32Array(nodes);
            this.sky = new Float32Array(nodes);
            this.texels = new Uint8Array(4 * nodes);
        }
    }

    /** Shares `amount` among the eight nodes around a point. */
    private splat(x: number, y: number, z: number, amount: number): void {
        const [nx, ny] = this.size;
        const gx = (x - this.low[0]) / this.cell,
            gy = (y - this.low[1]) / this.cell,
            gz = (z - this.low[2]) / this.cell;
        const ix = Math.floor(gx),
            iy = Math.floor(gy),
            iz = Math.floor(gz);
        const fx = gx - ix,
            fy = gy - iy,
            fz = gz - iz;
        const at = ix + nx * (iy + ny * iz),
            d = this.density,
            up = nx * ny;
        const a = amount * (1 - fz),
            b = amount * fz;
        d[at] += a * (1 - fx) * (1 - fy);
        d[at + 1] += a * fx * (1 - fy);
        d[at + nx] += a * (1 - fx) * fy;
        d[at + nx + 1] += a * fx * fy;
        d[at + up] += b * (1 - fx) * (1 - fy);
        d[at + up + 1] += b * fx * (1 - fy);
        d[at + up + nx] += b * (1 - fx) * fy;
        d[at + up + nx + 1] += b * fx * fy;
    }

    /** Points spread over the wisp's sections and along its segments, each with its part of the shadow. */
    private addWisp(hair: Hair, sections: Float32Array, wisp: number, shadow: number): void {
        const k = hair.envelopePoints,
            record = 4 * (k + 1);
        const perVolume = (kMeanSine * shadow) / this.cell ** 3;
        for (let s = hair.firstSection[wisp] + 1; s + 1 < hair.firstSection[wisp + 1]; ++s) {
            const a = record * s,
                b = a + record;
            const along = Math.hypot(
                sections[b] - sections[a], sections[b + 1] - sections[a + 1], sections[b + 2] - sections[a + 2]);
            const radius = Math.hypot(sections[a + 4], sections[a + 5], sections[a + 6]);
            const steps = Math.max(1, Math.ceil(along / this.cell)),
                rings = Math.max(1, Math.round(radius / this.cell));
            const points = rings * k;
            const amount = (along * perVolume) / (steps * points);
            for (let i = 0; i < steps; ++i) {
                const t = (i + 0.5) / steps;
                for (let p = 0; p < points; ++p) {
                    // Rings of equal area; turned from step to step, so that they do not line up.
                    const ring = Math.sqrt((Math.floor(p / k) + 0.5) / rings),
                        share = (p * 0.61803399 + i * 0.38196601) % 1;
                    const line = p % k,
                        next = (line + 1) % k;
                    const alpha = ring * (1 - share),
                        beta = ring * share;
                    const of = (axis: number, o: number) =>
                        sections[o + axis] + alpha * sections[o + 4 + 4 * line + axis] + beta * sections[o + 4 + 4 * next + axis];
                    this.splat(
                        of(0, a) + (of(0, b) - of(0, a)) * t,
                        of(1, a) + (of(1, b) - of(1, a)) * t,
                        of(2, a) + (of(2, b) - of(2, a)) * t,
                        amount,
                    );
                }
            }
        }
    }

    /** A body's surface as a shell, moved a little under its skin, so that it does not shade what lies on it. */
    private addBody(body: PosedBody): void {
        const { vertices: p, normals: n } = body;
        const under = 1.5 * this.cell,
            perVolume = kSkinDepth / this.cell ** 3;
        body.forEachTriangle((a, _b, _c, ux, uy, uz, vx, vy, vz) => {
            const area = 0.5 * Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
            const rows = Math.min(8, 1 + Math.floor(Math.sqrt(2 * area) / this.cell));
            const amount = (area * perVolume) / (rows * rows);
            for (let i = 0; i < rows; ++i)
                for (let j = 0; j < rows; ++j) {
                    let s = (i + 0.5) / rows,
                        r = (j + 0.5) / rows;
                    if (s + r > 1) (s = 1 - s), (r = 1 - r); // the parallelogram's other half, folded
                    const x = p[a] + ux * s + vx * r - under * n[a],
                        y = p[a + 1] + uy * s + vy * r - under * n[a + 1],
                        z = p[a + 2] + uz * s + vz * r - under * n[a + 2];
                    this.splat(x, y, z, amount);
                }
        });
    }

    private seeSky(): void {
        this.sky.fill(0);
        for (const { direction, weight } of kSky) {
            this.sweep(direction);
            for (let n = 0; n < this.sky.length; ++n) this.sky[n] += weight * Math.exp(-this.depth[n]);
        }
    }

    /**
     * Optical depth from every node toward a light: one sweep from the light's side. Each layer is read between nodes of the one
     * before, which blurs shadows with distance as a soft light does.
     */
    private sweep(light: Vec3): void {
        const { density, depth, size } = this;
        const stride = [1, size[0], size[0] * size[1]];
        let main = 0;
        for (let a = 1; a < 3; ++a) if (Math.abs(light[a]) > Math.abs(light[main])) main = a;
        const u = (main + 1) % 3,
            v = (main + 2) % 3;
        const steep = 1 / Math.abs(light[main]);
        const du = light[u] * steep,
            dv = light[v] * steep,
            half = 0.5 * steep * this.cell;
        const su = stride[u],
            sv = stride[v],
            nu = size[u],
            nv = size[v];
        depth.fill(0);
        for (let layer = 1; layer < size[main]; ++layer) {
            const here = (light[main] > 0 ? size[main] - 1 - layer : layer) * stride[main];
            const before = (light[main] > 0 ? size[main] - layer : layer - 1) * stride[main];
            for (let j = 0; j < nv; ++j) {
                const y = j + dv;
                if (y < 0 || y >= nv - 1) continue; // lit from outside the grid
                const y0 = Math.floor(y),
                    ty = y - y0,
                    row = before + y0 * sv;
                const first = Math.max(0, Math.ceil(-du)),
                    end = Math.min(nu, Math.ceil(nu - 1 - du));
                for (let i = first; i < end; ++i) {
                    const x = i + du,
                        x0 = Math.floor(x),
                        tx = x - x0;
                    const from = row + x0 * su,
                        w00 = (1 - tx) * (1 - ty),
                        w10 = tx * (1 - ty),
                        w01 = (1 - tx) * ty,
                        w11 = tx * ty;
                    const a = from + su,
                        b = from + sv,
                        c = b + su,
                        to = here + i * su + j * sv;
                    depth[to] =
                        w00 * depth[from] + w10 * depth[a] + w01 * depth[b] + w11 * depth[c] +
                        half * (w00 * density[from] + w10 * density[a] + w01 * density[b] + w11 * density[c] + density[to]);
                }
            }
        }
    }
}
