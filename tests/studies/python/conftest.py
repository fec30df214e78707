"""What the tests of the Python package share: a small pair, and the command line."""

import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture
def pair():
    """A helical pair by thin slices at a coarse, fixed resolution: a fraction of a second."""
    return {
        "title": "small",
        "task": "analyse",
        "pair": {"normal_module": 3.0, "helix_angle": 15.0},
        "pinion": {"teeth": 20, "face_width": 30.0, "modification": {"lead_crowning": 6.0, "tip_relief": {"amount": 10.0, "height": 1.5}}},
        "wheel": {"teeth": 41, "face_width": 30.0},
        "misalignment": {"mesh_misalignment": 8.0},
        "load": {"torque": [150.0, 250.0]},
        "fidelity": {"compliance": "thin_slice", "quadrature": {"rule": "graded", "intervals": 6}, "effect_sizes": "off"},
        "cycle": {"positions": 12},
    }


@pytest.fixture
def command(tmp_path):
    """Runs the program in a folder of its own."""

    def run(*arguments):
        return subprocess.run([os.environ["FLANKWRIGHT_EXECUTABLE"], *map(str, arguments)], cwd=tmp_path, capture_output=True, text=True)

    return run
