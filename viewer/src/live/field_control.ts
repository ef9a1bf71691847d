/** The control of one field: a slider per number beside a text that takes any number with its unit, a switch, or a choice. */
import { element } from "../ui/dom";
import { fromToml, numbersOf, toToml, type Field } from "./fields";
import { rounded, scaleOf } from "./scale";
import { shown } from "./units";

export interface FieldControl {
    root: HTMLElement;
    show(value: string, opened: string): void;
}

/** Asks for a value; `pulling` until a slider is let go. */
type Ask = (value: string, pulling: boolean) => void;

/** The part of a control that holds the value. */
interface Editor {
    parts: HTMLElement[];
    show(value: unknown): void;
}

export function fieldControl(field: Field, ask: Ask): FieldControl {
    const root = element("div", { class: `field ${field.kind}` });
    root.dataset["key"] = field.key;
    root.dataset["words"] = `${field.key} ${field.name.replaceAll("_", " ")} ${field.help}`.toLowerCase();
    root.title = hint(field);
    const name = element("span", { class: "name" }, field.name.replaceAll("_", " "));
    if (!field.live) name.append(element("span", { class: "anew" }, "↺"));
    const reset = element("button", { class: "reset" }, "×");
    reset.title = "Back to the scene's value";
    reset.setAttribute("aria-label", `Reset ${field.key}`);
    let opened = "";
    reset.addEventListener("click", () => ask(opened, false));
    const editor = editorOf(field, ask);
    root.append(name, ...editor.parts, reset);
    return {
        root,
        show(value, scene) {
            opened = scene;
            root.classList.toggle("changed", value !== scene);
            editor.show(fromToml(value));
        },
    };
}

function hint({ key, help, unit, low, high, live }: Field): string {
    const range = Number.isFinite(low) && Number.isFinite(high) ? `${low} to ${high}${unit && ` [${unit}]`}` : "";
    return [key, help, range, live ? "" : "↺ may begin the hair anew"].filter((line) => line).join("\n");
}

function editorOf(field: Field, ask: Ask): Editor {
    switch (field.kind) {
        case "switch":
            return switchEditor(ask);
        case "choice":
            return choiceEditor(field, ask);
        case "text":
            return textEditor(ask);
        default:
            return numbersEditor(field, ask);
    }
}

function switchEditor(ask: Ask): Editor {
    const box = element("input");
    box.type = "checkbox";
    box.addEventListener("change", () => ask(toToml(box.checked), false));
    return { parts: [box], show: (value) => void (box.checked = value as boolean) };
}

function choiceEditor({ choices }: Field, ask: Ask): Editor {
    const select = element("select");
    select.append(...choices.map((choice) => new Option(choice, choice)));
    select.addEventListener("change", () => ask(toToml(select.value), false));
    return { parts: [select], show: (value) => void (select.value = value as string) };
}

function textEditor(ask: Ask): Editor {
    const text = element("input", { class: "text" });
    text.addEventListener("change", () => ask(toToml(text.value), false));
    return { parts: [text], show: (value) => void (text.value = value as string) };
}

/** A slider and a text per number: one, root and tip, or x, y, z. */
function numbersEditor(field: Field, ask: Ask): Editor {
    const names = { ramp: ["root", "tip"], vector: ["x", "y", "z"] }[field.kind as string] ?? [""];
    let numbers: number[] = names.map(() => 0);
    const send = (i: number, value: unknown, pulling: boolean) => {
        const all: unknown[] = numbers.map((number, other) => (other === i ? value : number));
        ask(toToml(all.length === 1 ? all[0] : all), pulling);
    };
    const rows = names.map((name, i) => numberRow(field, name, (value, pulling) => send(i, value, pulling)));
    return {
        parts: rows.map(({ root }) => root),
        show(value) {
            const given = numbersOf(value);
            numbers = names.map((_, i) => given[i] ?? given[0]);
            rows.forEach((row, i) => row.show(numbers[i]));
        },
    };
}

function numberRow(field: Field, name: string, send: (value: unknown, pulling: boolean) => void) {
    const scale = scaleOf(field);
    const root = element("span", { class: "number" });
    const slider = element("input");
    slider.type = "range";
    slider.min = "0";
    slider.max = "1";
    slider.step = "0.001";
    slider.setAttribute("aria-label", name ? `${field.key} ${name}` : field.key);
    const text = element("input", { class: "value" });
    text.setAttribute("aria-label", `${slider.getAttribute("aria-label")} as text`);
    const pulled = () => rounded(scale.toNumber(slider.valueAsNumber), field.kind === "whole");
    let held = false; // what is under a hand stays there
    slider.addEventListener("input", () => {
        held = true;
        text.value = shown(pulled(), field.unit);
        if (field.live) send(pulled(), true);
    });
    slider.addEventListener("change", () => {
        held = false;
        send(pulled(), false);
    });
    // Typed numbers may carry any unit: C++ reads them. Bare ones are in the field's unit.
    text.addEventListener("change", () => send(/^[-+.\d]+(e[-+]?\d+)?$/i.test(text.value.trim()) ? Number(text.value) : text.value.trim(), false));
    if (name) root.append(element("span", { class: "axis" }, name));
    root.append(slider, text);
    return {
        root,
        show(number: number) {
            if (held) return;
            if (document.activeElement !== text) text.value = shown(number, field.unit);
            slider.value = String(scale.toWay(number));
        },
    };
}
