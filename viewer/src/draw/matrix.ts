/** 4 × 4 matrices, column after column, and vectors of three. */
export type Vec3 = [number, number, number];

export const add = (a: Vec3, b: Vec3, s = 1): Vec3 => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
export const subtract = (a: Vec3, b: Vec3): Vec3 => add(a, b, -1);
export const scale = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec3, b: Vec3): Vec3 => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
];
export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const normalized = (a: Vec3): Vec3 => scale(a, 1 / (length(a) || 1));

/** The rotation of a unit quaternion x y z w. */
export function rotate(q: ArrayLike<number>, v: Vec3): Vec3 {
    const axis: Vec3 = [q[0], q[1], q[2]];
    const t = scale(cross(axis, v), 2);
    return add(add(v, t, q[3]), cross(axis, t));
}

export function multiply(a: Float64Array, b: Float64Array): Float64Array {
    const m = new Float64Array(16);
    for (let column = 0; column < 4; ++column)
        for (let row = 0; row < 4; ++row)
            for (let k = 0; k < 4; ++k) m[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return m;
}
