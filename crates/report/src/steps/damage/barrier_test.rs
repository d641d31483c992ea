//! A, B and G from a barrier test.

use case::{Fit, GivenTest};
use crash3::Stiffness;
use pim_core::VehicleId;

use super::super::{Step, inertia, n, p, step};
use crate::units::Measure;

pub(super) fn steps(stiffness: &Stiffness, test: &GivenTest, i: VehicleId) -> Vec<Step> {
    let Ok(fitted) = test.test() else { return Vec::new() };
    let sums = fitted.profile().sums();
    let depths = fitted.profile().depths();
    let mut steps = vec![inertia::mass(&test.mass, of_test("mass", i), &format!("T,{i}"))];
    let mean_crush = step(of_test("mean crush", i), format!("C_T,{i}"))
        .equals(
            "Σ ((C_j + C_j+1)/2)/n",
            mean(depths, |c1, c2| format!("({} + {}) / 2", n(c1, "m"), n(c2, "m"))),
        )
        .is(sums.mean_depth(), "m", "theory 5");
    steps.push(mean_crush.of(Measure::Crush));
    let (v, b0) = (test.speed.si(), test.no_damage_speed.si());
    let slope = match test.fit {
        Fit::Exact => {
            let square = sums.mean_square_depth();
            steps.push(
                step(of_test("mean square of the crush", i), format!("Q_T,{i}"))
                    .equals(
                        "Σ ((C_j² + C_j C_j+1 + C_j+1²)/3)/n",
                        mean(depths, |c1, c2| {
                            format!(
                                "({}² + {} · {} + {}²) / 3",
                                p(c1, "m"),
                                n(c1, "m"),
                                n(c2, "m"),
                                p(c2, "m")
                            )
                        }),
                    )
                    .is(square, "m²", "theory 5"),
            );
            let (formula, numbers) = exact([v, b0], sums.mean_depth(), square, i);
            Slope { formula, numbers, value: fitted.slope() }
        }
        Fit::Mean => Slope {
            formula: format!("(V_T,{i} − b_0T,{i})/C_T,{i}"),
            numbers: format!("({} − {}) / {}", n(v, "m/s"), n(b0, "m/s"), n(sums.mean_depth(), "m")),
            value: fitted.mean_slope(),
        },
    };
    let b1 = slope.value;
    let name = of_test("slope of the speed over the crush", i);
    steps.push(step(name, format!("b_T,{i}")).equals(slope.formula, slope.numbers).is(b1, "1/s", "theory 5"));
    steps.extend(coefficients(stiffness, test, b1, i));
    steps
}

fn of_test(what: &str, i: VehicleId) -> String {
    format!("{what} in the barrier test for vehicle {i}")
}

/// b_1 in symbols and in numbers.
struct Slope {
    formula: String,
    numbers: String,
    value: f64,
}

/// The mean over the zones of a term of their two ends, in numbers. The stations are equally spaced, so that
/// the zones weigh the same.
fn mean(depths: &[f64], term: impl Fn(f64, f64) -> String) -> String {
    let terms: Vec<String> = depths.windows(2).map(|ends| term(ends[0], ends[1])).collect();
    format!("({}) / {}", terms.join(" + "), terms.len())
}

/// The slope with which the test's profile reproduces the test's energy, in symbols and in numbers.
fn exact([v, b0]: [f64; 2], mean: f64, square: f64, i: VehicleId) -> (String, String) {
    let [b0, v, square] = [p(b0, "m/s"), p(v, "m/s"), n(square, "m²")];
    (
        format!(
            "(V_T,{i}² − b_0T,{i}²)/(b_0T,{i} C_T,{i} + √(b_0T,{i}² C_T,{i}² + Q_T,{i} (V_T,{i}² − b_0T,{i}²)))"
        ),
        format!(
            "({v}² − {b0}²) / ({b0} · {} + √({b0}² · {}² + {square} · ({v}² − {b0}²)))",
            n(mean, "m"),
            p(mean, "m")
        ),
    )
}

/// A, B and G from the slope.
fn coefficients(stiffness: &Stiffness, test: &GivenTest, b1: f64, i: VehicleId) -> [Step; 3] {
    let (mass, width, b0) = (n(test.mass.kg(), "kg"), n(test.width.si(), "m"), test.no_damage_speed.si());
    [
        (
            "A",
            format!("m_T,{i} b_0T,{i} b_T,{i}/w_T,{i}"),
            format!("{mass} · {} · {} / {width}", n(b0, "m/s"), n(b1, "1/s")),
            stiffness.a(),
            "N/m",
        ),
        (
            "B",
            format!("m_T,{i} b_T,{i}²/w_T,{i}"),
            format!("{mass} · {}² / {width}", p(b1, "1/s")),
            stiffness.b(),
            "N/m²",
        ),
        (
            "G",
            format!("m_T,{i} b_0T,{i}²/(2 w_T,{i})"),
            format!("{mass} · {}² / (2 · {width})", p(b0, "m/s")),
            stiffness.g(),
            "N",
        ),
    ]
    .map(|(what, formula, numbers, value, unit)| {
        let name = format!("stiffness {what} of vehicle {i}, from the barrier test");
        step(name, format!("{what}_{i}")).equals(formula, numbers).is(value, unit, "theory 5")
    })
}
