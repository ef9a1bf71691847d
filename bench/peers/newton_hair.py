"""Hair by Newton on its CPU device, with the settings of its own examples: chains of particles by XPBD
(`cloth_hanging`), or rods of capsules by VBD (`cable_pile`). Roots and head are kinematic.
"""

import newton
import numpy as np
import warp as wp

import worker
from grooms import FRAME_RATE

SUBSTEPS = 24  # the examples' step is 1/600 s; an even number, so that the two states are where they began
XPBD_ITERATIONS, VBD_ITERATIONS = 10, 5
RADIUS = 0.001  # [m] of a strand
STRAND_MASS = 1e-3  # [kg] of a whole strand of particles
SPRING = {"ke": 1.0e3, "kd": 1.0, "control": 0.0}  # of cloth_hanging
# Rods bend freely by default, and then fly apart at the first contact. This is about how stiff mane's wisps are.
BEND = {"bend_stiffness": 1e-3, "bend_damping": 1e-4}  # [N·m/rad], [N·m·s/rad]


@wp.kernel
def place_bodies(bodies: wp.array(dtype=int), bone: wp.array(dtype=int), rest: wp.array(dtype=wp.transform),
                 poses: wp.array2d(dtype=wp.transform), substep: int, q0: wp.array(dtype=wp.transform),
                 q1: wp.array(dtype=wp.transform)):
    i = wp.tid()
    placed = wp.transform_multiply(poses[substep, bone[i]], rest[i])
    q0[bodies[i]] = placed
    q1[bodies[i]] = placed


@wp.kernel
def place_particles(particles: wp.array(dtype=int), bone: int, rest: wp.array(dtype=wp.vec3),
                    poses: wp.array2d(dtype=wp.transform), substep: int, q0: wp.array(dtype=wp.vec3),
                    q1: wp.array(dtype=wp.vec3)):
    i = wp.tid()
    placed = wp.transform_point(poses[substep, bone], rest[i])
    q0[particles[i]] = placed
    q1[particles[i]] = placed


def add_bust(builder, scene):
    """Newton moves rigid bodies: the bust in pieces, each following the bone that its triangles follow most."""
    main = scene.bones[np.arange(len(scene.bones)), scene.weights.argmax(axis=1)].astype(int)
    of_triangle = np.median(main[scene.triangles], axis=1).astype(int)
    pieces = []
    for bone in np.unique(of_triangle):
        used, triangles = np.unique(scene.triangles[of_triangle == bone], return_inverse=True)
        body = builder.add_body(is_kinematic=True)
        builder.add_shape_mesh(body, mesh=newton.Mesh(scene.vertices[used], triangles.ravel().astype(np.int32)))
        pieces.append((body, int(bone), wp.transform_identity()))
    keep_apart(builder, [body for body, _, _ in pieces], [body for body, _, _ in pieces])
    return pieces


def keep_apart(builder, bodies, others):
    """No contacts between bodies of the two lists: they are held, and would only cost time."""
    for a in bodies:
        for b in others:
            if a != b:
                builder.add_shape_collision_filter_pair(builder.body_shapes[a][0], builder.body_shapes[b][0])


def with_root(scene):
    """Strands with the point inside the head before them: it clamps the root's direction."""
    return np.concatenate([scene.inside[:, None], scene.rest], axis=1)


class Particles:
    """Chains of particles and springs; the two first points of each are kinematic."""

    held_bodies = ()

    def __init__(self, builder, scene):
        strands = with_root(scene)
        count, points, _ = strands.shape
        mass = np.full((count, points), STRAND_MASS / points)
        mass[:, :2] = 0
        builder.add_particles(pos=strands.reshape(-1, 3).tolist(), vel=[(0.0, 0.0, 0.0)] * mass.size,
                              mass=mass.ravel().tolist(), radius=[RADIUS] * mass.size)
        index = np.arange(mass.size).reshape(count, points)
        for i, j in zip(index[:, 1:-1].ravel().tolist(), index[:, 2:].ravel().tolist()):
            builder.add_spring(i, j, **SPRING)
        self.shape, self.bone = (count, points), scene.head
        self.held = wp.array(index[:, :2].ravel(), dtype=int)
        self.rest = wp.array(strands[:, :2].reshape(-1, 3), dtype=wp.vec3)

    def solver(self, model):
        return newton.solvers.SolverXPBD(model, iterations=XPBD_ITERATIONS), newton.CollisionPipeline(model)

    def place(self, poses, substep, a, b):
        wp.launch(place_particles, len(self.held),
                  [self.held, self.bone, self.rest, poses, substep, a.particle_q, b.particle_q])

    def lines(self, state):
        return state.particle_q.numpy().reshape(*self.shape, 3)[:, 1:].copy()


class Rods:
    """Rods of capsules; the first capsule of each, which leaves the head, is kinematic."""

    def __init__(self, builder, scene):
        self.bodies, self.held_bodies = [], []
        for strand in with_root(scene):
            bodies, _ = builder.add_rod(rod=newton.Rod(strand.tolist(), radius=RADIUS), **BEND)
            root = bodies[0]  # made kinematic as in the example cable_twist
            builder.body_mass[root] = builder.body_inv_mass[root] = 0.0
            builder.body_inertia[root] = builder.body_inv_inertia[root] = wp.mat33(0.0)
            self.bodies.append(bodies)
            self.held_bodies.append((root, scene.head, builder.body_q[root]))
        self.bodies = np.array(self.bodies)
        self.half = np.linalg.norm(np.diff(with_root(scene), axis=1), axis=-1) / 2
        builder.color()

    def solver(self, model):
        pipeline = newton.CollisionPipeline(model, contact_matching="sticky")  # before the solver, which keeps history
        return newton.solvers.SolverVBD(model, iterations=VBD_ITERATIONS, rigid_body_contact_buffer_size=256,
                                        rigid_contact_history=True), pipeline

    def place(self, poses, substep, a, b):
        pass  # its roots are bodies, placed with the bust's

    def lines(self, state):
        """Where each capsule begins, and where the last one ends: gaps at joints count as stretch."""
        q = state.body_q.numpy()[self.bodies]
        x, y, z, w = np.moveaxis(q[..., 3:], -1, 0)
        along = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axis=-1)
        reach = along * self.half[..., None]
        centre = q[..., :3]
        return np.concatenate([(centre - reach)[:, 1:], (centre + reach)[:, -1:]], axis=1)


def poses_within(scene, frame):
    """Poses of the bones at the end of each substep of the way to a frame, (substeps, bones, 7)."""
    s = (np.arange(SUBSTEPS)[:, None, None] + 1) / SUBSTEPS
    position = (1 - s) * scene.positions[frame - 1] + s * scene.positions[frame]
    rotation = (1 - s) * scene.rotations[frame - 1] + s * scene.rotations[frame]
    rotation /= np.linalg.norm(rotation, axis=-1, keepdims=True)
    return np.concatenate([position, rotation], axis=-1).astype(np.float32)


class Simulation:
    """Steps a frame at a time. It owns all arrays: a recorded frame keeps none alive."""

    def __init__(self, scene, hair_class):
        self.scene = scene
        builder = newton.ModelBuilder(up_axis=newton.Axis.Y)
        builder.rigid_gap = 0.0
        builder.default_shape_cfg.mu, builder.default_shape_cfg.ke, builder.default_shape_cfg.kd = 1.0, 1.0e5, 0.0
        pieces = add_bust(builder, scene)
        self.hair = hair_class(builder, scene)
        held = [*pieces, *self.hair.held_bodies]
        keep_apart(builder, [body for body, _, _ in pieces], [body for body, _, _ in self.hair.held_bodies])
        self.bodies, self.bones = (wp.array([h[i] for h in held], dtype=int) for i in range(2))
        self.rest = wp.array([h[2] for h in held], dtype=wp.transform)
        self.model = builder.finalize()
        self.solver, self.pipeline = self.hair.solver(self.model)
        self.contacts, self.control = self.pipeline.contacts(), self.model.control()
        self.states = [self.model.state(), self.model.state()]
        self.poses = wp.array(poses_within(scene, 1), dtype=wp.transform, ndim=2)
        with wp.ScopedCapture() as capture:  # as the examples do: a frame is recorded once
            self._substeps()
        self.graph = capture.graph

    def _substeps(self):
        for substep in range(SUBSTEPS):
            now, then = self.states[substep % 2], self.states[(substep + 1) % 2]
            now.clear_forces()
            wp.launch(place_bodies, len(self.bodies),
                      [self.bodies, self.bones, self.rest, self.poses, substep, now.body_q, then.body_q])
            self.hair.place(self.poses, substep, now, then)
            self.pipeline.collide(now, self.contacts)
            self.solver.step(now, then, self.control, self.contacts, 1 / FRAME_RATE / SUBSTEPS)

    def step(self, frame):
        self.poses.assign(poses_within(self.scene, frame))
        wp.capture_launch(self.graph)

    def lines(self):
        return self.hair.lines(self.states[0])


def build(scene, arguments):
    wp.set_device("cpu")
    simulation = Simulation(scene, {"xpbd": Particles, "vbd": Rods}[arguments.variant])
    return simulation.step, simulation.lines


if __name__ == "__main__":
    worker.run(build)
