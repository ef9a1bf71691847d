/**
 * The data of a page, as src/formats/page_payload.cpp packs it: named arrays behind a directory in JSON, deflated and written as
 * base64 into the page. Whatever is wrong with it is thrown as a `DamagedPage` that a person can read.
 */

export class DamagedPage extends Error {}

const kMagic = "MANEPAGE",
    kVersion = 1;

interface Entry {
    name: string;
    type: "u8" | "u16" | "u32" | "f32" | "f64" | "planes" | "steps";
    count: number;
    offset: number;
    planes?: number;
    row?: number;
    quantum?: number;
}

/** Multiples of a quantum in rows, one per frame. */
export interface Steps {
    values: Int32Array;
    row: number;
    quantum: number;
}

const kNumbers = { u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };

export class PageData {
    readonly header: Record<string, any>;
    private readonly entries = new Map<string, Entry>();
    private readonly arrays: Uint8Array;

    constructor(bytes: Uint8Array) {
        const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
        if (bytes.length < 16 || new TextDecoder().decode(bytes.subarray(0, 8)) !== kMagic)
            throw new DamagedPage("what is in this page is no run of mane");
        const version = view.getUint32(8, true),
            size = view.getUint32(12, true);
        if (version !== kVersion)
            throw new DamagedPage(`this page's run has version ${version}, its script reads version ${kVersion}`);
        try {
            this.header = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes.subarray(16, 16 + size)));
        } catch {
            throw new DamagedPage("the directory of this page's run is damaged");
        }
        this.arrays = bytes.subarray(Math.ceil((16 + size) / 8) * 8);
        for (const entry of this.header.arrays as Entry[]) this.entries.set(entry.name, entry);
    }

    has(name: string): boolean {
        return this.entries.has(name);
    }

    /** Plain numbers. */
    numbers<T extends keyof typeof kNumbers>(name: string, type: T): InstanceType<(typeof kNumbers)[T]> {
        const entry = this.entry(name, type);
        const bytes = this.bytes(entry, entry.count * kNumbers[type].BYTES_PER_ELEMENT);
        // A copy, which begins where typed arrays may.
        return new kNumbers[type](bytes.slice().buffer) as InstanceType<(typeof kNumbers)[T]>;
    }

    planes(name: string): Uint32Array {
        return this.joined(this.entry(name, "planes"));
    }

    /** Undoes second differences from row to row, modulo 2³². */
    steps(name: string): Steps {
        const entry = this.entry(name, "steps");
        const coded = this.joined(entry),
            row = entry.row!;
        const values = new Int32Array(entry.count);
        for (let i = 0; i < values.length; ++i) {
            const difference = (coded[i] >>> 1) ^ -(coded[i] & 1);
            const before = i < row ? 0 : values[i - row],
                beforeThat = i < 2 * row ? 0 : values[i - 2 * row];
            values[i] = difference + 2 * before - beforeThat;
        }
        return { values, row, quantum: entry.quantum! };
    }

    private entry(name: string, type: Entry["type"]): Entry {
        const entry = this.entries.get(name);
        if (entry?.type !== type) throw new DamagedPage(`this page's run has no array "${name}" of ${type}`);
        return entry;
    }

    private bytes(entry: Entry, size: number): Uint8Array {
        if (!(entry.offset >= 0 && size >= 0 && entry.offset + size <= this.arrays.length))
            throw new DamagedPage(`the array "${entry.name}" of this page's run is cut short`);
        return this.arrays.subarray(entry.offset, entry.offset + size);
    }

    private joined(entry: Entry): Uint32Array {
        const values = new Uint32Array(entry.count),
            planes = entry.planes!;
        const bytes = this.bytes(entry, planes * entry.count);
        for (let plane = 0; plane < planes; ++plane)
            for (let i = 0; i < values.length; ++i) values[i] |= bytes[plane * entry.count + i] << (8 * plane);
        return values;
    }
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
    let binary: string;
    try {
        binary = atob(text);
    } catch {
        throw new DamagedPage("the run in this page is damaged: it holds characters that do not belong there");
    }
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
}

async function unpack(text: string): Promise<PageData> {
    const packed = fromBase64(text);
    let bytes: ArrayBuffer;
    try {
        const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
        bytes = await new Response(stream).arrayBuffer();
    } catch {
        throw new DamagedPage("the run in this page is damaged or was not copied whole: write the page again with `mane view`");
    }
    return new PageData(new Uint8Array(bytes));
}

/** The data that is embedded in this page. */
export async function readPageData(): Promise<PageData> {
    const script = document.getElementById("run");
    if (!script) throw new DamagedPage("this page holds no run; `mane view FILE.mane -o page.html` writes one that does");
    const text = script.textContent ?? "";
    script.remove(); // megabytes that nobody needs any more
    return unpack(text);
}

/** The data of another page that `mane view` wrote. */
export async function readPageFile(file: Blob & { name: string }): Promise<PageData> {
    const found = /<script type="application\/octet-stream" id="run">([^<]*)<\/script>/.exec(await file.text());
    if (!found) throw new DamagedPage(`${file.name} is no page of mane; make one of a cache with \`mane view FILE.mane -o page.html\``);
    return unpack(found[1]);
}
