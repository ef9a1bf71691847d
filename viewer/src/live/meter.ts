/** Speed against real time, and where the time goes: the mean of the last frames, stage by stage. */
import { element } from "../ui/dom";
import type { FrameCost } from "./protocol";

const FRAMES = 48;

export class Meter {
    readonly root = element("section", { class: "meter" });
    private readonly speed = element("strong", { class: "speed" }, "–");
    private readonly detail = element("span", { class: "detail" });
    private readonly bar = element("div", { class: "bar" });
    private readonly legend = element("div", { class: "legend" });
    private costs: FrameCost[] = [];
    private parts: { bar: HTMLElement; text: HTMLElement }[] = [];

    constructor() {
        const head = element("div", { class: "head" });
        head.append(this.speed, element("span", {}, "× real time"), this.detail);
        this.root.append(head, this.bar, this.legend);
        this.root.title = "Simulated time by the time it takes to compute. The bar is a frame's time; its parts are the stages of a step.";
    }

    /** The stages of a step, as C++ names them, and what is left of a frame. */
    setStages(names: string[]): void {
        this.parts = [...names, "other"].map((name, i) => {
            const bar = element("i", { class: `stage${i}` });
            const text = element("span", { class: `stage${i}` }, name);
            this.bar.append(bar);
            this.legend.append(text);
            text.dataset["name"] = name;
            return { bar, text };
        });
    }

    clear(): void {
        this.costs = [];
    }

    add(cost: FrameCost): void {
        this.costs.push(cost);
        if (this.costs.length > FRAMES) this.costs.shift();
    }

    /** How many times faster than real time frames of `frameSeconds` are computed; 0 without any. */
    times(frameSeconds: number): number {
        const total = this.costs.reduce((sum, cost) => sum + cost.total, 0);
        return total > 0 ? (frameSeconds * this.costs.length) / total : 0;
    }

    show(frameSeconds: number): void {
        const count = this.costs.length;
        if (count === 0) return;
        const times = this.times(frameSeconds);
        const perFrame = frameSeconds / times;
        this.speed.textContent = times.toFixed(times < 10 ? 1 : 0);
        this.detail.textContent = `${(1000 * perFrame).toFixed(1)} of ${(1000 * frameSeconds).toFixed(1)} ms a frame`;
        this.root.classList.toggle("late", times < 1);
        let rest = perFrame;
        this.parts.forEach(({ bar, text }, i) => {
            const stage = this.costs.reduce((sum, cost) => sum + (cost.stages[i] ?? 0), 0) / count;
            const seconds = i < this.parts.length - 1 ? stage : Math.max(rest, 0);
            rest -= seconds;
            bar.style.width = `${Math.min(100, (100 * seconds) / frameSeconds)}%`;
            text.textContent = `${text.dataset["name"]} ${(1000 * seconds).toFixed(2)}`;
        });
    }
}
