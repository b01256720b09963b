"""How often the judge says what a person or the known truth says; and what it learns that from.

    python benchmarks/judging.py [--count 16] [--seed 5] [--write] [--measures 4]
    python benchmarks/judging.py --cost 60

Pairs of known truth are made (benchmarks/known_pairs.py); pairs labelled by eye are read from ../shared/data/pairs and,
where the references are at hand, made from benchmarks/eye_labels.csv. What is reported was learned without the family
(known truth) or the kind (by eye) that it is measured on. --write learns from all of them and writes
src/shapewright/judging/weights.json. --measures compares other measures, on so many shapes a procedure. --cost says
instead what a pair takes of CPU time, on so many pairs a kind.
"""

from __future__ import annotations

import argparse
import csv
import json
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import roc_auc_score

import shapewright as sw
from known_pairs import GROSS, SAME, pairs
from shapewright.comparison import light_field, volumes
from shapewright.comparison.gaps import Surface
from shapewright.judging import opinion
from shapewright.judging.differences import Differences, Look, compare
from shapewright.judging.fidelity import Fidelity
from shapewright.settings import Settings
from shapewright.shapes import Mesh

ROOT = Path(__file__).resolve().parents[1]
SHARED = ROOT.parent / "shared" / "data"
LABELS = ROOT / "benchmarks" / "eye_labels.csv"
WEIGHTS = ROOT / "src" / "shapewright" / "judging" / "weights.json"
HIDDEN, STEPS, RATE, DECAY = 12, 900, 1e-2, 0.05  # of the network: small, since few kinds are at hand
REGULAR = 0.3  # of the regressions, scikit-learn's C
STRUCTURE = {"choice", "scalar", "part added", "part dropped"}  # what may stand out beside an exact rest


@dataclass(frozen=True, eq=False)
class Row:
    kind: str  # the family or kind that is left out
    said: str  # G, P, W by eye; "same" or "not" by the known truth
    variant: str
    name: str
    differences: Differences


def known(count: int, seed: int) -> list[Row]:
    rows, last = [], ("", None)
    for pair in pairs(count, seed):
        if last[0] != pair.shape:
            last = pair.shape, Look.of(pair.reference)
        found = compare(last[1], Look.of(pair.replica))[0]
        rows.append(Row(pair.family, "same" if pair.same else "not", pair.variant, pair.shape, found))
    return rows


def seen(row: Row) -> bool:
    """Whether the pictures differ at all: in a pixel of three hundred, or a thousandth of the surface is off."""
    d = row.differences
    return row.said != "not" or d.depth >= 0.003 or d.outline >= 0.002 or max(d.far_missing, d.far_surplus) > 0.001


def by_eye() -> Iterator[tuple[str, str, str, Mesh, Mesh]]:
    """Kind, label, name, reference and replica."""
    for path in sorted((SHARED / "pairs").glob("*.npz")):
        data = np.load(path, allow_pickle=True)
        for i, label in enumerate(data["label"]):
            yield path.stem, str(label), str(data["name"][i]), *(_mesh(data, side, i) for side in ("ref", "rep"))
    if not (SHARED / "references").is_dir():
        return
    with LABELS.open(encoding="utf-8") as file:
        for line in csv.DictReader(file):
            folder = SHARED / "references" / line["collection"]
            reference = next(iter(sw.Collection.load(folder / f"{line['reference']}.ply", up="y"))).shape
            replica = sw.load_procedure(ROOT / line["procedure"])(**json.loads(line["parameters"]))
            yield line["collection"].split("/")[0], line["label"], line["reference"], reference, replica


def _mesh(data: Any, side: str, i: int) -> Mesh:
    vertices, faces = (slice(*data[f"{side}_{what}_offset"][i : i + 2]) for what in ("vertex", "face"))
    return Mesh(data[f"{side}_vertices"][vertices].astype(float), data[f"{side}_faces"][faces])


def balanced(weights: np.ndarray, *parts: np.ndarray) -> np.ndarray:
    """Weights with which each of some sets (masks) counts the same."""
    out = weights.astype(float).copy()
    for part in parts:
        out[part] /= max(out[part].sum(), 1e-9)
    return out * len(out) / out.sum()


def learn(truth: list[Row], eye: list[Row], seed: int = 0) -> dict[str, np.ndarray]:
    """The weights of ``opinion``: see there."""
    x = np.array([opinion.features(row.differences) for row in (*truth, *eye)])
    said = np.array([row.said for row in (*truth, *eye)])
    mean, spread = x.mean(axis=0), x.std(axis=0) + 1e-9
    x = (x - mean) / spread
    labelled = np.isin(said, list("GPW"))
    weights = {"mean": mean, "spread": spread}
    kinds = np.array([row.kind for row in eye])
    for name, good in (("good", "G"), ("passable", "GP")):
        y = np.isin(said[labelled], list(good))
        each = balanced(
            np.ones(len(y)), *(((kinds == k) & (y == v)) for k in sorted(set(kinds)) for v in (True, False))
        )
        fitted = LogisticRegression(C=REGULAR).fit(x[labelled][:, :2], y, sample_weight=each)
        weights[name] = np.array([fitted.intercept_[0], *fitted.coef_[0]])
    variant = np.array([row.variant for row in (*truth, *eye)])
    used = np.isin(variant, [*SAME, *STRUCTURE]) | (said == "G")
    y = np.isin(said[used], ["same", "G"])
    sets = said[used] == "same", said[used] == "not", said[used] == "G"
    each = balanced(np.ones(len(y)), *sets)
    return weights | _network(x[used], y, each, seed)


def _network(x: np.ndarray, y: np.ndarray, each: np.ndarray, seed: int) -> dict[str, np.ndarray]:
    torch.manual_seed(seed)
    torch.set_num_threads(1)
    net = torch.nn.Sequential(torch.nn.Linear(x.shape[1], HIDDEN), torch.nn.Tanh(), torch.nn.Linear(HIDDEN, 1)).double()
    optimiser = torch.optim.AdamW(net.parameters(), RATE, weight_decay=DECAY)
    inputs, wanted, weights = (torch.tensor(np.asarray(a, dtype=float)) for a in (x, y, each))
    for _ in range(STEPS):
        optimiser.zero_grad()
        logits = net(inputs + 0.1 * torch.randn_like(inputs))[:, 0]
        loss = torch.nn.functional.binary_cross_entropy_with_logits(logits, wanted, weights)
        loss.backward()
        optimiser.step()
    hidden, _, out = net
    arrays = hidden.weight, hidden.bias, out.weight[0], out.bias
    return dict(zip(("hidden", "hidden_bias", "out", "out_bias"), (a.detach().numpy() for a in arrays), strict=True))


def opinions(weights: dict[str, np.ndarray], rows: list[Row]) -> np.ndarray:
    return np.array([opinion.opinion(row.differences, weights) for row in rows])


def left_out(truth: list[Row], eye: list[Row]) -> tuple[np.ndarray, np.ndarray]:
    """Opinions of both, each learned without its own family or kind."""
    of_truth, of_eye = np.empty(len(truth)), np.empty(len(eye))
    for rows, values, parts in ((truth, of_truth, "truth"), (eye, of_eye, "eye")):
        for kind in sorted({row.kind for row in rows}):
            rest = [row for row in rows if row.kind != kind]
            weights = learn(rest, eye) if parts == "truth" else learn(truth, rest)
            own = [i for i, row in enumerate(rows) if row.kind == kind]
            values[own] = opinions(weights, [rows[i] for i in own])
    return of_truth, of_eye


def accuracy(yes: np.ndarray, said: np.ndarray) -> float:
    """Balanced: the mean of the shares that are right, of either kind."""
    return float((yes[said].mean() + (~yes[~said]).mean()) / 2.0)


def report(truth: list[Row], eye: list[Row]) -> None:
    of_truth, of_eye = left_out(truth, eye)
    same = np.array([row.said == "same" for row in truth])
    found = accuracy(of_truth >= Settings.replicated, same)
    print(f"known truth, families left out: balanced accuracy {found:.3f} of {len(truth)} pairs")
    by = defaultdict(list)
    for row, value in zip(truth, of_truth, strict=True):
        by[row.variant].append(value)
    for variant, values in sorted(by.items()):
        print(f"  {variant:18} {shares(np.array(values))}")
    label, kinds = np.array([row.said for row in eye]), np.array([row.kind for row in eye])
    for kind in ("", *sorted(set(kinds))):
        own = kinds == kind if kind else kinds != ""
        print(f"{kind or 'by eye, kinds left out'}:")
        middle = (Settings.replicated + Settings.close) / 2.0
        for title, good, cut in (("good", "G", middle), ("not wrong", "GP", Settings.close)):
            used = own & np.isin(label, [*good, "W"])
            said, values = np.isin(label[used], list(good)), of_eye[used]
            auc, right = roc_auc_score(said, values), accuracy(values >= cut, said)
            print(f"  {title} against wrong: AUC {auc:.3f}, balanced accuracy {right:.3f} of {used.sum()}")
        counted = Counter(label[own & (of_eye >= Settings.replicated)].tolist())
        total, good = sum(counted.values()), int((label[own] == "G").sum())
        print(f"  replicated {total} of {own.sum()} {dict(counted)}, good by eye {good}")


def shares(values: np.ndarray) -> str:
    grades = np.mean(values >= Settings.replicated), np.mean(values < Settings.close)
    return f"{len(values):5} pairs, replicated {grades[0]:.3f}, different {grades[1]:.3f}"


def measures(count: int, seed: int) -> None:
    """The best balanced accuracy of single measures on known truth."""
    table, same, last = defaultdict(list), [], ("",)
    for pair in pairs(count, seed):
        a, b = pair.reference, pair.replica
        if last[0] != pair.shape:
            last = pair.shape, light_field.descriptor(a), Surface(a, 0), volumes.Volume.of(a)
        gaps, volume = last[2].gaps(Surface(b, 0)), volumes.intersection_over_union(last[3], volumes.Volume.of(b))
        table["light-field distance"].append(light_field.distance(last[1], light_field.descriptor(b)))
        table["Chamfer distance"].append(gaps.chamfer)
        table["F-score at 2 %"].append(-gaps.f_score(0.02))
        table["volumetric IoU"].append(-np.nan_to_num(volume))
        same.append(pair.same)
    said = np.array(same)
    paper = accuracy(np.array(table["light-field distance"]) <= Settings.threshold, said)
    print(f"light-field distance at most {Settings.threshold}: {paper:.3f} of {len(said)} pairs, unseen ones too")
    for name, column in table.items():
        values = np.array(column)
        cuts = np.quantile(values, np.linspace(0.02, 0.98, 97))
        print(f"{name}, the best cut in sample: {max(accuracy(values <= cut, said) for cut in cuts):.3f}")


def cost(count: int, seed: int) -> None:
    """The references are described before; a time is the least of five."""
    kinds = defaultdict(list)
    for kind, _, _, reference, replica in by_eye():
        kinds[kind].append((reference, replica))
    chair = sw.load_procedure(sorted(ROOT.glob("examples/categories/chair/v*.py"))[-1])
    chairs = [chair(**parameters) for parameters in chair.space.sample(2 * count, seed)]
    kinds["unlike chairs"] = list(zip(chairs[::2], chairs[1::2], strict=True))
    print("milliseconds of CPU a pair: mean, 95 % within; alone, with regions")
    for kind, found in kinds.items():
        rows = []
        for reference, replica in found[:: max(1, len(found) // count)]:
            judge = Fidelity(reference)
            rows.append([milliseconds(judge.value, replica), milliseconds(judge.evidence, replica)])
        alone, whole = ((np.mean(column), np.quantile(column, 0.95)) for column in zip(*rows, strict=True))
        print(f"{kind:14} {len(rows):4} pairs  {alone[0]:5.2f} {alone[1]:5.2f}  {whole[0]:5.2f} {whole[1]:5.2f}")


def milliseconds(judge: Callable[[Mesh], object], replica: Mesh) -> float:
    judge(replica)
    least = np.inf
    for _ in range(5):
        started = time.thread_time()
        judge(replica)
        least = min(least, time.thread_time() - started)
    return 1000.0 * least


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=16)
    parser.add_argument("--seed", type=int, default=5)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--measures", type=int, default=0)
    parser.add_argument("--cost", type=int, default=0)
    arguments = parser.parse_args()
    if arguments.cost:
        cost(arguments.cost, arguments.seed)
        return
    everything = known(arguments.count, arguments.seed)
    truth = [row for row in everything if seen(row)]
    print(f"{len(everything)} pairs of known truth; {len(everything) - len(truth)} that differ cannot be seen")
    eye = [Row(kind, label, "", name, compare(Look.of(a), Look.of(b))[0]) for kind, label, name, a, b in by_eye()]
    if eye:
        report(truth, eye)
        if arguments.write:
            learned = {name: np.round(values, 4).tolist() for name, values in learn(truth, eye).items()}
            WEIGHTS.write_text(json.dumps(learned, indent=1) + "\n", encoding="utf-8")
    values = np.array([opinion.opinion(row.differences) for row in truth])
    for title, kept in (("soups", SAME - {"jitter"}), ("on their heads and stretched", GROSS)):
        print(f"{title}: {shares(values[[row.variant in kept for row in truth]])}")
    if arguments.measures:
        measures(arguments.measures, arguments.seed + 1)


if __name__ == "__main__":
    main()
