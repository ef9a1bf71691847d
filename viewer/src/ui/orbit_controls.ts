import type { OrbitCamera } from "../draw/camera";

const kRadiansPerPixel = 0.008,
    kClickPixels = 4;

/**
 * Pointers on a canvas move a camera: drag to go round, with Shift or the right button to move across, wheel or two fingers to
 * come nearer. `changed` after every move; `clicked` with a place in CSS pixels where the pointer did not move.
 */
export function orbitControls(
    canvas: HTMLCanvasElement,
    camera: OrbitCamera,
    changed: () => void,
    clicked: (x: number, y: number) => void,
): void {
    const down = new Map<number, { x: number; y: number }>();
    let travelled = 0;
    const spread = () => {
        const [a, b] = [...down.values()];
        return Math.hypot(a.x - b.x, a.y - b.y);
    };
    canvas.addEventListener("contextmenu", (e) => e.preventDefault());
    canvas.addEventListener("pointerdown", (e) => {
        canvas.setPointerCapture(e.pointerId);
        if (down.size === 0) travelled = 0;
        down.set(e.pointerId, { x: e.clientX, y: e.clientY });
    });
    canvas.addEventListener("pointermove", (e) => {
        const before = down.get(e.pointerId);
        if (!before) return;
        const dx = e.clientX - before.x,
            dy = e.clientY - before.y,
            wide = down.size === 2 ? spread() : 0;
        down.set(e.pointerId, { x: e.clientX, y: e.clientY });
        travelled += Math.hypot(dx, dy);
        if (travelled < kClickPixels) return;
        if (down.size === 2) camera.zoom(wide / Math.max(spread(), 1));
        else if (e.shiftKey || (e.buttons & 6) !== 0) camera.pan(-dx / canvas.clientHeight, dy / canvas.clientHeight);
        else camera.orbit(-dx * kRadiansPerPixel, dy * kRadiansPerPixel);
        changed();
    });
    const up = (e: PointerEvent) => {
        if (!down.delete(e.pointerId)) return;
        if (e.type === "pointerup" && down.size === 0 && travelled < kClickPixels && e.button === 0) clicked(e.offsetX, e.offsetY);
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("wheel", (e) => {
        e.preventDefault();
        camera.zoom(Math.exp(e.deltaY * (e.deltaMode === 1 ? 0.03 : 0.001)));
        changed();
    }, { passive: false });
}
