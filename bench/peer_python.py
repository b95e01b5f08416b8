#!/usr/bin/env python3
"""Runs a scene through an engine that has Python bindings; a step is one call of it. Prints JSON.
peer_python.py box2d|pymunk SCENE.json STEPS WARMUP    (the file by quadrille_bench_broad dump)"""

import json
import math
import sys
import time


class Box2d:
    """Box2D 3, as bench/peer_box2d.cpp sets up 2.4; 4 substeps, as its manual recommends."""

    settings = "float; fixed rotation; 4 substeps; no sleep"

    def __init__(self, scene):
        import pyb2d3 as b2
        from importlib.metadata import version
        self.name = f"Box2D 3 (pyb2d3 {version('pyb2d3')})"
        self.dt = scene["dt"]
        self.world = b2.World(gravity=tuple(scene["gravity"]))
        self.world.sleeping_enabled = False
        self.world.restitution_threshold = 0
        material = b2.surface_material(restitution=scene["restitution"], friction=0)
        self.moving = []
        for moves, x, y, half_width, half_height, vx, vy, mass in scene["bodies"]:
            density = mass / (4 * half_width * half_height)
            shape = b2.shape_def(density=density, material=material, enable_contact_events=False)
            make = self.world.create_dynamic_body if moves else self.world.create_static_body
            body = make(position=(x, y), linear_velocity=(vx, vy), fixed_rotation=True,
                        enable_sleep=False)
            body.create_shape(shape, b2.box(half_width, half_height))
            if moves:
                self.moving.append(body)

    def step(self):
        self.world.step(self.dt, 4)

    def velocities(self):
        for body in self.moving:
            velocity = body.linear_velocity
            yield velocity.x, velocity.y


class Pymunk:
    """pymunk 7, as bench/peer_chipmunk.cpp sets up Chipmunk."""

    settings = "double; infinite moment; 10 iterations; slop 0; damping 1"

    def __init__(self, scene):
        import pymunk
        self.name = f"pymunk {pymunk.version}"
        self.dt = scene["dt"]
        self.space = pymunk.Space()
        self.space.gravity = tuple(scene["gravity"])
        self.space.collision_slop = 0
        self.moving = []
        for moves, x, y, half_width, half_height, vx, vy, mass in scene["bodies"]:
            if moves:
                body = pymunk.Body(mass, math.inf)
                body.velocity = (vx, vy)
                self.moving.append(body)
            else:
                body = pymunk.Body(body_type=pymunk.Body.STATIC)
            body.position = (x, y)
            shape = pymunk.Poly.create_box(body, (2 * half_width, 2 * half_height))
            shape.elasticity = math.sqrt(scene["restitution"])
            shape.friction = 0
            self.space.add(body, shape)

    def step(self):
        self.space.step(self.dt)

    def velocities(self):
        for body in self.moving:
            yield body.velocity


def main():
    if len(sys.argv) != 5 or sys.argv[1] not in ("box2d", "pymunk"):
        sys.exit(__doc__)
    with open(sys.argv[2], encoding="utf-8") as file:
        scene = json.load(file)
    steps, warmup = int(sys.argv[3]), int(sys.argv[4])
    engine = {"box2d": Box2d, "pymunk": Pymunk}[sys.argv[1]](scene)
    masses = [body[7] for body in scene["bodies"] if body[0]]

    def kinetic():
        return sum(m * (vx * vx + vy * vy) / 2 for m, (vx, vy) in zip(masses, engine.velocities()))

    before = kinetic()
    for _ in range(warmup):
        engine.step()
    start = time.process_time()
    for _ in range(steps):
        engine.step()
    milliseconds = 1e3 * (time.process_time() - start) / steps
    conserved = scene["restitution"] == 1 and not any(scene["gravity"]) and before > 0
    print(json.dumps({"name": engine.name, "settings": engine.settings,
                      "milliseconds": milliseconds,
                      "energy_drift": (kinetic() - before) / before if conserved else None}))


if __name__ == "__main__":
    main()
