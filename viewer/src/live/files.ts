/** Files that are dropped on the page, or chosen: a scene with what it names, or a clip. */
import type { SceneFile } from "./protocol";

export interface Dropped {
    scene: { name: string; text: string } | null;
    clip: SceneFile | null;
    others: SceneFile[]; // what a scene may name: meshes, clips
}

/** Throws an Error that says what is wrong. */
export async function readDropped(files: readonly File[]): Promise<Dropped> {
    const read = async (file: File): Promise<SceneFile> => ({ path: `/${file.name}`, bytes: new Uint8Array(await file.arrayBuffer()) });
    const of = (ending: string) => files.filter(({ name }) => name.toLowerCase().endsWith(ending));
    const [scene, ...scenes] = of(".toml");
    if (scenes.length > 0) throw new Error(`found ${scenes.length + 1} scenes, expected one`);
    const known = [...of(".toml"), ...of(".bvh"), ...of(".obj")];
    const unknown = files.find((file) => !known.includes(file));
    if (unknown) throw new Error(`${unknown.name}: expected a scene (.toml), a clip (.bvh) or a mesh that a scene names (.obj)`);
    if (scene) {
        const others = await Promise.all([...of(".bvh"), ...of(".obj")].map(read));
        return { scene: { name: scene.name, text: await text(scene) }, clip: null, others };
    }
    const [clip] = of(".bvh");
    if (!clip) throw new Error(`${files.map(({ name }) => name).join(", ")}: a mesh is dropped together with the scene that names it`);
    return { scene: null, clip: await read(clip), others: [] };
}

/** A scene is text in UTF-8; another file by that name is not one. */
async function text(file: File): Promise<string> {
    try {
        return new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer());
    } catch {
        throw new Error(`${file.name}: found bytes that are no text, expected a scene file (TOML)`);
    }
}

/** Calls `take` with the files of each drop on the page; `over` while some are above it. */
export function acceptDrops(over: (above: boolean) => void, take: (files: File[]) => void): void {
    let above = 0;
    const change = (by: number) => over((above = Math.max(0, above + by)) > 0);
    addEventListener("dragenter", () => change(1));
    addEventListener("dragleave", () => change(-1));
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => {
        event.preventDefault();
        change(-above);
        take([...(event.dataTransfer?.files ?? [])]);
    });
}
