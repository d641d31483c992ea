"""What results hold: the classes of their parts, for type checkers, editors and annotations.

The attributes are the keys of the program's JSON document, in SI units and radians; the unit is in front of what each
says. A pair is of vehicle 1 and vehicle 2, or x and y of a vector, as stated. ``None`` is what is not known or not
defined. An attribute that does not apply is absent: access to it raises ``AttributeError``, and ``"pdof" in part``
shows whether it is there. Signs are those of ``axes``.

Where the type depends on what the case asks for, it says ``| Any``, so that no check is needed in front of
``result.found.value``.

>>> from pydeltav.results import Vehicle
>>> def harm(vehicle: Vehicle) -> str:
...     return f"{vehicle.delta_v:.2f} m/s"
>>> harm(pydeltav.Case.example().reconstruct().vehicle1)
'12.15 m/s'
"""

from collections.abc import Mapping
from typing import Any

from pydeltav._record import Keyed, Record

__all__ = [
    "AbilityOf",
    "Assumption",
    "AtLimit",
    "Avoidable",
    "AvoidanceAnswer",
    "AvoidanceIntervals",
    "AvoidanceProbability",
    "AvoidanceRun",
    "Bar",
    "CaseFile",
    "CaseWarning",
    "Check",
    "Choice",
    "Combination",
    "Correction",
    "Crash3",
    "CrushError",
    "Demand",
    "Derivative",
    "Distribution",
    "Doubt",
    "Doubtful",
    "DriverResponse",
    "Enough",
    "EstimatedOutput",
    "Evidence",
    "EvidenceAnswer",
    "Figures",
    "Found",
    "Headline",
    "HeadlineFigure",
    "HeadlineVehicle",
    "Impact",
    "Index",
    "IndexRows",
    "InferredCrush",
    "Influence",
    "Input",
    "Interval",
    "Iteration",
    "JudgedData",
    "JudgedVehicle",
    "Keyed",
    "LawAnswer",
    "LawCheck",
    "LeftOut",
    "MedianInterval",
    "Moment",
    "Momentum",
    "OutputErrors",
    "Passed",
    "Piece",
    "Posterior",
    "PosteriorErrors",
    "Program",
    "Question",
    "Rest",
    "SameLine",
    "Sight",
    "SightIntervals",
    "Skid",
    "Start",
    "Stood",
    "SweepRow",
    "TakenAsExact",
    "Truncation",
    "UncertainInput",
    "UncertainOutput",
    "Unknown",
    "Unused",
    "Vehicle",
    "WhyNotExact",
]

_Pair = tuple[float, float]
_MaybePair = tuple[float | None, float | None]


# Of every result.


class Program(Record):
    """The program that made a result."""

    name: str
    """``"deltav"``."""
    version: str
    """Its version."""


class CaseFile(Record):
    """The case of a result."""

    file: str
    """Its name."""
    sha256: str
    """The SHA-256 of its text, in hexadecimal digits."""


class CaseWarning(Record):
    """A warning that a careful reconstructionist would want."""

    code: str
    """What it is about, in a word."""
    vehicle: int
    """1 or 2, where it is about one vehicle."""
    message: str
    """In words."""


# reconstruct(), impact(), motion() and crush()


class WhyNotExact(Record):
    """Why the exact solution is not the answer."""

    left_aside: tuple[str, ...]
    """Keys of evidence that it does not use."""
    refuted_by: tuple[str, ...]
    """Codes of the checks that it does not pass."""
    contradicted: bool
    """Whether other evidence contradicts it, or a vehicle would back faster than any does."""
    energy_share: float | None
    """(–) the average share of the impact's energy that its crush energies show, if it does not correct them."""
    takes_bound: bool
    """Whether it takes the energy at which residual crush begins for that of the impact, without residual crush."""
    nearly_stood: tuple[str, ...]
    """The vehicles that it has move backward so slowly that they are likely to have stood."""


class HeadlineFigure(Record):
    """A number of the answer."""

    value: float | None
    """(m/s) as solved, or the median of all the evidence; None where that gives no answer."""
    interval95: _Pair
    """(m/s) 95 % interval by all the evidence, where it was weighed and gives an answer."""


class HeadlineVehicle(Record):
    """The answer for a vehicle."""

    speed: HeadlineFigure
    """(m/s) before the impact, along its heading."""
    delta_v: HeadlineFigure
    """(m/s) change of its velocity in the impact."""


class Headline(Record):
    """The answer of a reconstruction, and how it was obtained."""

    by: str
    """``"exact"``, ``"estimate"`` for all the evidence weighed, or ``"none"`` where neither is the answer."""
    why_not_exact: WhyNotExact
    """Why the exact solution is not the answer, where it is not."""
    converged: bool
    """Whether the weighing has converged, where there was one."""
    contradicting: tuple[str, ...]
    """Keys of evidence that all the other evidence contradicts, where there is any."""
    doubtful: tuple[str, ...]
    """Keys of evidence that the other evidence makes doubtful, where there is any."""
    vehicle1: HeadlineVehicle
    """Vehicle 1, where there is an answer and it can move."""
    vehicle2: HeadlineVehicle
    """Vehicle 2, likewise."""


class Solution(Record):
    """The answer by a part of the evidence, taken as exact."""

    by: str
    """That part, in words."""
    speeds: _MaybePair
    """(m/s) of both vehicles along their headings, if it gives them."""
    delta_v: _MaybePair
    """(m/s) of both vehicles; None for one that cannot move."""
    outside: tuple[str, ...]
    """Keys of the results that lie outside the 95 % interval of all the evidence."""
    differs_from_given: tuple[str, ...]
    """Keys of given speeds from which it differs, where there are any."""
    failed: tuple[str, ...]
    """Codes of its checks that fail."""


class Check(Record):
    """A consistency check: two values of the same quantity, compared."""

    code: str
    """What is checked, in a word."""
    vehicle: int
    """1 or 2, where it is about one vehicle."""
    value: float
    """(SI) the difference of the two."""
    limit: float
    """(SI) the greatest difference allowed."""
    passed: bool
    """Whether they are within the limit."""


class Iteration(Record):
    """A step of the root finder."""

    speed: float
    """(m/s) the speed that was tried."""
    normal_work: float
    """(J) work of the normal impulse at this speed, where the crush energy is that work alone."""
    crush_work: float
    """(J) work of the normal impulse and a share of that of the tangential one, where the crush energy is that sum."""


class Found(Record):
    """A speed that was sought."""

    quantity: str
    """What was sought: ``"vehicle1.speed"``."""
    value: float
    """(m/s) along the heading."""
    admissible_roots: int
    """(–) number of speeds that fit."""
    roots: tuple[float, ...]
    """(m/s) all of them."""
    method: str
    """How it was found, such as ``"closed form"``, ``"root finder"`` or ``"momentum"``."""
    iterations: tuple[Iteration, ...]
    """The steps of the root finder."""


class Combination(Record):
    """A pair of motions, one of each vehicle to its rest, and how well the two agree with the impulse."""

    speeds: _Pair
    """(m/s) speeds of both vehicles along their headings, before the impact."""
    velocities: tuple[_Pair, _Pair]
    """(m/s) velocities of both vehicles after the impact, x and y."""
    yaw_rates: _MaybePair
    """(rad/s) yaw rates of both vehicles after the impact."""
    turns: _MaybePair
    """(rad) of both on the path to rest; None for one that is not followed."""
    misfit: float
    """(–) χ² of the values that the speeds imply against those known from elsewhere."""
    weight: float
    """(–) share of this combination among all."""
    against: tuple[str, ...]
    """Codes of the checks that it does not pass."""


class Momentum(Record):
    """What both speeds and the velocities after the impact imply, without an impact law."""

    approach_angle: float
    """(rad) from the heading of vehicle 1 to that of vehicle 2."""
    impulse: _Pair
    """(N s) x and y, on vehicle 1."""
    disagreement: float
    """(N s) difference between the impulses by the two vehicles."""
    restitution: float | None
    """(–) restitution at the contact point."""
    cg_closing_speed: float
    """(m/s) closing speed of the centres of gravity, for point masses."""
    cg_restitution: float
    """(–) restitution of the centres of gravity, for point masses."""
    impulse_ratio: float | None
    """(–) tangential impulse divided by normal impulse; not for point masses."""
    critical_impulse_ratio: float | None
    """(–) impulse ratio that just ends the sliding; not for point masses."""
    energy_loss: float
    """(J) kinetic energy lost in the impact."""
    normal_work: float
    """(J) work of the normal impulse; not for point masses."""
    tangential_work: float
    """(J) work of the tangential impulse; not for point masses."""
    delta_v: _MaybePair
    """(m/s) of both vehicles."""
    pdof: _MaybePair
    """(rad) PDOF of both vehicles, clockwise from the heading."""
    final_yaw_rate: _MaybePair
    """(rad/s) yaw rates of both vehicles after the impact; not for point masses."""
    combinations: tuple[Combination, ...]
    """The motions that lead to the rest positions, beginning with the one that is used."""


class Impact(Record):
    """What the impact did."""

    law: str
    """The impact law, where one gave the speeds after the impact."""
    regime: str
    """Whether the contact slid, stuck or turned around, if the law determines it."""
    restitution: float | None
    """(–) None where vehicles do not close by momentum."""
    impulse_ratio: float | None
    """(–) tangential impulse divided by normal impulse; not for point masses."""
    critical_impulse_ratio: float | None
    """(–) impulse ratio that just ends the sliding; None where no push could end it."""
    normal_impulse: float
    """(N s) impulse along the normal; not for point masses."""
    tangential_impulse: float
    """(N s) impulse along the crush plane; not for point masses."""
    impulse: _Pair
    """(N s) x and y, on vehicle 1."""
    impulse_direction: float
    """(rad) from the x axis."""
    normal: _Pair
    """(–) x and y of the normal of the crush plane; not for point masses."""
    closing_speed: float
    """(m/s) closing speed along the normal at the contact point, before the impact."""
    normal_velocity: _Pair
    """(m/s) relative velocity along the normal before and after the impact; not for point masses."""
    tangential_velocity: _Pair
    """(m/s) relative velocity along the crush plane before and after the impact; not for point masses."""
    initial_energy: float
    """(J) kinetic energy of both vehicles before the impact."""
    final_energy: float
    """(J) kinetic energy of both vehicles after it."""
    energy_loss: float
    """(J) energy lost in the impact."""
    normal_work: float
    """(J) work of the normal impulse; not for point masses."""
    tangential_work: float
    """(J) work of the tangential impulse; not for point masses."""
    moment_impulse: float
    """(N m s) moment impulse between the vehicles, where the law has one."""
    moment_work: float
    """(J) work of that moment."""


class LawCheck(Record):
    """What the impact law gives at the speeds that momentum gave."""

    law: str
    """The impact law."""
    regime: str
    """Whether the contact slid, stuck or turned around, if the law determines it."""
    restitution: float
    """(–) restitution of the law."""
    energy_loss: float
    """(J) energy lost in the impact."""
    delta_v: _MaybePair
    """(m/s) of both vehicles."""
    delta_v_difference: _MaybePair
    """(m/s) ΔV by the law less ΔV by momentum."""
    final_speed: _MaybePair
    """(m/s) speeds of both vehicles after the impact."""
    final_yaw_rate: _MaybePair
    """(rad/s) yaw rates of both vehicles after the impact."""
    pdof: _MaybePair
    """(rad) PDOF of both vehicles, clockwise from the heading."""


class InferredCrush(Record):
    """A crush that follows from the force on the other vehicle."""

    depth: float
    """(m) depth of the crush."""
    width: float
    """(m) width of the damage."""


class Skid(Record):
    """Skid marks before the impact."""

    speed: float
    """(m/s) speed where they begin."""


class Start(Record):
    """How a vehicle left the impact."""

    source: str
    """How it is known: ``"impact"``, ``"given"``, ``"rest"`` or ``"straight rest"``."""
    speed: float
    """(m/s) speed of its centre of gravity."""
    direction: float
    """(rad) direction of its velocity, from the x axis."""
    yaw_rate: float
    """(rad/s) yaw rate."""


class Rest(Record):
    """Where a vehicle came to rest."""

    x: float
    """(m) coordinate of its centre of gravity."""
    y: float
    """(m) coordinate of its centre of gravity."""
    heading: float
    """(rad) heading, counted on from that at the impact, full turns included."""
    time: float
    """(s) after the impact."""
    distance: float
    """(m) of the path."""


class Moment(Record):
    """A moment on the path to rest."""

    time: float
    """(s) after the impact."""
    x: float
    """(m) coordinate of the centre of gravity."""
    y: float
    """(m) coordinate of the centre of gravity."""
    heading: float
    """(rad) heading, counted on from that at the impact."""
    velocity: _Pair
    """(m/s) velocity, x and y."""
    yaw_rate: float
    """(rad/s) yaw rate."""
    sliding: tuple[bool, bool, bool, bool]
    """Whether the wheels slide: front left, front right, rear left, rear right."""


class Passed(Record):
    """How the path passes a point of the case."""

    wheel: str
    """The wheel that left the mark, where the case says."""
    miss: float
    """(m) distance of the path from the point."""
    turned: float
    """(rad) difference of the heading there from that of the case, where it gives one."""


class Vehicle(Record):
    """A vehicle, or a fixed object, which has only a name and ``fixed``."""

    name: str
    """Its name in the case."""
    fixed: bool
    """True for a fixed object; absent for a vehicle."""
    speed: float
    """(m/s) before the impact, along its heading."""
    velocity: _Pair
    """(m/s) x and y before the impact."""
    yaw_rate: float
    """(rad/s) before the impact."""
    final_velocity: _Pair
    """(m/s) x and y after the impact."""
    final_yaw_rate: float
    """(rad/s) after the impact, where it is known."""
    final_speed: float
    """(m/s) after the impact."""
    delta_v: float
    """(m/s) change of its velocity in the impact."""
    delta_v_longitudinal: float
    """(m/s) component of that change along its heading, forward."""
    delta_v_lateral: float
    """(m/s) component of that change along its y axis."""
    delta_v_vector: _Pair
    """(m/s) that change as x and y of the scene."""
    pdof: float
    """(rad) principal direction of force, from the front."""
    stiffness_source: str
    """Where its stiffness comes from, in words."""
    crush_source: str
    """How its crush energy is known: ``"measured"``, ``"force balance"``, ``"EES"``, ``"none"`` or ``"object"``."""
    crush_energy: float
    """(J) crush energy, by the damage."""
    crush_energy_bounds: _Pair
    """(J) lowest and highest, where its crush was inferred with a range."""
    inferred_crush: InferredCrush
    """Where its crush follows from the force on the other vehicle."""
    oblique_angle: float
    """(rad) between the force and the normal of the damaged side."""
    oblique_factor: float
    """(–) factor by which an oblique force raises the energy."""
    corrected_crush_energy: float
    """(J) crush energy with that factor."""
    ees: float
    """(m/s) energy equivalent speed."""
    peak_force: float
    """(N) peak force, at maximum crush."""
    no_damage_speed: float
    """(m/s) no-damage speed of its stiffness."""
    skid: Skid
    """Skid marks before the impact, where the case has them."""
    start: Start
    """How it left the impact, where it is followed."""
    rest: Rest
    """Where it came to rest, where it is followed."""
    path: tuple[Moment, ...]
    """Its path to rest, where it is followed."""
    points: tuple[Passed, ...]
    """How the path passes the points of the case, where it has them."""


class Correction(Record):
    """CRASH3's answer with one correction for oblique forces."""

    oblique: str
    """The correction."""
    friction: _MaybePair
    """(–) friction limits of both vehicles, for the friction-limited correction."""
    factor: _Pair
    """(–) factors on the energies of both vehicles."""
    crush_energy: float
    """(J) crush energy of both vehicles together."""
    delta_v: _MaybePair
    """(m/s) of both vehicles."""


class Crash3(Record):
    """CRASH3: ΔV from damage and PDOF alone."""

    crush_energy: float
    """(J) crush energy of both vehicles together."""
    corrected_crush_energy: float
    """(J) that energy corrected for oblique forces."""
    moment_arm: _MaybePair
    """(m) moment arm of the force about the centre of gravity, for both vehicles."""
    effective_mass_ratio: _Pair
    """(–) effective mass ratio of both vehicles: the share of the mass that the force has to move."""
    delta_v: _MaybePair
    """(m/s) of both vehicles."""
    corrected_delta_v: _MaybePair
    """(m/s) ΔV of both vehicles, corrected for oblique forces."""
    restitution_factor: float
    """(–) factor on ΔV, where the case gives a restitution."""
    corrections: tuple[Correction, ...]
    """The answers with each correction."""


class _Document:
    program: Program
    """The program that made the result."""
    case: CaseFile
    """The case of the result."""
    title: str
    """The title of the case; empty without one."""
    axes: str
    """``"z-up"`` or ``"z-down"``: the axes of all signed values."""


class _Analysis(_Document):
    headline: Headline
    """The answer of a reconstruction, and how it was obtained."""
    solutions: tuple[Solution, ...]
    """The answers by parts of the evidence, where all of it was weighed."""
    left_aside: tuple[str, ...]
    """Keys of evidence that the numbers do not use, where there are any."""
    energy_basis: str
    """What the crush energy stands for."""
    tangential_share: float
    """(–) share of the tangential work, where the energy basis is such a share."""
    warnings: tuple[CaseWarning, ...]
    """Objections to the answer."""
    solution_warnings: tuple[CaseWarning, ...]
    """Objections to the exact solution, if all the evidence was weighed."""
    checks: tuple[Check, ...]
    """The consistency checks."""
    found: Found | Any
    """The speed that was sought; where both were sought, a tuple of two ``Found``."""
    momentum: Momentum
    """What follows from momentum, where the case gives how the vehicles left the impact."""
    impact: Impact
    """What the impact did, where there are speeds."""
    law_check: LawCheck
    """What the impact law gives at the speeds that momentum gave."""
    vehicle1: Vehicle
    """Vehicle 1."""
    vehicle2: Vehicle
    """Vehicle 2."""
    crash3: Crash3
    """CRASH3, where both vehicles have damage."""


# check()


class AbilityOf(Record):
    """Whether a command, or the method of the same name, can answer."""

    command: str
    """Its name."""
    runs: bool
    """Whether the case has what it needs."""
    obstacles: tuple[str, ...]
    """What the case lacks, in words."""
    left_aside: tuple[str, ...]
    """Keys of evidence that its exact answer does not use, where there are any."""
    draws: tuple[str, ...]
    """For ``draw``: what can be drawn."""


class Input(Record):
    """A number of the case."""

    path: str
    """Its key, such as ``"vehicle1.mass"``."""
    number: float
    """In the unit of the case."""
    unit: str | None
    """The unit in the case; None for a number without one."""
    si: float
    """(SI) in ``si_unit``."""
    si_unit: str | None
    """The SI unit."""
    us: float
    """(US) in ``us_unit``."""
    us_unit: str | None
    """The US unit."""
    range: str
    """Its range in words, where it has one."""


class Choice(Record):
    """A choice that the case makes."""

    path: str
    """Its key."""
    value: str
    """What was chosen."""


class Assumption(Record):
    """What is assumed where the case gives nothing."""

    key: str
    """The key that would give it."""
    message: str
    """What is assumed, in words."""


class _Judgement(_Document):
    commands: tuple[AbilityOf, ...]
    """Which questions the case can answer."""
    answers_most: str | None
    """The command that makes the fullest use of what the case has."""
    inputs: tuple[Input, ...]
    """The numbers of the case."""
    choices: tuple[Choice, ...]
    """The choices of the case."""
    assumptions: tuple[Assumption, ...]
    """What is assumed where the case gives nothing."""
    warnings: tuple[CaseWarning, ...]
    """The warnings on the case."""


# compare()


class LawAnswer(Record):
    """The answer of an impact law, or of CRASH3."""

    law: str
    """Its name."""
    coefficients: str
    """Its coefficients, in words."""
    assumed: str
    """What it assumes that the case does not give, in words."""
    friction: _Pair
    """(–) CRASH3's friction limits of both vehicles."""
    found: float
    """(m/s) the speed that was sought."""
    speeds: _Pair
    """(m/s) both speeds, where both were sought."""
    regime: str
    """Whether the contact slid, stuck or reversed."""
    delta_v: _Pair
    """(m/s) of both vehicles."""
    pdof: _MaybePair
    """(rad) PDOF of both vehicles, clockwise from the heading; None for a fixed object."""
    energy_loss: float
    """(J) energy lost in the impact."""
    normal_share: float
    """(–) work of the normal impulse as a share of the initial kinetic energy."""
    tangential_share: float
    """(–) work of the tangential impulse as a share of the initial kinetic energy."""
    moment_share: float
    """(–) work of the moment as a share of the initial kinetic energy, for a law that has one."""
    final_yaw_rate: _Pair
    """(rad/s) yaw rates of both vehicles after the impact."""
    found_difference: float
    """(m/s) difference from the first row."""
    speeds_difference: _Pair
    """(m/s) differences of both speeds from the first row."""
    delta_v_difference: _Pair
    """(m/s) differences of both ΔV from the first row."""
    error: str
    """Why the law has no answer, in words."""


class EvidenceAnswer(Record):
    """The answer by one kind of evidence, or why there is none."""

    speeds: _Pair
    """(m/s) of both vehicles before the impact."""
    delta_v: _Pair
    """(m/s) of both vehicles."""
    closing_speed: float
    """(m/s) closing speed."""
    crush_energy_needed: float
    """(J) crush energy that the impact would need."""
    energy_loss: float
    """(J) energy lost in the impact."""
    standard_deviations_apart: float
    """(–) standard deviations between momentum and crush energy, where both were weighted."""
    how: str
    """How it was found, in words."""
    error: str
    """Why there is no answer, in words."""


class Evidence(Record):
    """The answers by damage, by momentum and by both together."""

    crush_energy: float
    """(J) crush energy as measured."""
    damage: EvidenceAnswer
    """By the damage."""
    momentum: EvidenceAnswer
    """By momentum."""
    momentum_and_damage: EvidenceAnswer
    """By both."""


class _Comparison(_Document):
    rows: tuple[LawAnswer, ...]
    """The answers; the first is that of the case's own law."""
    evidence: Evidence
    """The answers by kind of evidence, where the case has several."""
    left_aside: tuple[str, ...]
    """Keys of evidence that the numbers do not use, where there are any."""
    warnings: tuple[CaseWarning, ...]
    """Those of the case as it stands."""


# sensitivity()


class Derivative(Record):
    """How much an output changes with an input."""

    output: str
    """The key of the result."""
    input: str
    """The key of the case."""
    name: str
    """In words, for an input that is not a key of the file."""
    value: float
    """(SI/SI) the derivative."""
    relative: float
    """(–) per cent of the output for each per cent of the input."""
    influence: float
    """(–) relative change of the output for 1 % of the input, or for 1° of an angle."""


class SweepRow(Record):
    """CRASH3's answer with the PDOF turned."""

    change: float
    """(rad) angle by which it is turned."""
    pdof: _MaybePair
    """(rad) PDOF of both vehicles, clockwise from the heading."""
    oblique_angle: _MaybePair
    """(rad) of both vehicles, between the force and the normal of the damaged side."""
    moment_arm: _MaybePair
    """(m) moment arm of the force about the centre of gravity, for both vehicles."""
    uncorrected_delta_v: _MaybePair
    """(m/s) of both vehicles."""
    delta_v: _MaybePair
    """(m/s) ΔV of both vehicles, with the correction of the case."""
    capped_delta_v: _MaybePair
    """(m/s) ΔV of both vehicles, with CRASH3's correction."""
    uncapped_delta_v: _MaybePair
    """(m/s) ΔV of both vehicles, with that correction without its cap."""


class _Sensitivity(_Document):
    derivatives: tuple[Derivative, ...]
    """The influence of each input on each output, the greatest first."""
    pdof_sweep: tuple[SweepRow, ...]
    """CRASH3 with the PDOF turned."""
    pdof_sweep_held: tuple[str, ...]
    """Keys of the case that were kept in every row, where there are any."""
    pdof_sweep_turned: tuple[str, ...]
    """Keys of the case that were turned with the direction, where there are any."""
    left_aside: tuple[str, ...]
    """Keys of evidence that the numbers do not use, where there are any."""
    warnings: tuple[CaseWarning, ...]
    """Those of the case as it stands."""


# uncertainty()


class Doubtful(Record):
    """Samples whose answer would cause a warning in a single case."""

    code: str
    """What the warning is about, in a word."""
    vehicle: int
    """1 or 2, where it is about one vehicle."""
    samples: int
    """(–) number of these samples."""
    of: int
    """(–) number of samples that were examined."""
    share: float
    """(–) share of these samples among those."""


class Truncation(Record):
    """The bounds of a distribution that is cut off."""

    low: float
    """(SI) its lower bound, where it has one."""
    high: float
    """(SI) its upper bound, where it has one."""
    kept: float
    """(–) share of the distribution that is left."""


class UncertainInput(Record):
    """A number of the case that has a range."""

    input: str
    """Its key."""
    name: str
    """In words, for what is not a key of the file."""
    distribution: str
    """``"normal"``, ``"log-normal"``, ``"uniform"`` or ``"triangular"``."""
    central: float
    """(SI) central value."""
    mean: float
    """(SI) mean of the distribution."""
    sd: float
    """(SI) standard deviation of the distribution."""
    truncated: Truncation
    """Its bounds, where it is cut off."""


class TakenAsExact(Record):
    """A value that all samples share, so that no interval contains its error."""

    key: str
    """Its key."""
    value: float | tuple[float, ...] | str
    """(SI) the number, the numbers of a list, or a word."""
    worth: str
    """How well such a number is usually known, in words."""
    source: str
    """The source of this."""


class OutputErrors(Record):
    """Standard errors of an output, due to sampling."""

    mean: float | None
    """(SI) error of the mean."""
    sd: float | None
    """(SI) error of the standard deviation."""
    median: float | None
    """(SI) error of the median."""
    interval50: _MaybePair
    """(SI) errors of both ends."""
    interval90: _MaybePair
    """(SI) errors of both ends."""
    interval95: _MaybePair
    """(SI) errors of both ends."""
    interval99: _MaybePair
    """(SI) errors of both ends."""


class Bar(Record):
    """The effect of one input alone on an output."""

    input: str
    """The key of the input."""
    low: _MaybePair
    """(SI) the input at its 2.5 % quantile, and the output there."""
    high: _MaybePair
    """(SI) the input at its 97.5 % quantile, and the output there."""
    share: float
    """(–) share of the output's first-order variance."""


class Index(Record):
    """Sobol' indices of an input."""

    input: str
    """The key of the input."""
    first_order: float
    """(–) share of the variance due to it alone."""
    total: float
    """(–) share due to it, alone and together with others."""
    first_order_interval95: _Pair | None
    """(–) 95 % interval, from the sampling alone."""
    total_interval95: _Pair | None
    """(–) 95 % interval, from the sampling alone."""


class UncertainOutput(Record):
    """A result with its spread; None where fewer than two samples have an answer."""

    central: float
    """(SI) answer for the central values."""
    mean: float | None
    """(SI) of the samples."""
    sd: float | None
    """(SI) standard deviation of the samples."""
    median: float | None
    """(SI) of the samples."""
    interval50: _Pair | None
    """(SI) lower and upper end of 50 %."""
    interval90: _Pair | None
    """(SI) lower and upper end of 90 %."""
    interval95: _Pair | None
    """(SI) lower and upper end of 95 %."""
    interval99: _Pair | None
    """(SI) lower and upper end of 99 %."""
    standard_error: OutputErrors
    """Standard errors due to sampling."""
    first_order_sd: float
    """(SI) standard deviation by the derivatives alone."""
    first_order_differs: bool | None
    """Whether that differs from the one of the samples."""
    tornado: tuple[Bar, ...]
    """The effect of each input alone, the greatest first."""
    sensitivity: tuple[Index, ...]
    """Sobol' indices, where they were asked for."""


class IndexRows(Record):
    """The samples from which Sobol' indices are computed."""

    rows: int
    """(–) number of rows requested."""
    used: int
    """(–) number of rows in which all samples have an answer."""
    evaluations: int
    """(–) number of evaluations of the case."""


class _Uncertainty(_Document):
    samples: int
    """(–) number of samples evaluated."""
    requested: int
    """(–) number of samples requested."""
    seed: int
    """(–) seed of the random numbers."""
    method: str
    """How the samples were drawn."""
    succeeded: int
    """(–) number of samples with an answer."""
    failed: Keyed[int]
    """(–) numbers of samples without an answer, by reason."""
    doubtful: tuple[Doubtful, ...]
    """Samples whose answer would cause a warning in a single case."""
    inputs: tuple[UncertainInput, ...]
    """The numbers that have a range."""
    taken_as_exact: tuple[TakenAsExact, ...]
    """The numbers that have none."""
    outputs: Keyed[UncertainOutput]
    """The results by their keys, such as ``"vehicle1.speed"``."""
    sensitivity: tuple[Index, ...]
    """Sobol' indices of the first output, where they were asked for."""
    index_rows: IndexRows
    """The samples from which these are computed."""
    headline: Headline
    """The answer of a reconstruction at the central values: ``by`` is ``"none"`` where the intervals are not of it."""
    left_aside: tuple[str, ...]
    """Keys of evidence that the numbers do not use, where there are any."""
    warnings: tuple[CaseWarning, ...]
    """Those of the case as it stands."""


# estimate()


class Doubt(Record):
    """Why a run counts as not converged."""

    code: str
    """What fails, in a word."""
    key: str
    """The number concerned, where there is one."""


class Interval(Record):
    """What is known about a speed, or about a result before the evidence."""

    median: float
    """(SI) half of the probability is below it."""
    interval95: _Pair
    """(SI) lower and upper end of 95 %."""


class PosteriorErrors(Record):
    """Standard errors of a result, due to sampling."""

    median: float | None
    """(SI) error of the median."""
    interval95: _MaybePair
    """(SI) errors of both ends."""
    mean: float | None
    """(SI) error of the mean."""
    sd: float | None
    """(SI) error of the standard deviation."""


class EstimatedOutput(Record):
    """A result after all the evidence; None where the run has not converged."""

    told: bool | None
    """Whether the evidence determines it."""
    prior: Interval | None
    """Before the evidence."""
    median: float | None
    """(SI) half of the probability is below it."""
    interval50: _Pair | None
    """(SI) lower and upper end of 50 %."""
    interval80: _Pair | None
    """(SI) lower and upper end of 80 %."""
    interval90: _Pair | None
    """(SI) lower and upper end of 90 %."""
    interval95: _Pair | None
    """(SI) lower and upper end of 95 %."""
    mean: float | None
    """(SI) of the draws."""
    sd: float | None
    """(SI) standard deviation of the draws."""
    standard_error: PosteriorErrors | None
    """Standard errors due to sampling."""
    if_serious_injury: Interval | None
    """The result if somebody in either vehicle was seriously hurt; None where another prior was requested."""


class Tested(Record):
    """Real collisions on which intervals were judged."""

    code: str
    """Its name, such as ``"front-side"``."""
    collisions: str
    """Which collisions, with which evidence."""
    quantity: str
    """What was judged: ``"ΔV"`` or ``"speed"``."""
    n: int
    """(–) number of these."""
    inside95: float
    """(–) share of the true values inside their 95 % intervals."""
    rms: float | None
    """(–) root mean square of ln(median/truth)."""
    source: str
    """The data, and how far they were blind."""


class Question(Record):
    """The probability that a result is above a limit."""

    output: str
    """The key of the result."""
    above: float
    """(SI) the limit."""
    probability: float | None
    """(–) None where the run has not converged."""
    standard_error: float | None
    """(–) standard error due to sampling."""


class Piece(Record):
    """What a piece of evidence implies for the speeds of both vehicles."""

    key: str
    """Its key."""
    alone: tuple[Interval | None, Interval | None] | None
    """(m/s) speeds by it alone; None where that was not requested."""
    without: tuple[Interval | None, Interval | None] | None
    """(m/s) speeds by all other evidence."""
    p_value: float | None
    """(–) p-value: the probability, given all other evidence, of an observation at least this far off."""
    adjusted_p_value: float | None
    """(–) the same, adjusted for the number of pieces; the verdict uses this."""
    reversed: bool
    """Whether it points in the opposite direction to the rest."""
    verdict: str | None
    """Whether it agrees with the other evidence."""


class CrushError(Record):
    """How far the crush energy of a vehicle may be off, in ln."""

    method: str
    """How the energy was obtained: ``"class"``, ``"fleet"``, ``"coefficients"``, ``"test"``, ``"ees"``, or, for a
    fixed object, ``"object"``."""
    bias: float
    """(–) average error that all such energies share."""
    shared_sd: float
    """(–) standard deviation of the error that both vehicles share."""
    own_sd: float
    """(–) standard deviation of the error of this vehicle alone."""


class Stood(Record):
    """How probable it is that a vehicle was stationary."""

    assumed: float
    """(–) as assumed."""
    prior: float | None
    """(–) among the possible collisions, before the evidence."""
    probability: float | None
    """(–) after the evidence; None where the run has not converged."""


class Distribution(Record):
    """What is known about a number before the evidence."""

    distribution: str
    """``"normal"``, ``"log-normal"``, ``"uniform"`` or ``"triangular"``."""
    mean: float
    """(SI) mean of the distribution."""
    sd: float
    """(SI) its standard deviation."""


class Posterior(Record):
    """What is known about a number after the evidence."""

    median: float
    """(SI) half of the probability is below it."""
    interval95: _Pair
    """(SI) lower and upper end of 95 %."""
    mean: float
    """(SI) of the draws."""
    sd: float
    """(SI) standard deviation of the draws."""


class Unknown(Record):
    """A number that the estimate seeks."""

    key: str
    """Its key."""
    assumed: bool
    """Whether its prior is assumed, because the case gives none."""
    prior: Distribution
    """Before the evidence."""
    posterior: Posterior | None
    """After it; None where the run has not converged."""


class Unused(Record):
    """Evidence that the estimate does not use."""

    key: str
    """Its key."""
    reason: str
    """Why not, in a word."""


class _Estimate(_Document):
    prior: str
    """The severity before the evidence: ``"field"``, ``"serious-injury"`` or ``"flat"``."""
    seed: int
    """(–) seed of the random numbers."""
    particles: int
    """(–) number of particles of each island, as requested."""
    draws: int
    """(–) number of draws."""
    converged: bool
    """Whether the run has converged; without that it gives no interval."""
    doubts: tuple[Doubt, ...]
    """Why it has not."""
    missed: tuple[str, ...]
    """Keys of evidence that even the nearest collisions miss: the medians are then not an answer."""
    ess: float
    """(–) the least effective sample size of all numbers."""
    outputs: Keyed[EstimatedOutput]
    """The results by their keys, such as ``"vehicle1.speed"``."""
    questions: tuple[Question, ...]
    """The answers to ``above``."""
    pieces: tuple[Piece, ...]
    """What each piece of evidence implies."""
    crush: tuple[CrushError | None, CrushError | None] | None
    """How far the crush energies of both may be off; None where the crush is not evidence."""
    tested: Tested | None
    """The class of real collisions on which such intervals were judged; None if there is no such class."""
    stood: tuple[Stood | None, Stood | None]
    """How probable it is that each vehicle was stationary; None for one that was not, or whose speed is known."""
    same_twice: tuple[tuple[str, str], ...]
    """Keys of evidence that may be the same observation."""
    unknown: tuple[Unknown, ...]
    """The numbers that are sought."""
    default_errors: tuple[str, ...]
    """Keys of errors that the case does not give, so that defaults are used."""
    unused: tuple[Unused, ...]
    """Evidence that is not used, and why."""
    warnings: tuple[CaseWarning, ...]
    """Objections to the inputs."""


# avoid()


class Demand(Record):
    """The reaction demand, from which on everything counts."""

    distance: float
    """(m) distance of the vehicle from the place of the impact."""
    time: float
    """(s) before the impact."""


class Sight(Record):
    """When the view of the other party became free."""

    time: float
    """(s) before the impact."""
    distance_subject: float
    """(m) that the vehicle covers from there to the impact."""
    distance_other: float
    """(m) that the other party covers from there to the impact."""
    hidden_by: int | None
    """(–) the obstacle that hid it last, counted from 1; None if no obstacle hid it."""
    seen_earlier: float | None
    """(s) before the impact, when it was first in sight before it was hidden; None if it was not."""


class SameLine(Record):
    """Another vehicle that moves along the same line, so that the place of a collision moves with it."""

    direction: str
    """``"ahead"`` or ``"oncoming"``."""
    gap: float
    """(m) its distance at the demand."""
    speed: float
    """(m/s) at the impact."""
    deceleration: float
    """(m/s²) deceleration with which it goes on until it stops; 0 if it keeps its speed."""


class Avoidable(Record):
    """Avoidability in space or in time."""

    speed: float
    """(m/s) the greatest speed that avoids the collision; 0 if none does."""
    avoidable_at_limit: bool
    """Whether the limit avoids it."""


class AtLimit(Record):
    """The speed that is left at the impact when driving at the limit, with the reaction and the braking of the inputs."""

    collision_speed: float
    """(m/s) at the place of the impact; 0 if the vehicle stops before."""
    delta_v: tuple[float | None, float | None] | None
    """(m/s) ΔV of both vehicles, None for a fixed object; None if the case has no impact."""


class Influence(Record):
    """How much a number affects the probability."""

    input: str
    """Its key; ``"speed"`` for the speed that the rest of the case gives."""
    difference: float
    """(–) the probability if the number is above its median, less that if it is below."""


class AvoidanceProbability(Record):
    """The probability that the collision is avoided."""

    avoided_at_limit: float
    """(–) at the limit, with the reaction and the braking of the inputs."""
    above_limit: float
    """(–) that the vehicle was faster than the limit."""
    mc_error: float
    """(–) standard error of ``avoided_at_limit`` from sampling."""
    stopped_at_limit: float
    """(–) that the vehicle then stops before the place of the impact."""
    avoided_at_limit_else_as_it_was: float
    """(–) at the limit, with the reaction and the braking of the actual run."""
    samples: int
    """(–) number of samples."""
    possible: int
    """(–) number of those that are a scene."""
    influences: tuple[Influence, ...]
    """The most influential number first."""


class DriverResponse(Record):
    """What the driver could have done."""

    reaction_time: float
    """(s) from the demand to the first effect of the brakes."""
    swell: float
    """(s) from then to the full deceleration."""
    swell_form: str
    """How the deceleration grows in it: ``"linear"``, ``"half"`` or ``"full speed"``."""
    deceleration: float
    """(m/s²) full deceleration."""


class AvoidanceRun(Record):
    """A run up to the place of the impact."""

    hypothesis: str
    """What it assumes; ``"actual"`` for what happened."""
    speed: float
    """(m/s) at the demand."""
    reaction_time: float | None
    """(s) reaction time; None for a run without a reaction."""
    deceleration: float | None
    """(m/s²) deceleration; None for a run without a reaction."""
    stopping_distance: float | None
    """(m) from the demand; None if it does not stop."""
    collision_speed: float
    """(m/s) at the place of the impact or, on the same line, at the contact; 0 if it does not get there."""
    arrival: float | None
    """(s) arrival there, after the demand; None if it does not get there."""
    stops_before: bool
    """Whether it stops before the place of the impact or, on the same line, does not reach the other."""
    least_gap: float | None
    """(m) least distance from a vehicle on the same line that it does not reach."""
    late_enough: bool | None
    """Whether the other party has then left the danger zone; None if that is not examined."""
    delta_v: tuple[float | None, float | None] | None
    """(m/s) as in ``at_limit``."""


class Enough(Record):
    """What would have been enough, in space or, where the case has ``clear``, in time; None where no
    value would have been."""

    speed: float
    """(m/s) at most."""
    deceleration: float | None
    """(m/s²) at least, at the speed driven; 0 if the vehicle arrives late enough without braking."""
    reaction_time: float | None
    """(s) at most, at the speed driven; where ``deceleration`` is 0, the time until the other party is gone."""
    deceleration_at_limit: float | None
    """(m/s²) at least, at the limit."""
    reaction_time_at_limit: float | None
    """(s) at most, at the limit."""


class MedianInterval(Record):
    """A median, with the ends of an interval of 95 %."""

    low: float
    """(SI) lower end."""
    median: float
    """(SI) half of the samples are below it."""
    high: float
    """(SI) upper end."""


class SightIntervals(Record):
    """When the view became free, among the samples in which something hides the other party before."""

    time: MedianInterval
    """(s) before the impact."""
    distance_subject: MedianInterval
    """(m) that the vehicle covers from there."""
    distance_other: MedianInterval
    """(m) that the other party covers from there."""
    never_hidden: float
    """(–) share of the samples in which nothing hides it."""


class AvoidanceIntervals(Record):
    """Intervals of 95 %."""

    speed: MedianInterval
    """(m/s) at the demand."""
    demand_distance: MedianInterval
    """(m) from the demand to the impact."""
    demand_time: MedianInterval
    """(s) from the demand to the impact."""
    spatial_speed: MedianInterval
    """(m/s) speed that avoids it in space."""
    temporal_speed: MedianInterval | None
    """(m/s) speed that avoids it in time; None if that is not examined."""
    collision_speed_at_limit: MedianInterval
    """(m/s) the speed that is left when driving at the limit."""
    sight: SightIntervals | None
    """None without obstacles."""


class AvoidanceAnswer(Record):
    """Whether the collision was avoidable."""

    vehicle: int
    """The vehicle whose driver is considered, 1 or 2."""
    speed: float
    """(m/s) its speed at the demand."""
    speed_source: str
    """``"avoid"``, ``"vehicle"``, ``"reconstruct"``, ``"estimate"``, ``"phases"`` or ``"recorder"``."""
    speed_determined: bool
    """False where the evidence behind the speed leaves it open, so that the probability depends on the prior."""
    exact_speed_at_impact: float | None
    """(m/s) by the exact solution that leads ``reconstruct``; None unless the speed comes from ``estimate``."""
    limit: float
    """(m/s) the speed limit, or the other speed that is tested."""
    demand: Demand
    """The reaction demand."""
    sight: Sight | None
    """None where no obstacle hides the other party."""
    same_line: SameLine | None
    """None where the place of the impact is fixed."""
    stopping_distance: float
    """(m) at the speed driven, with the reaction and the braking of the inputs."""
    spatial: Avoidable
    """In space: the vehicle stops before the place of the impact."""
    temporal: Avoidable | None
    """In time: the other party has left the danger zone; None if that is not examined."""
    at_limit: AtLimit
    """The speed that is left at the impact when driving at the limit."""
    converged: bool
    """Whether the estimate behind the speed has converged; without that there are no probabilities."""
    probability: AvoidanceProbability | None
    """None if nothing is uncertain, or without convergence."""
    response: DriverResponse
    """What the driver could have done."""
    actual: str
    """How the vehicle approached: ``"responded"``, ``"unbraked"``, ``"skidded"``, ``"by the recorder"``, and others."""
    reaction_late_by: float | None
    """(s) by how much the reaction was later than that of the inputs; None if it is not known."""
    runs: tuple[AvoidanceRun, ...]
    """First the actual run, then the others."""
    enough: Enough
    """What would have been enough."""
    intervals: AvoidanceIntervals | None
    """None if nothing is uncertain."""
    warnings: tuple[str, ...]
    """Objections to the inputs, as sentences."""


class _Avoidance(_Document):
    avoid: AvoidanceAnswer
    """Whether the collision was avoidable."""


# pydeltav.ciss.judge()


class Figures(Record):
    """How well the intervals of a kind of collision contain what recorders stored."""

    n: int
    """(–) number of recorders."""
    collisions: int
    """(–) number of collisions."""
    bias: float
    """(m/s) mean of the median less the recorder."""
    bias_error: float
    """(m/s) standard error of the bias."""
    rms: float
    """(m/s) root mean square of the median less the recorder."""
    rms_error: float
    """(m/s) standard error of that."""
    coverage: Keyed[float]
    """(–) share of the recorders within the intervals of ``"50"``, ``"80"`` and ``"95"`` per cent; not for WinSMASH."""
    coverage_error: Keyed[float]
    """(–) standard errors of these."""
    width95: float
    """(m/s) mean width of the 95 % intervals; not for WinSMASH."""
    crps: float
    """(m/s) mean continuous ranked probability score."""
    pit: tuple[int, ...]
    """(–) numbers of recorders in each tenth of the predicted distribution; not for WinSMASH."""


class LeftOut(Record):
    """A recorder that is left out."""

    case: str
    """The pair."""
    vehicle: int
    """1 or 2."""


class JudgedData(Record):
    """What was judged."""

    sha256: str
    """SHA-256 of the table of pairs, as ``Pairs.save`` writes it."""


class JudgedVehicle(Record):
    """A vehicle whose recorder was compared with the estimate."""

    case: str
    """The pair."""
    vehicle: int
    """1 or 2."""
    kind: str
    """The kind of collision."""
    recorder: float
    """(m/s) ΔV of the recorder."""
    longitudinal: bool
    """Whether that is only the longitudinal ΔV."""
    median: float
    """(m/s) median of the estimate."""
    interval50: _Pair
    """(m/s) lower and upper end of 50 %."""
    interval80: _Pair
    """(m/s) lower and upper end of 80 %."""
    interval95: _Pair
    """(m/s) lower and upper end of 95 %."""
    below: float
    """(–) share of the draws below the recorder."""
    crps: float
    """(m/s) continuous ranked probability score."""
    converged: bool
    """Whether the run has converged."""
    winsmash: float
    """(m/s) ΔV of WinSMASH, where there is one."""


class _Coverage:
    other: bool
    """Whether each was estimated with the recorder of the other vehicle."""
    objects: bool
    """Whether each vehicle struck a fixed object, and no other vehicle."""
    prior: str
    """Severity before the evidence: ``"field"`` or ``"serious-injury"``."""
    pairs: int
    """(–) number of pairs that were read."""
    finished: int
    """(–) number of pairs that were judged."""
    groups: Keyed[Figures]
    """All, and by kind of collision."""
    winsmash: Keyed[Figures]
    """The same for WinSMASH."""
    left_out: tuple[LeftOut, ...]
    """Recorders that are left out."""
    judged: tuple[JudgedVehicle, ...]
    """One entry for each vehicle."""
    program: Program
    """The program that judged them."""
    data: JudgedData
    """What it judged."""


class _AnalysisDocument(_Analysis, Record):
    pass


class _JudgementDocument(_Judgement, Record):
    pass


class _ComparisonDocument(_Comparison, Record):
    pass


class _SensitivityDocument(_Sensitivity, Record):
    pass


class _UncertaintyDocument(_Uncertainty, Record):
    pass


class _EstimateDocument(_Estimate, Record):
    pass


class _AvoidanceDocument(_Avoidance, Record):
    pass


_DOCUMENTS: dict[str, type[Record]] = {
    "Analysis": _AnalysisDocument,
    "Judgement": _JudgementDocument,
    "Comparison": _ComparisonDocument,
    "Sensitivity": _SensitivityDocument,
    "Uncertainty": _UncertaintyDocument,
    "Estimate": _EstimateDocument,
    "Avoidance": _AvoidanceDocument,
}


def _document(of: str, entries: Mapping[str, Any]) -> Record:
    """The document of a class of results."""
    return _DOCUMENTS.get(of, Record)(entries)
