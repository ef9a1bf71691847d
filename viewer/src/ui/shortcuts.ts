/** Keys and what they do, for the window and for a list to read. */
export interface Shortcut {
    keys: string[]; // as KeyboardEvent.key names them
    label: string;
    does: () => void;
}

/** Keys go to a control that takes text or that they move, as everywhere. */
const takesKeys = (target: EventTarget | null): boolean =>
    target instanceof HTMLElement && (target.isContentEditable || /^(TEXTAREA|SELECT)$/.test(target.tagName) ||
        (target instanceof HTMLInputElement && target.type !== "range" && target.type !== "color"));

/** Listens until the function that it returns is called. */
export function listenForShortcuts(shortcuts: readonly Shortcut[]): () => void {
    const listen = (e: KeyboardEvent) => {
        if (e.ctrlKey || e.metaKey || e.altKey || takesKeys(e.target)) return;
        const found = shortcuts.find((s) => s.keys.includes(e.key.length === 1 ? e.key.toLowerCase() : e.key));
        if (!found) return;
        e.preventDefault();
        if (e.target instanceof HTMLElement && e.target.tagName === "BUTTON") e.target.blur();
        found.does();
    };
    window.addEventListener("keydown", listen);
    return () => window.removeEventListener("keydown", listen);
}
