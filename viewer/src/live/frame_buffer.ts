/**
 * A frame as it travels: one buffer. Doubles first: time, origin, the bones of all bodies (position, then rotation); then the floats
 * of positions, radii and first axes. Both sides look at it through the same views; nobody packs or unpacks.
 */
import type { BonePoses, HairFrame } from "../hair/hair";
import type { FrameLayout } from "./protocol";

/** A frame of the buffer's own memory, with the time that is in it now; its index is the reader's to fill. */
export function frameOf(buffer: ArrayBufferLike, layout: FrameLayout, begin = 0): HairFrame {
    const doubles = (offset: number, count: number) => new Float64Array(buffer, begin + 8 * offset, count);
    const floats = (from: number, to: number) => new Float32Array(buffer, begin + from, (to - from) / 4);
    let next = 4;
    const bodies = layout.bones.map((bones): BonePoses => {
        const pose = { position: doubles(next, 3 * bones), rotation: doubles(next + 3 * bones, 4 * bones) };
        next += 7 * bones;
        return pose;
    });
    return {
        index: 0,
        time: doubles(0, 1)[0],
        origin: doubles(1, 3),
        position: floats(layout.position, layout.radius),
        radius: floats(layout.radius, layout.firstAxis),
        firstAxis: floats(layout.firstAxis, layout.bytes),
        bodies,
    };
}
