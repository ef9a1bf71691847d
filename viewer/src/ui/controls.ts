import { element } from "./dom";

/** A control: what goes into the page, and how its value is set from outside. */
export interface Control<T> {
    root: HTMLElement;
    set(value: T): void;
}

const hint = (tip: string, key?: string): string => (key ? `${tip} (${key})` : tip);

export function button(label: string | Element, tip: string, onclick: (e: MouseEvent) => void, key?: string): HTMLButtonElement {
    return element("button", { type: "button", class: "button", title: hint(tip, key), onclick }, label);
}

/** On or off. */
export function toggle(label: string, tip: string, on: boolean, change: (on: boolean) => void, key?: string): Control<boolean> {
    const root = button(label, tip, () => {
        set(root.getAttribute("aria-pressed") !== "true");
        change(root.getAttribute("aria-pressed") === "true");
    }, key);
    const set = (value: boolean) => root.setAttribute("aria-pressed", String(value));
    root.classList.add("toggle");
    set(on);
    return { root, set };
}

export interface SliderOptions {
    label: string;
    tip: string;
    from: number;
    to: number;
    step?: number;
    logarithmic?: boolean; // equal ways are equal factors
    format: (value: number) => string; // with the unit
    value: number;
    change: (value: number) => void;
}

const kLogSteps = 1000;

export function slider(o: SliderOptions): Control<number> {
    const toPlace = (v: number) => (o.logarithmic ? (kLogSteps * Math.log(v / o.from)) / Math.log(o.to / o.from) : v);
    const fromPlace = (p: number) => (o.logarithmic ? o.from * (o.to / o.from) ** (p / kLogSteps) : p);
    const output = element("output");
    const input = element("input", {
        type: "range",
        min: o.logarithmic ? "0" : String(o.from),
        max: o.logarithmic ? String(kLogSteps) : String(o.to),
        step: o.logarithmic ? "1" : String(o.step ?? "any"),
        "aria-label": o.label,
    });
    const show = (value: number) => (output.textContent = o.format(value));
    input.addEventListener("input", () => {
        const value = fromPlace(Number(input.value));
        show(value);
        o.change(value);
    });
    const set = (value: number) => {
        input.value = String(toPlace(value));
        show(value);
    };
    set(o.value);
    return { root: element("label", { class: "slider", title: o.tip }, element("span", {}, o.label), input, output), set };
}

/** One of several, all to be seen. */
export function choice<T>(tip: string, options: [label: string, value: T][], value: T, change: (value: T) => void): Control<T> {
    const buttons = options.map(([label, v]) =>
        element("button", {
            type: "button",
            class: "button",
            onclick: () => {
                set(v);
                change(v);
            },
        }, label),
    );
    const set = (now: T) => buttons.forEach((b, i) => b.setAttribute("aria-pressed", String(options[i][1] === now)));
    set(value);
    return { root: element("div", { class: "choice", title: tip, role: "group" }, ...buttons), set };
}

export function section(title: string, ...children: (Node | string)[]): HTMLElement {
    return element("section", {}, element("h2", {}, title), ...children);
}
