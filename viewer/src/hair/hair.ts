/**
 * Hair in a page: what a source of frames (a recorded run, a live solver) hands to whatever draws or
 * judges it. Plain data, the same names as `mane/groom.h`, `mane/frame.h` and `mane/body.h`; metres,
 * seconds, Y up. Frames are many and wisps too, so every array is flat.
 */

export type StrandDistribution = "uniform" | "gaussian" | "rim";

/** Layer 3 (§3.4, §5.2), as `StrandDesc` of mane/desc.h. */
export interface StrandDesc {
    count: number; // strands on the whole head
    distribution: StrandDistribution;
    jitter: number; // [1] largest share by which a control point moves toward the skeleton
    lengthJitter: number; // [1] largest share by which a strand is shortened
    waves: number; // waves along a strand
    waveAmplitude: number; // [1] at rest, relative to the wisp's radius
    curls: number; // [turns] along a strand
    rootWidth: number; // [m] diameters
    tipWidth: number;
}

/** What stays the same over a run. Wisp w owns the sections firstSection[w] … firstSection[w + 1] − 1. */
export interface Hair {
    wisps: number;
    envelopePoints: number; // K, per section
    firstSection: Uint32Array; // wisps + 1
    designedLength: Float32Array; // [m] per section s: of the segment s → s + 1 as designed; 0 at tips
    strands: Uint32Array; // per wisp: `strandDesc.count` is spread in proportion to these
    strandDesc: StrandDesc;
    seed: number;
}

/** A character or an obstacle: linear blend skinning of up to four bones. The first wears the hair. */
export interface BodyMesh {
    name: string;
    vertices: Float32Array; // [m] 3 per vertex, rest pose
    triangles: Uint32Array; // 3 per triangle, counter-clockwise seen from outside
    bones: Uint16Array; // 4 per vertex; empty: all follow bone 0
    weights: Float32Array; // 4 per vertex, sum 1
    headBone: number; // the bone that carries the hair
}

/** Where the bones of a body have taken its rest pose: p → rotation·p + position, in the world. */
export interface BonePoses {
    position: Float64Array; // [m] 3 per bone
    rotation: Float64Array; // unit quaternions x y z w, 4 per bone
}

/** The hair and the bodies at one time. Positions are relative to `origin`, which follows the head. */
export interface HairFrame {
    index: number;
    time: number; // [s]
    origin: Float64Array; // [m] 3
    position: Float32Array; // [m] 3 per section
    radius: Float32Array; // [m] K per section
    firstAxis: Float32Array; // 3 per wisp: unit first axis of its section 0
    bodies: BonePoses[]; // a body without bones stays in its rest pose
}

export const sectionCount = (hair: Hair): number => hair.firstSection[hair.wisps];

/** The wisp that owns a section. */
export function wispOfSection(hair: Hair, section: number): number {
    let low = 0,
        high = hair.wisps;
    while (low + 1 < high) {
        const middle = (low + high) >> 1;
        if (hair.firstSection[middle] <= section) low = middle;
        else high = middle;
    }
    return low;
}
