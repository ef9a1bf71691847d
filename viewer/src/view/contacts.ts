import type { Hair, HairFrame } from "../hair/hair";
import { wispOfSection } from "../hair/hair";
import type { Vec3 } from "../draw/matrix";
import type { PageData } from "./page_data";

/** As `ContactKind` of mane/contact.h. */
export const kContactKinds = ["friction", "collision", "sliding contact", "penetration reaction"] as const;
export type ContactKind = 0 | 1 | 2 | 3;
const kPenetration = 3;
const kBetween = 255; // a point that is no section's own

/** One thing that moved a wisp, in the last step of a frame; penetration reactions over the whole frame. */
export interface Contact {
    kind: ContactKind;
    section: number;
    point: number; // 0: the skeleton point, 1 + k: envelope point k, 255: between this section and the next
    along: number;
    other: number; // first section of the other wisp's segment, or the body's triangle
    otherAlong: number;
    body: number;
    strength: number; // [N·s]; of a penetration reaction [m]
    direction: Vec3; // of the impulse, or of the shift, on the point
}

export const isWithBody = (contact: Contact): boolean => contact.kind >= 2;
export const isPenetration = (contact: Contact): boolean => contact.kind === kPenetration;

export class RunContacts {
    private readonly first: Uint32Array; // per frame
    private readonly columns: Record<string, Uint32Array> = {};
    private readonly section: Uint32Array;
    private readonly stepsPerOctave: number;
    private readonly weakestOctave: number;

    constructor(data: PageData, frames: number) {
        const count = data.planes("contact.count");
        this.first = new Uint32Array(frames + 1);
        for (let i = 0; i < frames; ++i) this.first[i + 1] = this.first[i] + count[i];
        for (const name of ["kind", "point", "along", "other", "other_along", "body", "strength", "direction_x", "direction_y"])
            this.columns[name] = data.planes(`contact.${name}`);
        // Sections are stored as differences from contact to contact of a frame, modulo 2³².
        this.section = data.planes("contact.section");
        for (let i = 0; i < frames; ++i)
            for (let c = this.first[i] + 1; c < this.first[i + 1]; ++c) this.section[c] += this.section[c - 1];
        this.stepsPerOctave = data.header.contacts.strength_steps_per_octave;
        this.weakestOctave = data.header.contacts.weakest_octave;
    }

    /** How many of a kind each frame has. */
    counts(kind: ContactKind): Float32Array {
        const kinds = this.columns.kind;
        return Float32Array.from({ length: this.first.length - 1 }, (_, frame) => {
            let n = 0;
            for (let c = this.first[frame]; c < this.first[frame + 1]; ++c) if (kinds[c] === kind) ++n;
            return n;
        });
    }

    /** Those of a wisp in a frame, the strongest first: where it is the point's, and where it is the other. */
    ofWisp(frame: number, hair: Hair, wisp: number): Contact[] {
        const first = hair.firstSection[wisp],
            end = hair.firstSection[wisp + 1];
        const within = (s: number) => s >= first && s < end;
        const list: Contact[] = [];
        for (let c = this.first[frame]; c < this.first[frame + 1]; ++c) {
            const withWisp = this.columns.kind[c] < 2;
            if (within(this.section[c]) || (withWisp && within(this.columns.other[c]))) list.push(this.contact(c));
        }
        const rank = (contact: Contact) => (isPenetration(contact) ? 1e6 * contact.strength : contact.strength);
        return list.sort((a, b) => rank(b) - rank(a));
    }

    private contact(c: number): Contact {
        const { kind, point, along, other, other_along, body, strength, direction_x, direction_y } = this.columns;
        const octave = strength[c] / this.stepsPerOctave + this.weakestOctave;
        return {
            kind: kind[c] as ContactKind,
            section: this.section[c],
            point: point[c],
            along: along[c] / 255,
            other: other[c],
            otherAlong: other_along[c] / 255,
            body: body[c],
            strength: strength[c] === 0 ? 0 : 2 ** octave,
            direction: fromOctahedron(direction_x[c] / 127 - 1, direction_y[c] / 127 - 1),
        };
    }
}

/** A point of the octahedron's unfolded surface as a unit vector. */
function fromOctahedron(x: number, y: number): Vec3 {
    const z = 1 - Math.abs(x) - Math.abs(y);
    if (z < 0) [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
    const l = Math.hypot(x, y, z) || 1;
    return [x / l, y / l, z / l];
}

/** Where a contact is: [m] relative to the frame's origin. `records`: `Sections.values`. */
export function contactPoint(hair: Hair, frame: HairFrame, records: Float32Array, contact: Contact): Vec3 {
    const centre = (s: number): Vec3 => [frame.position[3 * s], frame.position[3 * s + 1], frame.position[3 * s + 2]];
    const at = centre(contact.section);
    if (contact.point === 0) return at;
    if (contact.point === kBetween) {
        const next = centre(contact.section + 1);
        return at.map((x, i) => x + (next[i] - x) * contact.along) as Vec3;
    }
    const record = 4 * ((hair.envelopePoints + 1) * contact.section + contact.point);
    return at.map((x, i) => x + records[record + i]) as Vec3;
}

/** The wisp on the other side of a contact between wisps, seen from `wisp`. */
export function otherWisp(hair: Hair, contact: Contact, wisp: number): number {
    const own = wispOfSection(hair, contact.section),
        other = wispOfSection(hair, contact.other);
    return own === wisp ? other : own;
}
