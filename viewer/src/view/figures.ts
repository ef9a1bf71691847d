import { Plot, type Curve } from "../ui/plot";
import { kContactKinds, type ContactKind } from "./contacts";
import type { Run } from "./run";

/** By kind of contact. */
export const kContactColours = ["#6fb3d2", "#e2725b", "#9bc27e", "#d07fd6"] as const;
const kLegend = ["friction", "collision", "sliding", "penetration"];
const kStages: [name: string, colour: string][] = [
    ["forces", "#e0a458"],
    ["wisp detection", "#6fb3d2"],
    ["character detection", "#9bc27e"],
    ["velocities", "#e2725b"],
    ["positions", "#a58fd0"],
];

/** A colour #rrggbb as numbers 0 … 1. */
export const channels = (colour: string): [number, number, number] =>
    [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16) / 255) as [number, number, number];

/** The plots under the timeline: what the whole head does over the run. */
export function headPlots(run: Run, seek: (frame: number) => void): Plot[] {
    const series = (name: string) => run.head.find((s) => s.name === name);
    const scaled = (name: string, factor: number, colour: string, label = ""): Curve[] => {
        const found = series(name);
        return found ? [{ name: label, values: found.values.map((v) => v * factor), colour }] : [];
    };
    const record = "Simulate with `mane simulate SCENE.toml -o FILE.mane --record` and write the page again.";
    const contacts: Curve[] = run.contacts
        ? kContactKinds.map((_, kind) => ({ name: kLegend[kind], values: run.contacts!.counts(kind as ContactKind), colour: kContactColours[kind] }))
        : [];
    return [
        new Plot({
            title: "kinetic energy", tip: "of all skeletons and envelopes", unit: "mJ", seek,
            curves: scaled("kinetic energy", 1000, "#e0a458"), format: (v) => v.toPrecision(3),
        }),
        new Plot({
            title: "contacts", tip: "engaged at the end of the frame, by kind; penetration reactions during it", unit: "", seek,
            curves: contacts, format: (v) => String(v), missing: `Contacts were not recorded. ${record}`,
        }),
        new Plot({
            title: "volume", tip: "of all envelopes, from x₁ on", unit: "l", seek,
            curves: scaled("volume", 1000, "#9bc27e"), format: (v) => v.toFixed(3),
        }),
        new Plot({
            title: "deepest penetration", tip: "of a skeleton or envelope point in a body", unit: "mm", seek,
            curves: scaled("penetration", 1000, "#d07fd6"), format: (v) => v.toFixed(2),
        }),
        new Plot({
            title: "time per stage", tip: "of the frame, as it was simulated", unit: "ms", seek, stacked: true,
            curves: kStages.flatMap(([name, colour]) => scaled(name, 1000, colour, name)), format: (v) => v.toFixed(1),
            missing: `Times were not recorded. ${record}`,
        }),
    ];
}
