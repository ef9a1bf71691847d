/**
 * Frames come 24 times a second; screens show 60 or more. Between two frames everything moves evenly from the one to the other, so
 * what is seen is one frame late and smooth. Places of frames that are no longer needed go back to the solver.
 */
import type { BodyMesh, BonePoses, HairFrame } from "../hair/hair";
import { frameOf } from "./frame_buffer";
import type { Place, WorldDescription } from "./protocol";

interface Arrived {
    frame: HairFrame;
    place: Place;
}

export class FrameBlend {
    private before: Arrived | null = null;
    private latest: Arrived | null = null;
    private arrival = 0; // [ms] of the latest
    private interval: number; // [ms] between frames, as they come
    private readonly between: HairFrame;
    private readonly middles: Point[]; // of bodies, in the rest pose
    private shown = -1; // what was asked for last

    constructor(
        private readonly world: WorldDescription,
        private readonly giveBack: (place: Place) => void,
    ) {
        const { layout } = world;
        this.between = frameOf(new ArrayBuffer(Math.ceil(layout.bytes / 8) * 8), layout);
        this.interval = 1000 / world.frameRate;
        this.middles = world.bodies.map(middleOf);
    }

    push(index: number, place: Place, now: number): void {
        const { layout, shared } = this.world;
        const slot = Math.ceil(layout.bytes / 8) * 8;
        const frame = frameOf(shared ?? place.buffer!, layout, shared ? place.slot * slot : 0);
        frame.index = index;
        if (this.before) this.giveBack(this.before.place);
        this.before = this.latest;
        this.latest = { frame, place };
        const usual = 1000 / this.world.frameRate;
        this.interval = Math.min(Math.max(now - this.arrival, 0.5 * usual), 4 * usual);
        this.arrival = now;
        this.shown = -1;
    }

    get newest(): HairFrame | null {
        return this.latest?.frame ?? null;
    }

    /** The hair now; null if it is the same as when last asked. `still`: no frame is on its way, so the latest one. */
    at(now: number, still: boolean): HairFrame | null {
        if (!this.latest) return null;
        const step = this.before ? this.latest.frame.time - this.before.frame.time : 0;
        const follows = step > 0 && step < 1.5 / this.world.frameRate; // else it is another place, or frames were missed
        const share = still || !follows ? 1 : Math.min(1, (now - this.arrival) / this.interval);
        if (share === this.shown) return null;
        this.shown = share;
        // Never the frame itself: who draws keeps it, and its memory goes back to the solver.
        blend(share === 1 ? this.latest.frame : this.before!.frame, this.latest.frame, share, this.middles, this.between);
        return this.between;
    }
}

type Numbers = Float32Array | Float64Array;

type Point = [number, number, number];

function middleOf({ vertices }: BodyMesh): Point {
    const sum: Point = [0, 0, 0];
    for (let i = 0; i < vertices.length; ++i) sum[i % 3] += vertices[i];
    return sum.map((x) => (3 * x) / Math.max(vertices.length, 1)) as Point;
}

/** Relative to the origin of `b`. */
function blend(a: HairFrame, b: HairFrame, share: number, middles: Point[], to: HairFrame): void {
    to.index = b.index;
    to.time = a.time + share * (b.time - a.time);
    to.origin.set(b.origin);
    const shift = [0, 1, 2].map((axis) => a.origin[axis] - b.origin[axis]);
    for (let i = 0; i < to.position.length; ++i) {
        const from = a.position[i] + shift[i % 3];
        to.position[i] = from + share * (b.position[i] - from);
    }
    mix(a.radius, b.radius, share, to.radius);
    mix(a.firstAxis, b.firstAxis, share, to.firstAxis);
    normalize(to.firstAxis, 3);
    to.bodies.forEach((poses, body) => mixPoses(a.bodies[body], b.bodies[body], share, middles[body], poses));
}

function mix(a: Numbers, b: Numbers, share: number, to: Numbers): void {
    for (let i = 0; i < to.length; ++i) to[i] = a[i] + share * (b[i] - a[i]);
}

/** Bones turn about the middle of their body, which goes straight: about the world's origin, a metre and a half below, a head that turns would nod. */
function mixPoses(a: BonePoses, b: BonePoses, share: number, middle: Point, to: BonePoses): void {
    for (let q = 0; q < to.rotation.length; q += 4) {
        const along = a.rotation[q] * b.rotation[q] + a.rotation[q + 1] * b.rotation[q + 1] + a.rotation[q + 2] * b.rotation[q + 2] + a.rotation[q + 3] * b.rotation[q + 3];
        const sign = along < 0 ? -1 : 1; // the same rotation, on the same side
        for (let i = q; i < q + 4; ++i) to.rotation[i] = (1 - share) * a.rotation[i] + share * sign * b.rotation[i];
    }
    normalize(to.rotation, 4);
    for (let bone = 0; bone < to.position.length / 3; ++bone) {
        const [from, target, turned] = [a, b, to].map(({ rotation }) => rotate(rotation, 4 * bone, middle));
        for (let axis = 0; axis < 3; ++axis) {
            const at = 3 * bone + axis;
            const begin = a.position[at] + from![axis];
            to.position[at] = begin + share * (b.position[at] + target![axis] - begin) - turned![axis];
        }
    }
}

function rotate(quaternions: Numbers, q: number, [vx, vy, vz]: Point): Point {
    const [x, y, z, w] = [quaternions[q], quaternions[q + 1], quaternions[q + 2], quaternions[q + 3]];
    const tx = 2 * (y * vz - z * vy),
        ty = 2 * (z * vx - x * vz),
        tz = 2 * (x * vy - y * vx);
    return [vx + w * tx + y * tz - z * ty, vy + w * ty + z * tx - x * tz, vz + w * tz + x * ty - y * tx];
}

function normalize(vectors: Numbers, size: number): void {
    for (let v = 0; v < vectors.length; v += size) {
        let sum = 0;
        for (let i = v; i < v + size; ++i) sum += vectors[i] * vectors[i];
        const scale = sum > 0 ? 1 / Math.sqrt(sum) : 0;
        for (let i = v; i < v + size; ++i) vectors[i] *= scale;
    }
}
