"""The light field distance: agreement with the original program, seconds, and growth.

    python benchmarks/light_field.py [--large]

Seconds are the best of several runs on one thread, unless a number of threads is named. The original took 2.7 s of CPU
for a descriptor and 6.5 ms for a pair. Agreement needs the original's figures in ../shared/data/lfd, and is left out
where they are absent; --large adds 5,000 shapes.
"""

from __future__ import annotations

import argparse
import resource
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import trimesh
from scipy.spatial.transform import Rotation
from scipy.stats import spearmanr

from shapewright.comparison import light_field
from shapewright.comparison.light_field import Descriptor, descriptor, descriptors, distance, raw_distances
from shapewright.comparison.light_field.dodecahedra import symmetries
from shapewright.shapes import Mesh

GROUND_TRUTH = Path(__file__).resolve().parents[1].parent / "shared" / "data" / "lfd"
ORIGINAL_DESCRIPTOR, ORIGINAL_PAIR = 2.7, 6.5e-3
COMPATIBLE = light_field.THRESHOLD * light_field.RAW_SCALE
SPHERES = ((5, 2), (10, 6), (25, 21), (40, 26), (100, 51), (250, 201), (1000, 501))  # 10 to a million triangles


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--large", action="store_true", help="describe 5,000 shapes and measure all their distances")
    large = parser.parse_args().large
    if GROUND_TRUTH.is_dir():
        agreement()
    seconds_per_descriptor()
    shapes = [waves(seed) for seed in range(200)]
    described = descriptors(shapes)
    seconds_per_pair(described)
    growth(described)
    if large:
        many()
    print(f"peak memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20:.2f} GB")


def waves(seed: int, segments: int = 40, stacks: int = 26) -> Mesh:
    """A ball with random waves on it, of 2 * segments * (stacks - 1) triangles."""
    rng = np.random.default_rng(seed)
    azimuth, polar = np.meshgrid(
        np.linspace(0.0, 2.0 * np.pi, segments, endpoint=False), np.linspace(0.0, np.pi, stacks + 1)
    )
    around, along = rng.integers(1, 5, size=2)
    radius = (
        1.0 + 0.3 * np.sin(around * azimuth + rng.uniform(0.0, 6.0)) * np.sin(polar) ** 2 + 0.3 * np.cos(along * polar)
    )
    directions = np.stack([np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)], axis=-1)
    vertices = radius[..., None] * directions * rng.uniform(0.4, 1.0, size=3)
    corner = np.arange(stacks * segments).reshape(stacks, segments)
    ahead = np.roll(corner, -1, axis=1)
    upper = np.stack([corner, ahead, corner + segments], axis=-1)[1:]
    lower = np.stack([ahead, ahead + segments, corner + segments], axis=-1)[:-1]
    return Mesh(vertices.reshape(-1, 3), np.concatenate([upper, lower]).reshape(-1, 3))


def agreement() -> None:
    original = np.load(GROUND_TRUTH / "original.npz")
    loaded = [trimesh.load(GROUND_TRUTH / "meshes" / f"{name}.ply", process=False) for name in original["names"]]
    meshes = [Mesh(mesh.vertices, mesh.faces) for mesh in loaded]
    pairs = np.triu_indices(len(meshes), 1)
    print(f"agreement with the original: {len(meshes)} meshes, {len(pairs[0])} pairs")
    for bits, suffix in ((4, ""), (8, "_8bit")):
        ours = descriptors(meshes, bits=bits)
        known, found = original["distances" + suffix][pairs], raw_distances(ours)[pairs]
        error = np.abs(found - known) / known
        print(
            f"  {bits}-bit ART: Spearman {spearmanr(known, found).statistic:.8f}, equal {np.mean(found == known):.1%}"
        )
        print(f"    relative error: median {np.median(error):.3%}, mean {error.mean():.4%}, maximum {error.max():.3%}")
        fields = np.split(np.stack([each.coefficients for each in ours]), [35, 45, 46], axis=-1)
        for key, field in zip(("art" + suffix, "fourier", "circularity", "eccentricity"), fields, strict=True):
            different = int((field.squeeze() != original[key]).sum())
            print(f"    {key}: {different} of {original[key].size} coefficients differ")
        if bits == 4:
            alike = np.mean((known <= COMPATIBLE) == (found <= COMPATIBLE))
            upright = raw_distances(ours, align="upright")[pairs]
            ratio = upright / found
            print(f"    compatible: {np.mean(known <= COMPATIBLE):.1%} of the pairs, {alike:.2%} decided alike")
            print(f"    upright over free: median {np.median(ratio):.3f}, most {ratio.max():.2f}")
            print(f"    compatible upright: {np.mean(upright <= COMPATIBLE):.1%} of the pairs")
    invariance(meshes)
    seconds = [best_of(3, lambda mesh=mesh: descriptor(mesh)) for mesh in meshes]
    faces = [len(mesh.faces) for mesh in meshes]
    print(f"  a descriptor ({min(faces)} to {max(faces)} triangles), ms and how many times as long the original takes:")
    for name, value in (("median", np.median(seconds)), ("longest", max(seconds))):
        print(f"    {name:9s} {value * 1e3:6.1f} {ORIGINAL_DESCRIPTOR / value:6.0f}")


def invariance(meshes: list[Mesh]) -> None:
    """Raw distances of shapes to themselves, moved: what rasterisation adds to a distance that should be 0."""
    rng = np.random.default_rng(0)
    around, other = np.eye(4), np.eye(4)
    around[:3, :3], other[:3, :3] = symmetries()[17], Rotation.random(random_state=0).as_matrix()
    motions = {
        "scaled by 3.7": lambda mesh: Mesh(mesh.vertices * 3.7, mesh.faces),
        "shifted": lambda mesh: Mesh(mesh.vertices + rng.uniform(-10.0, 10.0, 3), mesh.faces),
        "rotated by one of the 60": lambda mesh: mesh.transformed(around),
        "rotated at random": lambda mesh: mesh.transformed(other),
    }
    print(f"raw distance of {len(meshes)} shapes to themselves ({COMPATIBLE:.0f} is the threshold): median, most")
    for name, move in motions.items():
        raw = [light_field.raw_distance(mesh, move(mesh)) for mesh in meshes]
        print(f"  {name:25s} {np.median(raw):6.0f} {max(raw):6d}")


def seconds_per_descriptor() -> None:
    print("a descriptor by triangles, ms and how many times as long the original takes")
    for segments, stacks in SPHERES:
        mesh = waves(0, segments, stacks)
        seconds = best_of(3 if len(mesh.faces) > 10_000 else 10, lambda mesh=mesh: descriptor(mesh))
        print(f"  {len(mesh.faces):9,d} {seconds * 1e3:8.1f} {ORIGINAL_DESCRIPTOR / seconds:6.0f}")


def seconds_per_pair(described: list[Descriptor]) -> None:
    print("a pair, microseconds and how many times as long the original takes")
    for align in ("free", "upright"):
        alone = best_of(200, lambda align=align: distance(described[0], described[1], align))
        row = best_of(10, lambda align=align: raw_distances(described[:1], described, align, threads=1))
        for how, seconds in (("alone", alone), ("in a row of 200", row / len(described))):
            print(f"  {align:8s} {how:16s} {seconds * 1e6:6.1f} {ORIGINAL_PAIR / seconds:6.0f}")


def growth(described: list[Descriptor]) -> None:
    print("a matrix: shapes, threads, seconds, microseconds a pair")
    for count in (25, 50, 100, 200):
        for threads in (1, 2):
            seconds = best_of(5, lambda n=count, t=threads: raw_distances(described[:n], threads=t))
            print(f"  {count:4d} {threads:2d} {seconds:8.3f} {seconds / (count * (count - 1) / 2) * 1e6:6.1f}")


def many(count: int = 5000) -> None:
    start = time.perf_counter()
    described = descriptors(waves(seed) for seed in range(count))
    between = time.perf_counter()
    raw_distances(described)
    end = time.perf_counter()
    print(f"{count} shapes, all cores: descriptors {between - start:.0f} s, matrix {end - between:.0f} s")


def best_of(runs: int, function: Callable[[], object]) -> float:
    """Seconds of the fastest run, after one that is not counted."""
    function()
    seconds = []
    for _ in range(runs):
        start = time.perf_counter()
        function()
        seconds.append(time.perf_counter() - start)
    return min(seconds)


if __name__ == "__main__":
    main()
