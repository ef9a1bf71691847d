import { element } from "./dom";

export interface Curve {
    name: string;
    values: Float32Array; // one per frame
    colour: string;
}

export interface PlotOptions {
    title: string;
    tip: string;
    unit: string;
    curves: Curve[];
    stacked?: boolean; // areas, one on the other
    format: (value: number) => string; // without the unit
    seek: (frame: number) => void;
    missing?: string; // what to say when there is nothing to draw
}

/** Numbers over the frames of a run, under a timeline: a click or a drag jumps there. */
export class Plot {
    readonly root: HTMLElement;
    private readonly canvas = element("canvas");
    private readonly legend = element("div", { class: "legend" });
    private readonly cursor = element("div", { class: "cursor" });
    private readonly frames: number;
    private readonly top: number;
    private readonly stack: Float32Array[] = [];
    private drawn = "";

    constructor(private readonly o: PlotOptions) {
        this.frames = o.curves[0]?.values.length ?? 0;
        for (const curve of o.curves) {
            const below = o.stacked ? this.stack.at(-1) : undefined;
            this.stack.push(below ? curve.values.map((v, i) => v + below[i]) : curve.values);
        }
        this.top = this.stack.reduce((most, values) => values.reduce((a, b) => Math.max(a, b), most), 0) || 1;
        const area = element("div", { class: "area" }, this.canvas, this.cursor);
        if (this.frames === 0) area.replaceChildren(element("p", { class: "missing" }, o.missing ?? ""));
        this.root = element("div", { class: "plot", title: o.tip, "data-plot": o.title },
            element("div", { class: "label" }, element("span", {}, o.title), this.legend), area);
        const seek = (e: PointerEvent) => {
            if (e.buttons & 1) o.seek(this.frameAt(e.clientX));
        };
        if (this.frames > 0) {
            area.addEventListener("pointerdown", (e) => {
                area.setPointerCapture(e.pointerId);
                seek(e);
            });
            area.addEventListener("pointermove", seek);
        }
    }

    private frameAt(x: number): number {
        const box = this.canvas.getBoundingClientRect();
        const share = Math.min(Math.max((x - box.left) / box.width, 0), 1);
        return Math.round(share * (this.frames - 1));
    }

    /** Shows the values at a frame, and the cursor there. */
    show(frame: number): void {
        if (this.frames === 0) return;
        this.draw();
        this.cursor.style.left = `${(100 * frame) / Math.max(this.frames - 1, 1)}%`;
        this.legend.replaceChildren(
            ...this.o.curves.map((c) => {
                const value = element("b", {}, `${this.o.format(c.values[frame])} ${this.o.unit}`);
                if (this.o.curves.length === 1) return value;
                const name = element("i", {}, c.name);
                name.style.setProperty("--colour", c.colour);
                return element("span", {}, name, value);
            }),
        );
    }

    private draw(): void {
        const scale = window.devicePixelRatio,
            width = Math.round(this.canvas.clientWidth * scale),
            height = Math.round(this.canvas.clientHeight * scale);
        if (this.drawn === `${width} ${height}` || width === 0) return;
        this.drawn = `${width} ${height}`;
        Object.assign(this.canvas, { width, height });
        const context = this.canvas.getContext("2d")!;
        const x = (i: number) => (i / Math.max(this.frames - 1, 1)) * width,
            y = (v: number) => height - scale - (v / this.top) * (height - 3 * scale);
        // From the topmost down, so that stacked areas lie before those above them.
        for (let c = this.stack.length - 1; c >= 0; --c) {
            const values = this.stack[c];
            context.beginPath();
            for (let i = 0; i < values.length; ++i) context.lineTo(x(i), y(values[i]));
            context.strokeStyle = context.fillStyle = this.o.curves[c].colour;
            if (this.o.stacked || this.stack.length === 1) {
                context.lineTo(width, height);
                context.lineTo(0, height);
                context.globalAlpha = this.o.stacked ? 1 : 0.18;
                context.fill();
                context.globalAlpha = 1;
            }
            if (this.o.stacked) continue;
            context.lineWidth = 1.2 * scale;
            context.beginPath();
            for (let i = 0; i < values.length; ++i) context.lineTo(x(i), y(values[i]));
            context.stroke();
        }
    }
}
