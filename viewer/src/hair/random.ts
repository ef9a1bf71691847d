/**
 * The counter-based random numbers of src/base/random.h: the n-th number of (seed, wisp, strand) depends on these alone. All
 * arithmetic is on two 32-bit halves: BigInt gives the same numbers a hundred times slower, and 100,000 strands take over a
 * million of them.
 */

// The 64-bit number that the functions below work on.
let high = 0,
    low = 0;

function highProduct(a: number, b: number): number {
    const a0 = a & 0xffff,
        a1 = a >>> 16,
        b0 = b & 0xffff,
        b1 = b >>> 16;
    const middle = a1 * b0 + ((a0 * b0) >>> 16);
    const other = a0 * b1 + (middle & 0xffff);
    return a1 * b1 + (middle >>> 16) + (other >>> 16);
}

function multiply(byHigh: number, byLow: number): void {
    high = (highProduct(low, byLow) + Math.imul(high, byLow) + Math.imul(low, byHigh)) >>> 0;
    low = Math.imul(low, byLow) >>> 0;
}

function xorShifted(by: number): void {
    const shifted = ((low >>> by) | (high << (32 - by))) >>> 0;
    low = (low ^ shifted) >>> 0;
    high = (high ^ (high >>> by)) >>> 0;
}

/** SplitMix64's finaliser, `mix` of src/base/hash.h. */
function mix(): void {
    const sum = low + 0x7f4a7c15;
    high = (high + 0x9e3779b9 + (sum > 0xffffffff ? 1 : 0)) >>> 0;
    low = sum >>> 0;
    xorShifted(30);
    multiply(0xbf58476d, 0x1ce4e5b9);
    xorShifted(27);
    multiply(0x94d049bb, 0x133111eb);
    xorShifted(31);
}

export class Random {
    private readonly keyHigh: number;
    private readonly keyLow: number;

    constructor(seed: number, wisp: number, strand = 0) {
        high = 0;
        low = seed >>> 0;
        mix();
        low = (low ^ wisp) >>> 0;
        mix();
        low = (low ^ strand) >>> 0;
        mix();
        this.keyHigh = high;
        this.keyLow = low;
    }

    /** The n-th number, uniform in [0, 1), with 24 bits. */
    unit(n: number): number {
        high = 0;
        low = n >>> 0;
        multiply(0xd1342543, 0xde82ef95);
        high = (high ^ this.keyHigh) >>> 0;
        low = (low ^ this.keyLow) >>> 0;
        mix();
        return (high >>> 8) * 2 ** -24;
    }

    /** The n-th number, uniform in [from, to). */
    between(n: number, from: number, to: number): number {
        return from + (to - from) * this.unit(n);
    }
}
