//! Values written with the feature `serde` are read back unchanged.

use std::cell::Cell;

use oracle::scenes::for_all;
use oracle::written::{again, assert_again};
use pim_core::{RestitutionCurve, VehicleId};
use reconcile::{Iterations, MAX_STEPS, Problem, SolutionMethod};
use serde_json::{Value, from_value, json, to_value};

use crate::reconciliation::{Case, all_laws, case, with_curve};

/// A problem read back gives the same answer as the one written, bit for bit; the answer is read back
/// unchanged, too.
#[test]
fn problems_and_answers() {
    let (closed, searched) = (Cell::new(0), Cell::new(0));
    for_all(500, 0.2, case(all_laws()), |case: Case| {
        let Ok(outcome) = case.scene.impact() else { return false };
        let problem = case.problem(outcome.energy.normal_work);
        let curve = RestitutionCurve::new(vec![(0.0, 0.5), (20.0, 0.1)]).unwrap();
        for problem in [with_curve(&problem, &curve), problem] {
            let read: Problem = again(&problem);
            assert_eq!(read, problem);
            assert_again(&problem.line());
            let Ok(answer) = problem.solve() else { return false };
            assert_again(&problem.quadratic(&answer.acting));
            assert_eq!(read.solve().unwrap(), answer);
            assert_again(&answer);
            match answer.method {
                SolutionMethod::ClosedForm => closed.set(closed.get() + 1),
                SolutionMethod::RootFinder(_) => searched.set(searched.get() + 1),
            }
        }
        true
    });
    assert!(closed.get() > 20 && searched.get() > 100, "{closed:?} {searched:?}");
    assert_eq!(to_value(VehicleId::ALL).unwrap(), json!(["One", "Two"]));
    assert_again(&VehicleId::ALL);
}

#[test]
fn a_search_has_no_more_steps_than_it_can_have() {
    let steps = |count: usize| {
        let step = json!({ "speed": 1.0, "normal_work": 2.0 });
        from_value::<Iterations>(Value::Array(vec![step; count]))
    };
    assert_eq!(steps(MAX_STEPS).unwrap().as_slice().len(), MAX_STEPS);
    let refusal = steps(MAX_STEPS + 1).unwrap_err().to_string();
    assert!(refusal.contains("at most 64 steps"), "{refusal}");
}
