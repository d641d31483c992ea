"""Writes tables like those of NHTSA's CISS, of crashes that are simulated: to try what reads the real ones.

    python simulated_ciss.py FOLDER [CRASHES] [SEED]

Two cars of known speeds meet; planar impact mechanics gives their ΔV and the energy. Damage, direction of force
and what the recorders store follow from these, each with an error such as that of the field (docs/calibration.md).
Nothing of it is a real crash.
"""

import csv
import math
import pathlib
import random
import sys
from typing import Any

import pydeltav

# (√N, √N/m) d0 and d1 of front, rear and side, of a car in the middle of the fleet.
STIFFNESS = {"F": (80.3, 876.0), "B": (80.3, 658.0), "L": (48.1, 1113.0)}
# Mean and spread of the logarithm of crush energy by energy of the impact, and of a recorder's error.
CRUSH_MISFIT = (-0.388, 0.363)
RECORDER_ERROR = 0.10
# What meets the front of vehicle 1: heading of vehicle 2 clockwise, its plane, and the least speeds (m/s).
KINDS = ((0.0, "B", (14.0, 0.0)), (180.0, "F", (7.0, 7.0)), (270.0, "L", (11.0, 6.0)))
UNKNOWN = {"HEADINGANG": 888, "DVANGTHIS": 997, "MAXDVLAT": 997, "CARGOWT": 9999, "DVENERGY": 9999997}


def write(folder: str | pathlib.Path, crashes: int = 12, seed: int = 1, incomplete: int = 0) -> None:
    """Writes CRASH, GV, CDC, EDREVENT and EVENT as CSV, with ``crashes`` pairs that have all it takes, and others."""
    chance = random.Random(seed)
    tables: dict[str, list[dict[str, Any]]] = {name: [] for name in ("CRASH", "EVENT", "GV", "CDC", "EDREVENT")}
    for crash in range(1, crashes + 1):
        _add(tables, crash, KINDS[crash % len(KINDS)], chance)
        if crash % 4 == 0:
            # A third vehicle that a tree stopped: no pair.
            _add_single(tables, crash, chance)
    for crash in range(crashes + 1, crashes + incomplete + 1):
        _add(tables, crash, KINDS[crash % len(KINDS)], chance)
        if crash % 2:
            tables["CDC"][-1]["PDOF"] = 888
        else:
            # The recorders stored something else.
            for stored in tables["EDREVENT"]:
                stored["CDCEVENT"] = 97 if stored["CASEID"] == crash else stored["CDCEVENT"]
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    for name, rows in tables.items():
        with open(pathlib.Path(folder) / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(rows[0]), lineterminator="\r\n")
            writer.writeheader()
            writer.writerows(rows)


def _impact(kind: tuple[Any, ...], masses: list[float], chance: random.Random) -> tuple[Any, list[list[float]]]:
    heading, plane, least = kind
    speeds = [speed + chance.uniform(0.0, 9.0) if speed else 0.0 for speed in least]
    # Along the damaged faces (m): to the left on an end, forward on a side.
    along = [chance.uniform(-0.4, 0.4), chance.uniform(-0.5, 0.5)]
    places = [[2.0, along[0]], {"B": [-2.3, along[1]], "F": [2.0, along[1]], "L": [along[1], 0.8]}[plane]]
    case: dict[str, Any] = {
        "impact": {"crush_plane": "180 deg", "restitution": 0.12, "tangential": "critical"},
    }
    for vehicle in (0, 1):
        case[f"vehicle{vehicle + 1}"] = {
            "mass": f"{masses[vehicle]} kg",
            "yaw_radius": "1.37 m",
            "heading": f"{-heading * vehicle} deg",
            "speed": f"{speeds[vehicle]} m/s",
            "contact": {"x": f"{places[vehicle][0]} m", "y": f"{places[vehicle][1]} m"},
        }
    return pydeltav.Case.from_dict(case).impact(), [along, speeds]


def _add(tables: dict[str, list[dict[str, Any]]], crash: int, kind: tuple[Any, ...], chance: random.Random) -> None:
    curb = [round(chance.uniform(1150.0, 2100.0)) for _ in range(2)]
    result, (along, _) = _impact(kind, [mass + 75.0 for mass in curb], chance)
    energy = result.impact.energy_loss * math.exp(chance.gauss(*CRUSH_MISFIT))
    share = chance.uniform(0.35, 0.65)
    width = chance.uniform(1.2, 1.6)
    turn = 10.0 * chance.randrange(36)
    tables["CRASH"].append({"CASEID": crash, "CRASHYEAR": 2017, "PSU": 10, "CATEGORY": "D", "VEHICLES": 2})
    tables["EVENT"].append({"CASEID": crash, "EVENTNO": 1, "VEHNUM": 1, "GAD1": "F", "OBJCONT": 2, "GAD2": kind[1]})
    for place, (plane, part) in enumerate((("F", share), (kind[1], 1.0 - share))):
        vehicle = result.vehicle1 if place == 0 else result.vehicle2
        d0, d1 = STIFFNESS[plane]
        # E = ½ L (d0 + d1 C)²
        depth = max((math.sqrt(2.0 * energy * part / width) - d0) / d1, 0.0)
        depths = [max(round(100.0 * depth * chance.uniform(0.85, 1.15)), 0) for _ in range(6)]
        pdof = round(math.degrees(vehicle.pdof) / 10.0) * 10 % 360
        size = round(3.6 * vehicle.delta_v)
        recorded = math.exp(chance.gauss(0.0, RECORDER_ERROR))
        offset = round(-100.0 * along[place]) if plane != "L" else round(100.0 * along[place])
        length = round(100.0 * (width if plane != "L" else 1.3 * width))
        known = chance.random() > 0.2
        tables["GV"].append(
            {"CASEID": crash, "VEHNO": place + 1, "MAKE": 20, "MODEL": 401, "MODELYR": 2012, "BODYTYPE": 4}
            | {"CURBWT": curb[place], "CARGOWT": 0 if known else UNKNOWN["CARGOWT"]}
            | {"DVANGTHIS": UNKNOWN["DVANGTHIS"]}
        )
        tables["CDC"].append(
            {"CASEID": crash, "EVENTNO": 1, "VEHNO": place + 1, "OBJCONT": 2 - place, "CDCPLANE": plane}
            | {"CDC": f"{(pdof // 30 - 1) % 12 + 1:02d}{plane}DEW02", "PDOF": pdof}
            | {"HEADINGANG": (turn + kind[0] * place) % 360.0 if known else UNKNOWN["HEADINGANG"]}
            | {"FIELDL": length, "FIELDLD": 0, "DIRECTL": length, "DIRECTD": offset}
            | {f"C{station}": cm for station, cm in enumerate(depths, 1)}
            | {"CMAX": max(depths), "DVTOTAL": round(0.85 * size), "DVLONG": "", "DVLAT": ""}
            | {"DVENERGY": UNKNOWN["DVENERGY"]}
        )
        parts = [3.6 * recorded * part for part in (vehicle.delta_v_longitudinal, vehicle.delta_v_lateral)]
        if place == 0 or known:
            tables["EDREVENT"].append(
                {"CASEID": crash, "VEHNO": place + 1, "EDRSUMMNO": 1, "EDREVENTNO": 1, "CDCEVENT": 1}
                | {"MAXDVLONG": round(parts[0], 2), "MAXDVLAT": round(parts[1], 2) if known else UNKNOWN["MAXDVLAT"]}
            )


def _add_single(tables: dict[str, list[dict[str, Any]]], crash: int, chance: random.Random) -> None:
    damage = dict(tables["CDC"][-2], EVENTNO=2, VEHNO=3, OBJCONT=41, C6=round(chance.uniform(5.0, 40.0)))
    tables["CDC"].append(damage)
    tables["GV"].append(dict(tables["GV"][-2], VEHNO=3))
    tables["EVENT"].append(dict(tables["EVENT"][-1], EVENTNO=2, VEHNUM=3, OBJCONT=41, GAD2=""))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    write(sys.argv[1], *map(int, sys.argv[2:4]))
