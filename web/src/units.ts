// The unit that an empty field offers: the one in which the case has its like, or that of its system of units.
import type { Check, Field } from "./engine.js";
import { fieldOf } from "./keys.js";
import { type Value, readValue, splitUnit } from "./toml.js";

/** For each list of units, known by a unit of it, the metric one and the US one. */
const OF_SYSTEM: [has: string, metric: string, us: string][] = [
  ["km/h", "km/h", "mph"],
  ["kg", "kg", "lb"],
  ["kgf", "N", "lb"],
  ["kg m^2", "kg m^2", "lb ft s^2"],
  ["kJ", "kJ", "ft lb"],
  ["N/cm", "N/cm", "lb/in"],
  ["N/cm^2", "N/cm^2", "lb/in^2"],
  ["N", "N", "lb"],
  ["N^0.5", "N^0.5", "lb^0.5"],
  ["N^0.5/cm", "N^0.5/cm", "lb^0.5/in"],
  ["m/s^2", "m/s^2", "g"],
];

/** A number of the case, with what it is like. */
interface Used {
  /** Without the number of the vehicle and of a list. */
  key: string;
  /** Damage, vehicle or scene: lengths of each have units of their own. */
  part: string;
  /** The units that it can have. */
  units: string;
  unit: string;
}

const general = (key: string): string => key.replaceAll(/\[\d+\]/g, "");
const common = (key: string): string => general(key).replace(/^vehicle[12]/, "vehicle");
const partOf = (key: string): string => (/\.crush\./.test(key) ? "damage" : /^vehicle[12]\.\w+$/.test(key) ? "vehicle" : "scene");

/** The unit of a value: of a range or a list that of its first number. */
function unitOf(value: Value | undefined): string | undefined {
  if (typeof value === "string") return splitUnit(value)?.unit;
  if (typeof value !== "object") return undefined;
  return Object.values(value).map(unitOf).find((unit) => unit !== undefined && unit !== "");
}

const used = new WeakMap<Check, Used[]>();

function usedIn(check: Check): Used[] {
  const known = used.get(check);
  if (known) return known;
  const all = Object.entries(check.values).flatMap(([key, { text }]): Used[] => {
    const units = fieldOf(general(key))?.units ?? [];
    const unit = units.length > 0 ? unitOf(readValue(text)) : undefined;
    return unit !== undefined && units.includes(unit) ? [{ key: common(key), part: partOf(key), units: units.join(), unit }] : [];
  });
  used.set(check, all);
  return all;
}

/** The unit that most of them have. */
function most(list: Used[]): string | undefined {
  const count = (unit: string) => list.filter((one) => one.unit === unit).length;
  return list.map(({ unit }) => unit).sort((one, other) => count(other) - count(one))[0];
}

/** The case is in US units, as far as a case with an error shows it. */
function isUs(check: Check, all: Used[]): boolean {
  if (check.units !== "") return check.units === "us";
  return 2 * all.filter(({ unit }) => /^(?:mph|lb|ft|in)\b/.test(unit)).length > all.length;
}

export function unitFor(field: Field, check: Check): string {
  const [first = ""] = field.units;
  const all = usedIn(check);
  const isLength = field.units.includes("cm");
  const same = all.filter(({ units }) => units === field.units.join());
  const found = most(same.filter(({ key }) => key === common(field.key)))
    ?? most(same.filter(({ part }) => part === partOf(field.key)))
    ?? (isLength ? undefined : most(same));
  if (found !== undefined) return found;
  const us = isUs(check, all);
  if (isLength) return partOf(field.key) === "scene" ? (us ? "ft" : "m") : us ? "in" : "cm";
  const [, metric, american] = OF_SYSTEM.find(([has]) => field.units.includes(has)) ?? [];
  return (us ? american : metric) ?? first;
}
