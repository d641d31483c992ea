//! Time per operation, by criterion.

use std::error::Error;
use std::hint::black_box;

use case::Case;
use crash3::crush_energy;
use criterion::Criterion;
use deltav_benches::{CASE_FILE, Example, FRICTION, TANGENTIAL_CONDITIONS};
use pim_core::{Contact, Tangential};

// Not criterion's own macros: an input that is refused ends the run with its reason.
fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    impact(&mut criterion)?;
    crush(&mut criterion)?;
    reconciliation(&mut criterion)?;
    case_file(&mut criterion)?;
    criterion.final_summary();
    Ok(())
}

fn impact(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let example = Example::new()?;
    let contact = example.contact;
    let mut group = criterion.benchmark_group("impact");
    for (name, tangential) in TANGENTIAL_CONDITIONS {
        let law = Example::law(tangential)?;
        contact.impact(example.motions, &law)?;
        group.bench_function(name, |b| {
            b.iter(|| black_box(&contact).impact(black_box(example.motions), black_box(&law)));
        });
    }
    let law = Example::law(Tangential::Critical)?;
    group.bench_function("critical with contact", |b| {
        b.iter(|| {
            Contact::new(black_box(example.participants), black_box(example.crush_plane))
                .map(|contact| contact.impact(black_box(example.motions), black_box(&law)))
        });
    });
    group.finish();
    Ok(())
}

fn crush(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let [(profile, stiffness), _] = Example::new()?.damage;
    criterion.bench_function("crush energy", |b| {
        b.iter(|| crush_energy(black_box(&profile), black_box(&stiffness)));
    });
    Ok(())
}

fn reconciliation(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let example = Example::new()?;
    let critical = example.problem(Tangential::Critical)?;
    let friction = example.problem(FRICTION)?;
    let mut group = criterion.benchmark_group("reconcile");
    critical.solve()?;
    group.bench_function("closed form", |b| b.iter(|| black_box(&critical).solve()));
    for (name, problem) in [("root-finder, critical", critical), ("root-finder, friction", friction)] {
        problem.root_finder()?;
        group.bench_function(name, |b| b.iter(|| black_box(&problem).root_finder()));
    }
    group.finish();
    Ok(())
}

fn case_file(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let (name, text) = CASE_FILE;
    Case::parse(name, text)?;
    criterion.bench_function("parse", |b| b.iter(|| Case::parse(black_box(name), black_box(text))));
    Ok(())
}
