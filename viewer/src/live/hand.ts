/**
 * A hand on the head, the hair or the camera: what a pointer on the canvas does. The camera's own moves are the view's
 * (ui/orbit_controls); this takes what begins on the character.
 */
import type { HairView } from "../draw/hair_view";
import { add, cross, dot, length, scale, subtract, type Vec3 } from "../draw/matrix";
import type { Hair, HairFrame } from "../hair/hair";
import { sectionCount, wispOfSection } from "../hair/hair";
import type { Hold } from "./protocol";

export type Tool = "turn" | "move" | "pull";

export interface HandEvents {
    hold(hold: Hold): void;
    pin(section: number, place: Vec3): void;
    release(section: number): void;
    pinsChanged(): void;
}

const kRadiansPerPixel = 0.008,
    kClickPixels = 4,
    kReach = 0.2, // [m] around the middle of the head: what is near it is the head
    kGrasp = 18; // [pixels] around a skeleton point
const kPinColour = [1, 0.72, 0.3, 1];

export const kAtEase: Hold = { position: [0, 0, 0], yaw: 0, pitch: 0, roll: 0 };

/** What the pointer has got hold of. */
type Grip = { kind: "head"; hold: Hold } | { kind: "hair"; section: number; place: Vec3; pinned: boolean };

export class Hand {
    tool: Tool = "turn";
    hold: Hold = kAtEase;
    /** Skeleton points that stay where they were put, and where that is. */
    readonly pins = new Map<number, Vec3>();
    private grip: Grip | null = null;
    private from = { x: 0, y: 0 };

    constructor(
        private readonly view: HairView,
        private readonly hair: () => { hair: Hair; frame: HairFrame } | null,
        private readonly events: HandEvents,
    ) {
        const { canvas } = view;
        // Before the camera's listeners, which never hear of what a hand takes.
        canvas.addEventListener("pointerdown", (e) => this.take(e), { capture: true });
        canvas.addEventListener("pointermove", (e) => this.move(e), { capture: true });
        for (const end of ["pointerup", "pointercancel"] as const) canvas.addEventListener(end, (e) => this.letGo(e), { capture: true });
    }

    setHold(hold: Hold): void {
        this.hold = hold;
        this.events.hold(hold);
    }

    /** Turns and moves the head by so much more. */
    nudge(by: Partial<Hold>): void {
        const { position, yaw, pitch, roll } = this.hold;
        const limit = (angle: number) => Math.min(Math.max(angle, -0.9), 0.9); // [rad] as far as a neck goes
        this.setHold({
            position: add(position, by.position ?? [0, 0, 0]),
            yaw: yaw + (by.yaw ?? 0),
            pitch: limit(pitch + (by.pitch ?? 0)),
            roll: limit(roll + (by.roll ?? 0)),
        });
    }

    releaseAll(): void {
        this.pins.clear();
    }

    /** Draws the pins: a dot where each holds, and a line from the point it holds. */
    mark(frame: HairFrame): void {
        const { marks } = this.view;
        const origin: Vec3 = [frame.origin[0], frame.origin[1], frame.origin[2]];
        marks.clear();
        for (const [section, place] of this.pins) {
            const at = subtract(place, origin);
            marks.line(subtract(pointOf(frame, section), origin), at, -1.5, -1.5, kPinColour);
            marks.dot(at, -9, kPinColour);
        }
    }

    private take(event: PointerEvent): void {
        if (event.button !== 0 || event.shiftKey || !this.hair()) return;
        this.grip = this.tool === "pull" ? this.grasp(event) : this.touchesHead(event) ? { kind: "head", hold: this.hold } : null;
        if (!this.grip) return;
        event.stopImmediatePropagation();
        this.view.canvas.setPointerCapture(event.pointerId);
        this.from = { x: event.clientX, y: event.clientY };
    }

    private move(event: PointerEvent): void {
        if (!this.grip) return;
        event.stopImmediatePropagation();
        const dx = event.clientX - this.from.x,
            dy = event.clientY - this.from.y;
        if (this.grip.kind === "hair") {
            if (Math.hypot(dx, dy) >= kClickPixels) this.pull(this.grip, dx, dy);
        } else if (this.tool === "move") {
            this.setHold({ ...this.hold, position: add(this.grip.hold.position, this.across(this.view.headCentre(), dx, dy)) });
        } else {
            this.hold = this.grip.hold;
            this.nudge({ yaw: dx * kRadiansPerPixel, pitch: dy * kRadiansPerPixel });
        }
    }

    private letGo(event: PointerEvent): void {
        const { grip } = this;
        if (!grip) return;
        event.stopImmediatePropagation();
        this.grip = null;
        const still = Math.hypot(event.clientX - this.from.x, event.clientY - this.from.y) < kClickPixels;
        if (grip.kind !== "hair" || !still) return;
        if (grip.pinned) this.release(grip.section);
        else this.pin(grip.section, grip.place);
    }

    private pin(section: number, place: Vec3): void {
        this.pins.set(section, place);
        this.events.pin(section, place);
        this.events.pinsChanged();
    }

    private release(section: number): void {
        this.pins.delete(section);
        this.events.release(section);
        this.events.pinsChanged();
    }

    private pull(grip: Grip & { kind: "hair" }, dx: number, dy: number): void {
        this.pin(grip.section, add(grip.place, this.across(grip.place, dx, dy)));
    }

    /** [m] How far a place goes when the pointer goes so many pixels, in the picture's plane. */
    private across(place: Vec3, dx: number, dy: number): Vec3 {
        const { camera, canvas } = this.view;
        const { forward, across, above } = camera.axes();
        const pixel = camera.pixel(canvas.clientHeight) * dot(subtract(place, camera.eye()), forward);
        return add(scale(across, dx * pixel), above, -dy * pixel);
    }

    private ray(event: PointerEvent): { eye: Vec3; direction: Vec3 } {
        const { canvas, camera } = this.view;
        return camera.ray(event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight, canvas.clientWidth / canvas.clientHeight);
    }

    private touchesHead(event: PointerEvent): boolean {
        const { eye, direction } = this.ray(event);
        return length(cross(subtract(this.view.headCentre(), eye), direction)) < kReach;
    }

    /** The skeleton point under the pointer: a pinned one first, else the nearest to the eye of those in reach. */
    private grasp(event: PointerEvent): Grip | null {
        const { hair, frame } = this.hair()!;
        const { camera, canvas } = this.view;
        const { eye, direction } = this.ray(event);
        const { forward } = camera.axes();
        const reach = kGrasp * camera.pixel(canvas.clientHeight);
        let best: Grip | null = null,
            nearest = Infinity;
        for (let s = 0; s < sectionCount(hair); ++s) {
            const place = pointOf(frame, s),
                away = subtract(place, eye),
                depth = dot(away, forward);
            if (isRoot(hair, s) || length(cross(away, direction)) > reach * depth) continue;
            const pinned = this.pins.has(s),
                rank = pinned ? -1 : depth;
            if (rank < nearest) {
                nearest = rank;
                best = { kind: "hair", section: s, place: pinned ? this.pins.get(s)! : place, pinned };
            }
        }
        return best;
    }
}

const pointOf = ({ position, origin }: HairFrame, s: number): Vec3 => [
    position[3 * s] + origin[0],
    position[3 * s + 1] + origin[1],
    position[3 * s + 2] + origin[2],
];

/** The first two sections of a wisp ride on the head. */
const isRoot = (hair: Hair, s: number): boolean => s < hair.firstSection[wispOfSection(hair, s)] + 2;
