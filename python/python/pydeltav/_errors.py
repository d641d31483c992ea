"""What is raised, besides the errors of Python itself."""

from collections.abc import Sequence
from typing import NamedTuple


class Problem(NamedTuple):
    """Something that is wrong with a case.

    Parameters
    ----------
    key : str or None
        The key that it is about, such as ``vehicle1.crush.width``; None of the case as a whole.
    line : int or None
        Its line in ``Case.text``, from 1 on; None of what stands in no text.
    column : int or None
        Its column, from 1 on.
    message : str
        What is wrong.
    help : str or None
        What to write instead.

    Examples
    --------
    >>> try:
    ...     pydeltav.Case.parse("vehicle3 = 1")
    ... except pydeltav.CaseError as error:
    ...     print(error.problems[0].line)
    1
    """

    key: str | None
    """The key that it is about, such as ``vehicle1.crush.width``; None of the case as a whole."""
    line: int | None
    """Its line in ``Case.text``, from 1 on; None of what stands in no text."""
    column: int | None
    """Its column, from 1 on."""
    message: str
    """What is wrong."""
    help: str | None
    """What to write instead."""


class CaseError(ValueError):
    """The case is wrong, or lacks what the method needs.

    The text points at each place; ``problems`` has the same as data.

    Parameters
    ----------
    text : str
        What is wrong, where, and what to write instead.
    problems : sequence of Problem
        The same as data.

    Examples
    --------
    >>> try:
    ...     pydeltav.Case.from_dict({"vehicle1": {"speed": "35 feets/s"}, "vehicle2": {"fixed": True}})
    ... except pydeltav.CaseError as error:
    ...     [problem] = error.problems
    >>> problem.key, problem.line, problem.column
    ('vehicle1.speed', 3, 9)
    >>> problem.message
    '"35 feets/s" has an unknown unit "feets/s"'
    """

    problems: tuple[Problem, ...]

    def __init__(self, text: str, problems: Sequence[Problem] = ()) -> None:
        super().__init__(text, tuple(problems))
        self.problems = tuple(problems)

    def __str__(self) -> str:
        return str(self.args[0])


class NoAnswerError(ValueError):
    """The case is well formed, but has no answer: no collision can be like it.

    Examples
    --------
    >>> numbers = pydeltav.Case.example().to_dict()
    >>> numbers["vehicle1"]["speed"] = "-80 mph"
    >>> try:
    ...     pydeltav.Case.from_dict(numbers).impact()
    ... except pydeltav.NoAnswerError:
    ...     print("no collision is like it")
    no collision is like it
    """


for _class in (Problem, CaseError, NoAnswerError):
    _class.__module__ = "pydeltav"
del _class
