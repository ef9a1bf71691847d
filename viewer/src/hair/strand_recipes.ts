import type { Hair, StrandDesc, StrandDistribution } from "./hair";
import { Random } from "./random";
import type { StrandLayout } from "./strand_layout";
import { wavesAmplitude } from "./strand_waves";

/**
 * What is random about strands and no frame changes, as src/strands/recipe.cpp makes it: the same numbers in the same order, so
 * that strand k of a page is strand k of the C++ code.
 */
export interface StrandRecipes {
    wisp: Uint32Array; // per slot
    strand: Uint32Array; // per slot: the strand's number
    place: Float32Array; // 4 per slot: disc x, y; p where it ends; its own part of the waves' phase [rad]
    firstShare: Uint32Array; // per slot: its first record in `shares`
    shares: Uint16Array; // 4 per piece: jitter's random numbers of the piece's four control points, in 1/65535
}

/** The order in which a strand takes its random numbers. */
const kPlace = 0,
    kPlaceAngle = 1,
    kLength = 2,
    kPhase = 3,
    kFirstJitter = 4;
const kPhaseSpread = 0.8; // [rad]
const kGaussianSpread = 0.4;
const kRimInner = 0.8;

/** The inverse of each distribution's share of the disc within a radius (M16). */
function radiusOf(distribution: StrandDistribution, share: number): number {
    switch (distribution) {
        case "gaussian": {
            const variance = kGaussianSpread ** 2;
            return Math.sqrt(-2 * variance * Math.log(1 - share * (1 - Math.exp(-0.5 / variance))));
        }
        case "rim":
            return Math.sqrt(kRimInner ** 2 + share * (1 - kRimInner ** 2));
        case "uniform":
            return Math.sqrt(share);
    }
}

/** [m] Designed length of every section from x₁ on, in floats as the C++ code adds them. */
function designedArc(hair: Hair): Float32Array {
    const arc = new Float32Array(hair.designedLength.length);
    for (let w = 0; w < hair.wisps; ++w)
        for (let s = hair.firstSection[w] + 2; s < hair.firstSection[w + 1]; ++s)
            arc[s] = arc[s - 1] + hair.designedLength[s - 1];
    return arc;
}

/** p where a strand ends that has the given share of the designed length from x₁ on. */
function designedEnd(arc: Float32Array, first: number, behind: number, share: number): number {
    const length = Math.fround(arc[behind - 1] * share);
    let next = first + 2;
    while (next < behind - 1 && arc[next] < length) ++next;
    const segment = Math.fround(arc[next] - arc[next - 1]);
    const t = segment > 0 ? Math.fround(Math.fround(length - arc[next - 1]) / segment) : 1;
    return next - 1 - first + Math.min(Math.max(t, 0), 1);
}

/** The recipes of all strands, slot after slot in the order given. */
export function makeRecipes(hair: Hair, desc: StrandDesc, layout: StrandLayout, order: Uint32Array): StrandRecipes {
    const slots = order.length;
    const wispOf = new Uint32Array(layout.count);
    for (let w = 0; w < hair.wisps; ++w) wispOf.fill(w, layout.firstStrand[w], layout.firstStrand[w + 1]);

    const recipes: StrandRecipes = {
        wisp: new Uint32Array(slots),
        strand: order,
        place: new Float32Array(4 * slots),
        firstShare: new Uint32Array(slots + 1),
        shares: new Uint16Array(0),
    };
    for (let slot = 0; slot < slots; ++slot) {
        const w = wispOf[order[slot]];
        recipes.wisp[slot] = w;
        const pieces = hair.firstSection[w + 1] - hair.firstSection[w] - 1;
        recipes.firstShare[slot + 1] = recipes.firstShare[slot] + pieces;
    }
    recipes.shares = new Uint16Array(4 * recipes.firstShare[slots]);

    const arc = designedArc(hair);
    // M17: the disc leaves room for all that moves a strand outward.
    const discRadius = (1 - wavesAmplitude(desc)) / (1 + desc.jitter / 8);
    const jitter = new Uint16Array(4096);
    for (let slot = 0; slot < slots; ++slot) {
        const w = recipes.wisp[slot];
        const first = hair.firstSection[w],
            behind = hair.firstSection[w + 1];
        const random = new Random(hair.seed, w, order[slot] - layout.firstStrand[w] + 1); // 0 is the wisp's own
        const radius = radiusOf(desc.distribution, random.unit(kPlace)),
            angle = 2 * Math.PI * random.unit(kPlaceAngle);
        const share = Math.fround(1 - desc.lengthJitter * random.unit(kLength));
        recipes.place[4 * slot] = Math.fround(radius * Math.cos(angle)) * discRadius;
        recipes.place[4 * slot + 1] = Math.fround(radius * Math.sin(angle)) * discRadius;
        recipes.place[4 * slot + 2] = designedEnd(arc, first, behind, share);
        recipes.place[4 * slot + 3] = random.between(kPhase, -kPhaseSpread, kPhaseSpread);

        const last = behind - first - 1;
        for (let i = 0; i <= last; ++i) jitter[i] = Math.round(65535 * random.unit(kFirstJitter + i));
        let at = 4 * recipes.firstShare[slot];
        for (let i = 0; i < last; ++i) {
            recipes.shares[at++] = jitter[Math.max(i - 1, 0)];
            recipes.shares[at++] = jitter[i];
            recipes.shares[at++] = jitter[i + 1];
            recipes.shares[at++] = jitter[Math.min(i + 2, last)];
        }
    }
    return recipes;
}
