/** The list of keys. */
import { element } from "../ui/dom";
import { showMessage } from "../ui/message";
import type { Shortcut } from "../ui/shortcuts";

const kNames: Record<string, string> = { " ": "Space", ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Escape: "Esc" };

export function showKeys(shortcuts: readonly Shortcut[]): void {
    showMessage("Keys", "Drag on the character to turn or move the head or to pull hair; beside it to go round, with Shift to move across; wheel to come nearer.", true);
    const box = document.querySelector(".message")!;
    box.classList.add("help");
    const rows = shortcuts.flatMap(({ keys: [key], label }) => [
        element("dt", {}, element("kbd", {}, kNames[key] ?? key.toUpperCase())),
        element("dd", {}, label),
    ]);
    box.querySelector("p")!.after(element("dl", {}, ...rows));
}
