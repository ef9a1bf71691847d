import type { Hair } from "./hair";
import { Random } from "./random";

/** Strand k of the hair is strand `inWisp` of wisp `wisp`, as `StrandLayout` of src/strands counts them. */
export interface StrandLayout {
    count: number;
    firstStrand: Uint32Array; // wisps + 1
}

/** Spreads `count` strands over the wisps in proportion to `hair.strands`. */
export function layOutStrands(hair: Hair, count: number): StrandLayout {
    const total = hair.strands.reduce((sum, n) => sum + n, 0);
    const firstStrand = new Uint32Array(hair.wisps + 1);
    let before = 0;
    for (let w = 0; w < hair.wisps; ++w) {
        before += hair.strands[w];
        firstStrand[w + 1] = total > 0 ? Math.floor((before * count) / total) : 0;
    }
    return { count: firstStrand[hair.wisps], firstStrand };
}

/**
 * The order in which strands are drawn: every run of neighbours in it is spread over all wisps in proportion, so that any part
 * of the strands stands for the whole.
 */
export function drawingOrder(layout: StrandLayout): Uint32Array {
    // One number sorts and names a strand: its turn in its wisp, in steps of 2⁻²⁴, then itself.
    const keys = new Float64Array(layout.count);
    const wisps = layout.firstStrand.length - 1;
    for (let w = 0; w < wisps; ++w) {
        const first = layout.firstStrand[w],
            end = layout.firstStrand[w + 1],
            start = new Random(0, w).unit(0);
        for (let s = first; s < end; ++s) {
            const turn = (s - first + start) / (end - first);
            keys[s] = Math.floor(turn * 2 ** 24) * 2 ** 28 + s;
        }
    }
    keys.sort();
    return Uint32Array.from(keys, (key) => key % 2 ** 28);
}
