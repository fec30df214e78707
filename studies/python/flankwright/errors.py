"""What is wrong with an input."""

from __future__ import annotations

from typing import NamedTuple, Sequence


class Problem(NamedTuple):
    """One thing that is not allowed."""

    file: str  #: path as given; "" where there is no file
    line: int  #: from 1; 0 where there is no line, as in a dict
    column: int
    key: str  #: dotted path; "" of a syntax error
    value: str  #: as written, shortened
    allowed: str  #: what would have been accepted


class InvalidInput(ValueError):
    """Bad input. It has the members of the first of its ``problems``, of which a study may have many."""

    def __init__(self, message: str, problems: Sequence[Problem]) -> None:
        super().__init__(message)
        self.problems = list(problems)
        self.file, self.line, self.column, self.key, self.value, self.allowed = self.problems[0]

    def __reduce__(self) -> tuple[type, tuple[str, list[Problem]]]:
        return type(self), (str(self), self.problems)
