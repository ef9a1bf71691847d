// Strands as `mane extract` writes them: Cem Yuksel's HAIR files.
import { readFileSync } from "node:fs";

/** Per strand its points [m], three numbers each, in the world. */
export function readHair(file) {
    const bytes = readFileSync(file);
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const strands = view.getUint32(4, true),
        arrays = view.getUint32(12, true),
        defaultSegments = view.getUint32(16, true);
    let at = 128;
    const segments = Array.from({ length: strands }, (_, i) => (arrays & 1 ? view.getUint16(at + 2 * i, true) : defaultSegments));
    if (arrays & 1) at += 2 * strands;
    return segments.map((n) => {
        const points = Array.from({ length: 3 * (n + 1) }, (_, i) => view.getFloat32(at + 4 * i, true));
        at += 12 * (n + 1);
        return points;
    });
}
