//! `deltav estimate`.

use std::io::{self, BufWriter};

use analysis::{EstimateOutput, EstimatePlan, EstimateStage, Estimated, Failure, Kind, estimate_outputs};
use anyhow::{Context as _, Result};
use case::{Case, Dimension, Prior, read_quantity};
use rayon::ThreadPool;
use report::{Asked, Question};
use validation::FOOT_POUND;

use crate::arguments::{EstimateArguments, EstimatePrior};
use crate::sink::Sink;
use crate::{NoAnswer, answered, case_file, named, pool, present, progress, units};

pub(crate) fn report(arguments: &EstimateArguments) -> Result<()> {
    let of_case = &arguments.arguments;
    let file = case_file(&of_case.case)?;
    let units = units(of_case.units, &file);
    let outputs = answered(estimate_outputs(&file.case), &file, units)?;
    let questions = arguments.above.iter().map(|text| question(text, &outputs));
    let questions = questions.collect::<Result<Vec<Question>, String>>().map_err(anyhow::Error::msg)?;
    let plan = EstimatePlan {
        particles: arguments.particles,
        seed: arguments.seed,
        prior: arguments.prior.map(|prior| match prior {
            EstimatePrior::Field => Prior::Field,
            EstimatePrior::Flat => Prior::Flat,
        }),
        pieces: !arguments.no_pieces,
    };
    let estimated = answered(run(&file.case, &plan, &pool(arguments.threads)?)?, &file, units)?;
    let is_answer = estimated.doubts().is_empty();
    // Draws that have not converged are no answer either.
    if let Some(path) = arguments.samples_out.as_deref().filter(|_| is_answer) {
        let cannot = || format!("cannot write the draws to {}", named(path));
        let mut out = BufWriter::new(Sink::open(Some(path)).with_context(cannot)?);
        report::write_draws(&estimated, arguments.csv_style.into(), &mut out)
            .and_then(|()| out.into_inner().map_err(io::IntoInnerError::into_error)?.finish())
            .with_context(cannot)?;
    }
    let asked = Asked { plan, questions };
    let document = report::estimate(&file.case, &estimated, &asked, units);
    present(&document, of_case, || report::estimate_json(&file, &estimated, &asked))?;
    if is_answer {
        return Ok(());
    }
    let draws = if arguments.samples_out.is_some() { ", and the draws are not written" } else { "" };
    let message = format!("the run has not converged: the report says why, and has no intervals{draws}");
    Err(NoAnswer(message).into())
}

fn run(case: &Case, plan: &EstimatePlan, pool: &ThreadPool) -> Result<Result<Estimated, Failure>> {
    let mut progress = progress::Progress::new()?;
    Ok(pool.install(|| {
        analysis::estimate(case, plan, &mut |stage, done, total| {
            let counted = match stage {
                EstimateStage::All => "particles",
                EstimateStage::Prior => "particles before the evidence",
                EstimateStage::Piece => "pieces of evidence",
            };
            progress.at(counted, done, total)
        })
    }))
}

/// `vehicle1.speed 50 km/h`: a result of the case, and a limit.
fn question(text: &str, outputs: &[EstimateOutput]) -> Result<Question, String> {
    let text = text.trim();
    let (key, limit) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    let shown = case::shown(text);
    let Some(&output) = outputs.iter().find(|output| output.path() == key) else {
        let keys: Vec<String> = outputs.iter().map(|output| output.path()).collect();
        return Err(format!(
            "--above \"{shown}\": the case has no result of this name; its results are {}",
            keys.join(", ")
        ));
    };
    let limit =
        limit_of(limit.trim(), output.kind()).map_err(|problem| format!("--above \"{shown}\": {problem}"))?;
    Ok(Question { output, limit })
}

/// (SI) a number with a unit of its kind.
fn limit_of(text: &str, kind: Kind) -> Result<f64, String> {
    let dimension = match kind {
        Kind::Ratio => {
            let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
            return number.ok_or_else(|| "give a number without a unit, such as 0.3".to_owned());
        }
        Kind::Energy => {
            return energy(text)
                .ok_or_else(|| "give an energy in J, kJ or ft-lb, such as \"50 kJ\"".to_owned());
        }
        Kind::Speed => Dimension::Speed,
        Kind::Length => Dimension::Length,
        Kind::Angle => Dimension::Angle,
        Kind::YawRate => Dimension::YawRate,
        Kind::Time => Dimension::Time,
        // No result of an estimate is one.
        Kind::Impulse | Kind::MomentImpulse | Kind::Force => {
            return Err("no limit can be given of this result".to_owned());
        }
    };
    let quantity = read_quantity(text, dimension);
    quantity.map(|quantity| quantity.si()).map_err(|error| format!("{error}; {}", error.help()))
}

/// (J)
fn energy(text: &str) -> Option<f64> {
    const UNITS: [(&str, f64); 4] =
        [("kJ", 1000.0), ("J", 1.0), ("ft-lb", FOOT_POUND), ("ft·lb", FOOT_POUND)];
    let (number, size) = UNITS.iter().find_map(|(unit, size)| Some((text.strip_suffix(unit)?, size)))?;
    number.trim().parse::<f64>().ok().filter(|number| number.is_finite()).map(|number| number * size)
}

#[cfg(test)]
mod tests {
    use analysis::{EstimateOutput, Output};

    use super::question;

    #[test]
    fn a_question_names_a_result_and_a_limit() {
        let closing = EstimateOutput::Result(Output::ClosingSpeed);
        let outputs = [closing, EstimateOutput::Restitution, EstimateOutput::CrushEnergy];
        let limit = |text: &str| question(text, &outputs).map(|question| question.limit);
        assert_eq!(question("impact.closing_speed 36 km/h", &outputs).unwrap().output, closing);
        assert_eq!(limit(" impact.closing_speed  36 km/h "), Ok(10.0));
        assert_eq!(limit("impact.closing_speed -36 km/h"), Ok(-10.0));
        assert_eq!(limit("impact.restitution 0.3"), Ok(0.3));
        assert_eq!(limit("crush_energy 50 kJ"), Ok(50_000.0));
        // 1 ft·lb is 1.355 817 95 J.
        assert!((limit("crush_energy 1000 ft-lb").unwrap() - 1355.818).abs() < 1e-3);
        for (text, says) in [
            ("speed 50 km/h", "its results are impact.closing_speed, impact.restitution, crush_energy"),
            ("", "its results are impact.closing_speed"),
            ("impact.closing_speed", "a speed"),
            ("impact.closing_speed 50", "km/h"),
            ("impact.closing_speed 50 kg", "a speed"),
            ("impact.restitution 3 m", "without a unit"),
            ("crush_energy 5 km/h", "50 kJ"),
            ("crush_energy inf J", "50 kJ"),
        ] {
            let error = limit(text).unwrap_err();
            assert!(error.contains(says), "{text}: {error}");
        }
    }
}
