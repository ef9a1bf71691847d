"""The grooms that all run, and the motion, as scenes of mane."""

import math
from dataclasses import dataclass
from pathlib import Path

LENGTH = 0.28  # [m] of every wisp
FRAME_RATE = 24
SHAKE = math.radians(40)  # to both sides
SHAKE_RATE = 1.0  # [Hz]
SHAKE_START = 0.5  # [s] in which it grows from nothing: everybody starts at rest
CLIP_RATE = 240
# The bust's joints in its rest pose [m]: about the neck's axis the head turns.
JOINTS = {"chest": (0, 1.20, -0.06), "neck": (0, 1.385, -0.048), "head": (0, 1.495, -0.018)}


@dataclass(frozen=True)
class Groom:
    """A head of `wisps`, each simulated at `points` points from the scalp to the tip.

    The radius gives 14 to 25 intersections per segment, as the paper's styles have. Thin wisps are stiff for their
    mass: `settings` softens them until they are stable at the rates of the preset `default`. The two largest are
    bench/scenes/slender-*.toml.
    """

    wisps: int
    points: int
    radius: float  # [m]
    settings: dict

    @property
    def name(self):
        return f"{self.wisps}x{self.points}"


SLENDER = {
    "style": {"thickness": 1, "parting": 0, "variation": 0},
    "skeleton": {"strain": 0.01, "bending_length": 0.04},
    "envelope": {"mass_share": 0.5, "squeeze": 0.6, "stiffness": 1, "damping": 0.3, "ring_stiffness": 0.2,
                 "ring_damping": 0.3},
}
GROOMS = [
    Groom(200, 5, 0.012, {"envelope": {"squeeze": 0.4, "mass_share": 0.5}}),
    Groom(73, 11, 0.03, {}),
    Groom(56, 9, 0.03, {}),
    Groom(1000, 11, 0.0023, SLENDER),
    Groom(10000, 11, 0.0008, {**SLENDER, "style": {**SLENDER["style"], "volume": 0.03}}),
]


def yaw(time):
    """The head's turn at a time [rad]: a sine that grows smoothly from rest."""
    s = min(max(time / SHAKE_START, 0), 1)
    return SHAKE * s**3 * (10 - 15 * s + 6 * s * s) * math.sin(2 * math.pi * SHAKE_RATE * time)


def write_clip(path, seconds):
    """The shake as a BVH clip, which is how mane reads any motion of a head."""
    lines, depth, parent = ["HIERARCHY"], 0, (0, 0, 0)
    for name, joint in JOINTS.items():
        offset = " ".join(f"{a - b:.6f}" for a, b in zip(joint, parent))
        channels = "6 Xposition Yposition Zposition" if depth == 0 else "3"
        lines += [f"{'JOINT' if depth else 'ROOT'} {name}", "{", f"OFFSET {'0 0 0' if depth == 0 else offset}",
                  f"CHANNELS {channels} Zrotation Xrotation Yrotation"]
        depth, parent = depth + 1, joint
    lines += ["End Site", "{", "OFFSET 0 0.2 0", "}"] + ["}"] * depth
    count = math.ceil(seconds * CLIP_RATE) + 1
    lines += ["MOTION", f"Frames: {count}", f"Frame Time: {1 / CLIP_RATE:.9f}"]
    start = " ".join(map(str, JOINTS["chest"]))
    lines += [f"{start} 0 0 0 0 0 0 0 0 {math.degrees(yaw(i / CLIP_RATE)):.6f}" for i in range(count)]
    Path(path).write_text("\n".join(lines) + "\n")


def write_scene(groom, folder, frames):
    """The groom's scene file and its clip in a folder; its path."""
    folder = Path(folder)
    write_clip(folder / "shake.bvh", frames / FRAME_RATE)
    sections = {
        "style": {"wisps": groom.wisps, "segments": groom.points - 1, "nape_length": LENGTH, "crown_length": LENGTH,
                  "length_variation": 0, "root_radius": groom.radius, "radius": groom.radius,
                  "tip_radius": groom.radius},
        "schedule": {"frames": frames, "frame_rate": FRAME_RATE, "preroll": 0},
        "motion": {"clip": '"shake.bvh"', "lowpass": 0, **{joint: f'"{joint}"' for joint in JOINTS}},
    }
    for section, values in groom.settings.items():
        sections.setdefault(section, {}).update(values)
    text = "".join(f"[{section}]\n" + "".join(f"{key} = {value}\n" for key, value in values.items())
                   for section, values in sections.items())
    path = folder / f"{groom.name}.toml"
    path.write_text(text)
    return path
