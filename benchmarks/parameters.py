"""Error of predicted parameters on shapes that another implementation built from known ones.

    python benchmarks/parameters.py ../shared/data/parameters

Trains on examples/tables v1 to v3; one row a version: mean absolute error of each scalar (normalised to its Range),
F1 of the others, seconds to train and to predict.
"""

import argparse
import time
from pathlib import Path

import numpy as np

import shapewright as sw
from shapewright.prediction.evaluation import score

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


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    for version in ("v1", "v2", "v3"):
        procedure = sw.load_procedure(TABLES / f"{version}.py")
        meshes, truth = known(arguments.folder / f"tables_{version}.npz", procedure.space)
        started = time.perf_counter()
        predictor = sw.train(procedure, sw.Settings(seed=arguments.seed))
        trained = time.perf_counter()
        inferred = predictor.infer(meshes)
        predicted = time.perf_counter()
        targets = np.array([procedure.space.encode(vector) for vector in truth], dtype=np.float32)
        metrics = score(procedure.space, inferred, targets, np.ones(targets.shape, dtype=bool))
        errors = [m["mae"] for m in metrics.values() if "mae" in m]
        cells = "  ".join(f"{name} {m.get('mae', m.get('f1')):.4f}" for name, m in metrics.items())
        print(f"{version}  {len(meshes)} shapes  mean scalar error {np.mean(errors):.4f}  |  {cells}")
        print(f"    {trained - started:.0f} s to train, {predicted - trained:.2f} s to predict", flush=True)


if __name__ == "__main__":
    main()
