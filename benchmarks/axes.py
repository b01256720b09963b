"""Up and front of shapes that are turned at random over the 24 turns: how often they are found, what tidy data loses.

    python benchmarks/axes.py ../shared/data/references [--looks FILE] [--sheets FOLDER] [--json]
    python benchmarks/axes.py ../shared/data/references --learn src/shapewright/axes/weights.json
    python benchmarks/axes.py ../shared/data/references --scans [--learn src/shapewright/axes/weights_of_points.json]

Each folder with files is a collection. What everyday things look like is learned on every second shape and measured on
the others, and the other way round; with ``--learn`` on all of them. A procedure of examples/categories teaches by 300
samples; a hundred others are measured.

An up is there where no turn that brings another side up leaves the looks of a shape as they are, proportions apart; a
front where not every turn about the up axis leaves them so, proportions included (``looks.ALIKE``). A turn that leaves
them as they are is right, and one that leaves most shapes of the procedure as they are.

With ``--scans`` every second shape of each folder is a scan of three sides with noise; what teaches are meshes.
"""

import argparse
import io
import json
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import numpy as np
import torch
from PIL import Image, ImageDraw

import shapewright as sw
from shapewright.axes.agreement import Z_UP
from shapewright.axes.finding import Kind, told
from shapewright.axes.looks import ALIKE, Looks
from shapewright.axes.turns import AFTER, INVERSE, TURNS, UPRIGHT, UPS
from shapewright.prediction.scanning import Scanner, side_cameras
from shapewright.references.scans.cleaning import cleaned
from shapewright.rendering.thumbnails import thumbnail
from shapewright.shapes import Mesh

PROCEDURES = {"chair": "chair/v4", "table": "table/v4", "bed": "bed/v3", "shelf": "shelf/v3", "storage": "shelf/v3"}
"""That are for the shapes in a folder, by its name."""
TAUGHT, MEASURED = 300, 100  # samples that teach, and others
SAMPLE, RATE, HIDDEN, EPOCHS = 0.15, 6e-3, 32, 45  # what a sample counts beside a reference; of the network
TRIED = 6  # turns of a whole collection
SIDES, ASIDE, ELEVATIONS, POINTS = (30.0, 150.0, 270.0), 12.0, (12.0, 38.0), 6000  # of scans, in degrees


def learned(parts, counts, seed):
    """The weights of a small network: a softmax over the 24 turns of each shape."""
    torch.manual_seed(seed)
    looks = np.concatenate([part.features for part in parts])
    right = torch.tensor(np.concatenate([part.apart[:, 1] <= ALIKE for part in parts]))
    counts = torch.tensor(np.repeat(counts, [len(part.features) for part in parts]))
    mean, spread = looks.mean((0, 1)), looks.std((0, 1)) + 1e-3
    x = torch.tensor(np.clip((looks - mean) / spread, -4, 4), dtype=torch.float32)
    first, last = torch.nn.Linear(x.shape[2], HIDDEN), torch.nn.Linear(HIDDEN, 1, bias=False)
    drop = torch.nn.Dropout(0.2)
    network = torch.nn.Sequential(drop, first, torch.nn.Tanh(), drop, last)
    optimiser = torch.optim.AdamW(network.parameters(), weight_decay=3e-2)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, RATE, total_steps=EPOCHS * -(-len(x) // 64))
    for _ in range(EPOCHS):
        for rows in torch.randperm(len(x)).split(64):
            logs = network(x[rows])[..., 0].log_softmax(1)
            loss = -(logs.masked_fill(~right[rows], -1e9).logsumexp(1) * counts[rows]).mean()
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            schedule.step()
    numbers = {"mean": mean, "spread": spread}
    numbers |= {"hidden": first.weight.tolist(), "hidden_bias": first.bias.tolist(), "out": last.weight[0].tolist()}
    return {name: np.round(np.array(value, dtype=np.float64), 4) for name, value in numbers.items()}


def scanned(mesh, seed):
    """What three sides a little from above see of a mesh, as a reference has it."""
    rng = np.random.default_rng(seed)
    azimuths = np.array(SIDES) + rng.normal(scale=ASIDE, size=len(SIDES))
    cameras = side_cameras(azimuths.tolist(), rng.uniform(*ELEVATIONS, len(SIDES)).tolist())
    return cleaned(Scanner(cameras, POINTS).scan(mesh, rng))[0].normalised()


def truth(looks, kind):
    """(N, 24) turns that leave the looks right, (N, 24) the up right, (N,) has an up, (N,) has a front."""
    same = looks.apart[:, 1] <= ALIKE
    if kind is not None:
        same = same[:, AFTER[np.flatnonzero(kind.alike)]].any(1)
    has_up = ~(looks.apart[:, 0][:, UPS[0] != UPS] <= ALIKE).any(1)
    return same, same[:, AFTER[UPRIGHT]].any(1), has_up, has_up & (same[:, UPRIGHT].sum(1) < len(UPRIGHT))


def measured(looks, meant, kind, weights, rng):
    """Counts by how the files were turned: of ups and fronts that are wrong, of how many, and of shapes that are not
    as they were; and turns and findings of shapes that were turned each by its own."""
    right, up, has_up, has_front = truth(meant, kind)
    count = len(looks.features)
    counts = defaultdict(lambda: np.zeros(5, int))

    def tell(case, turns, rows):
        found = np.array([each.turn for each in told(looks.take(rows).turned(turns), None, kind, weights)])
        left = AFTER[found, turns]
        wrong_up, wrong = ~up[rows, left] & has_up[rows], ~right[rows, left]
        both = wrong & has_front[rows]
        counts[case] += [wrong_up.sum(), has_up[rows].sum(), both.sum(), has_front[rows].sum(), wrong.sum()]
        return found, wrong_up | both

    every = np.arange(count)
    tell("tidy", np.zeros(count, int), every)
    for turn in rng.choice(np.arange(1, len(TURNS)), TRIED, replace=False):
        tell("all by one turn", np.full(count, turn), every)
    tell("two in five Z up", np.where(rng.random(count) < 0.4, INVERSE[Z_UP], 0), every)
    tell("one in ten turned", np.where(rng.random(count) < 0.1, rng.integers(0, len(TURNS), count), 0), every)
    turns = rng.integers(0, len(TURNS), count)
    found, wrong = tell("each by its own", turns, every)
    for row in every:
        tell("a tidy file alone", np.zeros(1, int), every[row : row + 1])
        tell("a turned file alone", turns[row : row + 1], every[row : row + 1])
    return counts, AFTER[found, turns], wrong


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("references", type=Path)
    parser.add_argument("--learn", type=Path, help="Learn on all shapes, write the weights here, and measure nothing.")
    parser.add_argument("--scans", action="store_true", help="Measure, or learn, scans in place of meshes.")
    parser.add_argument("--looks", type=Path, help="A file that keeps what is seen, which takes most of the time.")
    parser.add_argument("--sheets", type=Path, help="A folder for pictures of what is wrong.")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    torch.set_num_threads(1)
    folders, meant, samples = seen(arguments)
    even = {name: np.arange(len(looks.features)) % 2 == 0 for name, looks in folders.items()}

    def weights(rows):
        parts = [looks.take(rows[name]) for name, looks in meant.items()]
        more = [looks.take(np.arange(TAUGHT)) for looks in samples.values() if not arguments.scans]
        return learned([*parts, *more], [1.0] * len(parts) + [SAMPLE] * len(more), arguments.seed)

    if arguments.learn:
        found = weights({name: half | True for name, half in even.items()})
        arguments.learn.write_text(json.dumps({name: value.tolist() for name, value in found.items()}) + "\n")
        return
    halves = [
        (even, weights({n: ~half for n, half in even.items()})),
        ({n: ~h for n, h in even.items()}, weights(even)),
    ]
    table = defaultdict(dict)
    wrong = defaultdict(list)

    def add(title, name, looks, right, kind, known):
        counts, left, bad = measured(looks, right, kind, known, np.random.default_rng(arguments.seed))
        for case, row in counts.items():
            table[f"{title}{case}"][name] = table[f"{title}{case}"].get(name, 0) + row
        return left, bad

    for name, looks in folders.items():
        procedure = PROCEDURES.get(name.split("/")[-1])
        for half, known in halves:
            rows = np.flatnonzero(half[name])
            kinds = {"by looks: ": None}
            if procedure:
                taught = samples[procedure].take(np.arange(TAUGHT))
                kinds["with a procedure: "] = Kind.of(taught, None if arguments.scans else known)
            for title, kind in kinds.items():
                left, bad = add(title, name, looks.take(rows), meant[name].take(rows), kind, known)
                wrong[title, name] += [(int(rows[i]), int(left[i])) for i in np.flatnonzero(bad)]
    for name, looks in {} if arguments.scans else samples.items():
        others, known = looks.take(np.arange(TAUGHT, len(looks.features))), halves[0][1]
        add("samples, by looks: ", name, others, others, None, known)
        add("samples, with the procedure: ", name, others, others, Kind.of(looks.take(np.arange(TAUGHT)), known), known)
    for case, rows in table.items():
        print(f"\n{case:48} {share(sum(rows.values()))}")
        for name, row in rows.items():
            print(f"    {name:44} {share(row)}")
    if arguments.json:
        print(json.dumps({case: {name: row.tolist() for name, row in rows.items()} for case, rows in table.items()}))
    if arguments.sheets:
        arguments.sheets.mkdir(parents=True, exist_ok=True)
        for (title, name), rows in wrong.items():
            if rows:
                path = arguments.sheets / f"{title.split()[0]}-{title.split()[1]}-{name.replace('/', '-')}.png"
                sheet([*sw.Collection.load(arguments.references / name)], rows).save(
                    path.with_name(path.name.replace(":", ""))
                )


def share(row):
    up, ups, both, fronts, moved = row
    right = [f"{1 - wrong / max(of, 1):.3f} ({wrong} of {of})" for wrong, of in ((up, ups), (both, fronts))]
    return f"up {right[0]:22} and front {right[1]:22} other {moved}"


def seen(arguments):
    """What is seen of the shapes of each folder; the same with the turns that are alike by their meshes; and what is
    seen of samples of each procedure."""
    looks, meant = {}, {}
    if arguments.looks and arguments.looks.is_file():
        kept = np.load(arguments.looks)
        names = [key[:-6] for key in kept if key.endswith(":apart")]
        looks = {name: Looks(*(kept[f"{name}:{part}"] for part in ("looks", "apart", "points"))) for name in names}
        meant = {name: replace(one, apart=kept[f"{name}:meant"]) for name, one in looks.items()}
    else:
        for folder in sorted({file.parent for file in arguments.references.rglob("*.ply")}):
            shapes = [reference.shape for reference in sw.Collection.load(folder)]
            name = str(folder.relative_to(arguments.references))
            meant[name] = Looks.of(shapes[::2] if arguments.scans else shapes)
            looks[name] = meant[name]
            if arguments.scans:
                looks[name] = Looks.of([scanned(shape, seed) for seed, shape in enumerate(shapes[::2])])
                meant[name] = replace(looks[name], apart=meant[name].apart)
        for name in dict.fromkeys(PROCEDURES.values()):
            procedure = sw.load_procedure(f"examples/categories/{name}.py")
            builds = sw.sample(procedure, TAUGHT + MEASURED, seed=arguments.seed)
            looks[f"samples {name}"] = meant[f"samples {name}"] = Looks.of(
                [build.shape for build in builds if build.shape is not None]
            )
        if arguments.looks:
            arrays = {f"{name}:looks": one.features for name, one in looks.items()}
            arrays |= {f"{name}:meant": one.apart for name, one in meant.items()}
            arrays |= {f"{name}:apart": one.apart for name, one in looks.items()}
            np.savez(arguments.looks, **arrays, **{f"{name}:points": one.points for name, one in looks.items()})
    folders = {name: one for name, one in looks.items() if not name.startswith("samples ")}
    return (
        folders,
        {name: meant[name] for name in folders},
        {name[8:]: one for name, one in looks.items() if name.startswith("samples ")},
    )


def sheet(references, rows, side=110, columns=6):
    """Each shape as it stands right, and as it was found to stand."""
    picture = Image.new("RGB", (columns * (2 * side + 8), -(-len(rows) // columns) * (side + 14)), "white")
    for number, (row, turn) in enumerate(rows):
        x, y = number % columns * (2 * side + 8), number // columns * (side + 14)
        shape = references[row].shape
        for i, mesh in enumerate((shape, Mesh(shape.vertices @ TURNS[turn].T, shape.faces))):
            small = Image.open(io.BytesIO(thumbnail(mesh, side))).convert("RGBA")
            picture.paste(small.convert("RGB"), (x + i * side, y), small.getchannel("A"))
        ImageDraw.Draw(picture).text((x, y + side), references[row].name[:36], fill="black")
    return picture


if __name__ == "__main__":
    main()
