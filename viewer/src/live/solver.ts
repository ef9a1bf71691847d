/** The compiled solver (viewer/wasm) behind functions with types. It throws what the C++ threw, as an Error with the same message. */
import type { SolverSource } from "./protocol";

/** What Emscripten's script makes: the exported functions with an underscore, memory, and a file system in memory. */
interface Module {
    [name: `_${string}`]: (...values: (number | bigint)[]) => number;
    HEAPU8: Uint8Array;
    FS: {
        mkdirTree(path: string): void;
        writeFile(path: string, bytes: Uint8Array): void;
    };
    UTF8ToString(address: number): string;
    stringToUTF8(text: string, address: number, space: number): void;
    lengthBytesUTF8(text: string): number;
}
type CreateModule = (options: object) => Promise<Module>;

type Numbers = Float32ArrayConstructor | Float64ArrayConstructor | Uint32ArrayConstructor | Uint16ArrayConstructor;

const moduleOptions = (source: SolverSource): object => {
    if (source.kind === "inline") return { wasmBinary: source.module };
    const folder = source.script.slice(0, source.script.lastIndexOf("/") + 1);
    return { mainScriptUrlOrBlob: source.script, locateFile: (name: string) => folder + name };
};

export class Solver {
    private constructor(
        private readonly module: Module,
        readonly threads: number,
    ) {}

    static async create(source: SolverSource, create: CreateModule): Promise<Solver> {
        const threads = source.kind === "threads" ? source.count : 1;
        const solver = new Solver(await create(moduleOptions(source)), threads);
        solver.call("begin", threads);
        return solver;
    }

    /** Calls an exported function; texts go in as UTF-8. What it returns false for is thrown. */
    call(name: string, ...values: (number | boolean | string)[]): void {
        const texts: number[] = [];
        try {
            const plain = values.map((value) => {
                if (typeof value !== "string") return Number(value);
                texts.push(this.text(value));
                return texts.at(-1)!;
            });
            if (!this.module[`_solver_${name}`](...plain)) throw new Error(this.ask("error"));
        } finally {
            for (const address of texts) this.module._free!(address);
        }
    }

    /** What an exported function without failures says. */
    ask(name: string): string {
        return this.module.UTF8ToString(this.module[`_solver_${name}`]());
    }

    /** A number that an exported function without failures gives. */
    number(name: string): number {
        return this.module[`_solver_${name}`]();
    }

    /** Numbers in the solver's memory: valid until its next call. */
    view<Type extends Numbers>(type: Type, name: string, index = 0): InstanceType<Type> {
        this.call("find", name, index);
        const address = this.module._solver_found!();
        const count = this.module._solver_found_count!();
        return new type(this.module.HEAPU8.buffer as ArrayBuffer, address, count) as InstanceType<Type>;
    }

    /** Puts a file where a scene finds it. */
    write(path: string, bytes: Uint8Array): void {
        const whole = path.startsWith("/") ? path : `/${path}`;
        this.module.FS.mkdirTree(whole.slice(0, whole.lastIndexOf("/")) || "/");
        this.module.FS.writeFile(whole, bytes);
    }

    private text(text: string): number {
        const space = this.module.lengthBytesUTF8(text) + 1;
        const address = this.module._malloc!(space);
        this.module.stringToUTF8(text, address, space);
        return address;
    }
}
