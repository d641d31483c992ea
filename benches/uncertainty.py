#!/usr/bin/env python3
"""What `deltav uncertainty fixtures/sae-980025-uncertain.toml` computes, as a vectorised NumPy program: the yardstick for the program's speed.

    python3 benches/uncertainty.py [SAMPLES]

Needs NumPy 2. Draws all 31 numbers, solves each sample in closed form (docs/theory.md, sections 2 to 5) and prints mean, standard deviation, median and the
ends of the 50, 90, 95 and 99 % intervals of the same nine outputs. benches/README.md says what to compare.
"""

import os
import sys
import time

# One thread, as the program that it is compared with.
for library in ("OMP", "OPENBLAS", "MKL"):
    os.environ[f"{library}_NUM_THREADS"] = "1"

import numpy as np

N = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
rng = np.random.default_rng(1)

INCH, FOOT = 0.0254, 0.3048
POUND = 0.45359237  # kg
POUND_FORCE = POUND * 9.80665  # N
INERTIA = POUND_FORCE * FOOT  # lb ft s² in kg·m²
MPH = 0.44704
DEGREE = np.pi / 180.0
D0 = np.sqrt(POUND_FORCE)  # lb^0.5 in √N
D1 = D0 / FOOT


def normal(mean, sd):
    return rng.normal(mean, sd, N)


def positive(mean, sd):
    """Normal, drawn again where not above zero."""
    x = rng.normal(mean, sd, N)
    bad = np.flatnonzero(x <= 0.0)
    while bad.size:
        x[bad] = rng.normal(mean, sd, bad.size)
        bad = bad[x[bad] <= 0.0]
    return x


def within(mean, share):
    """Normal, 95 % of it within a share of the mean."""
    return positive(mean, share * mean / 1.959963984540054)


def energy(width, depths, d0, d1):
    """E = Σ w [A (C₁ + C₂)/2 + B (C₁² + C₁C₂ + C₂²)/6 + G]"""
    a, b, g = d0 * d1, d1 * d1, d0 * d0 / 2.0
    w = width / (len(depths) - 1)
    total = np.zeros(N)
    for c1, c2 in zip(depths, depths[1:]):
        total += w * (a * (c1 + c2) / 2.0 + b * (c1 * c1 + c1 * c2 + c2 * c2) / 6.0 + g)
    return total


def main():
    started = time.perf_counter()
    m1, j1 = positive(3696 * POUND, 50 * POUND), within(2437 * INERTIA, 0.10)
    m2, j2 = positive(3413 * POUND, 50 * POUND), within(2165 * INERTIA, 0.10)
    h1, h2 = normal(180 * DEGREE, 3 * DEGREE), normal(67 * DEGREE, 3 * DEGREE)
    d_1, f1 = positive(6.3 * FOOT, 3 * INCH), normal(-22.4 * DEGREE, 3 * DEGREE)
    d_2, f2 = positive(3.8 * FOOT, 3 * INCH), normal(-39 * DEGREE, 3 * DEGREE)
    v2 = rng.triangular(8 * MPH, 10 * MPH, 12 * MPH, N)
    crush_plane = normal(-23 * DEGREE, 3 * DEGREE)
    e = rng.uniform(0.2, 0.4, N)
    crush = np.zeros(N)
    for width, depths, d0, d1 in [
        (65, [21.3, 20.3, 13.8, 11.3, 5.3, 4.8], 35, 115),
        (84, [3.0, 15.8, 13.5, 6.7, 3.3, 5.0], 30, 77.5),
    ]:
        crush += energy(
            positive(width * INCH, 1 * INCH),
            [positive(depth * INCH, 0.5 * INCH) for depth in depths],
            within(d0 * D0, 0.20),
            within(d1 * D1, 0.10),
        )

    # Arms in the scene, the normal, arms along n and t.
    s1, c1, s2, c2 = np.sin(h1), np.cos(h1), np.sin(h2), np.cos(h2)
    x1, y1 = d_1 * np.cos(h1 + f1), d_1 * np.sin(h1 + f1)
    x2, y2 = d_2 * np.cos(h2 + f2), d_2 * np.sin(h2 + f2)
    nx, ny = np.cos(crush_plane), np.sin(crush_plane)
    sign = np.sign((x2 - x1) * nx + (y2 - y1) * ny)
    nx, ny = sign * nx, sign * ny
    n1, t1 = x1 * nx + y1 * ny, y1 * nx - x1 * ny
    n2, t2 = x2 * nx + y2 * ny, y2 * nx - x2 * ny

    # K
    inverse_mass = 1.0 / m1 + 1.0 / m2
    k_nn = inverse_mass + t1 * t1 / j1 + t2 * t2 / j2
    k_tt = inverse_mass + n1 * n1 / j1 + n2 * n2 / j2
    k_nt = -(n1 * t1 / j1 + n2 * t2 / j2)
    det = k_nn * k_tt - k_nt * k_nt

    # u at the speed 0 of vehicle 1, and its slope; P_n = α x + β with x = −u_n
    w_n, w_t = c1 * nx + s1 * ny, s1 * nx - c1 * ny
    r_n, r_t = -v2 * (c2 * nx + s2 * ny), -v2 * (s2 * nx - c2 * ny)
    slope = -w_t / w_n
    touch = r_t + r_n * slope
    beta = k_nt * touch / det
    alpha = (k_tt * (1.0 + e) + k_nt * slope) / det
    q = 2.0 * crush / (1.0 - e)
    root = np.sqrt(beta * beta + 4.0 * alpha * q)
    x = (root - beta) / (2.0 * alpha)
    speed = -(x + r_n) / w_n

    # The impact there.
    u_n, u_t = -x, touch + x * slope
    p_n = (-k_tt * (1.0 + e) * u_n + k_nt * u_t) / det
    p_t = (-k_nn * u_t + k_nt * (1.0 + e) * u_n) / det
    px, py = p_n * nx - p_t * ny, p_n * ny + p_t * nx
    size = np.sqrt(px * px + py * py)
    normal_work = -0.5 * p_n * u_n * (1.0 - e)
    tangential_work = -0.5 * p_t * u_t
    answers = {
        "vehicle1.speed": speed,
        "vehicle1.delta_v": size / m1,
        "vehicle2.delta_v": size / m2,
        "vehicle1.pdof": np.arctan2(py * c1 - px * s1, -(px * c1 + py * s1)),
        "vehicle2.pdof": np.arctan2(-(py * c2 - px * s2), px * c2 + py * s2),
        "impact.closing_speed": -u_n,
        "impact.energy_loss": normal_work + tangential_work,
        "impact.normal_work": normal_work,
        "impact.tangential_work": tangential_work,
    }
    good = (p_n > 0.0) & (u_n < 0.0) & np.isfinite(speed)
    probabilities = [0.5, 0.25, 0.75, 0.05, 0.95, 0.025, 0.975, 0.005, 0.995]
    for name, column in answers.items():
        if not good.all():
            column = column[good]
        quantiles = " ".join(f"{value:.6g}" for value in np.quantile(column, probabilities))
        print(f"{name:24} {column.mean():.6g} {column.std(ddof=1):.6g} {quantiles}")
    print(f"{(time.perf_counter() - started) * 1e9 / N:.1f} ns a sample", file=sys.stderr)


main()
