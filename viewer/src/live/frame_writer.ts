/**
 * Hands frames from the solver's memory to the page with one copy: into buffers that change hands and come back, or, where memory may
 * be shared, into slots that both see. A page that has not given a place back yet misses a frame.
 */
import { frameOf } from "./frame_buffer";
import type { Place, WorldDescription } from "./protocol";
import type { Solver } from "./solver";

const SLOTS = 4; // two that are blended, one on its way, one being written

export class FrameWriter {
    private readonly free: Place[] = [];

    constructor(
        private readonly solver: Solver,
        private readonly world: WorldDescription,
    ) {
        const { bytes } = world.layout;
        const slot = Math.ceil(bytes / 8) * 8;
        if (solver.threads > 1) world.shared = new SharedArrayBuffer(SLOTS * slot);
        for (let i = 0; i < SLOTS; ++i) this.free.push(world.shared ? { slot: i } : { slot: i, buffer: new ArrayBuffer(slot) });
    }

    /** Writes the solver's frame; null if there is no free place. */
    write(): Place | null {
        const place = this.free.pop();
        if (!place) return null;
        const { layout, shared } = this.world;
        const begin = shared ? (place.slot * shared.byteLength) / SLOTS : 0;
        const memory = shared ?? place.buffer!;
        const frame = frameOf(memory, layout, begin);
        new Float64Array(memory, begin, layout.position / 8).set(this.solver.view(Float64Array, "frame.doubles"));
        frame.position.set(this.solver.view(Float32Array, "frame.position"));
        frame.radius.set(this.solver.view(Float32Array, "frame.radius"));
        frame.firstAxis.set(this.solver.view(Float32Array, "frame.first_axis"));
        return place;
    }

    /** The page has drawn what was here. */
    giveBack(place: Place): void {
        this.free.push(place);
    }
}
