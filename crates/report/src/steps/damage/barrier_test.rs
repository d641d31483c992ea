//! A, B and G from a barrier test.

use case::{Fit, GivenTest};
use crash3::Stiffness;
use pim_core::VehicleId;

use super::super::{Draft, inertia, n, step};
use super::profile;
use crate::units::Measure;

pub(super) fn steps(stiffness: &Stiffness, test: &GivenTest, i: VehicleId) -> Vec<Draft> {
    let Ok(fitted) = test.test() else { return Vec::new() };
    let sums = fitted.profile().sums();
    let depths = fitted.profile().depths();
    // The stations are equally spaced, so that the zones weigh the same.
    let mean = |term: &dyn Fn(usize) -> String| {
        let terms: Vec<String> = (1..depths.len()).map(term).collect();
        format!("({})/{}", terms.join(" + "), terms.len())
    };
    let (v, b0) = (test.speed.si(), test.no_damage_speed.si());
    let speeds = [(format!("V_T,{i}"), n(v, "m/s")), (format!("b_0T,{i}"), n(b0, "m/s"))];
    let mut steps = vec![
        inertia::mass(&test.mass, of_test("mass", i), &format!("T,{i}")),
        step(of_test("mean crush", i), format!("C_T,{i}"), (sums.mean_depth(), "m"), "theory 5")
            .equals("Σ ((C_j + C_j+1)/2)/n")
            .written_out(mean(&|j| format!("(C_{j} + C_{})/2", j + 1)))
            .with(profile::stations(depths))
            .of(Measure::Crush),
    ];
    let (formula, slope) = match test.fit {
        Fit::Exact => {
            let square = (sums.mean_square_depth(), "m²");
            steps.push(
                step(of_test("mean square of the crush", i), format!("Q_T,{i}"), square, "theory 5")
                    .equals("Σ ((C_j² + C_j C_j+1 + C_j+1²)/3)/n")
                    .written_out(mean(&|j| format!("({})/3", profile::squares(j))))
                    .with(profile::stations(depths)),
            );
            // The slope with which the test's profile reproduces the test's energy.
            let difference = format!("V_T,{i}² − b_0T,{i}²");
            let root = format!("√(b_0T,{i}² C_T,{i}² + Q_T,{i} ({difference}))");
            (format!("({difference})/(b_0T,{i} C_T,{i} + {root})"), fitted.slope())
        }
        Fit::Mean => (format!("(V_T,{i} − b_0T,{i})/C_T,{i}"), fitted.mean_slope()),
    };
    steps.push(
        step(of_test("slope of the speed over the crush", i), format!("b_T,{i}"), (slope, "1/s"), "theory 5")
            .equals(formula)
            .with(speeds.clone()),
    );
    let coefficients = [
        ("A", format!("m_T,{i} b_0T,{i} b_T,{i}/w_T,{i}"), stiffness.a(), "N/m"),
        ("B", format!("m_T,{i} b_T,{i}²/w_T,{i}"), stiffness.b(), "N/m²"),
        ("G", format!("m_T,{i} b_0T,{i}²/(2 w_T,{i})"), stiffness.g(), "N"),
    ];
    steps.extend(coefficients.map(|(what, formula, value, unit)| {
        let name = format!("stiffness {what} of vehicle {i}, from the barrier test");
        step(name, format!("{what}_{i}"), (value, unit), "theory 5")
            .equals(formula)
            .with(speeds.clone())
            .with([(format!("w_T,{i}"), n(test.width.si(), "m"))])
    }));
    steps
}

fn of_test(what: &str, i: VehicleId) -> String {
    format!("{what} in the barrier test for vehicle {i}")
}
