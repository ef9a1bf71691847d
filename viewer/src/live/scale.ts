/**
 * From a slider's way, 0 to 1, to a field's numbers and back. Fields take far more than anyone wants to slide through (friction: 0 to
 * 10,000), so a slider spans what is near its default, by the field's kind of range; a number outside is typed.
 */
import { numbersOf, type Field } from "./fields";

export interface Scale {
    low: number;
    high: number;
    toNumber(way: number): number;
    toWay(number: number): number;
}

const clamp = (x: number): number => Math.min(1, Math.max(0, x));

function linear(low: number, high: number): Scale {
    return { low, high, toNumber: (way) => low + way * (high - low), toWay: (x) => clamp((x - low) / (high - low)) };
}

/** Equal ways are equal factors. */
function logarithmic(low: number, high: number): Scale {
    const range = Math.log(high / low);
    return { low, high, toNumber: (way) => low * Math.exp(way * range), toWay: (x) => clamp(Math.log(Math.max(x, low) / low) / range) };
}

/** From 0, finer at its beginning. */
function quadratic(high: number): Scale {
    return { low: 0, high, toNumber: (way) => high * way * way, toWay: (x) => clamp(Math.sqrt(Math.max(x, 0) / high)) };
}

export function scaleOf(field: Field): Scale {
    const { low, high } = field;
    const usual = Math.max(...numbersOf(field.standard).map(Math.abs));
    if (low < 0) {
        const span = Math.min(high, usual > 0 ? 3 * usual : usualSpan[field.unit] ?? 10);
        return linear(Math.max(low, -span), span);
    }
    if (low > 0 && usual > 0 && high >= 50 * low) return logarithmic(Math.max(low, usual / 50), Math.min(high, usual * 50));
    if (usual > 0 && high > 8 * usual) return quadratic(Math.min(high, 10 * usual));
    return Number.isFinite(high) && (usual > 0 || high <= 1) ? linear(low, high) : quadratic(Math.min(high, usualSpan[field.unit] ?? 10));
}

/** How far a slider goes whose default is 0. */
const usualSpan: Record<string, number> = { "m/s": 10, m: 0.2, s: 10, deg: 45, Hz: 100, "1": 10 };

/** Rounded to what a slider can say: three digits. */
export function rounded(x: number, whole: boolean): number {
    return whole ? Math.round(x) : Number(x.toPrecision(3));
}
