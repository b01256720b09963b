"""The report: what it says of a record, what it compares, and that nothing in a name can break the page."""

from __future__ import annotations

import io
import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
from PIL import Image, ImageDraw

from broken_disk import full_after, hidden, shown
from shapewright.judging.paper import FAR
from shapewright.judging.target import Measures
from shapewright.report import write_report
from shapewright.report.scale import GREEN, RED, YELLOW, colour
from shapewright.runs.changes import Move, compare
from shapewright.runs.folder import RunError

EVIL = """<img src=x onerror="window.broken=1"></script><script>window.broken=1</script>&amp; {{ 7*7 }}'"\u2028"""


def parameter(
    name: str, kind: str, low: Any = None, high: Any = None, options: list[str] | None = None
) -> dict[str, Any]:
    return {"name": name, "kind": kind, "low": low, "high": high, "steps": None, "options": options, "default": None}


PARAMETERS = [
    parameter("height", "scalar", 0.5, 1.0),
    parameter("shelves", "integer", 0, 3),
    parameter("round_top", "binary"),
    parameter("legs", "choice", options=["four", "one"]),
]


def picture(shade: int) -> bytes:
    """A thumbnail in which a rectangle covers x from 16 to 47 and y from 24 to 43 of 64."""
    image = Image.new("LA", (64, 64), (0, 0))
    ImageDraw.Draw(image).rectangle((16, 24, 47, 43), fill=(shade, 255))
    buffer = io.BytesIO()
    image.save(buffer, "PNG")
    return buffer.getvalue()


def reference(name: str, distance: float | None, group: int | None = None, **other: Any) -> dict[str, Any]:
    slug = re.sub(r"\W+", "-", name.lower())[:24].strip("-")
    failed = distance is None
    return {
        "name": name,
        "slug": slug,
        "path": f"/shapes/{name}.ply",
        "parameters": None if failed else {"height": 0.75, "shelves": 3, "round_top": True, "legs": "one"},
        "active": ["height", "shelves", "round_top"],
        "at_limit": [] if failed else ["shelves"],
        "distance": distance,
        "iou": None if failed else 0.875,
        "chamfer": None if failed else 0.0123,
        "compatible": distance is not None and distance <= 0.18,
        "group": group,
        "error": "ValueError: the legs met" if failed else None,
        "replica": None if failed else f"replicas/{slug}.glb",
        "triangles": 1234,
    } | other


def record(references: list[dict[str, Any]], **other: Any) -> dict[str, Any]:
    groups: dict[int, list[str]] = {}
    for one in references:
        if one["group"] is not None:
            groups.setdefault(one["group"], []).append(one["name"])
    return {
        "format": 1,
        "created": "2024-02-29T10:05:00+00:00",
        "version": "0.1.0",
        "versions": {"python": "3.11.7", "numpy": "2.0.0"},
        "seed": 7,
        "settings": {"preset": "fast", "epochs": 30, "learning_rate": 0.002, "refine": True, "limit": None},
        "procedure": {"name": "table", "path": "/procedures/v5.py", "digest": "d1", "parameters": PARAMETERS},
        "collection": {"source": "/shapes", "count": len(references), "skipped": {"/shapes/broken.obj": "no faces"}},
        "threshold": 0.18,
        "references": references,
        "groups": [{"representative": names[-1], "members": names} for _, names in sorted(groups.items())],
        "metrics": {
            "samples": 3000,
            "failed": 2,
            "failures": "height=0.5: the foot is <wider> than the top",
            "epochs": 3,
            "curve": [{"epoch": i, "train": 2.0 / i, "validation": 3.0 / i} for i in (1, 2, 3)],
            "validation": {
                "height": {"kind": "scalar", "mae": 0.0123},
                "round_top": {"kind": "binary", "f1": 0.97, "accuracy": 0.98},
            },
        },
        "seconds": {"sample": 1.25, "train": 150.0},
    } | other


def typical() -> dict[str, Any]:
    return record(
        [
            reference("oak", 0.05),
            reference("elm", 0.21, group=0),
            reference("ash", 0.33, group=0),
            reference("fir", 0.25, group=0),
            reference("yew", 0.6, group=1),
            reference("box", None),
            reference(EVIL, 0.1),
        ]
    )


def saved(folder: Path, contents: dict[str, Any]) -> Path:
    (folder / "thumbnails").mkdir(parents=True)
    (folder / "replicas").mkdir()
    (folder / "iteration.json").write_text(json.dumps(contents), encoding="utf-8")
    for one in contents["references"]:
        (folder / "thumbnails" / f"{one['slug']}.reference.png").write_bytes(picture(200))
        if one["replica"]:
            (folder / "thumbnails" / f"{one['slug']}.replica.png").write_bytes(picture(120))
            (folder / one["replica"]).write_bytes(b"glTF")
    return folder


class Page(HTMLParser):
    """The elements of a page with their attributes, the text outside scripts and styles, and the script's data."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.source = path.read_text(encoding="utf-8")
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.pieces: list[str] = []
        self.scripts: list[str] = []
        self.inside = ""
        self.feed(self.source)
        self.text = " ".join(" ".join(self.pieces).split())
        self.data = json.loads(self.scripts[0])

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        self.inside = tag

    def handle_endtag(self, tag: str) -> None:
        self.inside = ""

    def handle_data(self, data: str) -> None:
        if self.inside == "script":
            self.scripts.append(data)
        elif self.inside != "style":
            self.pieces.append(data)

    def named(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.elements if name == tag]


@pytest.fixture
def page(tmp_path: Path) -> Page:
    return Page(write_report(saved(tmp_path / "003", typical())))


def test_the_head_of_the_page_gives_the_counts(page: Page) -> None:
    for words in (
        "run 003",
        "29 February 2024, 10:05 UTC · seed 7",
        "on 7 references from /shapes",
        "2 of 7 compatible: distance at most 0.18",
        "2 groups of 4 incompatible",
        "1 without a replica",
    ):
        assert words in page.text


def by_fidelity() -> dict[str, Any]:
    """The same references with a fidelity, a grade and a region each; all but box and yew are compatible."""
    values = {"oak": 0.9, "elm": 0.35, "ash": 0.1, "fir": 0.25, "yew": 0.02, "box": None, EVIL: 0.6}
    region = {"size": 0.314, "low": [-0.1, -0.4, 0.0], "high": [0.1, -0.09, 0.1], "share": 0.05}
    contents = record(
        typical()["references"], judge="fidelity", settings={"judge": "fidelity", "replicated": 0.5, "close": 0.2}
    )
    for one in contents["references"]:
        value = values[one["name"]]
        grade = "replicated" if (value or 0) >= 0.5 else "close" if (value or 0) >= 0.2 else "different"
        regions = [region] if one["name"] == "elm" else []
        one |= {
            "fidelity": value,
            "grade": grade,
            "missing": regions,
            "surplus": [],
            "compatible": one["name"] != "yew",
        }
    return contents


@pytest.fixture
def judged(tmp_path: Path) -> Page:
    return Page(write_report(saved(tmp_path / "004", by_fidelity())))


def test_the_count_in_front_is_what_a_person_calls_replicated_and_the_papers_is_beside(judged: Page) -> None:
    for words in (
        "2 of 7 replicated: fidelity at least 0.5",
        "2 close",
        "3 different",
        "6 of 7 by the paper's measure: distance at most 0.18",
        "2 groups of 4 misfits",
        "replicated from 0.5",
        "close from 0.2",
    ):
        assert words in judged.text
    assert [bar["data-pair"] for bar in judged.named("rect")] == ["5", "6", "1", "0", "2", "3", "4"]


def test_cards_have_the_colour_of_their_grade_and_tell_the_longest_region(judged: Page) -> None:
    colours = {pair["name"]: pair["colour"] for pair in judged.data["pairs"]}
    green, yellow, red = ("#" + bytes(rgb).hex() for rgb in (GREEN, YELLOW, RED))
    assert (colours["oak"], colours["elm"], colours["ash"], colours["yew"]) == (green, yellow, red, red)
    elm = next(pair for pair in judged.data["pairs"] if pair["name"] == "elm")
    assert (elm["title"], elm["value"]) == ("Fidelity, close", "0.350")
    assert elm["regions"] == [{"kind": "missing", "sizes": ["31 %"]}, {"kind": "surplus", "sizes": []}]
    assert judged.text.count("missing 31 %") == 1 and judged.source.count('<svg class="regions"') >= 1


def test_a_table_has_the_mean_of_each_measure_that_the_run_holds(judged: Page) -> None:
    fidelity, iou = (Measures.words()[name] for name in ("fidelity", "iou"))
    assert f"{iou} 0.8750 0.8750" in judged.text and f"{fidelity} 0.3700 0.7500" in judged.text
    assert Measures.words()["depth"] not in judged.text


def test_a_run_of_the_papers_judge_is_compared_by_the_papers_measure(tmp_path: Path) -> None:
    earlier = saved(tmp_path / "002", typical())
    text = Page(write_report(saved(tmp_path / "003", by_fidelity()), earlier)).text
    assert "judged by the paper's measure, and so the two are compared by it" in text
    assert "+4 since run 002: 4 newly compatible, 0 lost" in text


def test_misfits_come_first_in_their_groups_and_the_representative_leads(page: Page) -> None:
    assert [pair["name"] for pair in page.data["pairs"]] == ["fir", "elm", "ash", "yew", "box", "oak", EVIL]
    assert "+2 more" in page.text
    assert [a["id"] for a in page.named("div") if "members" in (a.get("class") or "")] == ["group-1"]


def test_every_picture_is_in_the_page_once_and_nothing_is_fetched(page: Page) -> None:
    sources = [attributes["src"] or "" for attributes in page.named("img")]
    assert len(sources) == 7 + 6  # one has no replica
    assert all(source.startswith("data:image/png;base64,") for source in sources)
    assert not page.named("link")[1:]
    assert page.named("link")[0]["href"] == "data:,"
    assert not re.search(r"https?:|@import|url\((?!#)", page.source)


def test_missing_thumbnails_leave_a_blank(tmp_path: Path) -> None:
    folder = saved(tmp_path / "001", typical())
    for file in (folder / "thumbnails").iterdir():
        file.unlink()
    page = Page(write_report(folder))
    assert not page.named("img")
    assert page.text.count("no replica") >= 7


def test_names_cannot_break_out_of_the_page(page: Page) -> None:
    assert len(page.named("script")) == 2
    assert "49" not in page.text
    assert not any("onerror" in attributes for _, attributes in page.elements)
    assert any(attributes.get("title") == EVIL for attributes in page.named("span"))
    assert "<wider>" in page.text


def test_the_data_of_a_pair(page: Page) -> None:
    pair = page.data["pairs"][0]
    assert (pair["title"], pair["value"]) == ("Distance, incompatible", "0.250")
    assert [number for _, number in pair["measures"]] == ["0.2500", "0.8750", "0.0123"]
    assert pair["link"] == "replicas/fir.glb"
    assert pair["values"] == [
        ["0.75", 0.5, True, False],
        ["3", 1.0, True, True],
        ["yes", 1.0, True, False],
        ["one", 1, False, False],
    ]
    assert page.data["parameters"] == [
        {"name": "height", "options": None, "ends": ["0.5", "1"]},
        {"name": "shelves", "options": None, "ends": ["0", "3"]},
        {"name": "round_top", "options": ["no", "yes"], "ends": None},
        {"name": "legs", "options": ["four", "one"], "ends": None},
    ]


def test_a_reference_without_a_replica_tells_why(page: Page) -> None:
    pair = next(pair for pair in page.data["pairs"] if pair["name"] == "box")
    assert (pair["error"], pair["link"], pair["tint"]) == ("ValueError: the legs met", None, None)
    assert pair["values"] == [None] * 4
    assert "ValueError: the legs met" in page.text


def test_links_are_quoted_paths(tmp_path: Path) -> None:
    odd = reference("odd", 0.1, replica="replicas/a b#c?.glb")
    script = reference("script", 0.1, replica="javascript:alert(1)")
    folder = tmp_path / "001"
    folder.mkdir()
    (folder / "iteration.json").write_text(json.dumps(record([odd, script])))
    links = [pair["link"] for pair in Page(write_report(folder)).data["pairs"]]
    assert links == ["replicas/a%20b%23c%3F.glb", "javascript%3Aalert%281%29"]


def test_the_strip_has_a_bar_for_each_reference_in_order_of_distance(page: Page) -> None:
    bars = page.named("rect")
    heights = [float(bar["height"] or "nan") for bar in bars]
    assert len(bars) == 7
    assert heights[:6] == sorted(heights[:6])
    assert heights[5] == 100.0  # yew, the farthest; then box, which has none
    assert [page.data["pairs"][int(bar["data-pair"] or -1)]["name"] for bar in bars][-2:] == ["yew", "box"]


def test_pictures_are_framed_to_what_the_shapes_cover(page: Page) -> None:
    zoom = float(re.search(r"--zoom: ([\d.]+)%", page.source)[1])  # type: ignore[index]
    assert zoom == pytest.approx(100 / (0.5 + 2 * 0.03), abs=0.01)


def test_metrics_times_and_what_was_left_out_are_told(page: Page) -> None:
    for words in (
        "height scalar 0.012 – –",
        "shelves integer – – – 6",
        "round_top binary – 0.97 0.98 –",
        "validation loss 1.000",
        "training loss 0.667",
        "Time 2 min 31 s",
        "sample 1.2 s train 2 min 30 s",
        "Skipped 1",
        "/shapes/broken.obj no faces",
        "Failed builds 2 of 3000 samples",
        "learning rate 0.002",
        "refine yes",
        "numpy 2.0.0",
    ):
        assert words in page.text


def test_a_procedure_that_builds_other_shapes_from_the_same_parameters_is_told(tmp_path: Path) -> None:
    contents = typical()
    kinds = {"stochastic": "p.py:3: <random> draws", "pace": "one shape takes 1 s"}
    contents["metrics"]["notices"] = [{"kind": kind, "text": text} for kind, text in kinds.items()]
    text = Page(write_report(saved(tmp_path / "001", contents))).text
    assert "Not steady p.py:3: <random> draws" in text and "one shape takes" not in text


def test_a_run_where_all_is_well_has_no_section_of_misfits(tmp_path: Path) -> None:
    contents = record([reference("oak", 0.0), reference("elm", 0.18)])
    contents["collection"]["skipped"] = {}
    contents["metrics"] |= {"failed": 0, "curve": []}
    text = Page(write_report(saved(tmp_path / "001", contents))).text
    assert "2 of 2 compatible" in text
    for words in ("Not replicated yet", "without a replica", "Skipped", "Failed builds", "Training", "Since run"):
        assert words.lower() not in text.lower()


def test_numbers_that_are_not_finite_are_shown_as_unknown(tmp_path: Path) -> None:
    contents = record([reference("oak", float("nan"), compatible=False, iou=float("inf"))])
    pair = Page(write_report(saved(tmp_path / "001", contents))).data["pairs"][0]
    assert (pair["value"], pair["tint"]) == ("–", None)
    assert [words for words, _ in pair["measures"]] == [Measures.words()["chamfer"]]


def test_the_change_since_the_previous_run(tmp_path: Path) -> None:
    before = record([reference("oak", 0.3, group=0), reference("elm", 0.1), reference("gum", 0.2, group=0)])
    before["threshold"] = 0.15
    earlier = saved(tmp_path / "002", before)
    page = Page(write_report(saved(tmp_path / "003", typical()), earlier))
    for words in (
        "±0 since run 002: 1 newly compatible, 1 lost",
        "The threshold was 0.15 then. The procedure is the same.",
        "References: 5 added, 1 removed.",
        "moved away; they are compatible as before",
        "Newly compatible 1 oak 0.30 → 0.05",
        "Lost 1 elm 0.10 → 0.21",
    ):
        assert words in page.text


def test_comparison_counts_each_reference_once() -> None:
    def distances(**by_name: float | None) -> dict[str, Any]:
        return record([reference(name, distance) for name, distance in by_name.items()])

    before = distances(a=0.3, b=0.1, c=0.5, d=0.05, e=0.4, f=None, g=None, h=0.25, gone=0.1)
    after = distances(a=0.1, b=0.2, c=0.45, d=0.09, e=0.41, f=0.3, g=None, h=None, new=0.1)
    comparison = compare(before, after)
    assert comparison.gained == (Move("a", 0.3, 0.1),)
    assert comparison.lost == (Move("b", 0.1, 0.2),)
    assert comparison.closer == (Move("f", None, 0.3), Move("c", 0.5, 0.45))
    assert comparison.further == (Move("d", 0.05, 0.09), Move("h", 0.25, None))
    assert (comparison.added, comparison.removed) == (("new",), ("gone",))


def test_colours_run_from_green_over_yellow_to_red() -> None:
    def code(rgb: tuple[int, ...]) -> str:
        return "#" + bytes(rgb).hex()

    assert [colour(part * 0.18, 0.18) for part in (0.0, 1.0, FAR, 9.0)] == [*map(code, (GREEN, YELLOW, RED, RED))]
    assert colour(None, 0.18) == "#9a9a9a"
    halfway = [round((a + b) / 2) for a, b in zip(GREEN, YELLOW, strict=True)]
    assert list(bytes.fromhex(colour(0.09, 0.18)[1:])) == pytest.approx(halfway, abs=1)


def test_writing_again_replaces_the_page_and_leaves_nothing_else(tmp_path: Path) -> None:
    folder = saved(tmp_path / "001", typical())
    before = sorted(folder.iterdir())
    first = write_report(folder).read_bytes()
    assert write_report(folder).read_bytes() == first
    assert sorted(folder.iterdir()) == sorted([*before, folder / "report.html"])


def test_a_full_disk_leaves_the_page_as_it_was(tmp_path: Path) -> None:
    folder = saved(tmp_path / "001", typical())
    write_report(folder)
    before = shown(folder)
    with pytest.raises(OSError, match="File too large"), full_after(1000):
        write_report(folder)
    assert shown(folder) == before and not hidden(folder)


def test_what_is_no_run_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RunError, match=r"holds no iteration\.json"):
        write_report(tmp_path)
    (tmp_path / "iteration.json").write_text('{"format": 3}')
    with pytest.raises(RunError, match="has format 3; this version of shapewright reads formats up to 2"):
        write_report(tmp_path)


def many(tmp_path: Path) -> Path:
    """A run of 1,040 references: three groups of 90 misfits, 70 of no group, 700 that are replicated; by the paper."""
    names = [f"g{group} {i:03d}" for group in range(3) for i in range(90)]
    entries = [reference(name, 0.3 + 0.001 * i, group=i // 90) for i, name in enumerate(names)]
    entries += [reference(f"alone {i:03d}", 0.5) for i in range(70)]
    entries += [reference(f"good {i:04d}", 0.01 + 0.0001 * i) for i in range(700)]
    contents = record(entries)
    members = [names[start : start + 90] for start in (0, 90, 180)]
    return saved(tmp_path, contents | {"groups": [{"representative": some[1], "members": some} for some in members]})


def pages_of(run: Path) -> list[Page]:
    return [Page(path) for path in sorted((run / "report").iterdir())]


def names_on(page: Page) -> list[str]:
    return [pair["name"] for pair in page.data["pairs"]]


def test_many_references_have_pages(tmp_path: Path) -> None:
    run = many(tmp_path)
    overview = Page(write_report(run))
    assert [path.name for path in sorted((run / "report").iterdir())] == [f"000{i}.html" for i in range(1, 7)]
    pages = pages_of(run)
    shown = [name for page in pages for name in names_on(page)]
    known = [one["name"] for one in json.loads((run / "iteration.json").read_text())["references"]]
    assert sorted(shown) == sorted(known) and shown[0] == "g0 001" and shown[-1] == "good 0699"
    assert names_on(overview)[:3] == ["g0 001", "g1 001", "g2 001"] and len(names_on(overview)) == 3 + 60 + 60
    assert "+89 more" in overview.text and ("a", {"class": "more", "href": "report/0001.html"}) in overview.elements
    assert all("700 of 1040" in page.text for page in (overview, *pages))
    assert "Settings and versions" in overview.text and "Settings and versions" not in pages[0].text


def test_links_between_pages_lead_to_files(tmp_path: Path) -> None:
    run = many(tmp_path)
    for path in (write_report(run), *(run / "report").iterdir()):
        links = [dict(made)["href"] for name, made in Page(path).elements if name == "a"]
        assert len([link for link in links if str(link).endswith(".html")]) >= 12
        assert all((path.parent / str(link)).resolve().is_file() for link in links)


def test_pages_that_are_not_needed_any_more_go(tmp_path: Path) -> None:
    run = many(tmp_path)
    write_report(run)
    contents = json.loads((run / "iteration.json").read_text())
    contents |= {"references": contents["references"][:60], "groups": []}
    (run / "iteration.json").write_text(json.dumps(contents))
    overview = Page(write_report(run))
    assert not list((run / "report").iterdir()) and "Overview" not in overview.text
    assert len(names_on(overview)) == 60
