/** The table of fields, as C++ tells it (a JSON schema of scene files): what there is to set, in which unit and range, and what it does. */

export type FieldKind = "switch" | "choice" | "number" | "whole" | "ramp" | "vector" | "text";

export interface Field {
    key: string; // section.name
    section: string;
    name: string;
    kind: FieldKind;
    help: string;
    unit: string; // empty: none
    low: number; // of each number
    high: number;
    choices: string[];
    standard: unknown; // the default: boolean, number, numbers, text
    live: boolean; // may change while the hair moves; others begin it anew
}

interface Schema {
    type?: string;
    description?: string;
    default?: unknown;
    enum?: string[];
    minimum?: number;
    maximum?: number;
    anyOf?: Schema[];
    items?: Schema;
    minItems?: number;
    properties?: Record<string, Schema>;
    "x-live"?: boolean;
}

/** All fields of a scene but its lists (obstacles, overrides), in the table's order. */
export function fieldsOf(schema: unknown): Field[] {
    const fields: Field[] = [];
    for (const [section, { type, properties = {} }] of Object.entries((schema as Schema).properties ?? {}))
        if (type === "object") for (const [name, field] of Object.entries(properties)) fields.push(fieldOf(section, name, field));
    return fields;
}

function fieldOf(section: string, name: string, schema: Schema): Field {
    const [, unit = "", help = ""] = /^(?:\[(.*?)\] )?(.*)$/s.exec(schema.description ?? "")!;
    const number = numberSchema(schema);
    return {
        key: `${section}.${name}`,
        section,
        name,
        kind: kindOf(schema),
        help,
        unit: unit === "1" ? "" : unit,
        low: number.minimum ?? -Infinity,
        high: number.maximum ?? Infinity,
        choices: schema.enum ?? [],
        standard: schema.default,
        live: schema["x-live"] ?? false,
    };
}

function kindOf(schema: Schema): FieldKind {
    if (schema.type === "boolean") return "switch";
    if (schema.type === "integer") return "whole";
    if (schema.type === "array") return "vector";
    if (schema.type === "string") return schema.enum ? "choice" : "text";
    return schema.anyOf?.some((one) => one.type === "array") ? "ramp" : "number";
}

/** The part that has the range: of a list, its numbers'. */
function numberSchema(schema: Schema): Schema {
    const inner = schema.items ?? schema;
    return inner.anyOf?.find((one) => one.type === "number") ?? inner;
}

/** Numbers of a value, whatever its kind. */
export const numbersOf = (value: unknown): number[] => (Array.isArray(value) ? value : [value]) as number[];

/** A value as a scene file writes it. TOML tells reals from whole numbers; fields of reals take both. */
export const toToml = (value: unknown): string => JSON.stringify(value);
/** A value of a scene file: those of fields are JSON too. */
export const fromToml = (text: string): unknown => JSON.parse(text);
