"""A peer's own process: it loads a scene, steps it frame by frame under a time limit, and saves what came of it."""

import argparse
import resource
import time

import numpy as np

from scene import Scene


def run(build):
    """`build(scene, arguments)` sets a peer up and returns its `step(frame)` and `lines()`.

    Only `step` is timed. lines() gives the points now, (strands, points, 3).
    """
    parser = argparse.ArgumentParser()
    parser.add_argument("scene")
    parser.add_argument("result")
    parser.add_argument("--limit", type=float, default=600, help="seconds of stepping")
    parser.add_argument("--variant", default="")
    arguments = parser.parse_args()
    scene = Scene.load(arguments.scene)
    step, lines = build(scene, arguments)
    kept, seconds = [lines()], []
    for frame in range(1, scene.frames):
        start = time.perf_counter()
        step(frame)
        seconds.append(time.perf_counter() - start)
        kept.append(lines())
        if sum(seconds) > arguments.limit:
            break
    resident = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    np.savez(arguments.result, lines=np.stack(kept).astype(np.float32), seconds=seconds, resident=resident)
