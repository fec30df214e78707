import os
from typing import Any, Callable, Mapping, Optional, Union

_Path = Union[str, "os.PathLike[str]"]

__version__: str

class Study:
    """A study: the contents of a study file, validated."""

    def __init__(self, values: Mapping[str, Any], file: str = "study") -> None:
        """values: the keys of a study file, tables as mappings. file: stands for it in messages; paths of grids count from its folder."""
    @staticmethod
    def load(path: _Path, values: Mapping[str, Any] = {}) -> Study:
        """Reads a study file. values: dotted paths with what replaces or adds to the file's, as `--set` does."""
    @staticmethod
    def from_toml(text: str, file: str = "study") -> Study: ...
    def replace(self, values: Mapping[str, Any]) -> Study:
        """Another study, with values under dotted paths replaced or added: study.replace({"load.torque": 300})."""
    def to_dict(self) -> dict[str, Any]:
        """The values as they were given; Study(study.to_dict()) is the same study."""
    def to_toml(self) -> str: ...
    def save(self, path: _Path) -> None: ...
    @property
    def title(self) -> str: ...
    @property
    def task(self) -> str: ...
    @property
    def file(self) -> str: ...
    @property
    def notes(self) -> list[str]: ...
    def __eq__(self, other: object) -> bool: ...

class Results:
    """What a run leaves, under the names of results.json."""

    def __getitem__(self, name: str) -> Any:
        """What is under a dotted name.

        A number picks an entry of a list, from 0. A list that the name passes through without one gives an entry for each of its entries, so that
        "loaded.summary.te_mean_um" is an array over the load cases and "loaded.cycle.te_um" one over load cases and positions. Numbers are float or
        int, lists of numbers arrays of float64 with NaN for what was not computed, lists of lists of different lengths lists of arrays, objects dicts.
        """
    def __contains__(self, name: str) -> bool: ...
    def keys(self) -> list[str]:
        """The sections."""
    def unit(self, name: str) -> str:
        """The unit of a quantity, "-" of a plain number."""
    def gradient(self, name: str) -> Any:
        """Derivatives of a quantity of `loaded`: as the quantity itself, with one more axis behind, an entry for each of `parameters`."""
    @property
    def parameters(self) -> list[tuple[str, str]]:
        """What derivatives were asked for by, `analyse.gradients`: paths, and their units."""
    def json(self) -> str:
        """The text of results.json."""
    def report(self) -> str:
        """The report, a page that opens without a network."""
    @property
    def task(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def folder(self) -> str:
        """The folder that files were written to, "" for none."""
    @property
    def summary(self) -> str:
        """The table that `flankwright run` prints; "" of results that were loaded."""
    @property
    def notes(self) -> list[str]: ...
    @property
    def requirements_not_met(self) -> list[str]: ...
    @property
    def not_as_expected(self) -> str:
        """What differs from [expect], a line each; "" where nothing does, and of results that were loaded."""
    @property
    def met(self) -> bool:
        """Whether nothing that was required is missing: exit code 0 of the command line."""

class Progress:
    """A progress bar on stderr, as the program has it: it redraws itself on a terminal and is a line every few seconds elsewhere."""

    def show(self, label: str, done: int, total: int, remark: str = "") -> None: ...
    def finish(self) -> None: ...

def keys() -> list[tuple[str, str, str, str, str]]: ...
def stored_results(folder: _Path) -> Results: ...
def run(
    study: Study, out: Optional[_Path], threads: Optional[int], progress: Union[None, bool, Callable[[str, int, int, str], None]]
) -> Results: ...
