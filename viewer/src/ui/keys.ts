import { element } from "./dom";
import { showMessage } from "./message";
import type { Shortcut } from "./shortcuts";

const kNames: Record<string, string> = { " ": "Space", ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Escape: "Esc" };

/** A list of the keys, under a word on what pointers do. */
export function showKeys(pointers: string, shortcuts: readonly Shortcut[]): void {
    showMessage("Keys", pointers, true);
    const box = document.querySelector(".message")!;
    box.classList.add("help");
    const rows = shortcuts.flatMap(({ keys: [key], label }) => [
        element("dt", {}, element("kbd", {}, kNames[key] ?? key.toUpperCase())),
        element("dd", {}, label),
    ]);
    box.querySelector("p")!.after(element("dl", {}, ...rows));
}
