#!/usr/bin/env python3
"""Posteriors of ten collisions by another program and another sampler.

The model is written anew from docs/theory.md (sections 1 to 4) and docs/calibration.md in NumPy: it shares
neither code nor method with the crates. Two samplers answer, each of which needs no trust in the other:

- emcee (Foreman-Mackey, Hogg, Lang & Goodman 2013): ENSEMBLES ensembles of walkers that know nothing of each
  other, moved by differential evolution in the space of the values themselves;
- importance sampling from the prior, which starts the walkers and has no chain that could be stuck.

The result has mean, standard deviation and quantiles of each quantity by the first, with Monte Carlo errors from
the spread between its ensembles, and the mean and the log evidence by the second. `python3 reference.py > reference.json` writes it
anew, in half an hour; with names of collisions, those alone. Made with Python 3.11, NumPy 2.4.6, SciPy 1.17.1, emcee 3.1.6.

The same collisions stand in reference.rs. Units are SI and radians.
"""

import json
import sys

import emcee
import numpy as np
from scipy.stats import norm, t

ENSEMBLES = 8
SEED = 20261123
QUANTILES = [0.05, 0.5, 0.95]
QUANTITIES = ["speed_1", "speed_2", "delta_v_1", "delta_v_2", "closing_speed", "energy_loss", "restitution"]


# --- distributions ---------------------------------------------------------------------------------------------


class Normal:
    def __init__(self, mean, sd, low=-np.inf, high=np.inf):
        self.mean, self.sd, self.low, self.high = mean, sd, low, high

    def log_density(self, x):
        inside = (x >= self.low) & (x <= self.high)
        return np.where(inside, -0.5 * ((x - self.mean) / self.sd) ** 2, -np.inf)

    def draw(self, rng, n):
        a, b = norm.cdf([(self.low - self.mean) / self.sd, (self.high - self.mean) / self.sd])
        return self.mean + self.sd * norm.ppf(rng.uniform(a, b, n))


class LogNormal:
    def __init__(self, median, ln_sd):
        self.median, self.ln_sd = median, ln_sd

    def log_density(self, x):
        x = np.maximum(x, 1e-300)
        return np.where(x > 1e-299, -0.5 * (np.log(x / self.median) / self.ln_sd) ** 2 - np.log(x), -np.inf)

    def draw(self, rng, n):
        return self.median * np.exp(self.ln_sd * rng.standard_normal(n))


class Uniform:
    def __init__(self, low, high):
        self.low, self.high = low, high

    def log_density(self, x):
        return np.where((x >= self.low) & (x <= self.high), 0.0, -np.inf)

    def draw(self, rng, n):
        return rng.uniform(self.low, self.high, n)


# --- the impact ------------------------------------------------------------------------------------------------


def impact(v):
    """All that follows from the numbers `v`, a dictionary of arrays (theory, sections 1 to 4)."""
    heading = [v["heading_1"], v["heading_2"]]
    forward = [np.stack([np.cos(h), np.sin(h)]) for h in heading]
    left = [np.stack([-np.sin(h), np.cos(h)]) for h in heading]
    if "ln_relative" in v:
        c, s = np.cos(v["split"]), np.sin(v["split"])
        unit = np.linalg.norm(c * forward[0] - s * forward[1], axis=0)
        scale = np.exp(v["ln_relative"]) / unit
        speeds = [scale * c, scale * s]
    else:
        speeds = [v["speed_1"], v["speed_2"]]
    velocity = [speeds[i] * forward[i] for i in (0, 1)]
    omega = [v["yaw_rate_1"], v["yaw_rate_2"]]
    arm = [v[f"ahead_{i + 1}"] * forward[i] + v[f"left_{i + 1}"] * left[i] for i in (0, 1)]
    inverse_mass, inverse_inertia = [], []
    for i in ("1", "2"):
        if "mass_" + i in v:
            inverse_mass.append(1.0 / v["mass_" + i])
            inverse_inertia.append(1.0 / (v["mass_" + i] * v["yaw_radius_" + i] ** 2))
        else:
            inverse_mass.append(0.0 * heading[0])
            inverse_inertia.append(0.0 * heading[0])

    # The normal points from vehicle 2 to vehicle 1.
    n = np.stack([np.cos(v["crush_plane"]), np.sin(v["crush_plane"])])
    n = n * np.where(np.sum(n * (arm[1] - arm[0]), axis=0) > 0.0, 1.0, -1.0)
    tangent = np.stack([-n[1], n[0]])

    def at_contact(velocity, omega):
        relative = 0.0
        for sign, i in ((1.0, 0), (-1.0, 1)):
            relative = relative + sign * (velocity[i] + omega[i] * np.stack([-arm[i][1], arm[i][0]]))
        return np.sum(relative * n, axis=0), np.sum(relative * tangent, axis=0)

    u_n, u_t = at_contact(velocity, omega)
    # K, column by column: what a unit impulse changes of the relative velocity at C.
    columns = []
    for axis in (n, tangent):
        change = (inverse_mass[0] + inverse_mass[1]) * axis
        for i in (0, 1):
            torque = arm[i][0] * axis[1] - arm[i][1] * axis[0]
            change = change + torque * inverse_inertia[i] * np.stack([-arm[i][1], arm[i][0]])
        columns.append((np.sum(change * n, axis=0), np.sum(change * tangent, axis=0)))
    (k_nn, k_nt), (_, k_tt) = columns

    closing = -u_n
    if "e" in v:
        e = v["e"]
    else:
        low, rise, fade, most = RESTITUTION
        e = np.minimum((low + rise * np.exp(-np.maximum(closing, -50.0) / fade)) * v["e_factor"], most)
    # Either the tangential velocity ends, or the impulse slides against what it would be without friction.
    determinant = k_nn * k_tt - k_nt**2
    wanted_n, wanted_t = -(1.0 + e) * u_n, -u_t
    stick_n = (k_tt * wanted_n - k_nt * wanted_t) / determinant
    stick_t = (k_nn * wanted_t - k_nt * wanted_n) / determinant
    sticks = (stick_n > 0.0) & (np.abs(stick_t) <= v["friction"] * stick_n)
    free_t = u_t + k_nt * wanted_n / k_nn
    mu = -np.sign(free_t) * v["friction"]
    slide_n = wanted_n / (k_nn + mu * k_nt)
    p_n = np.where(sticks, stick_n, slide_n)
    p_t = np.where(sticks, stick_t, mu * slide_n)
    impulse = p_n * n + p_t * tangent

    after_v, after_omega, delta_v = [], [], []
    for sign, i in ((1.0, 0), (-1.0, 1)):
        change = sign * impulse * inverse_mass[i]
        torque = sign * (arm[i][0] * impulse[1] - arm[i][1] * impulse[0])
        delta_v.append(np.linalg.norm(change, axis=0))
        after_v.append(velocity[i] + change)
        after_omega.append(omega[i] + torque * inverse_inertia[i])
    big_u_n, big_u_t = at_contact(after_v, after_omega)
    work_n, work_t = -0.5 * p_n * (u_n + big_u_n), -0.5 * p_t * (u_t + big_u_t)
    taken = work_n + v["share"] * work_t
    # The PDOF counts clockwise from the heading to where the force comes from.
    pdof = []
    for sign, i in ((1.0, 0), (-1.0, 1)):
        source = -sign * impulse
        pdof.append(-(np.arctan2(source[1], source[0]) - heading[i]))
    possible = (closing > 0.3) & (p_n > 0.0) & (taken > 0.0) & (work_n + work_t > 0.0)
    possible &= (e >= 0.0) & (e <= 1.0) & (np.where(sticks, 1.0, k_nn + mu * k_nt) > 0.0)
    return {
        "possible": possible,
        "speeds": speeds,
        "after_v": after_v,
        "after_omega": after_omega,
        "delta_v": delta_v,
        "along": [
            np.sum(sign * impulse * forward[i], axis=0) * inverse_mass[i] for sign, i in ((1.0, 0), (-1.0, 1))
        ],
        "closing": closing,
        "loss": work_n + work_t,
        "taken": taken,
        "e": e,
        "pdof": pdof,
    }


# --- the evidence ----------------------------------------------------------------------------------------------


def turned(angle):
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


def ln_normal(error, sd):
    return -0.5 * (error / sd) ** 2 - np.log(sd * np.sqrt(2.0 * np.pi))


def ln_student(error, scale, freedom):
    return t.logpdf(error / scale, freedom) - np.log(scale)


def crush_energy(v, i, crush):
    constant, linear, square = crush
    slope, no_damage = v[f"slope_{i}"], v[f"no_damage_{i}"]
    return constant * no_damage**2 + linear * slope * no_damage + square * slope**2


def log_likelihood(case, v):
    out = impact(v)
    total = 0.0
    for piece, *given in case["evidence"]:
        if piece == "severity":
            median, ln_sd, speed = given
            mean = 0.5 * np.log(out["delta_v"][0] * out["delta_v"][1])
            total = total + ln_normal(mean - np.log(median), ln_sd)
            total = total - 0.5 * (out["speeds"][0] ** 2 + out["speeds"][1] ** 2) / speed**2
        elif piece == "crush":
            bias, ln_sd, crushes = given
            energy = sum(crush_energy(v, i, crush) for i, crush in crushes.items())
            total = total + ln_normal(np.log(energy) - np.log(out["taken"]) - bias, ln_sd)
        elif piece == "severity of one":
            median, ln_sd, speed = given
            total = total + ln_normal(np.log(out["delta_v"][0] / median), ln_sd)
            total = total - 0.5 * out["speeds"][0] ** 2 / speed**2
        elif piece == "crush by fitted figures":
            bias, ln_sd, covariance, energies = given
            # Each draw has figures of its own: ξ = L z, L Lᵀ their covariance, z standard normal.
            z = np.stack([v[f"figure_{k}"] for k in range(len(covariance))])
            of_bias, of_spread, *others = np.linalg.cholesky(np.array(covariance)) @ z
            error = np.log(energies(v, others)) - np.log(out["taken"]) - bias - of_bias
            total = total + ln_normal(error, ln_sd * np.exp(of_spread))
        elif piece == "pdof":
            i, value, scale = given
            total = total + ln_student(turned(value - out["pdof"][i - 1]), scale, 2.0)
        elif piece == "speed_after":
            i, value, ln_sd = given
            total = total + ln_normal(np.log(value / np.linalg.norm(out["after_v"][i - 1], axis=0)), ln_sd)
        elif piece == "direction_after":
            i, value, sd = given
            x, y = out["after_v"][i - 1]
            total = total + ln_normal(turned(value - np.arctan2(y, x)), sd)
        elif piece == "yaw_rate_after":
            i, value, sd = given
            total = total + ln_normal(value - out["after_omega"][i - 1], sd)
        elif piece == "recorded_delta_v":
            i, value, ln_scale, along = given
            shown = out["delta_v"][i - 1]
            if along:
                shown = np.maximum(np.abs(out["along"][i - 1]), 0.05 * shown)
            total = total + ln_student(np.log(value / shown), ln_scale, 3.0)
        elif piece == "recorded_speed":
            i, value, ln_sd = given
            speed = out["speeds"][i - 1]
            error = np.log(value / np.maximum(speed, 1e-300))
            total = total + np.where(speed > 0.0, ln_normal(error, ln_sd), -np.inf)
        elif piece == "limits":
            i, least, most = given
            speed = out["speeds"][i - 1]
            total = total + np.where((speed >= least) & (speed <= most), 0.0, -np.inf)
        else:
            raise ValueError(piece)
    total = np.where(out["possible"], total, -np.inf)
    return np.where(np.isnan(total), -np.inf, total), out


# --- the collisions --------------------------------------------------------------------------------------------

# docs/calibration.md
RESTITUTION = (0.05, 0.32, 5.0, 0.7)
CRUSH = (-0.404, 0.366)
SEVERITY = (7.36, 0.47, 25.0)
DEGREE = np.pi / 180.0


# The figures of crashes against fixed objects, with the covariance of the bias and of ln of the spread.
OBJECT_CRUSH = (-0.770, 1.470)
OBJECT_COVARIANCE = [[0.05907, -0.00801], [-0.00801, 0.02470]]
OBJECT_SEVERITY = (7.7, 0.83, 25.0)
# Those where a side was hit: the bias and ln of the spread, of b_1 of sides, of the spread of b_1, and of b_0 of
# fronts and of sides. b_1 of fronts is exact.
SIDE_CRUSH = (-0.521, 0.336)
SIDE_COVARIANCE = [
    [0.02542, -0.01025, 0.01470, -0.00791, 0.02657, 0.00534],
    [-0.01025, 0.04747, 0.00542, -0.01145, -0.01120, -0.01208],
    [0.01470, 0.00542, 0.02470, -0.00096, 0.01382, -0.01723],
    [-0.00791, -0.01145, -0.00096, 0.11381, -0.01002, -0.00220],
    [0.02657, -0.01120, 0.01382, -0.01002, 0.03742, -0.00328],
    [0.00534, -0.01208, -0.01723, -0.00220, -0.00328, 0.07919],
]
SLOPE = {"front": 27.7, "side": 31.1}
NO_DAMAGE = {"front": 2.22, "side": 1.58}


def front_and_side(v, figures, mean, square):
    """Crush energy of a front and a side, each 1.4 m wide, by the mean (m) and mean square (m²) of their depths."""
    slope_of_sides, slope_spread, no_damage_of_fronts, no_damage_of_sides = figures
    total = 0.0
    for i, side, of_slope, of_no_damage in (
        (1, "front", 0.0, no_damage_of_fronts),
        (2, "side", slope_of_sides, no_damage_of_sides),
    ):
        # ln of this vehicle's b_1 by that of its kind grows with the spread.
        b1 = SLOPE[side] * np.exp(of_slope) * v[f"slope_{i}"] ** np.exp(slope_spread)
        b0 = NO_DAMAGE[side] * np.exp(of_no_damage) * v[f"no_damage_{i}"]
        # Width by width, ½ m (b_0 + b_1 C)² with m = 1600 kg on 1.6 m.
        total = total + 0.5 * 1600.0 / 1.6 * 1.4 * (b0**2 + 2.0 * b0 * b1 * mean + b1**2 * square)
    return total


def usual(**changes):
    """A crash of the field: both speeds unknown, the errors of docs/calibration.md."""
    numbers = {
        "ln_relative": Uniform(np.log(0.3), np.log(120.0)),
        "split": Uniform(0.0, 0.5 * np.pi),
        "crush_plane": 0.0,
        "e_factor": LogNormal(1.0, 0.6),
        "friction": LogNormal(1.0, 0.4),
        "share": Normal(0.5, 0.35, 0.0, 1.0),
        "yaw_rate_1": 0.0,
        "yaw_rate_2": 0.0,
    }
    for i in ("1", "2"):
        numbers["slope_" + i] = LogNormal(1.0, 0.16)
        numbers["no_damage_" + i] = LogNormal(1.0, 0.38)
    numbers.update(changes)
    return numbers


def cases():
    # A front strikes the left side of a crossing car.
    crossing = usual(
        heading_1=Normal(0.0, 10.0 * DEGREE),
        heading_2=-0.5 * np.pi,
        crush_plane=Normal(np.pi, 10.0 * DEGREE),
        ahead_1=1.9,
        left_1=Normal(0.1, 0.25),
        ahead_2=Normal(0.4, 0.25),
        left_2=0.7,
        mass_1=LogNormal(1500.0, 0.03),
        yaw_radius_1=1.35,
        mass_2=LogNormal(1300.0, 0.03),
        yaw_radius_2=1.3,
    )
    yield "crush", crossing, [
        ("severity", *SEVERITY),
        ("crush", *CRUSH, {1: (5e3, 18e3, 20e3), 2: (3e3, 15e3, 24e3)}),
    ]

    # A front strikes a rear, offset; an investigator coded a PDOF.
    rear_end = usual(
        heading_1=0.0,
        heading_2=Normal(0.1, 14.0 * DEGREE),
        crush_plane=Normal(np.pi, 10.0 * DEGREE),
        ahead_1=2.0,
        left_1=Normal(0.3, 0.25),
        ahead_2=-2.1,
        left_2=Normal(-0.3, 0.25),
        mass_1=LogNormal(1800.0, 0.03),
        yaw_radius_1=1.4,
        mass_2=LogNormal(1200.0, 0.03),
        yaw_radius_2=1.25,
    )
    yield "crush and PDOF", rear_end, [
        ("severity", *SEVERITY),
        ("crush", *CRUSH, {1: (4e3, 12e3, 10e3), 2: (5e3, 16e3, 15e3)}),
        ("pdof", 1, 12.0 * DEGREE, 6.0 * DEGREE),
    ]

    # Two fronts, offset; velocities after the impact are known.
    fronts = usual(
        heading_1=0.0,
        heading_2=np.pi + 0.15,
        crush_plane=Normal(np.pi, 5.0 * DEGREE),
        ahead_1=Normal(1.8, 0.1),
        left_1=Normal(0.5, 0.1),
        ahead_2=Normal(1.7, 0.1),
        left_2=Normal(0.45, 0.1),
        mass_1=1400.0,
        yaw_radius_1=1.3,
        mass_2=1600.0,
        yaw_radius_2=1.35,
    )
    yield "velocities after", fronts, [
        ("severity", 1.42 * SEVERITY[0], *SEVERITY[1:]),
        ("crush", *CRUSH, {1: (8e3, 30e3, 40e3), 2: (8e3, 28e3, 30e3)}),
        ("speed_after", 1, 4.4, 0.12),
        ("direction_after", 1, -2.35, 8.0 * DEGREE),
        ("speed_after", 2, 2.6, 0.12),
        ("direction_after", 2, 2.95, 8.0 * DEGREE),
    ]

    # The crossing cars again: the recorder of the struck car, and what the other's showed of its speed.
    yield "recorder", crossing, [
        ("severity", *SEVERITY),
        ("crush", *CRUSH, {1: (5e3, 18e3, 20e3), 2: (3e3, 15e3, 24e3)}),
        ("recorded_speed", 1, 13.0, 0.05),
        ("recorded_delta_v", 2, 4.0, 0.155, True),
        ("recorded_delta_v", 1, 6.0, 0.155, False),
    ]

    # Limits alone cut what the crush leaves.
    bounded = {key: value for key, value in crossing.items() if key not in ("ln_relative", "split", "e_factor")}
    bounded.update(
        speed_1=Normal(16.0, 6.0), speed_2=Uniform(0.0, 25.0), e=Normal(0.1, 0.08, 0.0, 1.0), share=0.5
    )
    yield "limits", bounded, [
        ("crush", *CRUSH, {1: (5e3, 18e3, 20e3), 2: (3e3, 15e3, 24e3)}),
        ("limits", 1, 11.0, 14.0),
        ("limits", 2, -np.inf, 9.0),
    ]

    # Against a fixed wall, with the yaw rate after the impact.
    wall = {
        "speed_1": Normal(14.0, 6.0),
        "speed_2": 0.0,
        "heading_1": Normal(0.2, 0.1),
        "heading_2": 0.0,
        "crush_plane": np.pi,
        "ahead_1": 1.8,
        "left_1": Normal(-0.4, 0.2),
        "ahead_2": 0.0,
        "left_2": 0.0,
        "mass_1": LogNormal(1500.0, 0.03),
        "yaw_radius_1": 1.35,
        "e_factor": LogNormal(1.0, 0.6),
        "friction": LogNormal(0.6, 0.3),
        "share": Normal(0.5, 0.35, 0.0, 1.0),
        "yaw_rate_1": 0.2,
        "yaw_rate_2": 0.0,
        "slope_1": LogNormal(1.0, 0.16),
        "no_damage_1": LogNormal(1.0, 0.38),
    }
    yield "wall and yaw rate", wall, [
        ("crush", *CRUSH, {1: (10e3, 45e3, 50e3)}),
        ("yaw_rate_after", 1, -2.0, 0.4),
    ]

    # A car that is hit in its side at a known speed slid along the other one, forward or back: the energy of
    # the sliding tells how fast, but not which way.
    sideways = dict(crossing)
    del sideways["ln_relative"], sideways["split"], sideways["e_factor"]
    sideways.update(
        heading_1=0.0,
        crush_plane=np.pi,
        left_1=0.0,
        ahead_2=Normal(0.2, 0.1),
        speed_1=Normal(6.0, 0.5),
        speed_2=Normal(0.0, 9.0),
        e=0.1,
        friction=1.5,
        share=0.9,
    )
    yield "two modes", sideways, [
        ("crush", 0.0, 0.2, {1: (14e3, 24e3, 20e3), 2: (8e3, 24e3, 25e3)}),
    ]

    # A front against a tree, as a case poses it: the speed is anything up to 70 m/s, so that the severity is that
    # of uniform speeds; the stiffness is that of a class, whose fitted figures have errors.
    tree = {
        "speed_1": Uniform(0.0, 70.0),
        "speed_2": 0.0,
        "heading_1": Normal(0.0, 2.0 * DEGREE),
        "heading_2": 0.0,
        "crush_plane": Normal(np.pi, 5.0 * DEGREE),
        "ahead_1": Normal(1.9, 0.1),
        "left_1": Normal(-0.3, 0.1),
        "ahead_2": 0.0,
        "left_2": 0.0,
        "mass_1": Normal(1500.0, 29.5),
        "yaw_radius_1": 1.4,
        "e": LogNormal(0.1, 0.6),
        "friction": LogNormal(1.0, 0.4),
        "share": Normal(0.5, 0.35, 0.0, 1.0),
        "yaw_rate_1": 0.0,
        "yaw_rate_2": 0.0,
        "slope_1": LogNormal(1.0, 0.295),
        "no_damage_1": LogNormal(1.0, 0.085),
        "figure_0": Normal(0.0, 1.0),
        "figure_1": Normal(0.0, 1.0),
    }
    median, ln_sd, speed = OBJECT_SEVERITY

    def of_tree(v, _):
        return crush_energy(v, 1, (5.6e3, 27e3, 38e3))

    yield "tree", tree, [
        # A uniform speed has a density of its logarithm that grows with it.
        ("severity of one", median * np.exp(-(ln_sd**2)), ln_sd, speed),
        ("crush by fitted figures", *OBJECT_CRUSH, OBJECT_COVARIANCE, of_tree),
        ("pdof", 1, 10.0 * DEGREE, 6.0 * DEGREE),
    ]

    # The crossing cars again, with the stiffness of the field, all of whose figures have errors.
    by_figures = dict(crossing)
    for i in ("1", "2"):
        by_figures["slope_" + i] = LogNormal(1.0, 0.18)
    for k in range(len(SIDE_COVARIANCE)):
        by_figures[f"figure_{k}"] = Normal(0.0, 1.0)
    # Where the crush is deep, it disagrees with the severity, and the answer depends on how far each is trusted.
    for name, *depths in (("errors of figures", 0.2, 0.05), ("errors of figures, deep crush", 0.5, 0.3)):

        def energies(v, figures, depths=depths):
            return front_and_side(v, figures, *depths)

        yield name, by_figures, [
            ("severity", *SEVERITY),
            ("crush by fitted figures", *SIDE_CRUSH, SIDE_COVARIANCE, energies),
        ]


# --- the samplers ----------------------------------------------------------------------------------------------


def run(name, numbers, evidence, rng, prior_draws, steps):
    case = {"evidence": evidence}
    unknown = [key for key, value in numbers.items() if not isinstance(value, float)]

    def filled(x):
        n = x.shape[0]
        v = {key: np.full(n, value) for key, value in numbers.items() if isinstance(value, float)}
        v.update({key: x[:, i] for i, key in enumerate(unknown)})
        return v

    def log_posterior(x):
        total = sum(numbers[key].log_density(x[:, i]) for i, key in enumerate(unknown))
        with np.errstate(all="ignore"):
            likelihood, _ = log_likelihood(case, filled(x))
        total = total + likelihood
        return np.where(np.isnan(total), -np.inf, total)

    def quantities(x):
        with np.errstate(all="ignore"):
            _, out = log_likelihood(case, filled(x))
        columns = [*out["speeds"], *out["delta_v"], out["closing"], out["loss"], out["e"]]
        return np.stack([np.broadcast_to(column, x.shape[:1]) for column in columns], axis=1)

    # Importance sampling from the prior.
    kept, log_weights = [], []
    block = 500_000
    for _ in range(prior_draws // block):
        x = np.stack([numbers[key].draw(rng, block) for key in unknown], axis=1)
        with np.errstate(all="ignore"):
            likelihood, _ = log_likelihood(case, filled(x))
        # exp(−40) of the greatest is nothing.
        best = np.flatnonzero(likelihood > np.max(likelihood) - 40.0)
        kept.append(x[best])
        log_weights.append(likelihood[best])
    kept, log_weights = np.concatenate(kept), np.concatenate(log_weights)
    weights = np.exp(log_weights - np.max(log_weights))
    weights /= np.sum(weights)
    effective = 1.0 / np.sum(weights**2)
    y = quantities(kept)
    importance_mean = weights @ y
    importance_error = np.sqrt(np.sum((weights[:, None] * (y - importance_mean)) ** 2, axis=0))
    # Z = Σ L/N over the draws of the prior; its relative error is √(1/n_eff − 1/N).
    log_evidence = np.max(log_weights) + np.log(np.sum(np.exp(log_weights - np.max(log_weights))) / prior_draws)
    log_evidence_error = np.sqrt(1.0 / effective - 1.0 / prior_draws)

    # Ensembles that begin at draws of it.
    walkers = 32 * len(unknown)
    means, sds, quantiles = [], [], []
    moves = [(emcee.moves.DEMove(), 0.7), (emcee.moves.DEMove(gamma0=1.0), 0.1), (emcee.moves.StretchMove(), 0.2)]
    acceptance = []
    for ensemble in range(ENSEMBLES):
        np.random.seed(rng.integers(2**31))
        start = kept[rng.choice(len(weights), walkers, p=weights)]
        start = start + 1e-6 * np.abs(start) * rng.standard_normal(start.shape)
        possible = np.isfinite(log_posterior(start))
        start[~possible] = start[possible][0] * (1.0 + 1e-9)
        sampler = emcee.EnsembleSampler(walkers, len(unknown), log_posterior, vectorize=True, moves=moves)
        sampler.run_mcmc(start, steps, skip_initial_state_check=True, thin_by=1)
        acceptance.append(np.mean(sampler.acceptance_fraction))
        y = quantities(sampler.get_chain(discard=steps // 5, thin=5, flat=True))
        means.append(np.mean(y, axis=0))
        sds.append(np.std(y, axis=0))
        quantiles.append(np.quantile(y, QUANTILES, axis=0))

    def with_error(of_ensembles):
        of_ensembles = np.array(of_ensembles)
        error = np.std(of_ensembles, axis=0, ddof=1) / np.sqrt(ENSEMBLES)
        return np.mean(of_ensembles, axis=0), error

    mean, sd, quantile = with_error(means), with_error(sds), with_error(quantiles)
    result = {"log_evidence": [log_evidence, log_evidence_error]}
    for i, quantity in enumerate(QUANTITIES):
        result[quantity] = {
            "mean": [mean[0][i], mean[1][i]],
            "sd": [sd[0][i], sd[1][i]],
            **{f"q{100 * q:02.0f}": [quantile[0][k, i], quantile[1][k, i]] for k, q in enumerate(QUANTILES)},
            "mean_by_importance": [importance_mean[i], importance_error[i]],
        }
    worst = np.max(np.abs(mean[0] - importance_mean) / np.hypot(mean[1], importance_error).clip(1e-12))
    print(
        f"{name}: {len(unknown)} unknown, acceptance {np.mean(acceptance):.2f}, "
        f"{effective:.0f} effective draws of the prior, samplers differ by {worst:.1f} standard errors",
        file=sys.stderr,
    )
    return result


def rounded(tree):
    if isinstance(tree, dict):
        return {key: rounded(value) for key, value in tree.items()}
    if isinstance(tree, list):
        return [rounded(value) for value in tree]
    return float(f"{tree:.6g}")


def main():
    quick = "--quick" in sys.argv
    wanted = [argument for argument in sys.argv[1:] if argument != "--quick"]
    results = {}
    for place, (name, numbers, evidence) in enumerate(cases()):
        if wanted and name not in wanted:
            continue
        rng = np.random.default_rng([SEED, place])
        draws, steps = (500_000, 300) if quick else (6_000_000, 2_500)
        results[name] = rounded(run(name, numbers, evidence, rng, draws, steps))
    json.dump(results, sys.stdout, indent=1)
    print()


main()
