"""Flankwright designs the micro-geometry of involute spur and helical gears.

    import flankwright as fw

    study = fw.Study.load("pump.toml")                # or fw.Study({...}), with the keys of a study file
    results = fw.analyse(study)
    results["loaded.summary.te_peak_to_peak_um"]      # an array: an entry for each load case
    results.gradient("loaded.summary.te_peak_to_peak_um")

Names are those of results.json. Errors are InvalidInput, with file, line, key, value and what is allowed.
"""

from __future__ import annotations

import os
from typing import Any, Callable, Iterable, Iterator, Mapping, NamedTuple, Optional, Sized, TypeVar, Union

from ._flankwright import Progress, Results, Study, __version__
from . import _flankwright
from .errors import InvalidInput, Problem

__all__ = [
    "Check", "InvalidInput", "Key", "Problem", "Progress", "Results", "Study", "__version__",
    "accuracy", "analyse", "check", "fit", "geometry", "keys", "load_results", "optimise", "run", "sweep", "track",
]  # fmt: skip

Source = Union[Study, Mapping[str, Any], str, "os.PathLike[str]"]
ShowProgress = Union[None, bool, Callable[[str, int, int, str], None]]
Item = TypeVar("Item")


class Key(NamedTuple):
    """A key of a study file, as the key reference has it."""

    path: str  #: dotted; "scenes[].name" is a key of each scene
    unit: str  #: of a bare number, "-" where it has none
    default: str  #: as a study file would have it; in (...) where it comes from elsewhere
    allowed: str
    meaning: str


class Check(NamedTuple):
    """What `flankwright check` says of a study. It is true where the study is valid."""

    problems: list[Problem]
    notes: list[str]  #: warnings, and the backlash that a given centre distance leaves

    def __bool__(self) -> bool:
        return not self.problems


def _study(source: Source) -> Study:
    if isinstance(source, Study):
        return source
    if isinstance(source, (str, os.PathLike)):
        return Study.load(source)
    return Study(source)


def check(study: Source) -> Check:
    """Reads and validates only. Never raises InvalidInput: the problems are in what it returns."""
    try:
        return Check([], _study(study).notes)
    except InvalidInput as error:
        return Check(error.problems, [])


def run(
    study: Source,
    *,
    out: Union[None, str, "os.PathLike[str]"] = None,
    threads: Optional[int] = None,
    progress: ShowProgress = None,
) -> Results:
    """Does the study's task, as `flankwright run` does.

    out: folder for results.json, report.html, tables and stores; without one nothing is written, and a sweep that is interrupted begins anew.
    threads: default all cores; results do not depend on it.
    progress: True for a bar on stderr, or a callable that gets (label, done, total, remark); total is 0 where it is not known.

    The interpreter is free while it runs. Ctrl-C and an exception of the callback end it at its next report of progress.
    """
    return _flankwright.run(_study(study), out, threads, progress)


def _as_task(study: Source, task: str, options: dict[str, Any]) -> Results:
    given = _study(study)
    return run(given if given.task == task else given.replace({"task": task}), **options)


def analyse(study: Source, **options: Any) -> Results:
    """Analyses a study, whatever its task is. Options are those of run()."""
    return _as_task(study, "analyse", options)


def optimise(study: Source, **options: Any) -> Results:
    """Optimises a study that has a table `optimise`. Options are those of run()."""
    return _as_task(study, "optimise", options)


def sweep(study: Source, **options: Any) -> Results:
    """Does the sweep of a study that has a table `sweep`. With the `out` of an interrupted one it goes on from there."""
    return _as_task(study, "sweep", options)


def accuracy(study: Source, **options: Any) -> Results:
    """Compares fidelity levels. Options are those of run()."""
    return _as_task(study, "accuracy", options)


def fit(study: Source, **options: Any) -> Results:
    """Fits the compliance of single gears. Options are those of run()."""
    return _as_task(study, "fit", options)


def geometry(study: Source, **options: Any) -> Results:
    """The gears alone: diameters, contact ratios, thicknesses. Options are those of run()."""
    return _as_task(study, "geometry", options)


def load_results(folder: Union[str, "os.PathLike[str]"]) -> Results:
    """Results that a run has left in a folder."""
    return _flankwright.stored_results(folder)


def keys() -> list[Key]:
    """Every key of a study file, in the order of the key reference."""
    return [Key(*row) for row in _flankwright.keys()]


def track(items: Iterable[Item], label: str = "studies", total: Optional[int] = None) -> Iterator[Item]:
    """The items one by one, with a progress bar on stderr: for variant in fw.track(variants): ..."""
    count = total if total is not None else len(items) if isinstance(items, Sized) else 0
    bar = Progress()
    try:
        for done, item in enumerate(items):
            bar.show(label, done, count)
            yield item
        bar.show(label, count, count)
    finally:
        bar.finish()
