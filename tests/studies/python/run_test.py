"""Runs from Python: the figures of the command line, arrays with their units, gradients, progress, interruption."""

import json
import os
import pathlib
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import flankwright as fw
from conftest import ROOT

TIMES = re.compile(r'"(seconds|[a-z_]*_seconds)":[-+.e0-9]+')


def without_times(text):
    return TIMES.sub("", text)


def with_sweep(pair, samples):
    pair["load"]["torque"] = 250.0
    return pair | {"task": "sweep", "sweep": {"samples": samples, "parameters": {"misalignment.mesh_misalignment": {"normal": [0, 6]}}}}


def test_results_are_those_of_the_command_line(pair, command, tmp_path, monkeypatch):
    fw.Study(pair).save(tmp_path / "small.toml")
    ending = command("run", "small.toml", "--out", "by-command")
    assert ending.returncode == 0, ending.stderr
    monkeypatch.chdir(tmp_path)
    results = fw.run("small.toml", out="by-python")
    assert results.met and results.folder == "by-python"
    ours, theirs = sorted(p.name for p in pathlib.Path("by-python").iterdir()), sorted(p.name for p in pathlib.Path("by-command").iterdir())
    assert ours == theirs
    for name in ours:
        if name in ("steps.csv", "effects.csv"):
            continue  # times
        assert without_times(pathlib.Path("by-python", name).read_text()) == without_times(pathlib.Path("by-command", name).read_text()), name
    assert without_times(results.json()) == without_times(pathlib.Path("by-command/results.json").read_text())
    assert ending.stdout == results.summary + "\nreport: by-command/report.html\n"
    loaded = fw.load_results("by-command")
    assert without_times(loaded.json()) == without_times(results.json())
    assert loaded.report() == pathlib.Path("by-command/report.html").read_text()


def test_stored_results_say_what_was_not_as_expected(pair, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    expect = {"geometry.pinion.teeth": {"max": 3}}
    results, stored = fw.run(pair | {"expect": expect}, out="stored"), fw.load_results("stored")
    assert not results.met and not stored.met
    assert stored.not_as_expected == results.not_as_expected != ""


def test_results_do_not_depend_on_the_threads(pair):
    assert without_times(fw.run(pair, threads=1).json()) == without_times(fw.run(pair, threads=2).json())


def test_quantities_are_arrays_under_their_names(pair):
    results = fw.run(pair)
    document = json.loads(results.json())
    mean = results["loaded.summary.te_mean_um"]
    assert isinstance(mean, np.ndarray) and mean.dtype == np.float64
    assert mean.tolist() == [case["summary"]["te_mean_um"] for case in document["loaded"]]
    assert results["loaded.torque_Nm"].tolist() == [150.0, 250.0]
    te = results["loaded.cycle.te_um"]
    assert te.shape == (2, 12)
    assert te[1].tolist() == [position["te_um"] for position in document["loaded"][1]["cycle"]]
    assert results["loaded.1.summary.te_mean_um"] == mean[1]
    assert results["loaded.summary.te_harmonics_um"].shape[0] == 2
    lines = results["loaded.0.cycle.teeth.points.load_N_per_mm"]  # teeth and points differ from position to position
    assert len(lines) == 12
    assert [np.concatenate(list(map(np.atleast_1d, position))).size > 0 for position in lines] == [True] * 12
    assert results["loaded.summary.peak_root_stress_MPa"] == [None, None]  # thin slices have no root stress that nobody asks for
    assert results["loaded.0.summary.peak_root_stress_MPa"] is None
    assert results["geometry.pinion.teeth"] == 20
    assert results["title"] == "small"
    assert "loaded.summary.te_mean_um" in results and "loaded.summary.te_meen_um" not in results
    with pytest.raises(fw.InvalidInput, match="did you mean loaded.summary.te_mean_um"):
        results["loaded.summary.te_meen_um"]


def test_names_have_units(pair):
    results = fw.run(pair)
    units = {
        "loaded.summary.te_peak_to_peak_um": "um",
        "loaded.summary.te_peak_to_peak_um_error": "um",
        "loaded.summary.te_harmonics_um.0": "um",
        "loaded.cycle.stiffness_N_per_mm_um": "N/(mm um)",
        "loaded.cycle.teeth.points.load_N_per_mm": "N/mm",
        "loaded.summary.peak_contact_stress_MPa": "MPa",
        "loaded.torque_Nm": "N·m",
        "geometry.pinion.tip_diameter_mm": "mm",
        "geometry.transverse_pressure_angle_deg": "deg",
        "loaded.summary.load_factor": "-",
        "seconds": "s",
    }
    for name, unit in units.items():
        assert name in results, name
        assert results.unit(name) == unit


def test_gradients_are_arrays_and_match_differences(pair):
    paths = ["misalignment.mesh_misalignment", "pinion.modification.lead_crowning", "load.torque"]
    study = fw.Study(pair | {"analyse": {"gradients": paths}})
    results = fw.run(study)
    assert results.parameters == [(paths[0], "um"), (paths[1], "um"), (paths[2], "N·m")]
    name = "loaded.summary.te_mean_um"
    gradient = results.gradient(name)
    assert gradient.shape == (2, 3)
    assert results.gradient("loaded.cycle.te_um").shape == (2, 12, 3)
    np.testing.assert_array_equal(results.gradient("loaded.1.summary.te_mean_um"), gradient[1])
    plain = fw.Study(pair).replace({"load.torque": 250.0})
    for i, (path, step) in enumerate(zip(paths, (1e-3, 1e-3, 5e-3))):
        base = {"misalignment.mesh_misalignment": 8.0, "pinion.modification.lead_crowning": 6.0, "load.torque": 250.0}[path]
        above, below = (fw.run(plain.replace({path: base + s * step}))[name][0] for s in (1, -1))
        # Discretisation: a point that is about to carry load within the step; with a tenth of the step the difference comes nearer.
        assert gradient[1, i] == pytest.approx((above - below) / (2.0 * step), rel=1e-4)
    with pytest.raises(fw.InvalidInput, match="no derivatives"):
        results.gradient("geometry.pinion.teeth")


def test_tasks_are_functions(pair):
    assert fw.geometry(pair)["geometry.total_contact_ratio"] > 1.0
    asked = pair | {"optimise": {"objective": "te_peak_to_peak", "variables": {"pinion.modification.lead_crowning": [0, 20]}}}
    optimum = fw.optimise(asked)
    assert optimum.task == "optimise"
    assert optimum["optimise.after.objective"] <= optimum["optimise.before.objective"]
    assert 0.0 <= optimum["optimise.after.variables.pinion.modification.lead_crowning"] <= 20.0
    swept = fw.sweep(with_sweep(pair, 32))
    assert swept["sweep.samples"] == 32
    with pytest.raises(fw.InvalidInput, match="optimise"):
        fw.optimise(pair)


def test_progress_is_shown_to_the_caller_by_his_own_thread(pair):
    seen = []
    fw.run(with_sweep(pair, 64), progress=lambda *state: seen.append((threading.get_ident(), *state)))
    assert {thread for thread, *_ in seen} == {threading.get_ident()}
    thread, label, done, total, remark = seen[-1]
    assert (label, done, total) == ("samples", 64, 64) and isinstance(remark, str)


def test_an_exception_of_the_callback_ends_the_run(pair):
    class Enough(Exception):
        pass

    def callback(label, done, total, remark):
        raise Enough

    started = time.monotonic()
    with pytest.raises(Enough):
        fw.run(with_sweep(pair, 100000), progress=callback)
    assert time.monotonic() - started < 60.0


def test_a_bar_is_shown_on_demand(pair, capfd):
    fw.run(with_sweep(pair, 16))
    assert capfd.readouterr().err == ""
    fw.run(with_sweep(pair, 16), progress=True)
    assert "samples [" in capfd.readouterr().err
    assert list(fw.track(range(3), "variants")) == [0, 1, 2]
    assert "variants [##############################] 3/3" in capfd.readouterr().err


def test_the_interpreter_is_free_meanwhile(pair):
    ticks, done = 0, False

    def count():
        nonlocal ticks
        while not done:
            ticks += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    started = time.monotonic()
    fw.run(with_sweep(pair, 64), threads=1)
    seconds = time.monotonic() - started
    done = True
    counter.join()
    # A held interpreter would give the other thread none or a few turns; a free one hundreds a second, on a loaded machine still tens.
    assert ticks > 10 * seconds


SWEEP = """
import sys, flankwright as fw
study = fw.Study.load(sys.argv[1])
try:
    fw.sweep(study, out=sys.argv[2], threads=1, progress=lambda *state: print(*state, flush=True))
except KeyboardInterrupt:
    sys.exit(77)
"""


def test_ctrl_c_leaves_the_store_whole_and_the_next_run_goes_on(pair, tmp_path):
    study = fw.Study(with_sweep(pair, 100000))
    study.save(tmp_path / "long.toml")
    process = subprocess.Popen([sys.executable, "-c", SWEEP, tmp_path / "long.toml", tmp_path / "r"], stdout=subprocess.PIPE, text=True)
    for line in process.stdout:
        if line.startswith("samples") and int(line.split()[1]) >= 3:
            break
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=120)
    assert process.returncode == 77
    store = tmp_path / "r" / "results.sqlite"
    with sqlite3.connect(store) as database:
        kept = database.execute("SELECT count(*) FROM samples").fetchone()[0]
    assert kept >= 3
    # The smaller sweep is the beginning of the larger: it finds what it needs of the samples, and is that of an undisturbed run.
    few = min(kept, 8)
    shorter = study.replace({"sweep.samples": few})
    shown = []
    resumed = fw.sweep(shorter, out=tmp_path / "r", progress=lambda *state: shown.append(state))
    fresh = fw.sweep(shorter)
    statistics = "sweep.statistics.te_mean_um.mean"
    assert resumed[statistics] == fresh[statistics]


def test_a_hundred_variants_need_no_more_memory_than_a_few(pair):
    """Bodies of different gears one after another, none of which is kept."""

    def resident():
        return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def analyse(i):
        pair["pinion"]["teeth"], pair["pair"]["helix_angle"] = 18 + i % 7, 10.0 + 0.05 * i
        fw.analyse(pair)

    for i in range(30):
        analyse(i)
    before = resident()
    for i in range(30, 130):
        analyse(i)
    # A kept set of meshes is about a megabyte; the allocator's own unrest some megabytes in all.
    assert resident() - before < 30e6


def test_scripts_of_the_gallery_run():
    folder = ROOT / "studies/examples/python"
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    for script, arguments, said in (("contact_ratio.py", ["--quick"], "contact ratio"), ("openmdao_component.py", [], "partials")):
        ending = subprocess.run([sys.executable, folder / script, *arguments], capture_output=True, text=True, env=environment)
        assert ending.returncode == 0, ending.stderr
        assert said in ending.stdout


@pytest.mark.skipif(shutil.which("mypy") is None, reason="mypy is not installed")
def test_types_are_complete(tmp_path):
    package = pathlib.Path(fw.__file__).parent
    program = tmp_path / "user.py"
    program.write_text(
        "import flankwright as fw\n"
        "study: fw.Study = fw.Study.load('pump.toml', {'load.torque': 3})\n"
        "results: fw.Results = fw.analyse(study, progress=True)\n"
        "unit: str = results.unit('loaded.summary.te_mean_um')\n"
        "for key in fw.keys():\n    text: str = key.allowed\n"
    )
    environment = os.environ | {"MYPYPATH": str(package.parent), "PYTHONPATH": str(package.parent)}
    # The stub against the module itself: what pybind11 makes has a metaclass of its own, and Results no constructor.
    (tmp_path / "allowed").write_text("flankwright._flankwright.(Progress|Results|Study)\nflankwright._flankwright.Results.__init__\n")
    stubtest = ["stubtest", "flankwright._flankwright", "--ignore-missing-stub", "--ignore-positional-only", "--allowlist", tmp_path / "allowed"]
    for arguments in (["mypy", "--strict", program, package], stubtest):
        ending = subprocess.run(arguments, capture_output=True, text=True, cwd=tmp_path, env=environment)
        assert ending.returncode == 0, ending.stdout + ending.stderr
