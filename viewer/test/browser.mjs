// A headless Chromium with software WebGL, and pages in it that must stay quiet: no error, no request but for the page itself.
import { accessSync, constants } from "node:fs";
import { delimiter, join } from "node:path";
import { chromium } from "playwright-core";

const kNames = ["chromium", "chromium-browser", "google-chrome"];
const kArguments = ["--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

/** The path of a browser on this machine; undefined if there is none. */
export function findBrowser() {
    if (process.env.MANE_CHROMIUM) return process.env.MANE_CHROMIUM;
    for (const folder of (process.env.PATH ?? "").split(delimiter))
        for (const name of kNames) {
            const path = join(folder, name);
            try {
                accessSync(path, constants.X_OK);
                return path;
            } catch {
                // not there
            }
        }
    return undefined;
}

export const launch = () => chromium.launch({ executablePath: findBrowser(), args: kArguments });

/** Opens a page; `complaints` gathers what it must not do. */
export async function openPage(browser, url, { width = 860, height = 640 } = {}) {
    const context = await browser.newContext({ viewport: { width, height }, acceptDownloads: true });
    const page = await context.newPage();
    const complaints = [];
    page.on("console", (m) => {
        if (m.type() === "error" || m.type() === "warning") complaints.push(`${m.type()}: ${m.text()}`);
    });
    page.on("pageerror", (e) => complaints.push(`error: ${e.message}`));
    page.on("request", (r) => {
        if (r.url() !== url && !/^(blob|data):/.test(r.url())) complaints.push(`request: ${r.url()}`);
    });
    await page.goto(url);
    return { page, complaints, close: () => context.close() };
}
