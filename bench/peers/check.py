"""Checks of the peers' own Python, in seconds: what is measured on shapes whose answers are known.

    build/peers/bin/python bench/peers/check.py
"""

import math
import struct
import unittest
from types import SimpleNamespace

import numpy as np

import grooms
import mane_cache
from quality import depths, measure
from scene import Scene, rotate

CUBE = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], np.float32)
CUBE_TRIANGLES = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                           [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]])


def quarter_turn_scene():
    """A cube of one bone that turns by 90° about y and rises by 1 in its second frame."""
    half = math.sqrt(0.5)
    return Scene(inside=np.zeros((1, 3)), rest=np.array([[[0, 1, 0], [0, 3, 0]]], float), vertices=CUBE,
                 triangles=CUBE_TRIANGLES, bones=np.zeros((8, 4), int), weights=np.eye(4)[np.zeros(8, int)],
                 positions=np.array([[[0, 0, 0]], [[0, 1, 0]]], float),
                 rotations=np.array([[[0, 0, 0, 1]], [[0, half, 0, half]]], float), head=0)


class Checks(unittest.TestCase):
    def test_depth_is_the_distance_to_the_nearest_face_with_its_sign(self):
        points = np.array([[0, 0, 0.75], [0, 0, 1.5], [0.9, 0.2, 0], [2, 2, 2]], np.float32)
        np.testing.assert_allclose(depths(CUBE, CUBE_TRIANGLES, points), [0.25, -0.5, 0.1, -math.sqrt(3)], atol=1e-6)

    def test_a_quarter_turn_about_y_takes_z_to_x(self):
        np.testing.assert_allclose(rotate(quarter_turn_scene().rotations[1, 0], np.array([0, 0, 1.0])), [1, 0, 0], atol=1e-7)

    def test_skin_follows_its_bone(self):
        moved = quarter_turn_scene().bust(1)
        np.testing.assert_allclose(moved.min(axis=0), [-1, 0, -1], atol=1e-6)
        np.testing.assert_allclose(moved.max(axis=0), [1, 2, 1], atol=1e-6)

    def test_quality_of_known_lines(self):
        lines = np.array([[[[0, 1, 0], [0, 3, 0]]], [[[0, 2, 0], [0, 1.7, 0]]]], np.float32)
        quality = measure(quarter_turn_scene(), lines)
        self.assertAlmostEqual(quality["stretch_max"], 0, places=6)
        self.assertAlmostEqual(quality["stretch_mean"], (0 + 0.15 - 1) / 2, places=6)
        self.assertAlmostEqual(quality["deepest"], 0.3, places=6)
        self.assertEqual(quality["share_inside"], 0.5)

    def test_strands_that_are_not_finite_are_lost_and_not_measured(self):
        lines = np.array([[[[0, 1, 0], [0, 3, 0]]], [[[0, 2, 0], [np.nan, 4, 0]]]], np.float32)
        quality = measure(quarter_turn_scene(), lines)
        self.assertEqual(quality["lost"], 1)
        self.assertEqual(quality["stretch_max"], 0)

    def test_arrays_of_a_cache_are_unshuffled(self):
        values = np.arange(6, dtype="<f4").reshape(2, 3)
        payload = struct.pack("<I", 1) + b"\x04name\x01m" + struct.pack("<BBQ", 4, 3, 2)
        payload += values.view(np.uint8).reshape(2, 12).T.tobytes()
        np.testing.assert_array_equal(mane_cache._arrays(payload)["name"], values)

    def test_the_shake_grows_from_rest_to_its_amplitude(self):
        step = 1e-4
        self.assertEqual(grooms.yaw(0), 0)
        self.assertLess(abs(grooms.yaw(step)) / step, 1e-6)
        self.assertAlmostEqual(grooms.yaw(1.25), grooms.SHAKE)
        self.assertAlmostEqual(grooms.yaw(1.75), -grooms.SHAKE)

    def test_poses_within_a_frame_end_on_it(self):
        from newton_hair import poses_within
        scene = SimpleNamespace(positions=quarter_turn_scene().positions, rotations=quarter_turn_scene().rotations)
        poses = poses_within(scene, 1)
        np.testing.assert_allclose(poses[-1, 0], [0, 1, 0, 0, math.sqrt(0.5), 0, math.sqrt(0.5)], atol=1e-6)
        np.testing.assert_allclose(poses[len(poses) // 2 - 1, 0, 4], math.sin(math.pi / 8), atol=1e-6)


if __name__ == "__main__":
    unittest.main()
