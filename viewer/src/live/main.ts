import longScene from "../../../scenes/long.toml";
import mediumScene from "../../../scenes/medium.toml";
import shortScene from "../../../scenes/short.toml";
import { showMessage } from "../ui/message";
import { embeddedScene, embeddedSolver } from "./embedded";
import { LivePage, type Style } from "./live_page";

const kStyles: Style[] = [
    { label: "Short", name: "short.toml", text: shortScene },
    { label: "Medium", name: "medium.toml", text: mediumScene },
    { label: "Long", name: "long.toml", text: longScene },
];

const kMostThreads = 4; // what hair of this size can use, and what the solver's pool is for (viewer/wasm/CMakeLists.txt)

/** As many threads as the address asks for (`?threads=1`), else as many as the machine has. */
function wantedThreads(): number {
    const asked = Number(new URLSearchParams(location.search).get("threads"));
    return Math.min(asked > 0 ? asked : navigator.hardwareConcurrency || 1, kMostThreads);
}

try {
    const { script, source } = await embeddedSolver(wantedThreads());
    const scene = embeddedScene() ?? { ...kStyles[2], files: [] };
    // Tests and the curious look at the page through this.
    Object.assign(window, { mane: new LivePage(document.getElementById("app")!, script, source, kStyles, scene) });
} catch (error) {
    showMessage("The page cannot run here", error instanceof Error ? error.message : String(error), false);
}
