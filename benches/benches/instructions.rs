//! Instructions per operation, by gungraun under valgrind. `benches/compare-commits` reads the counts.
#![expect(missing_docs, reason = "gungraun's macros generate public items without documentation")]

use std::fmt::Display;
use std::io::{Write, stderr};
use std::process::exit;

use case::{CaseFile, Diagnostics};
use crash3::{Profile, Stiffness, crush_energy};
use deltav_benches::{
    CASE_FILE, Example, FRACTION, FRICTION, FULL_OR_SLIDING, RATIO, RESTITUTION, Refused, VELOCITY_CHANGE,
    centimetre, spin_out, spin_outs,
};
use gungraun::{library_benchmark, library_benchmark_group, main};
use pim_core::{
    Contact, ImpactError, InvalidInput, Law, Motion, Outcome, Participant, RestitutionCurve, Tangential,
};
use reconcile::{Problem, ReconcileError, Reconciliation};
use trajectory::{
    Chassis, Ground, NoRest, Outset, Rest, Starts, State, Steer, Target, Unreached, to_rest, to_rests,
    to_start,
};

type Impact = ([Motion; 2], Law, Contact);
type Meeting = ([Participant; 2], f64, [Motion; 2], Law);

/// An operation that gives up is quick: unless the run ends, its count would pass for an improvement.
fn accepted<T, E: Display>(result: Result<T, E>) -> T {
    result.unwrap_or_else(|refusal| {
        // If standard error is closed, there is nowhere to report to.
        let _ = writeln!(stderr(), "{refusal}");
        exit(1)
    })
}

/// By reference, so that neither a copy nor a drop of the input is counted.
fn kept<T>(input: Result<T, Refused>) -> &'static T {
    Box::leak(Box::new(accepted(input)))
}

fn check<T, E: Display>(result: Result<T, E>) {
    accepted(result);
}

fn impact_input(tangential: Tangential) -> &'static Impact {
    kept(Example::new().and_then(|example| Ok((example.motions, Example::law(tangential)?, example.contact))))
}

fn meeting_input(tangential: Tangential) -> &'static Meeting {
    kept(Example::new().and_then(|example| {
        let Example { participants, crush_plane, motions, .. } = example;
        Ok((participants, crush_plane, motions, Example::law(tangential)?))
    }))
}

fn damage_input() -> &'static (Profile, Stiffness) {
    kept(Example::new().map(|example| {
        let [damage, _] = example.damage;
        damage
    }))
}

fn problem_input(tangential: Tangential) -> &'static Problem {
    kept(Example::new().and_then(|example| example.problem(tangential)))
}

#[library_benchmark(setup = impact_input, teardown = check)]
#[bench::critical(Tangential::Critical)]
#[bench::ratio(RATIO)]
#[bench::fraction(FRACTION)]
#[bench::friction(FRICTION)]
#[bench::velocity_change(VELOCITY_CHANGE)]
#[bench::restitution(RESTITUTION)]
#[bench::full_or_sliding(FULL_OR_SLIDING)]
fn impact((motions, law, contact): &'static Impact) -> Result<Outcome, ImpactError> {
    contact.impact(*motions, law)
}

#[library_benchmark(setup = meeting_input, teardown = check)]
#[bench::critical(Tangential::Critical)]
fn contact_and_impact(
    (participants, crush_plane, motions, law): &'static Meeting,
) -> Result<Result<Outcome, ImpactError>, InvalidInput> {
    Contact::new(*participants, *crush_plane).map(|contact| contact.impact(*motions, law))
}

#[library_benchmark(setup = damage_input)]
#[bench::six_stations()]
fn crush((profile, stiffness): &'static (Profile, Stiffness)) -> f64 {
    crush_energy(profile, stiffness)
}

#[library_benchmark(setup = problem_input, teardown = check)]
#[bench::critical(Tangential::Critical)]
fn closed_form(problem: &'static Problem) -> Result<Reconciliation, ReconcileError> {
    problem.solve()
}

/// e falls from 0.5 to 0.1 with the closing speed, in four pieces.
fn curve_input(tangential: Tangential) -> &'static Problem {
    kept(Example::new().and_then(|example| {
        let points = vec![(2.0, 0.5), (10.0, 0.35), (20.0, 0.2), (30.0, 0.1)];
        let law = Example::law(tangential)?.with_restitution_curve(RestitutionCurve::new(points)?);
        Ok(Problem { law, ..example.problem(tangential)? })
    }))
}

#[library_benchmark(setup = problem_input, teardown = check)]
#[bench::critical(Tangential::Critical)]
#[bench::friction(FRICTION)]
#[bench::fraction(FRACTION)]
#[bench::critical_with_a_curve(args = (Tangential::Critical), setup = curve_input)]
#[bench::friction_with_a_curve(args = (FRICTION), setup = curve_input)]
fn root_finder(problem: &'static Problem) -> Result<Reconciliation, ReconcileError> {
    problem.root_finder()
}

#[library_benchmark(teardown = check)]
#[bench::sae_980025(CASE_FILE)]
fn parse((name, text): (&str, &str)) -> Result<CaseFile, Diagnostics> {
    CaseFile::parse(name, text)
}

type Way = (Chassis, Ground<'static>, State);

fn way_input() -> &'static Way {
    kept(spin_out())
}

#[library_benchmark(setup = way_input, teardown = check)]
#[bench::spin_out()]
fn forward((chassis, ground, start): &'static Way) -> Result<Rest, NoRest> {
    to_rest(chassis, Steer::straight(), ground, start, &centimetre(), |_| {})
}

fn ways_input() -> &'static [Outset<'static>] {
    kept::<Vec<_>>(spin_outs(64))
}

#[library_benchmark(setup = ways_input)]
#[bench::spin_outs()]
fn forward_block(outsets: &'static [Outset<'static>]) -> f64 {
    let mut time = 0.0;
    to_rests(outsets, &centimetre(), |_, rest| time += accepted(rest).time);
    time
}

/// With the turn known.
fn target_input() -> &'static (Way, Target) {
    kept(spin_out().map(|(chassis, ground, start)| {
        let rest = accepted(to_rest(&chassis, Steer::straight(), &ground, &start, &centimetre(), |_| {}));
        let target = Target { position: rest.position, heading: rest.heading, turns_known: true, via: None };
        ((chassis, ground, start), target)
    }))
}

#[library_benchmark(setup = target_input, teardown = check)]
#[bench::spin_out()]
fn backward(((chassis, ground, start), target): &'static (Way, Target)) -> Result<Starts, Unreached> {
    to_start(chassis, Steer::straight(), ground, start.position, start.heading, target, &centimetre())
}

library_benchmark_group!(
    name = deltav,
    benchmarks = [
        impact,
        contact_and_impact,
        crush,
        closed_form,
        root_finder,
        parse,
        forward,
        forward_block,
        backward
    ]
);

main!(library_benchmark_groups = deltav);
