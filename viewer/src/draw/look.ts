import type { Vec3 } from "./matrix";

/** What is drawn, and how. */
export interface Look {
    layers: { strands: boolean; skeleton: boolean; sections: boolean; envelope: boolean; character: boolean };
    strands: number; // on the whole head
    width: number; // [1] of a strand, relative to its own
    colour: Vec3; // linear: light that is left after passing a strand
    colourByWisp: boolean;
    selectedWisp: number; // −1: none
}

export const kDefaultLook: Look = {
    layers: { strands: true, skeleton: false, sections: false, envelope: false, character: true },
    strands: 100_000,
    width: 1,
    colour: [0.36, 0.17, 0.075],
    colourByWisp: false,
    selectedWisp: -1,
};
