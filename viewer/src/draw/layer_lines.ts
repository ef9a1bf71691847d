import type { Hair } from "../hair/hair";
import type { LineList } from "./lines";

const kSkeletonWidth = 0.0022, // [m]
    kPointWidth = 0.0055,
    kRimWidth = 0.0009,
    kHalfLineWidth = 0.0005,
    kArc = 6; // pieces of the rim between two half lines

/** sRGB of a wisp, as wisp_colour.glsl has it in light. */
export function wispColour(wisp: number): [number, number, number] {
    const hue = 6 * ((wisp * 0.61803399) % 1);
    const channel = (at: number): number => {
        const d = Math.abs(hue - at);
        return (0.13 + 0.5 * Math.min(Math.max(2 - Math.min(d, 6 - d), 0), 1)) ** (1 / 2.2);
    };
    return [channel(0), channel(2), channel(4)];
}

const mixed = (a: readonly number[], b: readonly number[], t: number): number[] => a.map((x, i) => x + (b[i] - x) * t);

/** The skeletons: segments, and their points as dots; the segment inside the head is not drawn. */
export function addSkeletons(hair: Hair, sections: Float32Array, selected: number, lines: LineList): void {
    const record = 4 * (hair.envelopePoints + 1);
    for (let w = 0; w < hair.wisps; ++w) {
        const faded = selected >= 0 && w !== selected ? 0.75 : 0;
        const colour = [...mixed(wispColour(w), [0.3, 0.31, 0.33], faded), 1],
            point = [...mixed([0.95, 0.95, 0.93], [0.3, 0.31, 0.33], faded), 1];
        for (let s = hair.firstSection[w] + 1; s < hair.firstSection[w + 1]; ++s) {
            const here = sections.subarray(record * s, record * s + 3);
            lines.dot(here, kPointWidth, point);
            if (s + 1 < hair.firstSection[w + 1])
                lines.line(here, sections.subarray(record * (s + 1), record * (s + 1) + 3), kSkeletonWidth, kSkeletonWidth, colour);
        }
    }
}

/** The cross-sections from x₁ on: their rims, arcs of ellipses between neighbouring half lines, and the half lines. */
export function addCrossSections(hair: Hair, sections: Float32Array, selected: number, lines: LineList): void {
    const k = hair.envelopePoints,
        record = 4 * (k + 1),
        step = (2 * Math.PI) / k;
    const at = [0, 0, 0],
        before = [0, 0, 0];
    for (let w = 0; w < hair.wisps; ++w) {
        const faded = selected >= 0 && w !== selected ? 0.75 : 0;
        const colour = [...mixed(mixed(wispColour(w), [1, 1, 1], 0.35), [0.3, 0.31, 0.33], faded), 1];
        for (let s = hair.firstSection[w] + 1; s < hair.firstSection[w + 1]; ++s) {
            const centre = record * s;
            for (let line = 0; line < k; ++line) {
                const a = centre + 4 + 4 * line,
                    b = centre + 4 + 4 * ((line + 1) % k);
                for (let i = 0; i <= kArc; ++i) {
                    // α and β of the unit disc's rim at this angle past half line `line`.
                    const angle = (step * i) / kArc;
                    const beta = Math.sin(angle) / Math.sin(step),
                        alpha = Math.cos(angle) - beta * Math.cos(step);
                    for (let axis = 0; axis < 3; ++axis) {
                        before[axis] = at[axis];
                        at[axis] = sections[centre + axis] + alpha * sections[a + axis] + beta * sections[b + axis];
                    }
                    if (i === 0) lines.line(sections.subarray(centre, centre + 3), at, kHalfLineWidth, kHalfLineWidth, colour);
                    else lines.line(before, at, kRimWidth, kRimWidth, colour);
                }
            }
        }
    }
}
