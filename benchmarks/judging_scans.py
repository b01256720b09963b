"""How often the judge of scans says what the known truth, a person or the judge of the meshes says.

    python benchmarks/judging_scans.py [--count 24] [--seed 5] [--write] [--json FILE] [--cost 100]

Pairs of known truth (benchmarks/known_pairs.py), and replicas with every scalar off by 3 to 15 % of its Range, of the
final procedures of four categories. Each reference becomes a scan of two to five sides, 3,000 to 12,000 points and
noise of up to 0.8 % of the extent. The judge learns from chairs and shelves what the judge of meshes says of the same
replica and the whole mesh. It is measured on tables and beds, and on the pairs of vessels and houses in
../shared/data/pairs that were labelled by eye. --write writes
src/shapewright/judging/scans/weights.json. --cost times so many pairs.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path

import numpy as np
import torch
from sklearn.metrics import roc_auc_score

import shapewright as sw
from judging import by_eye, milliseconds
from known_pairs import _built, _of_procedure
from shapewright.comparison.scans.scan import Scan
from shapewright.judging.fidelity import Fidelity
from shapewright.judging.scans import likeness
from shapewright.judging.scans.shortfall import Shortfall, compare
from shapewright.prediction.scanning import random_scanner
from shapewright.settings import Settings
from shapewright.shapes import Mesh, Points

ROOT = Path(__file__).resolve().parents[1]
WEIGHTS = ROOT / "src" / "shapewright" / "judging" / "scans" / "weights.json"
LEARNED, MEASURED = ("chair", "shelf"), ("table", "bed")
GRADED = (0.03, 0.06, 0.1, 0.15)  # of the Ranges
HIDDEN, STEPS, RATE, DECAY = 8, 900, 1e-2, 0.5  # of the network; larger ones fit chairs better and tables worse
REPLICATED, CLOSE = Settings.replicated, Settings.close


@dataclass(frozen=True)
class Row:
    kind: str
    variant: str
    said: str  # "same" or "not" by the known truth, "graded", or G, P, W by eye
    mesh: float  # what the judge of meshes says of the replica and the whole mesh
    shortfall: Shortfall


def scan_of(mesh: Mesh, rng: np.random.Generator) -> Scan | None:
    try:
        return Scan.of(Points(random_scanner(rng).scan(mesh, rng).normalised().positions))
    except ValueError:
        return None


def variants(category: str, count: int, seed: int) -> Iterator[tuple[str, str, str, Mesh, Mesh]]:
    """Variant, what is said, the reference's name, reference and replica."""
    path = sorted((ROOT / "examples" / "categories" / category).glob("v*.py"))[-1]
    procedure = sw.load_procedure(path)
    space, rng = procedure.space, np.random.default_rng(seed)
    for pair in _of_procedure(path, count, seed):
        yield pair.variant, "same" if pair.same else "not", pair.shape, pair.reference, pair.replica
    for number, values in enumerate(space.sample(count, seed=seed + 1)):
        if (mesh := _built(procedure, values)) is None:
            continue
        for size in GRADED:
            vector = space.encode(values)
            moved = np.clip(vector + rng.uniform(-size, size, len(vector)), 0.0, 1.0)
            replica = _built(procedure, space.decode(np.where(space.scalars, moved, vector)))
            if replica is not None and len(replica.faces):
                yield f"scalars {size:g} off", "graded", f"graded {number}", mesh, replica


def rows_of(kind: str, pairs: Iterator[tuple[str, str, str, Mesh, Mesh]], seed: int) -> list[Row]:
    rng, last, rows = np.random.default_rng([seed, 3]), "", []
    scan: Scan | None = None
    for variant, said, name, reference, replica in pairs:
        if name != last:
            last, scan, judge = name, scan_of(reference, rng), Fidelity(reference)
        if scan is not None:
            rows.append(Row(kind, variant, said, judge.value(replica), compare(scan, replica).shortfall))
    return [row for row in rows if np.isfinite(row.mesh)]


def learn(rows: list[Row], seed: int = 0) -> dict[str, np.ndarray]:
    """The weights of ``likeness``: a network that says what the judge of the meshes says."""
    torch.manual_seed(seed)
    torch.set_num_threads(1)
    x = np.array([likeness.features(row.shortfall) for row in rows])
    mean, spread = x.mean(axis=0), x.std(axis=0) + 1e-9
    wanted = torch.tensor([row.mesh for row in rows], dtype=torch.float64)
    # As much weight for what is replicated as for what is not: the cuts are among them.
    good = np.array([row.mesh >= REPLICATED for row in rows])
    each = torch.tensor(np.where(good, 0.5 / good.mean(), 0.5 / (~good).mean()))
    net = torch.nn.Sequential(torch.nn.Linear(x.shape[1], HIDDEN), torch.nn.Tanh(), torch.nn.Linear(HIDDEN, 1)).double()
    optimiser = torch.optim.AdamW(net.parameters(), RATE, weight_decay=DECAY)
    inputs = torch.tensor((x - mean) / spread)
    for _ in range(STEPS):
        optimiser.zero_grad()
        logits = net(inputs + 0.1 * torch.randn_like(inputs))[:, 0]
        torch.nn.functional.binary_cross_entropy_with_logits(logits, wanted, each).backward()
        optimiser.step()
    hidden, _, out = net
    names = ("hidden", "hidden_bias", "out", "out_bias")
    arrays = (hidden.weight, hidden.bias, out.weight[0], out.bias)
    found = dict(zip(names, (a.detach().numpy() for a in arrays), strict=True))
    return {"mean": mean, "spread": spread, **found}


def seen(row: Row) -> bool:
    """Whether what is known to differ differs to the judge of the meshes, who sees all of it."""
    return row.said != "not" or row.mesh < REPLICATED


def balanced(yes: np.ndarray, said: np.ndarray) -> float:
    return float((yes[said].mean() + (~yes[~said]).mean()) / 2.0) if said.any() and not said.all() else float("nan")


def report(rows: list[Row], weights: dict[str, np.ndarray]) -> dict[str, dict[str, float]]:
    table: dict[str, dict[str, float]] = {}
    values = np.array([likeness.likeness(row.shortfall, weights) for row in rows])
    mesh = np.array([row.mesh for row in rows])
    gap, said = np.array([row.shortfall.gap for row in rows]), np.array([row.said for row in rows])
    kinds = np.array([row.kind for row in rows])
    for kind in sorted(set(kinds)):
        own = kinds == kind
        known = own & np.isin(said, ["same", "not"]) & np.array([seen(row) for row in rows])
        found = {
            "pairs": int(own.sum()),
            "as the mesh's judge": balanced(values[own] >= REPLICATED, mesh[own] >= REPLICATED),
        }
        found["replicated"] = int((values[own] >= REPLICATED).sum())
        found["replicated by the mesh's judge"] = int((mesh[own] >= REPLICATED).sum())
        if known.any():
            same = said[known] == "same"
            found["known truth"] = balanced(values[known] >= REPLICATED, same)
            found["known truth by the mesh's judge"] = balanced(mesh[known] >= REPLICATED, same)
            found["known truth by the distance"] = max(
                balanced(gap[known] <= cut, same) for cut in np.quantile(gap[known], np.linspace(0.02, 0.98, 49))
            )
        eyed = own & np.isin(said, list("GPW"))
        if eyed.any():
            for title, good in (("good against wrong", "G"), ("not wrong against wrong", "GP")):
                used = eyed & np.isin(said, [*good, "W"])
                right = np.isin(said[used], list(good))
                found[f"{title}, AUC"] = float(roc_auc_score(right, values[used]))
                found[f"{title}, AUC of the mesh's judge"] = float(roc_auc_score(right, mesh[used]))
                found[f"{title}, balanced"] = balanced(values[used] >= (REPLICATED + CLOSE) / 2.0, right)
        table[kind] = found
        print(
            kind,
            " ".join(
                f"{name}: {value:.3f}" if isinstance(value, float) else f"{name}: {value},"
                for name, value in found.items()
            ),
        )
        variant = np.array([row.variant for row in rows])
        for name in sorted(set(variant[own]) if not eyed.any() else ()):
            some = own & (variant == name)
            shares = [float((each[some] >= REPLICATED).mean()) for each in (values, mesh)]
            low = float((values[some] < CLOSE).mean())
            print(f"  {name:18} {some.sum():4} pairs, replicated {shares[0]:.3f} (mesh {shares[1]:.3f}), {low:.3f} not")
    return table


def cost(count: int, seed: int) -> None:
    rng, times, whole = np.random.default_rng(seed), [], []
    for _, _, _, reference, replica in list(variants("chair", 4, seed))[:count]:
        if (scan := scan_of(reference, rng)) is None:
            continue
        judge = Fidelity(reference)
        times.append(milliseconds(partial(compare, scan), replica))
        whole.append(milliseconds(judge.value, replica))
    print(f"ms of CPU a pair: mean {np.mean(times):.1f}, 95 % within {np.quantile(times, 0.95):.1f}")
    print(f"the judge of meshes: mean {np.mean(whole):.1f}, 95 % within {np.quantile(whole, 0.95):.1f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=24)
    parser.add_argument("--seed", type=int, default=5)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--eye", type=int, default=1, help="of the pairs that were labelled by eye take one in so many")
    parser.add_argument("--cost", type=int, default=0)
    parser.add_argument("--rows", type=Path, help="keep the rows in this file, or take them from it")
    arguments = parser.parse_args()
    if arguments.cost:
        cost(arguments.cost, arguments.seed)
        return
    if arguments.rows and arguments.rows.exists():
        kept = json.loads(arguments.rows.read_text(encoding="utf-8"))
        rows = [Row(**{**row, "shortfall": Shortfall(**row["shortfall"])}) for row in kept]
    else:
        rows = []
        for category in (*LEARNED, *MEASURED):
            rows += rows_of(category, variants(category, arguments.count, arguments.seed), arguments.seed)
        eye = [pair for pair in by_eye() if pair[0] in ("vessel", "house")][:: arguments.eye]
        for kind in sorted({pair[0] for pair in eye}):
            own = ((("eye", label, name + str(i), a, b)) for i, (k, label, name, a, b) in enumerate(eye) if k == kind)
            rows += rows_of(kind, own, arguments.seed)
        if arguments.rows:
            arguments.rows.write_text(json.dumps([asdict(row) for row in rows]), encoding="utf-8")
    weights = learn([row for row in rows if row.kind in LEARNED])
    table = report(rows, weights)
    if arguments.json:
        arguments.json.write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    if arguments.write:
        rounded = {name: np.round(values, 4).tolist() for name, values in weights.items()}
        WEIGHTS.write_text(json.dumps(rounded, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
