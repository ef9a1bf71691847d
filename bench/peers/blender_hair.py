"""Hair dynamics of Blender: particle hair stepped by the cloth solver, with its defaults.

The variant `grid` turns on what makes it hair and not single threads: internal friction on the grid of voxels.
"""

import struct
import tempfile

import bpy
import numpy as np

import worker
from grooms import FRAME_RATE

FIRST = 1  # Blender's number of frame 0
GRID_FRICTION = 0.5  # the variant's `internal_friction`; its default is 0, which leaves the grid out


def write_vertex_cache(path, frames):
    """A mesh's vertices by frame, as Blender's Mesh Cache reads them (PC2)."""
    with open(path, "wb") as out:
        out.write(struct.pack("<12siiffi", b"POINTCACHE2\0", 1, len(frames[0]), 0.0, 1.0, len(frames)))
        for vertices in frames:
            out.write(np.ascontiguousarray(vertices, "<f4").tobytes())


def add_object(name, vertices, faces=()):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(v) for v in vertices.tolist()], [], [tuple(f) for f in faces])
    made = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(made)
    return made


def add_bust(scene):
    """The bust with its skin's motion, as an obstacle."""
    bust = add_object("bust", scene.bust(0), scene.triangles.tolist())
    path = tempfile.NamedTemporaryFile(suffix=".pc2", delete=False).name
    write_vertex_cache(path, [scene.bust(frame) for frame in range(scene.frames)])
    cache = bust.modifiers.new("skin", "MESH_CACHE")
    cache.cache_format, cache.filepath, cache.frame_start = "PC2", path, FIRST
    bust.modifiers.new("collision", "COLLISION")


def add_roots(scene):
    """One vertex per root, on an object that moves as the head does."""
    q0, p0 = scene.rotations[0, scene.head], scene.positions[0, scene.head]
    if not (np.allclose(q0, [0, 0, 0, 1], atol=1e-6) and np.allclose(p0, 0, atol=1e-6)):
        raise ValueError("the head is not in its rest pose at frame 0")
    roots = add_object("roots", scene.rest[:, 0])
    roots.rotation_mode = "QUATERNION"
    for frame in range(scene.frames):
        x, y, z, w = scene.rotations[frame, scene.head]
        roots.location, roots.rotation_quaternion = scene.positions[frame, scene.head], (w, x, y, z)
        roots.keyframe_insert("location", frame=FIRST + frame)
        roots.keyframe_insert("rotation_quaternion", frame=FIRST + frame)
    return roots


def evaluated(roots):
    found = roots.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return found, found.modifiers["hair"], found.particle_systems[0].particles


def add_hair(scene, roots):
    """A particle per root, whose keys are the strand's points."""
    strands, points, _ = scene.rest.shape
    roots.modifiers.new("hair", "PARTICLE_SYSTEM")
    system = roots.particle_systems[0]
    settings = system.settings
    settings.type, settings.emit_from, settings.use_emit_random = "HAIR", "VERT", False
    settings.count, settings.hair_step = strands, points - 1
    bpy.context.scene.frame_set(FIRST)
    bpy.context.view_layer.objects.active = roots
    for _ in range(2):  # in and out: afterwards the keys are the user's
        bpy.ops.particle.particle_edit_toggle()
    made, modifier, particles = evaluated(roots)
    for strand, own, shown in zip(scene.rest.tolist(), system.particles, particles):
        for key, shown_key, point in zip(own.hair_keys, shown.hair_keys, strand):
            key.co_object_set(made, modifier, shown, point)
            shown_key.co_object_set(made, modifier, shown, point)
    roots.update_tag()
    return system


def build(scene, arguments):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    world = bpy.context.scene
    world.gravity, world.render.fps = (0, -9.81, 0), FRAME_RATE
    world.frame_start, world.frame_end = FIRST, FIRST + scene.frames
    add_bust(scene)
    roots = add_roots(scene)
    system = add_hair(scene, roots)
    system.use_hair_dynamics = True
    system.point_cache.frame_start, system.point_cache.frame_end = FIRST, FIRST + scene.frames
    if arguments.variant == "grid":
        system.cloth.settings.internal_friction = GRID_FRICTION
    world.frame_set(FIRST)

    def lines():
        made, modifier, particles = evaluated(roots)
        placed = np.array(made.matrix_world)
        points = np.array([[key.co_object(made, modifier, p) for key in p.hair_keys] for p in particles])
        return points @ placed[:3, :3].T + placed[:3, 3]

    return lambda frame: world.frame_set(FIRST + frame), lines


if __name__ == "__main__":
    worker.run(build)
