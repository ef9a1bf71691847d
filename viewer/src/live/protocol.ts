/**
 * What the page and the solver's worker say to each other. The worker owns the one world; the page asks, draws, and gives frames'
 * buffers back. Values of fields travel as text, as a scene file writes them: what they mean is for C++ alone to say.
 */
import type { BodyMesh, Hair, StrandDesc } from "../hair/hair";

/** A file that a scene names, under the name it uses. */
export interface SceneFile {
    path: string;
    bytes: Uint8Array;
}

/** Where the solver comes from: its module, whose script stands before the worker's, or the address of a build that uses threads. */
export type SolverSource =
    | { kind: "inline"; module: ArrayBuffer }
    | { kind: "threads"; script: string; count: number };

/** How the head is held by hand: where the character stands [m] and how the head is turned [rad]. */
export interface Hold {
    position: [number, number, number];
    yaw: number;
    pitch: number;
    roll: number;
}

export type Request =
    | { kind: "start"; source: SolverSource }
    | { kind: "open"; name: string; text: string; files: SceneFile[] }
    | { kind: "clip"; file: SceneFile }
    | { kind: "set"; settings: Setting[] }
    | { kind: "rates"; preset: string }
    | { kind: "hold"; hold: Hold }
    | { kind: "teleport"; by: [number, number, number] }
    | { kind: "pin"; section: number; position: [number, number, number] }
    | { kind: "release"; section: number | "all" }
    | { kind: "run"; running: boolean }
    | { kind: "advance"; frames: number }
    | { kind: "restart" }
    | { kind: "give-back"; world: number; place: Place }
    | { kind: "ask"; number: number; what: "hash" | "scene" };

export interface Setting {
    key: string; // section.name
    value: string; // TOML
}

/** Where things begin in a frame's buffer [byte]; its doubles are at 0 (frame_buffer.ts). */
export interface FrameLayout {
    bones: number[]; // per body
    position: number;
    radius: number;
    firstAxis: number;
    bytes: number; // in all
}

/** Where a frame is: in a buffer that changes hands, or in a slot of shared memory. */
export interface Place {
    slot: number;
    buffer?: ArrayBuffer;
}

export interface WorldDescription {
    number: number; // worlds are built anew; frames say of which they are
    name: string;
    hair: Hair;
    bodies: BodyMesh[];
    layout: FrameLayout;
    frameRate: number; // [Hz]
    instructionSet: string;
    warnings: string[];
    clip: string; // the clip's file; empty: none
    shared?: SharedArrayBuffer; // frames in slots, where threads may share memory
}

/** What a frame cost: seconds by stage, in the order of the names in `started`, and in all. */
export interface FrameCost {
    stages: number[];
    total: number;
}

export type Answer =
    | { kind: "started"; schema: unknown; stages: string[]; threads: number }
    | { kind: "world"; world: WorldDescription; values: Record<string, string> }
    | { kind: "values"; values: Record<string, string>; frameRate: number; strandDesc: StrandDesc }
    | { kind: "frame"; world: number; index: number; place: Place; costs: FrameCost[] }
    | { kind: "answer"; number: number; text: string }
    | { kind: "error"; message: string; request: Request["kind"] };
