import os
import subprocess
import sys
import textwrap

import numpy as np
import pytest

import shapewright as sw
from shapewright.building import Limits, Workers, describe_failures

SOURCE = """
import os, time
from typing import Annotated, Literal
import numpy as np
from shapewright import Infeasible, Range, procedure

@procedure
def part(
    size: Annotated[float, Range(0.5, 1.0, steps=8)] = 0.7,
    fault: Literal["none", "infeasible", "raises", "nothing", "nan", "endless", "killed", "exits", "memory"] = "none",
):
    if fault == "infeasible":
        raise Infeasible("it does not fit")
    if fault == "raises":
        return [][3]
    if fault == "nothing":
        return None
    if fault == "endless":
        while True:
            time.sleep(0.01)
    if fault == "killed":
        os.kill(os.getpid(), 9)
    if fault == "exits":
        os._exit(5)
    if fault == "memory":
        np.ones(2 * 10**9)
    scale = np.nan if fault == "nan" else size
    return np.eye(3) * scale, [[0, 1, 2]]
"""
LIMITS = Limits(seconds=0.5, memory_mb=512)
FAULTS = {
    "infeasible": ("infeasible", "it does not fit"),
    "raises": ("raised", "model.py:15: IndexError: list index out of range  (return [][3])"),
    "nothing": ("no shape", "it returned nothing (None)"),
    "nan": ("no shape", "not finite"),
    "endless": ("time", "it took longer than 0.5 s"),
    "killed": ("crash", "it killed its process (signal 9)"),
    "exits": ("crash", "it ended its process (exit status 5)"),
    "memory": ("memory", "it needed more than 512 MB of memory"),
}


@pytest.fixture
def part(tmp_path):
    path = tmp_path / "model.py"
    path.write_text(SOURCE)
    return sw.load_procedure(path)


def vectors(*faults):
    return [{"size": 0.5 + 0.01 * i, "fault": fault} for i, fault in enumerate(faults)]


def build_all(procedure, asked, workers):
    with Workers(procedure, workers, LIMITS) as crew:
        return crew.build(asked, give_up=True)


def outcome(builds):
    return [(b.parameters["size"], b.failure or b.shape.vertices.tobytes()) for b in builds]


def test_each_fault_costs_its_own_shape_only(part):
    asked = vectors(*["none"] * 10, *[f for fault in FAULTS for f in (fault, "none")], *["none"] * 100)
    builds = build_all(part, asked, workers=2)
    assert [build.parameters for build in builds] == asked
    for build in builds:
        fault = build.parameters["fault"]
        if fault == "none":
            assert build.failure is None
            assert np.array_equal(build.shape.vertices, np.eye(3) * build.parameters["size"])
        else:
            kind, message = FAULTS[fault]
            assert build.shape is None and build.failure.kind == kind
            assert message in str(build.failure)


def test_results_do_not_depend_on_the_number_of_workers(part):
    asked = vectors(*["none"] * 8, "raises", "exits", *["none"] * 150)
    assert outcome(build_all(part, asked, workers=1)) == outcome(build_all(part, asked, workers=3))


def test_a_procedure_that_always_fails_is_given_up_soon(part):
    with pytest.raises(
        sw.ProcedureError, match=r"every one of the first 8 shapes failed: 8 x raised.*IndexError.*size="
    ):
        build_all(part, vectors(*["raises"] * 500), workers=2)
    with pytest.raises(sw.ProcedureError, match=r"every one of the first 3 shapes failed: .*TimeLimit: it took longer"):
        build_all(part, vectors(*["endless"] * 500), workers=2)


def test_infeasible_parameters_alone_do_not_give_the_procedure_up(part):
    builds = build_all(part, vectors(*["infeasible"] * 12, "none"), workers=1)
    assert sum(build.shape is not None for build in builds) == 1


def test_workers_serve_several_requests_and_report_progress(part):
    told = []
    with Workers(part, 1, LIMITS) as crew:
        first = crew.build(vectors(*["none"] * 100), lambda done, total: told.append((done, total)))
        processes = [worker._worker.process for worker in crew.builders.pool.idle]
        second = crew.build(vectors("none"))
        assert [worker._worker.process for worker in crew.builders.pool.idle] == processes
    assert len(first) == 100 and len(second) == 1 and told[-1] == (100, 100)
    assert all(process.poll() is not None for process in processes)


def test_workers_turn_to_another_procedure_and_keep_their_processes(part, tmp_path):
    other, broken = tmp_path / "other.py", tmp_path / "broken.py"
    other.write_text(SOURCE.replace("np.eye(3) * scale", "2.0 * np.eye(3) * scale"))
    broken.write_text(SOURCE)
    lost = sw.load_procedure(broken)
    broken.write_text("raise ValueError('not any more')")
    asked = vectors("none", "raises", "none")
    with Workers(part, 1, LIMITS) as crew:
        first = crew.build(asked)
        processes = [worker._worker.process for worker in crew.builders.pool.idle]
        crew.turn_to(sw.load_procedure(other))
        second = crew.build(asked)
        assert [
            worker._worker.process for worker in crew.builders.pool.idle
        ] == processes and crew.procedure.path == other
        with pytest.raises(sw.ProcedureError, match="not any more"):
            crew.turn_to(lost)
        assert crew.builders.pool.idle == [] and all(process.poll() is not None for process in processes)
        crew.turn_to(part)
        assert outcome(crew.build(asked)) == outcome(first)
    assert np.array_equal(second[0].shape.vertices, 2.0 * first[0].shape.vertices)
    assert "other.py:15" in str(second[1].failure)


def test_nothing_asked_nothing_built(part):
    assert build_all(part, [], workers=1) == []


def test_failures_are_described_with_counts_and_parameters(part):
    builds = build_all(part, vectors("none", "raises", "raises", "nothing"), workers=1)
    text = describe_failures(builds)
    assert text.startswith("2 x raised: ") and "for example with size=0.51, fault='raises'; 1 x no shape" in text
    assert describe_failures(builds[:1]) == "no failures"


def test_a_script_needs_no_main_guard(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        textwrap.dedent(
            """
            from typing import Annotated
            import numpy as np
            from shapewright import Range, procedure
            from shapewright.building import Workers
            FACTOR = 3.0
            print("read")

            @procedure
            def part(size: Annotated[float, Range(0.5, 1.0)] = 0.7):
                print("from the author")
                return np.eye(3) * size * FACTOR, [[0, 1, 2]]

            with Workers(part, 2, shown=True) as crew:
                builds = crew.build(part.space.sample(20), give_up=True)
            print(sum(b.shape.vertices.max() > 1.4 for b in builds))
            """
        )
    )
    run = subprocess.run([sys.executable, script], capture_output=True, text=True, env=os.environ, timeout=120)
    assert run.stdout.split() == ["read", "20"], run.stderr
    assert "from the author" in run.stderr


def test_files_of_the_author_with_names_of_python_modules_do_not_stop_a_worker(part, tmp_path, monkeypatch):
    for name in ("random", "types", "string", "inspect", "json", "queue"):
        (tmp_path / f"{name}.py").write_text("raise RuntimeError\n")
    monkeypatch.chdir(tmp_path)
    with Workers(part, 1) as crew:
        assert len(crew.build(part.space.sample(3))) == 3


def test_a_file_that_vanished_is_an_error_of_the_procedure(part):
    part.path.unlink()
    with pytest.raises(sw.ProcedureError, match="no such file"):
        build_all(part, vectors("none"), workers=1)


@pytest.mark.skipif(
    not hasattr(os, "sched_getaffinity"), reason="this system cannot tell which cores a process may use"
)
def test_a_worker_may_use_all_cores_although_it_loads_on_one(tmp_path):
    path = tmp_path / "model.py"
    path.write_text(
        textwrap.dedent(
            """
            import os
            from typing import Annotated
            from shapewright import Range, procedure
            from shapewright.modelling.solids import box

            LOADED = len(os.sched_getaffinity(0))

            @procedure
            def part(size: Annotated[float, Range(0.5, 1.0, steps=3)] = 0.5):
                return box((1, LOADED, len(os.sched_getaffinity(0))))
            """
        )
    )
    with Workers(sw.load_procedure(path), 1) as crew:
        (built,) = crew.build([{"size": 0.5}])
    assert built.shape.extent.tolist() == [1, 1, len(os.sched_getaffinity(0))]


def test_what_a_procedure_needs_is_found_by_the_path_of_the_script(tmp_path):
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib" / "mylib.py").write_text(
        "def part(w):\n    return [[0, 0, 0], [w, 0, 0], [0, 1, 0]], [[0, 1, 2]]\n"
    )
    script = tmp_path / "script.py"
    script.write_text(
        "import sys\nfrom pathlib import Path\n"
        "sys.path.insert(0, str(Path(__file__).parent / 'lib'))\n"
        "from typing import Annotated\nimport mylib\nimport shapewright as sw\n"
        "@sw.procedure\ndef mine(w: Annotated[float, sw.Range(1, 2)] = 1.5):\n    return mylib.part(w)\n"
        "print(sum(b.shape is not None for b in sw.sample(mine, 3, workers=1)))\n"
    )
    done = subprocess.run([sys.executable, script], cwd="/", capture_output=True, text=True, check=False)
    assert done.stdout.strip() == "3", done.stderr
