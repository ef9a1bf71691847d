import { sectionCount, type BodyMesh, type BonePoses, type Hair, type HairFrame } from "../hair/hair";
import { DamagedPage, type PageData, type Steps } from "./page_data";
import { RunContacts } from "./contacts";

/** Numbers over time: one per frame, or one per wisp and frame. */
export interface Series {
    name: string;
    unit: string;
    values: Float32Array;
}

/** A recorded run: its frames in any order, and what was measured of them. */
export class Run {
    readonly title: string;
    readonly frames: number;
    readonly frameRate: number;
    readonly hair: Hair;
    readonly bodies: BodyMesh[];
    readonly time: Float64Array;
    readonly restLength: Float32Array; // [m] per section s: of the segment s → s + 1
    readonly designedRadius: Float32Array; // [m] K per section
    readonly head: Series[];
    readonly wispSeries: Series[];
    /** Null where the run was simulated without `--record`. */
    readonly contacts: RunContacts | null;

    private readonly origin: Float64Array;
    private readonly position: Steps;
    private readonly radius: Steps;
    private readonly firstAxis: Steps;
    private readonly bonePosition: Float64Array[];
    private readonly boneRotation: Float64Array[];

    constructor(data: PageData) {
        const h = data.header;
        this.title = String(h.title);
        this.frames = h.frames;
        this.frameRate = h.frameRate;
        this.hair = {
            wisps: h.wisps,
            envelopePoints: h.envelopePoints,
            firstSection: data.numbers("first_section", "u32"),
            designedLength: data.numbers("designed_length", "f32"),
            strands: data.numbers("strands", "u32"),
            strandDesc: h.strandDesc,
            seed: h.seed,
        };
        this.bodies = h.bodies.map((body: { name: string; headBone: number }, i: number) => ({
            name: body.name,
            headBone: body.headBone,
            vertices: data.numbers(`body${i}.vertices`, "f32"),
            triangles: data.numbers(`body${i}.triangles`, "u32"),
            bones: data.numbers(`body${i}.bones`, "u16"),
            weights: data.numbers(`body${i}.weights`, "f32"),
        }));
        this.time = data.numbers("time", "f64");
        this.origin = data.numbers("origin", "f64");
        this.position = data.steps("position");
        this.radius = data.steps("radius");
        this.firstAxis = data.steps("first_axis");
        this.bonePosition = this.bodies.map((_, i) => data.numbers(`body${i}.bone_position`, "f64"));
        this.boneRotation = this.bodies.map((_, i) => data.numbers(`body${i}.bone_rotation`, "f64"));
        this.restLength = data.numbers("rest_length", "f32");
        this.designedRadius = data.numbers("designed_radius", "f32");
        const series = (of: string): Series[] =>
            h[of].map((s: Series) => ({ ...s, values: data.numbers(`${of}.${s.name}`, "f32") }));
        this.head = series("head");
        this.wispSeries = series("wispSeries");
        this.checkSizes();
        this.contacts = data.has("contact.count") ? new RunContacts(data, this.frames) : null;
    }

    private checkSizes(): void {
        const { hair, frames } = this;
        const expect = (what: string, found: number, expected: number) => {
            if (found !== expected) throw new DamagedPage(`this page's run has ${found} ${what}, expected ${expected}`);
        };
        expect("wisps", hair.firstSection.length - 1, hair.wisps);
        const sections = sectionCount(hair);
        expect("designed lengths", hair.designedLength.length, sections);
        expect("times", this.time.length, frames);
        expect("origins", this.origin.length, 3 * frames);
        expect("positions", this.position.values.length, 3 * sections * frames);
        expect("radii", this.radius.values.length, hair.envelopePoints * sections * frames);
        expect("first axes", this.firstAxis.values.length, 3 * hair.wisps * frames);
        for (const s of this.head) expect(`values of "${s.name}"`, s.values.length, frames);
        for (const s of this.wispSeries) expect(`values of "${s.name}"`, s.values.length, frames * hair.wisps);
    }

    frame(index: number): HairFrame {
        const origin = this.origin.slice(3 * index, 3 * index + 3);
        const from = index * this.position.row,
            quantum = this.position.quantum;
        const position = new Float32Array(this.position.row);
        for (let i = 0; i < position.length; ++i)
            position[i] = this.position.values[from + i] * quantum - origin[i % 3]; // stored in the world
        return {
            index,
            time: this.time[index],
            origin,
            position,
            radius: row(this.radius, index),
            firstAxis: row(this.firstAxis, index),
            bodies: this.bodies.map((_, b) => this.poses(b, index)),
        };
    }

    private poses(body: number, index: number): BonePoses {
        const position = this.bonePosition[body],
            bones = position.length / 3 / this.frames;
        return {
            position: position.subarray(3 * bones * index, 3 * bones * (index + 1)),
            rotation: this.boneRotation[body].subarray(4 * bones * index, 4 * bones * (index + 1)),
        };
    }

    /** [m] Length of the segment s → s + 1 in a frame. */
    segmentLength(index: number, s: number): number {
        const at = index * this.position.row + 3 * s,
            v = this.position.values;
        return this.position.quantum * Math.hypot(v[at + 3] - v[at], v[at + 4] - v[at + 1], v[at + 5] - v[at + 2]);
    }

    /** [m] Mean radius of a section in a frame. */
    meanRadius(index: number, s: number): number {
        const k = this.hair.envelopePoints,
            at = index * this.radius.row + k * s;
        let sum = 0;
        for (let i = 0; i < k; ++i) sum += this.radius.values[at + i];
        return (this.radius.quantum * sum) / k;
    }
}

function row(steps: Steps, index: number): Float32Array {
    const from = index * steps.row;
    return Float32Array.from(steps.values.subarray(from, from + steps.row), (v) => v * steps.quantum);
}
