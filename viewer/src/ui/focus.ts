import type { OrbitCamera } from "../draw/camera";
import { rotate, type Vec3 } from "../draw/matrix";
import type { BodyMesh, HairFrame } from "../hair/hair";

/** Where a camera stands, from the head: as `View` of mane/picture.h. */
export const kViews: [label: string, degrees: number, key: string][] = [
    ["Face", 0, "f"],
    ["Three-quarter", 40, "t"],
    ["Profile", 90, "r"],
    ["Back", 180, "b"],
];

const kFrameHeight = 0.75; // [m] that a view sees

/** Where the head faces in the horizontal plane, as an angle about the vertical; 0 along +Z. */
export function headYaw(frame: HairFrame, wearer: BodyMesh | undefined): number {
    const rotation = wearer && frame.bodies[0]?.rotation.subarray(4 * wearer.headBone, 4 * wearer.headBone + 4);
    if (!rotation || rotation.length < 4) return 0;
    const face = rotate(rotation, [0, 0, 1]),
        crown = rotate(rotation, [0, 1, 0]);
    // Looking straight up or down, the neck's direction tells.
    const [x, , z] = face[1] > 0.9 ? crown.map((c) => -c) : face[1] < -0.9 ? crown : face;
    return Math.atan2(x, z);
}

/** The camera of a preset view. */
export function look(camera: OrbitCamera, head: Vec3, yaw: number, degrees: number): void {
    camera.target = aim(head);
    camera.yaw = yaw + (degrees * Math.PI) / 180;
    camera.pitch = 0.08;
    camera.distance = (0.5 * kFrameHeight) / Math.tan(camera.fieldOfView / 2);
}

/** What a camera looks at to see the head and its hair: hair hangs, so more is below than above. */
export const aim = (head: Vec3): Vec3 => [head[0], head[1] - 0.22 * kFrameHeight, head[2]];
