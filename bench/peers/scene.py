"""What all simulate: strands at rest on a head, and how the head moves. Taken from a run of mane, in metres, Y up."""

from dataclasses import dataclass

import numpy as np

from mane_cache import read_cache


def rotate(q, v):
    """Rotates v by unit quaternions q (scalar last), along the last axis."""
    axis, w = q[..., :3], q[..., 3:]
    turned = 2 * np.cross(axis, v)
    return v + w * turned + np.cross(axis, turned)


@dataclass
class Scene:
    inside: np.ndarray  # (strands, 3) the point inside the head that gives each root its direction
    rest: np.ndarray  # (strands, points, 3) from the scalp to the tip, at frame 0
    vertices: np.ndarray  # (vertices, 3) of the bust at rest
    triangles: np.ndarray  # (triangles, 3)
    bones: np.ndarray  # (vertices, 4)
    weights: np.ndarray  # (vertices, 4)
    positions: np.ndarray  # (frames, bones, 3)
    rotations: np.ndarray  # (frames, bones, 4)
    head: int  # the bone that carries the hair

    @property
    def frames(self):
        return len(self.positions)

    def bust(self, frame):
        """The bust's vertices at a frame, (vertices, 3)."""
        moved = [rotate(q, self.vertices) + p for p, q in zip(self.positions[frame], self.rotations[frame])]
        by_influence = np.stack(moved)[self.bones, np.arange(len(self.vertices))[:, None]]
        return (by_influence * self.weights[..., None]).sum(axis=1).astype(np.float32)

    def save(self, path):
        np.savez(path, **vars(self))

    @staticmethod
    def load(path):
        with np.load(path) as arrays:
            return Scene(**{name: arrays[name] for name in arrays.files})


def _centre_lines(cache, points):
    """Positions of all frames, (frames, wisps, points + 1, 3): the first point is inside the head."""
    frames = [cache["FRAM"][i] for i in sorted(cache["FRAM"])]
    lines = np.stack([f["position"] + f["origin"] for f in frames])
    sections = np.diff(cache["GROM"][0]["first_section"].ravel())
    if (sections != points + 1).any():
        raise ValueError(f"wisps of {sections.min()} to {sections.max()} sections, expected {points + 1}")
    return lines.reshape(len(frames), len(sections), points + 1, 3)


def read_run(path, points):
    """The scene of a run of mane, and where its hair went: (frames, wisps, points, 3)."""
    cache = read_cache(path)
    lines = _centre_lines(cache, points)
    body, frames = cache["BODY"][0], [cache["FRAM"][i] for i in sorted(cache["FRAM"])]
    scene = Scene(inside=lines[0, :, 0], rest=lines[0, :, 1:], vertices=body["vertices"], triangles=body["triangles"],
                  bones=body["bones"], weights=body["weights"],
                  positions=np.stack([f["body0.position"] for f in frames]),
                  rotations=np.stack([f["body0.rotation"] for f in frames]), head=int(body["head_bone"][0, 0]))
    return scene, lines[:, :, 1:].astype(np.float32)
