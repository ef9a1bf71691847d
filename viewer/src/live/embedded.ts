/** What the page carries with it, put there when it was made (tools/live.cpp): the solver, its worker, and a scene to begin with. */
import type { SceneFile, SolverSource } from "./protocol";

/** A scene with the files it names, in base64. */
interface EmbeddedScene {
    name: string;
    text: string;
    files: { path: string; bytes: string }[];
}

/** Beside the page on its server: a solver with threads, for pages that may share memory. */
interface ThreadedSolver {
    script: string;
}

const textOf = (id: string): string | null => document.getElementById(id)?.textContent ?? null;

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
    const binary = atob(base64.trim());
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
}

const inflated = (bytes: Uint8Array<ArrayBuffer>): Promise<ArrayBuffer> =>
    new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();

/** The worker's script and where its solver comes from; `threads`: how many at most. */
export async function embeddedSolver(threads: number): Promise<{ script: string; source: SolverSource }> {
    const worker = textOf("worker"),
        solver = textOf("solver-script"),
        module = textOf("solver-module");
    if (!worker || !solver || !module) throw new Error("this page was made without its solver");
    const threaded = textOf("solver-threads");
    if (threaded && crossOriginIsolated && threads > 1) {
        const { script }: ThreadedSolver = JSON.parse(threaded);
        return { script: worker, source: { kind: "threads", script: new URL(script, location.href).href, count: threads } };
    }
    return { script: `${solver}\n${worker}`, source: { kind: "inline", module: await inflated(bytesOf(module)) } };
}

/** The scene that the page was made with; null: none. */
export function embeddedScene(): { name: string; text: string; files: SceneFile[] } | null {
    const scene = textOf("scene");
    if (!scene) return null;
    const { name, text, files }: EmbeddedScene = JSON.parse(scene);
    return { name, text, files: files.map(({ path, bytes }) => ({ path, bytes: bytesOf(bytes) })) };
}
