/** What was set, step by step, so that it can be taken back. One pull of a slider is one step. */
import type { Setting } from "./protocol";

interface Step {
    before: Setting[];
    after: Setting[];
    open: boolean; // the slider is still being pulled
}

const sameKeys = (a: Setting[], b: Setting[]): boolean => a.length === b.length && a.every(({ key }, i) => key === b[i].key);

export class History {
    private done: Step[] = [];
    private undone: Step[] = [];

    get canUndo(): boolean {
        return this.done.length > 0;
    }
    get canRedo(): boolean {
        return this.undone.length > 0;
    }

    /** Keeps a change. While `open`, further changes of the same fields belong to the same step. */
    add(before: Setting[], after: Setting[], open = false): void {
        const last = this.done.at(-1);
        if (last?.open && sameKeys(last.after, after)) {
            last.after = after;
            last.open = open;
        } else {
            this.done.push({ before, after, open });
        }
        this.undone = [];
    }

    /** What to set to take the last step back; null if there is none. */
    undo(): Setting[] | null {
        const step = this.done.pop();
        if (!step) return null;
        this.undone.push({ ...step, open: false });
        return step.before;
    }

    redo(): Setting[] | null {
        const step = this.undone.pop();
        if (!step) return null;
        this.done.push(step);
        return step.after;
    }

    /** The change was refused. */
    drop(): void {
        this.done.pop();
    }

    clear(): void {
        this.done = [];
        this.undone = [];
    }
}
