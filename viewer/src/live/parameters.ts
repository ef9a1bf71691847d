/** The parameters of the scene: controls made from the table of fields, what was set and can be taken back, and the scene as text. */
import { button, choice } from "../ui/controls";
import { element } from "../ui/dom";
import type { Field } from "./fields";
import { History } from "./history";
import { Panel } from "./panel";
import type { Setting } from "./protocol";

export interface ParameterEvents {
    set(settings: Setting[]): void;
    /** The whole scene as TOML, as it is now. */
    scene(): Promise<string>;
    rates(preset: string): void;
}

/** Presets of C++ (`apply_rates`), and by which rates [Hz] they are known: of contacts with the character, of contacts between wisps. */
const kRates: [name: string, character: number, wisps: number][] = [["paper", 120, 24], ["default", 120, 120], ["fine", 1000, 1000]];

type Values = Record<string, string>;

export class Parameters {
    readonly root = element("div", { id: "parameters" });
    private readonly history = new History();
    private readonly panel: Panel;
    private readonly undoButton = button("Undo", "take the last change back", () => this.undo(), "z");
    private readonly redoButton = button("Redo", "make it again", () => this.redo(), "y");
    private readonly rates = choice("how often contacts are looked for, with the character and between wisps: 120 and 24 Hz, 120 and 120, 1000 and 1000",
        kRates.map(([name]) => [name, name]), "", (name) => this.setRates(name));
    private values: Values = {};
    private opened: Values = {}; // as the scene was opened
    private before: Values | null = null; // a preset is on its way
    private asked: Setting[] = []; // a request that is on its way
    private waiting: Setting[] = []; // for its answer
    private onIdle: (() => void)[] = [];

    constructor(
        fields: Field[],
        private readonly events: ParameterEvents,
    ) {
        this.panel = new Panel(fields, ({ key }, value, open) => this.set([{ key, value }], open));
        const copy = button("Copy TOML", "the whole scene, as `mane simulate` takes it", () => void this.copy(copy));
        this.root.append(
            element("div", { class: "row bar" }, this.undoButton, this.redoButton,
                button("Reset", "all parameters as the scene was opened", () => this.reset()), copy),
            element("div", { class: "row rates" }, element("span", { class: "label" }, "Rates"),
                this.rates.root),
            this.panel.root,
        );
        this.showHistory();
    }

    /** Values of all fields, from the solver. `opened`: of a scene that was just opened. */
    show(values: Values, opened: boolean): void {
        if (opened) {
            this.opened = values;
            this.history.clear();
        }
        if (this.before && !opened) this.keepDifferences(this.before, values);
        this.before = null;
        this.values = values;
        this.panel.show(values, this.opened);
        this.rates.set(kRates.find(([, character, wisps]) => Number(values["schedule.character_rate"]) === character && Number(values["schedule.wisp_rate"]) === wisps)?.[0] ?? "");
        this.showHistory();
        this.sendWaiting();
    }

    /** The solver has refused the last change. */
    refuse(): void {
        if (this.before) this.before = null;
        else this.history.drop();
        this.show(this.values, false);
    }

    undo(): void {
        this.send(this.history.undo());
    }
    redo(): void {
        this.send(this.history.redo());
    }

    reset(): void {
        this.send(this.keepDifferences(this.values, this.opened));
    }

    /** One step from these values to those; null if they are the same. */
    private keepDifferences(from: Values, to: Values): Setting[] | null {
        const keys = Object.keys(to).filter((key) => from[key] !== to[key]);
        if (keys.length === 0) return null;
        const of = (values: Values): Setting[] => keys.map((key) => ({ key, value: values[key] }));
        this.history.add(of(from), of(to));
        return of(to);
    }

    /** C++ knows what a preset means; what it has changed comes back. */
    private setRates(preset: string): void {
        this.before = this.values;
        this.events.rates(preset);
    }

    /** One step, of one field or of several. `open`: more of the same follows. */
    set(settings: Setting[], open = false): void {
        this.history.add(settings.map(({ key }) => ({ key, value: this.latest(key) })), settings, open);
        this.send(settings);
    }

    /** One request at a time: a slider says more than hair can follow that has to be laid anew. What comes meanwhile waits, the last of each field. */
    private send(settings: Setting[] | null): void {
        this.showHistory();
        if (!settings) return;
        const keys = new Set(settings.map(({ key }) => key));
        this.waiting = [...this.waiting.filter(({ key }) => !keys.has(key)), ...settings];
        if (this.asked.length === 0) this.sendWaiting();
    }

    private sendWaiting(): void {
        this.asked = this.waiting;
        this.waiting = [];
        if (this.asked.length > 0) this.events.set(this.asked);
        else for (const done of this.onIdle.splice(0)) done();
    }

    /** When all that was asked for is done, or refused. */
    idle(): Promise<void> {
        return new Promise((done) => {
            this.onIdle.push(done);
            if (this.asked.length === 0) this.sendWaiting();
        });
    }

    /** A field's value when all is done that was asked for. */
    private latest(key: string): string {
        return [...this.waiting, ...this.asked].find((setting) => setting.key === key)?.value ?? this.values[key];
    }

    private showHistory(): void {
        this.undoButton.disabled = !this.history.canUndo;
        this.redoButton.disabled = !this.history.canRedo;
    }

    private async copy(by: HTMLButtonElement): Promise<void> {
        await this.idle();
        await copyText(await this.events.scene());
        by.textContent = "Copied";
        setTimeout(() => (by.textContent = "Copy TOML"), 1500);
    }
}

/** Some browsers give no clipboard to pages from a disk; all copy what is selected. */
async function copyText(text: string): Promise<void> {
    try {
        await navigator.clipboard.writeText(text);
    } catch {
        const area = element("textarea", { value: text });
        document.body.append(area);
        area.select();
        document.execCommand("copy");
        area.remove();
    }
}
