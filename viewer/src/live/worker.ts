/**
 * The solver's worker: one world that runs in real time, changed between its frames by what the page asks. The solver's own script
 * stands in front of this one, or, with threads, is fetched first.
 */
import { Clock } from "./clock";
import { FrameWriter } from "./frame_writer";
import type { Answer, FrameCost, Request, SolverSource, WorldDescription } from "./protocol";
import { Solver } from "./solver";
import { describeWorld, summarize } from "./world";

declare const self: {
    createSolver: Parameters<typeof Solver.create>[1];
    onmessage: (event: { data: Request }) => void;
    postMessage(message: Answer, transfer: Transferable[]): void;
};
declare function importScripts(address: string): void;

const kSoon = -1;

class SolverWorker {
    private readonly clock = new Clock();
    private readonly soon = new MessageChannel(); // a timer waits for 4 ms at least
    private waiting = 0; // a timer, kSoon, or 0: for nothing
    private running = false;
    private world: WorldDescription | null = null;
    private frames: FrameWriter | null = null;
    private costs: FrameCost[] = []; // of frames since the last one sent

    private constructor(private readonly solver: Solver) {
        this.soon.port1.onmessage = () => this.keepPace();
    }

    static async start(source: SolverSource): Promise<SolverWorker> {
        if (source.kind === "threads") importScripts(source.script);
        const solver = await Solver.create(source, self.createSolver);
        const { threads } = solver;
        const schema = JSON.parse(solver.ask("schema"));
        const stages = JSON.parse(solver.ask("stages"));
        answer({ kind: "started", schema, stages, threads });
        return new SolverWorker(solver);
    }

    take(request: Request): void {
        const { solver } = this;
        switch (request.kind) {
            case "open":
                for (const { path, bytes } of request.files) solver.write(path, bytes);
                return this.change(() => solver.call("open", request.text, request.name));
            case "clip":
                solver.write(request.file.path, request.file.bytes);
                return this.change(() => solver.call("take_clip", request.file.path));
            case "set":
                return this.change(() => solver.call("set", lines(request.settings)));
            case "rates":
                return this.change(() => solver.call("set_rates", request.preset));
            case "restart":
                return this.change(() => solver.call("restart"));
            case "hold": {
                const { position, yaw, pitch, roll } = request.hold;
                return solver.call("hold", ...position, yaw, pitch, roll);
            }
            case "teleport":
                solver.call("teleport", ...request.by);
                return this.show();
            case "pin":
                return solver.call("pin", request.section, ...request.position);
            case "release":
                return request.section === "all" ? solver.call("release_all") : solver.call("release", request.section);
            case "run":
                return this.run(request.running);
            case "advance":
                for (let i = 0; i < request.frames; ++i) this.advance();
                return this.show();
            case "give-back":
                if (request.world === this.world?.number) this.frames!.giveBack(request.place);
                return;
            case "ask":
                return answer({ kind: "answer", number: request.number, text: solver.ask(request.what) });
        }
    }

    /** A change of the scene: the world is the same one, changed, or another. */
    private change(work: () => void): void {
        work();
        const values = JSON.parse(this.solver.ask("values"));
        if (this.world?.number === this.solver.number("worlds")) {
            const { frameRate, hair } = summarize(this.solver);
            answer({ kind: "values", values, frameRate, strandDesc: hair.strandDesc });
            return;
        }
        this.world = describeWorld(this.solver);
        this.frames = new FrameWriter(this.solver, this.world);
        this.costs = [];
        answer({ kind: "world", world: this.world, values });
        this.show();
        this.run(this.running);
    }

    private run(running: boolean): void {
        this.running = running;
        if (!running || !this.world) return;
        this.clock.set(performance.now(), this.time());
        if (this.waiting > 0) clearTimeout(this.waiting);
        if (this.waiting !== kSoon) this.comeBack(0);
    }

    /** Computes the next frame when it is due. */
    private keepPace(): void {
        this.waiting = 0;
        if (!this.running || !this.world) return;
        const wait = this.clock.wait(performance.now(), this.time());
        if (wait === 0) {
            this.running = tried("advance", () => this.advance()); // a state that is not finite stays so
            this.show();
        }
        this.comeBack(wait);
    }

    /** Goes on after so many milliseconds; what the page asks for meanwhile comes first. */
    private comeBack(wait: number): void {
        const early = 2;
        if (wait > 2 * early) {
            this.waiting = setTimeout(() => this.keepPace(), wait - early) as unknown as number;
        } else {
            this.waiting = kSoon;
            this.soon.port2.postMessage(null);
        }
    }

    private time(): number {
        return this.solver.view(Float64Array, "frame.doubles")[0];
    }

    private advance(): void {
        const stages = () => Array.from(this.solver.view(Float64Array, "statistics.stage_seconds"));
        const before = stages();
        const begin = performance.now();
        this.solver.call("advance");
        const total = (performance.now() - begin) / 1000;
        this.costs.push({ total, stages: stages().map((seconds, stage) => seconds - before[stage]) });
    }

    /** Sends the frame, unless the page is behind: then it gets a later one. */
    private show(): void {
        const place = this.frames!.write();
        if (!place) return;
        const { number } = this.world!;
        const index = this.solver.number("frame_index");
        answer({ kind: "frame", world: number, index, place, costs: this.costs }, place.buffer ? [place.buffer] : []);
        this.costs = [];
    }
}

const lines = (settings: { key: string; value: string }[]): string => settings.map(({ key, value }) => `${key}=${value}`).join("\n");

const answer = (message: Answer, transfer: Transferable[] = []): void => self.postMessage(message, transfer);

/** Does it; a failure is the page's to tell. */
function tried(request: Request["kind"], work: () => void): boolean {
    try {
        work();
        return true;
    } catch (error) {
        answer({ kind: "error", message: error instanceof Error ? error.message : String(error), request });
        return false;
    }
}

let worker: SolverWorker;
let started: Promise<void>;

self.onmessage = ({ data: request }) => {
    if (request.kind === "start")
        started = SolverWorker.start(request.source).then(
            (one) => void (worker = one),
            (error) => answer({ kind: "error", message: String(error), request: "start" }),
        );
    else void started.then(() => tried(request.kind, () => worker.take(request)));
};
