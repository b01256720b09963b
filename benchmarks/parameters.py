"""Error of the parameters found for shapes that another implementation built from known ones.

    python benchmarks/parameters.py ../shared/data/parameters [--seed 0]

Fits examples/tables v1 to v3; a row for the network alone and one after refinement: mean absolute error of each scalar
(normalised to its Range), F1 of the others; seconds of the whole fit.
"""

import argparse
import time
from pathlib import Path

import numpy as np

import shapewright as sw
from shapewright.parameters import Prediction
from shapewright.prediction.inference import score

TABLES = Path(__file__).resolve().parents[1] / "examples" / "tables"


def known(path: Path, space: sw.ParameterSpace) -> tuple[list[sw.Mesh], list[dict]]:
    """The shapes of a file and their parameters, each vector once."""
    data = np.load(path)
    vertices, faces = data["vertex_offsets"], data["face_offsets"]
    unique = {}
    for i in range(len(vertices) - 1):
        vector = tuple(data[name][i].item() for name in space.names)
        mesh = sw.Mesh(data["vertices"][vertices[i] : vertices[i + 1]], data["faces"][faces[i] : faces[i + 1]])
        unique.setdefault(vector, mesh)
    return list(unique.values()), [dict(zip(space.names, vector, strict=True)) for vector in unique]


def print_errors(title: str, prediction: Prediction, targets: np.ndarray) -> None:
    metrics = score(prediction, targets, np.ones(targets.shape, dtype=bool))
    errors = [m["mae"] for m in metrics.values() if "mae" in m]
    cells = "  ".join(f"{name} {m.get('mae', m.get('f1')):.4f}" for name, m in metrics.items())
    print(f"    {title:9} mean scalar error {np.mean(errors):.4f}  |  {cells}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    for version in ("v1", "v2", "v3"):
        procedure = sw.load_procedure(TABLES / f"{version}.py")
        space = procedure.space
        meshes, truth = known(arguments.folder / f"tables_{version}.npz", space)
        references = sw.Collection.of({f"{i:04d}": mesh for i, mesh in enumerate(meshes)})
        started = time.perf_counter()
        iteration = sw.fit(procedure, references, sw.Settings(seed=arguments.seed))
        seconds = time.perf_counter() - started
        targets = np.array([space.encode(vector) for vector in truth], dtype=np.float32)
        refined = Prediction.of(space, [iteration[name].parameters for name in references.names])
        stages = ", ".join(f"{name} {iteration.seconds[name]:.0f}" for name in ("train", "refine"))
        print(f"{version}  {len(meshes)} shapes, {len(iteration.compatible)} compatible, {seconds:.0f} s ({stages})")
        print_errors("network", iteration.predictor.infer(meshes), targets)
        print_errors("refined", refined, targets)


if __name__ == "__main__":
    main()
