import { showKeys as showList } from "../ui/keys";
import type { Shortcut } from "../ui/shortcuts";

/** The list of keys. */
export const showKeys = (shortcuts: readonly Shortcut[]): void =>
    showList("Drag on the character to turn or move the head or to pull hair; beside it to go round, with Shift to move across; wheel to come nearer.", shortcuts);
