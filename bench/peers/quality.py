"""How well hair was simulated, by the same measures for all."""

import numpy as np
import warp as wp

wp.config.log_level = wp.LOG_ERROR  # that there is no graphics card is no news


@wp.kernel
def _depths(mesh: wp.uint64, points: wp.array(dtype=wp.vec3), depths: wp.array(dtype=float)):
    i = wp.tid()
    found = wp.mesh_query_point_sign_winding_number(mesh, points[i], 10.0)
    if found.result:
        on_surface = wp.mesh_eval_position(mesh, found.face, found.u, found.v)
        depths[i] = -found.sign * wp.length(points[i] - on_surface)


def depths(vertices, triangles, points):
    """How deep each point is inside a closed mesh [m]; negative: outside."""
    mesh = wp.Mesh(wp.array(vertices, dtype=wp.vec3, device="cpu"),
                   wp.array(np.ascontiguousarray(triangles, np.int32).ravel(), dtype=int, device="cpu"),
                   support_winding_number=True)
    result = wp.zeros(len(points), dtype=float, device="cpu")
    wp.launch(_depths, len(points), [mesh.id, wp.array(points, dtype=wp.vec3, device="cpu"), result], device="cpu")
    return result.numpy()


def lengths(lines):
    return np.linalg.norm(np.diff(lines, axis=-2), axis=-1).sum(axis=-1)


def measure(scene, lines):
    """Of lines (frames, strands, points, 3): stretch of whole strands against rest [1], and how deep points other than
    the roots are in the bust [m]. Strands that are no longer finite are counted and left out."""
    finite = np.isfinite(lines).all(axis=(2, 3))
    stretch = (lengths(lines) / lengths(scene.rest) - 1)[finite]
    deepest, inside, count = 0.0, 0, 0
    for frame, (frame_lines, good) in enumerate(zip(lines, finite)):
        points = np.ascontiguousarray(frame_lines[good, 1:].reshape(-1, 3), np.float32)
        depth = depths(scene.bust(frame), scene.triangles, points)
        deepest, inside, count = max(deepest, depth.max(initial=0)), inside + (depth > 0).sum(), count + len(depth)
    return {"stretch_max": stretch.max(initial=0), "stretch_mean": stretch.mean() if stretch.size else 0,
            "deepest": deepest, "share_inside": inside / max(count, 1), "lost": int((~finite[-1]).sum())}
