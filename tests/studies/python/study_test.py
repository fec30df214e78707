"""Studies as dicts: what is given comes back, every key can be given, what is wrong is said."""

import math
import pathlib
import pickle
import random
import tomllib

import numpy as np
import pytest

import flankwright as fw
from conftest import ROOT

EXAMPLES = sorted((ROOT / "studies/examples").glob("*.toml"))


def nested(path, value):
    """{"a": {"b": value}} for a.b; x[].y is a key of the first table of a list."""
    for part in reversed(path.split(".")):
        value = {part[:-2]: [value]} if part.endswith("[]") else {part: value}
    return value


def merged(one, other):
    """`other` put into `one`."""
    both = dict(one)
    for key, value in other.items():
        both[key] = merged(both[key], value) if isinstance(value, dict) and isinstance(both.get(key), dict) else value
    return both


def test_a_dict_comes_back_as_it_was_given(pair):
    assert fw.Study(pair).to_dict() == pair
    assert fw.Study(fw.Study(pair).to_dict()) == fw.Study(pair)


def test_integers_stay_integers_and_numbers_stay_numbers(pair):
    pair["pair"]["normal_module"] = 3
    pair["wheel"]["face_width"] = 30.0
    back = fw.Study(pair).to_dict()
    assert type(back["pair"]["normal_module"]) is int
    assert type(back["wheel"]["face_width"]) is float


def test_numbers_come_back_to_the_last_bit(pair):
    generator = random.Random(1)
    for _ in range(200):
        value = generator.choice([generator.uniform(-60.0, 60.0), generator.gauss(0.0, 1.0) * 10.0 ** generator.randint(-300, 0)])
        pair["misalignment"] = {"crossing": value}
        assert fw.Study(pair).to_dict()["misalignment"]["crossing"] == value


def test_texts_come_back_with_everything_in_them(pair):
    pair["title"] = 'a "quoted" \\ title, µm, 齿轮 and an apostrophe\'s'
    pair["expect"] = {"loaded.summary.te_mean_um": {"max": 100.0}}  # a key with dots
    pair["misalignment"] = {"crossing": "3 arcmin"}
    assert fw.Study(pair).to_dict() == pair


def test_numpy_and_paths_are_values(pair):
    pair["load"]["torque"] = np.array([150.0, 250.0])
    pair["pinion"]["teeth"] = np.int64(20)
    pair["pair"]["helix_angle"] = np.float32(15.0)
    pair["title"] = pathlib.Path("small")
    back = fw.Study(pair).to_dict()
    assert back["load"]["torque"] == [150.0, 250.0]
    assert back["pinion"]["teeth"] == 20 and type(back["pinion"]["teeth"]) is int
    assert back["pair"]["helix_angle"] == 15.0
    assert back["title"] == "small"


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_dict_and_file_are_the_same_study(path):
    with path.open("rb") as file:
        given = tomllib.load(file)  # Python's own reader
    study = fw.Study.load(path)
    assert study.to_dict() == given
    assert tomllib.loads(study.to_toml()) == given
    assert fw.Study(given, file=str(path)) == study
    assert fw.check(path) and fw.check(fw.Study(given, file=str(path)))


def test_a_signal_is_named_and_comes_back(pair, tmp_path):
    (tmp_path / "torque.csv").write_text("time,torque\n0,100\n10,250\n20,-30\n")
    pair["load"] = {"speed": 1500, "spectrum": {"signal": str(tmp_path / "torque.csv"), "bins": 3, "hours": 1000.1, "counting": "time_at_level"}}
    study = fw.Study(pair)
    assert study.to_dict() == pair
    assert fw.Study(study.to_dict()) == study
    study.save(tmp_path / "small.toml")
    assert fw.Study.load(tmp_path / "small.toml").to_dict() == pair


def test_a_saved_study_is_the_same(pair, tmp_path):
    study = fw.Study(pair)
    study.save(tmp_path / "small.toml")
    assert fw.Study.load(tmp_path / "small.toml").to_dict() == pair
    assert pickle.loads(pickle.dumps(study)) == study


def test_values_are_replaced_by_their_paths(pair):
    study = fw.Study(pair).replace({"load.torque": 300, "misalignment.crossing": "2 arcmin", "cycle.positions": 8})
    expected = merged(pair, {"load": {"torque": 300}, "misalignment": {"crossing": "2 arcmin"}, "cycle": {"positions": 8}})
    assert study.to_dict() == expected
    assert fw.Study(pair).to_dict() == pair


@pytest.mark.parametrize("key", fw.keys(), ids=lambda key: key.path)
def test_every_key_of_the_schema_is_reached(key, pair):
    """No key takes a truth value. Its refusal says what the key takes: it was the key itself that was reached."""
    problems = fw.check(merged(pair, nested(key.path, True))).problems
    refusals = [problem.allowed for problem in problems if problem.key == key.path.replace("[]", ".0")]
    assert any(key.allowed in allowed for allowed in refusals), problems


@pytest.mark.parametrize("key", [k for k in fw.keys() if not k.default.startswith("(") and "[]" not in k.path], ids=lambda key: key.path)
def test_every_default_can_be_given_and_comes_back(key, pair):
    value = tomllib.loads("value = " + key.default)["value"]
    study = merged(pair, nested(key.path, value))
    problems = [p for p in fw.check(study).problems if p.key == key.path and key.allowed in p.allowed]
    assert problems == []
    if fw.check(study):
        back = fw.Study(study).to_dict()
        for part in key.path.split("."):
            back = back[part]
        assert back == value


def test_a_mistake_in_a_file_has_its_place(tmp_path):
    path = tmp_path / "gears.toml"
    path.write_text("[pair]\nnormal_module = 3\n[pinion]\nteeth = 2\nface_width = 10\n[wheel]\nteeth = 30\nface_wdth = 10\n")
    with pytest.raises(fw.InvalidInput) as caught:
        fw.Study.load(path)
    error = caught.value
    assert (error.file, error.line, error.column, error.key, error.value) == (str(path), 4, 1, "pinion.teeth", "2")
    assert error.allowed == "allowed is an integer 5 .. 1000"
    assert {4, 8} <= {problem.line for problem in error.problems}
    assert str(error).splitlines()[0] == f"{path}:4:1: pinion.teeth = 2: allowed is an integer 5 .. 1000"
    assert isinstance(error, ValueError)


def test_a_mistake_in_a_dict_has_its_key(pair):
    pair["pinion"]["teeth"] = 2
    problems = fw.check(pair).problems
    assert [(p.key, p.value, p.line) for p in problems] == [("pinion.teeth", "2", 0)]
    pair["pinion"]["teeth"] = None
    with pytest.raises(fw.InvalidInput, match="pinion.teeth"):
        fw.Study(pair)
    pair["pinion"]["teeth"] = 2**70
    with pytest.raises(fw.InvalidInput, match="64 bits"):
        fw.Study(pair)


def test_no_number_is_no_value(pair):
    for value in (math.nan, math.inf):
        pair["misalignment"] = {"crossing": value}
        assert [p.key for p in fw.check(pair).problems] == ["misalignment.crossing"]


def test_a_dict_that_contains_itself_is_refused(pair):
    pair["pinion"]["edges"] = pair
    with pytest.raises(fw.InvalidInput):
        fw.Study(pair)
