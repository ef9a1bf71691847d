import type { Look } from "../draw/look";
import type { Vec3 } from "../draw/matrix";
import { element } from "./dom";
import { section, slider, toggle, type Control } from "./controls";

/** Natural colours, as light that is left after passing a strand. */
const kColours: [name: string, colour: Vec3][] = [
    ["black", [0.06, 0.045, 0.04]],
    ["brown", [0.2, 0.1, 0.055]],
    ["chestnut", [0.36, 0.17, 0.075]],
    ["red", [0.55, 0.16, 0.05]],
    ["blond", [0.72, 0.5, 0.25]],
    ["grey", [0.62, 0.6, 0.58]],
];

type Layer = keyof Look["layers"];
export const kLayers: [layer: Layer, label: string, tip: string, key: string][] = [
    ["skeleton", "Skeleton", "layer 1: the chains of point-masses that carry the motion", "1"],
    ["sections", "Cross-sections", "layer 2: the envelope at each skeleton point, with its half lines", "2"],
    ["envelope", "Envelope", "layer 2: the deformable surface around each skeleton", "3"],
    ["strands", "Strands", "layer 3: the hairs, drawn inside the envelopes", "4"],
    ["character", "Character", "the body that wears the hair", "5"],
];

const encoded = (x: number): number => Math.round(255 * Math.min(Math.max(x, 0), 1) ** (1 / 2.2));
export const toHex = (c: Vec3): string => `#${c.map((x) => encoded(x).toString(16).padStart(2, "0")).join("")}`;
const fromHex = (text: string): Vec3 => [1, 3, 5].map((i) => (parseInt(text.slice(i, i + 2), 16) / 255) ** 2.2) as Vec3;

/** Layers, and the strands' count, width and colour: the look of the hair, for any page that draws it. */
export class HairPanel {
    readonly root: HTMLElement;
    private readonly layers: Record<Layer, Control<boolean>>;
    private readonly strands: Control<number>;
    private readonly width: Control<number>;
    private readonly byWisp: Control<boolean>;
    private readonly swatches: HTMLButtonElement[];
    private readonly picker: HTMLInputElement;

    constructor(
        private look: Look,
        private readonly changed: (look: Look) => void,
    ) {
        this.layers = Object.fromEntries(
            kLayers.map(([layer, label, tip, key]) => [
                layer,
                toggle(label, tip, look.layers[layer], (on) => this.apply({ layers: { ...this.look.layers, [layer]: on } }), key),
            ]),
        ) as Record<Layer, Control<boolean>>;
        this.swatches = kColours.map(([name, colour]) => {
            const swatch = element("button", { type: "button", class: "button swatch", title: name, "aria-label": name, onclick: () => this.setColour(colour) });
            swatch.style.setProperty("--colour", toHex(colour));
            return swatch;
        });
        this.picker = element("input", { type: "color", title: "any other colour", "aria-label": "hair colour" });
        this.picker.addEventListener("input", () => this.setColour(fromHex(this.picker.value)));
        this.byWisp = toggle("By wisp", "each wisp in a colour of its own", look.colourByWisp, (on) => this.apply({ colourByWisp: on }));
        this.strands = slider({
            label: "Strands", tip: "strands on the whole head", from: 1000, to: 200_000, logarithmic: true, value: look.strands,
            format: (v) => rounded(v).toLocaleString("en"), change: (v) => this.apply({ strands: rounded(v) }),
        });
        this.width = slider({
            label: "Width", tip: "of a strand, relative to what the scene says", from: 0.25, to: 4, logarithmic: true, value: look.width,
            format: (v) => `× ${v.toFixed(2)}`, change: (v) => this.apply({ width: v }),
        });
        this.root = element("div", {},
            section("Layers", element("div", { class: "row" }, ...kLayers.map(([layer]) => this.layers[layer].root))),
            section("Hair",
                this.strands.root,
                this.width.root,
                element("div", { class: "row" }, ...this.swatches, this.picker, this.byWisp.root),
            ),
        );
        this.showColour();
    }

    toggleLayer(layer: Layer): void {
        this.set({ layers: { ...this.look.layers, [layer]: !this.look.layers[layer] } });
    }

    /** A change that comes from elsewhere: the controls show it. */
    set(change: Partial<Look>): void {
        this.apply(change);
        for (const [layer] of kLayers) this.layers[layer].set(this.look.layers[layer]);
        this.strands.set(this.look.strands);
        this.width.set(this.look.width);
        this.byWisp.set(this.look.colourByWisp);
        this.showColour();
    }

    private apply(change: Partial<Look>): void {
        this.look = { ...this.look, ...change };
        this.changed(this.look);
    }

    private setColour(colour: Vec3): void {
        this.apply({ colour });
        this.showColour();
    }

    private showColour(): void {
        this.picker.value = toHex(this.look.colour);
        this.swatches.forEach((s, i) => s.setAttribute("aria-pressed", String(kColours[i][1].join() === this.look.colour.join())));
    }
}

/** To two digits, as a person would say it. */
function rounded(count: number): number {
    const unit = 10 ** (Math.floor(Math.log10(count)) - 1);
    return Math.round(count / unit) * unit;
}
