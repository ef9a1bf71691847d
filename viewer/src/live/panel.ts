/** The parameters: a control per field, made from the field table, by section. It shows values and asks for changes; it owns none. */
import { fieldControl, type FieldControl } from "./field_control";
import type { Field } from "./fields";
import { element } from "../ui/dom";

/** A change that someone made; `open` while a slider is still being pulled. */
export type Change = (field: Field, value: string, open: boolean) => void;

/** What a section is called, and whether it is open at first; others are named as in scene files. Those of `hidden` say nothing here. */
const titles: Record<string, [title: string, open: boolean]> = {
    simulation: ["Gravity, seed", true],
    air: ["Air", true],
    skeleton: ["Skeleton", true],
    envelope: ["Envelope", false],
    wisps: ["Contact between wisps", true],
    character: ["Contact with the character", false],
    strands: ["Strands", false],
    schedule: ["Rates", false],
    style: ["Style", false],
    motion: ["Motion", false],
};
const hidden = new Set(["check", "character.mesh", "character.unit", "character.offset", "character.scalp_centre", "character.scalp_radius", "schedule.frames"]);
const order = Object.keys(titles);

export class Panel {
    readonly root = element("div", { class: "fields" });
    private readonly controls = new Map<string, FieldControl>();
    private readonly sections: HTMLDetailsElement[] = [];

    constructor(fields: Field[], change: Change) {
        const search = element("input", { class: "search" });
        search.type = "search";
        search.placeholder = "Find a parameter";
        search.setAttribute("aria-label", "Find a parameter");
        search.addEventListener("input", () => this.filter(search.value.trim().toLowerCase()));
        this.root.append(search);
        const shown = fields.filter(({ section, key }) => !hidden.has(section) && !hidden.has(key));
        for (const section of order) this.add(section, shown.filter((field) => field.section === section), change);
    }

    /** All values now, as TOML, and those of the scene as it was opened, which a reset brings back. */
    show(values: Record<string, string>, opened: Record<string, string>): void {
        for (const [key, control] of this.controls) control.show(values[key], opened[key]);
    }

    private add(section: string, fields: Field[], change: Change): void {
        const [title, open] = titles[section];
        const details = element("details");
        details.open = open;
        details.dataset["section"] = section;
        details.append(element("summary", {}, title));
        for (const field of fields) {
            const control = fieldControl(field, (value, pulling) => change(field, value, pulling));
            this.controls.set(field.key, control);
            details.append(control.root);
        }
        this.sections.push(details);
        this.root.append(details);
    }

    private filter(words: string): void {
        for (const details of this.sections) {
            let any = false;
            for (const row of details.querySelectorAll<HTMLElement>(".field")) {
                row.hidden = words !== "" && !(row.dataset["words"] ?? "").includes(words);
                any ||= !row.hidden;
            }
            details.hidden = !any;
            if (words !== "" && any) details.open = true;
        }
    }
}
