/** Motions of the character that need no file, as settings of a scene's [motion]. */
import type { Setting } from "./protocol";

const kMotions: Record<string, Record<string, string>> = {
    "Built-in": { "motion.clip": '""', "motion.still": "false", "motion.shake": "0.0" },
    Shake: { "motion.clip": '""', "motion.still": "false", "motion.shake": "40.0" },
    Still: { "motion.clip": '""', "motion.still": "true", "motion.shake": "0.0" },
};
export const kMotionNames = Object.keys(kMotions);

export const motionSettings = (name: string): Setting[] => Object.entries(kMotions[name]).map(([key, value]) => ({ key, value }));

/** The one that these values describe; empty: another. */
export const motionOf = (values: Record<string, string>): string =>
    kMotionNames.find((name) => motionSettings(name).every(({ key, value }) => values[key] === value)) ?? "";
