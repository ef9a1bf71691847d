/** Numbers for people: 0.06 m is "6 cm", 5e-6 kg/m is "5 mg/m". Scene files take the same words. */

interface Shown {
    unit: string;
    factor: number; // of the field's unit in this one
}

const finer: Record<string, Shown[]> = {
    m: [
        { unit: "m", factor: 1 },
        { unit: "cm", factor: 100 },
        { unit: "mm", factor: 1000 },
        { unit: "µm", factor: 1e6 },
    ],
    "kg/m": [
        { unit: "kg/m", factor: 1 },
        { unit: "g/m", factor: 1000 },
        { unit: "mg/m", factor: 1e6 },
    ],
};

/** The unit in which a number of this size is read most easily. */
function shownUnit(x: number, unit: string): Shown {
    const units = finer[unit] ?? [{ unit, factor: 1 }];
    return units.find(({ factor }) => Math.abs(x) * factor >= 1) ?? (x === 0 ? units[0] : units.at(-1)!);
}

export function shown(x: number, unit: string): string {
    const { unit: name, factor } = shownUnit(x, unit);
    const digits = String(Number((x * factor).toPrecision(4)));
    return name === "" ? digits : `${digits} ${name}`;
}
