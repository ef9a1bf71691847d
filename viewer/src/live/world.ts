/** The solver's world, described for the page: what stays the same over its frames. */
import type { BodyMesh, Hair } from "../hair/hair";
import type { FrameLayout, WorldDescription } from "./protocol";
import type { Solver } from "./solver";

/** What C++ says in words and single numbers; arrays are asked for by name. */
interface Summary {
    number: number;
    name: string;
    frameRate: number;
    clip: string;
    instructionSet: string;
    warnings: string[];
    hair: Pick<Hair, "wisps" | "envelopePoints" | "strandDesc" | "seed">;
    bodies: { name: string; headBone: number; bones: number }[];
}

export const summarize = (solver: Solver): Summary => JSON.parse(solver.ask("world"));

export function describeWorld(solver: Solver): WorldDescription {
    const { hair: told, bodies, ...rest } = summarize(solver);
    const hair: Hair = {
        ...told,
        firstSection: solver.view(Uint32Array, "groom.first_section").slice(),
        designedLength: solver.view(Float32Array, "groom.designed_length").slice(),
        strands: solver.view(Uint32Array, "groom.strands").slice(),
    };
    const meshes = bodies.map(
        ({ name, headBone }, i): BodyMesh => ({
            name,
            headBone,
            vertices: solver.view(Float32Array, "body.vertices", i).slice(),
            triangles: solver.view(Uint32Array, "body.triangles", i).slice(),
            bones: solver.view(Uint16Array, "body.bones", i).slice(),
            weights: solver.view(Float32Array, "body.weights", i).slice(),
        }),
    );
    return { ...rest, hair, bodies: meshes, layout: frameLayout(hair, bodies.map((body) => body.bones)) };
}

function frameLayout(hair: Hair, bones: number[]): FrameLayout {
    const sections = hair.firstSection[hair.wisps];
    const poses = bones.reduce((sum, count) => sum + 7 * count, 0);
    const position = 8 * (1 + 3 + poses);
    const radius = position + 4 * 3 * sections;
    const firstAxis = radius + 4 * hair.envelopePoints * sections;
    return { bones, position, radius, firstAxis, bytes: firstAxis + 4 * 3 * hair.wisps };
}
