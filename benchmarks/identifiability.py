"""How far each parameter shows in the pictures that the network sees: python benchmarks/identifiability.py FILE.py ...

Of random samples, each active scalar is changed by 5 % of its Range and each active other parameter to every other
level. The change of the pictures (both channels of three views, 1 from black to white, exact coverage of pixels) is the
root of the sum of squares; "alone" is what is left when the other scalars are moved to make up for it, to first order
and by a third of their Range at most. A row a parameter: the median of both, what nine samples in ten and 98 in 100
exceed alone, and the share of samples where it is faint: less than FAINT alone.
"""

import argparse

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from shapewright import Infeasible, Mesh, Procedure, load_procedure
from shapewright.parameters import Parameters
from shapewright.rendering.raster import render

STEP, REACH = 0.05, 0.33
FAINT = {True: 0.3, False: 1.5}  # of a scalar, of another parameter
SUPERSAMPLE = 8


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("procedures", nargs="+")
    parser.add_argument("-n", "--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--examples", type=int, default=0, help="print so many of the faintest samples")
    arguments = parser.parse_args()
    for path in arguments.procedures:
        report(path, load_procedure(path), arguments.count, arguments.seed, arguments.examples)


def report(path: str, procedure: Procedure, count: int, seed: int, examples: int) -> None:
    """Print the rows of one procedure."""
    found: dict[str, list[tuple[float, float, Parameters]]] = {name: [] for name in procedure.space.names}
    for values in procedure.space.sample(count, seed=seed):
        mesh = built(procedure, values)
        if mesh is not None:
            for name, change, alone, to in changes(procedure, values, mesh):
                shown = {key: values[key] for key in procedure.space.active(values)}
                found[name].append((alone, change, {**shown, name: f"{_spelt(values[name])} -> {to}"}))
    print(f"{path:<22}{'n':>6}{'change':>9}{'alone':>8}{'9 in 10':>9}{'98 in 100':>11}{'faint':>8}")
    for name, rows in found.items():
        is_scalar = procedure.space[name].classes == 0
        alone, change = np.array([row[:2] for row in rows]).T if rows else np.zeros((2, 1))
        faint = (alone < FAINT[is_scalar]).mean()
        print(
            f"  {name:<20}{len(rows):>6}{np.median(change):>9.2f}{np.median(alone):>8.2f}"
            f"{np.quantile(alone, 0.1):>9.2f}{np.quantile(alone, 0.02):>11.2f}{faint:>8.1%}"
        )
        for value, _, example in sorted(rows, key=lambda row: row[0])[:examples]:
            print(f"      {value:.2f}: {', '.join(f'{k}={_spelt(v)}' for k, v in example.items())}")


def changes(procedure: Procedure, values: Parameters, mesh: Mesh) -> list[tuple[str, float, float, object]]:
    """Of one sample: parameter, change of the pictures, what the scalars cannot make up for, and the other value."""
    space, rows = procedure.space, []
    variants: list[tuple[str, object, Parameters]] = []
    for name in space.active(values):
        parameter = space[name]
        if parameter.classes:
            others = [level for level in parameter.levels or () if level != values[name]]
            variants += [(name, level, space.canonical({**values, name: level})) for level in others]
        else:
            at = parameter.encode(values[name])
            to = at + STEP if at <= 1.0 - STEP else at - STEP
            moved = parameter.decode(to)
            variants.append((name, _spelt(moved), {**values, name: moved}))
    tried = [built(procedure, other) for _, _, other in variants]
    made = [(variant, shape) for variant, shape in zip(variants, tried, strict=True) if shape is not None]
    shapes = [mesh.normalised(), *(shape.normalised() for _, shape in made)]
    pictures = render(shapes, supersample=SUPERSAMPLE, threads=1) / 255.0
    deltas = (pictures[1:] - pictures[0]).reshape(len(made), -1)
    products = deltas @ deltas.T
    slopes = {variant[0]: i for i, (variant, _) in enumerate(made) if not space[variant[0]].classes}
    for i, ((name, to, _), _) in enumerate(made):
        alone = remainder(products, i, [j for other, j in slopes.items() if other != name])
        rows.append((name, float(np.sqrt(products[i, i])), alone, to))
    return rows


def remainder(products: NDArray[np.float64], i: int, others: list[int]) -> float:
    """The length of vector i less the combination of others, each at most REACH of its Range, that comes nearest."""
    size = products[i, i]
    if not others or size == 0.0:
        return float(np.sqrt(size))
    inner, with_i = products[np.ix_(others, others)], products[others, i]
    root = np.linalg.cholesky(inner + 1e-9 * np.eye(len(others)))
    shares = lsq_linear(root.T, np.linalg.solve(root, with_i), (-REACH / STEP, REACH / STEP)).x
    return float(np.sqrt(max(size - 2.0 * shares @ with_i + shares @ inner @ shares, 0.0)))


def _spelt(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def built(procedure: Procedure, values: Parameters) -> Mesh | None:
    try:
        shape = procedure(**values)
    except Infeasible:
        return None
    assert isinstance(shape, Mesh)
    return shape


if __name__ == "__main__":
    main()
