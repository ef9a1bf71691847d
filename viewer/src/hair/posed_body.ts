import type { BodyMesh, BonePoses } from "./hair";

/** A body in the pose of one frame: vertices relative to the frame's origin, and smooth normals. */
export class PosedBody {
    readonly vertices: Float32Array;
    readonly normals: Float32Array;

    constructor(readonly mesh: BodyMesh) {
        this.vertices = mesh.vertices.slice();
        this.normals = new Float32Array(mesh.vertices.length);
    }

    update(poses: BonePoses, origin: Float64Array): void {
        const matrices = boneMatrices(poses, origin);
        const { bones, weights, vertices: rest } = this.mesh;
        const out = this.vertices,
            count = rest.length / 3,
            m = new Float64Array(12);
        if (matrices.length === 0) matrices.push(identityAt(origin));
        for (let v = 0; v < count; ++v) {
            let bone = matrices[0];
            if (bones.length > 0) {
                bone = m;
                m.fill(0);
                for (let k = 4 * v; k < 4 * v + 4; ++k) {
                    const weight = weights[k];
                    if (weight === 0) continue;
                    const of = matrices[bones[k]];
                    for (let i = 0; i < 12; ++i) m[i] += weight * of[i];
                }
            }
            const x = rest[3 * v],
                y = rest[3 * v + 1],
                z = rest[3 * v + 2];
            out[3 * v] = bone[0] * x + bone[1] * y + bone[2] * z + bone[3];
            out[3 * v + 1] = bone[4] * x + bone[5] * y + bone[6] * z + bone[7];
            out[3 * v + 2] = bone[8] * x + bone[9] * y + bone[10] * z + bone[11];
        }
        this.updateNormals();
    }

    /** Each triangle: where its corners' numbers begin, and its edges from the first corner to the second (u) and the third (v). */
    forEachTriangle(visit: (a: number, b: number, c: number, ux: number, uy: number, uz: number, vx: number, vy: number, vz: number) => void): void {
        const p = this.vertices,
            triangles = this.mesh.triangles;
        for (let t = 0; t < triangles.length; t += 3) {
            const a = 3 * triangles[t],
                b = 3 * triangles[t + 1],
                c = 3 * triangles[t + 2];
            visit(a, b, c, p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2], p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]);
        }
    }

    private updateNormals(): void {
        const n = this.normals.fill(0);
        this.forEachTriangle((a, b, c, ux, uy, uz, vx, vy, vz) => {
            const x = uy * vz - uz * vy,
                y = uz * vx - ux * vz,
                z = ux * vy - uy * vx; // twice the area long: larger triangles count for more
            for (const i of [a, b, c]) {
                n[i] += x;
                n[i + 1] += y;
                n[i + 2] += z;
            }
        });
        for (let i = 0; i < n.length; i += 3) {
            const l = Math.hypot(n[i], n[i + 1], n[i + 2]) || 1;
            n[i] /= l;
            n[i + 1] /= l;
            n[i + 2] /= l;
        }
    }
}

/** Per bone the rows of [R | t − origin]. */
export function boneMatrices(poses: BonePoses, origin: Float64Array): Float64Array[] {
    const matrices: Float64Array[] = [];
    for (let b = 0; 3 * b < poses.position.length; ++b) {
        const [x, y, z, w] = poses.rotation.subarray(4 * b, 4 * b + 4) as unknown as [number, number, number, number];
        const [tx, ty, tz] = [0, 1, 2].map((i) => poses.position[3 * b + i] - origin[i]);
        matrices.push(
            Float64Array.of(
                1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), tx!,
                2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), ty!,
                2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), tz!,
            ),
        );
    }
    return matrices;
}

const identityAt = (origin: Float64Array): Float64Array =>
    Float64Array.of(1, 0, 0, -origin[0], 0, 1, 0, -origin[1], 0, 0, 1, -origin[2]);
