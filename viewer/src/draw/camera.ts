import { add, cross, dot, multiply, normalized, scale, subtract, type Vec3 } from "./matrix";

const kUp: Vec3 = [0, 1, 0];
const kSteepest = (85 * Math.PI) / 180;

/** A camera that goes round a target, upright; angles in radians, metres in the world. */
export class OrbitCamera {
    target: Vec3 = [0, 1.4, 0];
    yaw = (40 * Math.PI) / 180; // 0 in front of the character, toward its left side
    pitch = (5 * Math.PI) / 180; // above the target
    distance = 1.7;
    fieldOfView = (24 * Math.PI) / 180; // over the picture's height

    orbit(yaw: number, pitch: number): void {
        this.yaw += yaw;
        this.pitch = Math.min(Math.max(this.pitch + pitch, -kSteepest), kSteepest);
    }
    /** Nearer for factors under 1. */
    zoom(factor: number): void {
        this.distance = Math.min(Math.max(this.distance * factor, 0.05), 30);
    }
    /** Moves the target across the picture, in shares of its height. */
    pan(right: number, up: number): void {
        const height = 2 * this.distance * Math.tan(this.fieldOfView / 2);
        const { across, above } = this.axes();
        this.target = add(add(this.target, across, right * height), above, up * height);
    }

    eye(): Vec3 {
        const c = Math.cos(this.pitch);
        const away: Vec3 = [Math.sin(this.yaw) * c, Math.sin(this.pitch), Math.cos(this.yaw) * c];
        return add(this.target, away, this.distance);
    }
    axes(): { forward: Vec3; across: Vec3; above: Vec3 } {
        const forward = normalized(subtract(this.target, this.eye()));
        const across = normalized(cross(forward, kUp));
        return { forward, across, above: cross(across, forward) };
    }
    /** [1] Size of one of `height` pixels at distance 1. */
    pixel(height: number): number {
        return (2 * Math.tan(this.fieldOfView / 2)) / height;
    }

    /** From coordinates relative to `origin` to clip space; `shift` moves the picture by parts of a pixel. */
    clip(origin: Vec3, width: number, height: number, shift: readonly [number, number] = [0, 0]): Float64Array {
        const { forward, across, above } = this.axes();
        const eye = subtract(this.eye(), origin);
        const near = Math.max(0.02, this.distance * 0.05),
            far = this.distance + 6;
        const f = 1 / Math.tan(this.fieldOfView / 2);
        const row = (v: Vec3): [number, number, number, number] => [...v, -dot(v, eye)];
        const [r, u, b] = [row(across), row(above), row(scale(forward, -1))];
        const view = new Float64Array(16);
        for (let column = 0; column < 4; ++column)
            view.set([r[column], u[column], b[column], column === 3 ? 1 : 0], 4 * column);
        const lens = new Float64Array(16);
        lens[0] = (f * height) / width;
        lens[5] = f;
        lens[8] = (2 * shift[0]) / width;
        lens[9] = (2 * shift[1]) / height;
        lens[10] = (near + far) / (near - far);
        lens[11] = -1;
        lens[14] = (2 * near * far) / (near - far);
        return multiply(lens, view);
    }

    /** The ray through a point of the picture, in shares of its size from the upper left. */
    ray(x: number, y: number, aspect: number): { eye: Vec3; direction: Vec3 } {
        const { forward, across, above } = this.axes();
        const half = Math.tan(this.fieldOfView / 2);
        const way = add(add(forward, across, (2 * x - 1) * half * aspect), above, (1 - 2 * y) * half);
        return { eye: this.eye(), direction: normalized(way) };
    }
}
