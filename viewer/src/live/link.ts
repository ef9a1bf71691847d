/** The page's end of the solver's worker: requests go out, answers come to whoever listens, questions get theirs. */
import type { Answer, Request, SolverSource } from "./protocol";

type Listeners = { [Kind in Answer["kind"]]?: (answer: Extract<Answer, { kind: Kind }>) => void };

export class SolverLink {
    private readonly questions = new Map<number, (text: string) => void>();
    private asked = 0;

    /** `script` is the worker's whole text: from a disk, only what the page holds itself can be started. */
    static start(script: string, source: SolverSource, listeners: Listeners): SolverLink {
        const address = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
        const link = new SolverLink(new Worker(address), listeners);
        link.send({ kind: "start", source });
        return link;
    }

    private constructor(
        private readonly worker: Worker,
        private readonly listeners: Listeners,
    ) {
        worker.onmessage = ({ data }: MessageEvent<Answer>) => this.take(data);
        worker.onerror = ({ message }) => this.take({ kind: "error", message, request: "start" });
    }

    send(request: Request, transfer: Transferable[] = []): void {
        this.worker.postMessage(request, transfer);
    }

    /** The state's hash, or the scene as TOML, behind all requests before. */
    ask(what: "hash" | "scene"): Promise<string> {
        const number = ++this.asked;
        return new Promise((resolve) => {
            this.questions.set(number, resolve);
            this.send({ kind: "ask", number, what });
        });
    }

    private take(answer: Answer): void {
        if (answer.kind === "answer") {
            this.questions.get(answer.number)?.(answer.text);
            this.questions.delete(answer.number);
        }
        (this.listeners[answer.kind] as ((a: Answer) => void) | undefined)?.(answer);
    }
}
