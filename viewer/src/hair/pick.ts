import type { Vec3 } from "../draw/matrix";
import { add, cross, dot, length, subtract } from "../draw/matrix";
import type { Hair } from "./hair";
import type { PosedBody } from "./posed_body";

/**
 * The wisp that a ray meets first, −1 for none: its segments as capsules of their sections' mean radius. `eye` is relative to the
 * frame's origin, `direction` unit, `records` as `Sections.values`. A wisp behind a body is not met.
 */
export function pickWisp(hair: Hair, records: Float32Array, bodies: readonly PosedBody[], eye: Vec3, direction: Vec3): number {
    const k = hair.envelopePoints,
        record = 4 * (k + 1);
    const centre = (s: number): Vec3 => [records[record * s], records[record * s + 1], records[record * s + 2]];
    const radius = (s: number): number => {
        let sum = 0;
        for (let i = 1; i <= k; ++i) {
            const at = record * s + 4 * i;
            sum += Math.hypot(records[at], records[at + 1], records[at + 2]);
        }
        return sum / k;
    };
    let best = -1,
        nearest = Math.min(...bodies.map((body) => distanceToBody(body, eye, direction)), Infinity);
    for (let w = 0; w < hair.wisps; ++w)
        for (let s = hair.firstSection[w] + 1; s + 1 < hair.firstSection[w + 1]; ++s) {
            const { along, apart, share } = nearestOnSegment(eye, direction, centre(s), centre(s + 1));
            const r = radius(s) + (radius(s + 1) - radius(s)) * share;
            const surface = along - Math.sqrt(Math.max(r * r - apart * apart, 0)); // about where the ray comes in
            if (apart < r && along > 0 && surface < nearest) {
                nearest = surface;
                best = w;
            }
        }
    return best;
}

/** Where a ray and a segment come nearest: distance along the ray, distance apart, share of the segment. */
function nearestOnSegment(eye: Vec3, direction: Vec3, a: Vec3, b: Vec3): { along: number; apart: number; share: number } {
    const segment = subtract(b, a),
        from = subtract(a, eye);
    const sd = dot(segment, direction),
        ss = dot(segment, segment);
    const across = ss - sd * sd;
    const share = across > 1e-12 ? Math.min(Math.max((sd * dot(from, direction) - dot(from, segment)) / across, 0), 1) : 0;
    const point = add(from, segment, share);
    const along = dot(point, direction);
    return { along, apart: length(add(point, direction, -along)), share };
}

function distanceToBody(body: PosedBody, eye: Vec3, direction: Vec3): number {
    const { vertices: p } = body,
        triangles = body.mesh.triangles;
    const vertex = (i: number): Vec3 => [p[3 * i], p[3 * i + 1], p[3 * i + 2]];
    let nearest = Infinity;
    for (let t = 0; t < triangles.length; t += 3) {
        const a = vertex(triangles[t]),
            ab = subtract(vertex(triangles[t + 1]), a),
            ac = subtract(vertex(triangles[t + 2]), a);
        const h = cross(direction, ac),
            det = dot(ab, h);
        if (Math.abs(det) < 1e-12) continue;
        const from = subtract(eye, a),
            u = dot(from, h) / det,
            q = cross(from, ab),
            v = dot(direction, q) / det;
        const at = dot(ac, q) / det;
        if (u >= 0 && v >= 0 && u + v <= 1 && at > 0) nearest = Math.min(nearest, at);
    }
    return nearest;
}
