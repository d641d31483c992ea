//! `deltav validate`.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result};
use case::SeverityPrior;
use report::Drawing;
use validation::{Data, Validation};

use crate::arguments::ValidateArguments;
use crate::ciss::{Downloaded, LARGEST_TABLE, downloaded};
use crate::files::{named, read_at_most};
use crate::pictures::write_plot;
use crate::present::{NoAnswer, present};
use crate::progress::Progress;
use crate::threads::pool;

/// The files that `deltav validate --plots` writes, without their endings.
pub(crate) const VALIDATION_PLOTS: [&str; 2] = ["computed-against-measured", "reconstructed-speed"];

/// Those of `deltav validate --field --plots`.
pub(crate) const FIELD_PLOTS: [&str; 2] = ["estimated-against-recorded", "ranks-of-recorders"];

pub(crate) fn validate(arguments: &ValidateArguments) -> Result<()> {
    if !arguments.field.is_empty() {
        return validate_field(arguments);
    }
    if let Some(path) = &arguments.recorders {
        return validate_recorders(path, arguments);
    }
    show(&validation::validate(&Data::built_in())?, arguments)
}

/// Particles of an island; a pair has sixteen islands, and the intervals of 350 vehicles need no more.
const PARTICLES_OF_PAIR: usize = 128;

/// The text of a table of crashes.
fn table(path: &Path, name: &str) -> Result<String> {
    if path.is_dir() {
        anyhow::bail!("{name} is a folder: name the table in it");
    }
    let bytes = fs::File::open(path)
        .and_then(|file| read_at_most(LARGEST_TABLE, file))
        .with_context(|| format!("cannot read {name}"))?;
    if bytes.len() > LARGEST_TABLE {
        anyhow::bail!("{name} is larger than {} MB: split it", LARGEST_TABLE >> 20);
    }
    String::from_utf8(bytes)
        .with_context(|| format!("{name} is not UTF-8 text: save the table as CSV, encoded in UTF-8"))
}

/// Particles of an island for a speed: few crashes have two recorders, so they can be more.
const PARTICLES_OF_SPEED: usize = 256;

fn validate_recorders(path: &Path, arguments: &ValidateArguments) -> Result<()> {
    let name = named(path).to_string();
    let rows = field::read_recorders(&table(path, &name)?).with_context(|| name.clone())?;
    let options = field::Options {
        particles: PARTICLES_OF_SPEED,
        seed: arguments.seed,
        other: true,
        crush: field::KnownCrush::Both,
        // The columns are CIREN's, which takes crashes in which somebody was seriously hurt.
        injury: analysis::injury(arguments.prior.unwrap_or(SeverityPrior::SeriousInjury)),
    };
    let mut progress = Progress::new()?;
    let judged = pool(arguments.threads)?.install(|| {
        field::judge_recorders(&rows, &evidence::FITTED, &options, &mut |done, total| {
            progress.at("pairs", done, total)
        })
    });
    let judged = judged.with_context(|| name.clone())?;
    let document = || Ok(report::judged_recorders(&judged, &name));
    present(arguments.format, arguments.output.file(), document, || report::judged_recorders_json(&judged))?;
    let (done, total) = (judged.finished, judged.rows);
    all_of(done, total)
}

fn validate_field(arguments: &ValidateArguments) -> Result<()> {
    let name = arguments.field.iter().map(|path| named(path).to_string()).collect::<Vec<_>>().join(", ");
    let downloaded = downloaded(&arguments.field, arguments.objects)?;
    let (text, years) = match (downloaded, &*arguments.field) {
        (Some(Downloaded { table, years }), _) => (table, years),
        (None, [path, ..]) if !arguments.objects => (table(path, &name)?, Vec::new()),
        (None, _) => anyhow::bail!(
            "{name} is a table: --objects is for NHTSA's download; a table with the column OBJCONT needs no option"
        ),
    };
    let data = report::FieldData { name: &name, table: &text, years: &years };
    judge_field(&data, arguments)
}

fn judge_field(data: &report::FieldData<'_>, arguments: &ValidateArguments) -> Result<()> {
    let name = || data.name.to_owned();
    let options = field::Options {
        particles: PARTICLES_OF_PAIR,
        seed: arguments.seed,
        other: arguments.other,
        crush: field::KnownCrush::Both,
        injury: arguments.prior.and_then(analysis::injury),
    };
    let judged = if let Some(crashes) = field::read_objects(data.table).with_context(name)? {
        let refused = [("--other", arguments.other), ("--judge", arguments.judge.is_some())];
        if let Some((option, _)) = refused.into_iter().find(|(_, is_asked)| *is_asked) {
            return Err(field::FieldError::NotOfObjects { option }).with_context(name);
        }
        judged(&crashes, &options, arguments)?
    } else {
        let pairs = field::read(data.table).with_context(name)?;
        if let Some(columns) = &arguments.judge {
            let claims = field::judge_claims(data.table, &pairs, columns).with_context(name)?;
            let document = || Ok(report::claims(&claims, data));
            let json = || report::claims_json(&claims, data);
            return present(arguments.format, arguments.output.file(), document, json);
        }
        judged(&pairs, &options, arguments)?
    };
    let judged = judged.with_context(name)?;
    let document = || Ok(report::field(&judged, data));
    let json = || report::field_json(&judged, data);
    present(arguments.format, arguments.output.file(), document, json)?;
    let plots = [report::estimated_against_recorded(&judged), report::ranks_of_recorders(&judged)];
    write_plots(FIELD_PLOTS, plots, arguments)?;
    let (done, total) = (judged.finished, judged.pairs);
    all_of(done, total)
}

/// The judgement of crashes, with a display of its progress.
fn judged<C: field::Crash>(
    crashes: &[C],
    options: &field::Options,
    arguments: &ValidateArguments,
) -> Result<Result<field::Field, field::FieldError>> {
    let mut progress = Progress::new()?;
    Ok(pool(arguments.threads)?.install(|| {
        field::judge(crashes, &evidence::FITTED, options, &mut |done, total| {
            progress.at(if C::IS_WITH_OBJECT { "vehicles" } else { "pairs" }, done, total)
        })
    }))
}

fn write_plots<const N: usize>(
    names: [&str; N],
    plots: [Drawing; N],
    arguments: &ValidateArguments,
) -> Result<()> {
    let Some(folder) = &arguments.plots else { return Ok(()) };
    for (name, plot) in names.into_iter().zip(plots) {
        write_plot(folder, name, &plot, arguments.plots_format)?;
    }
    Ok(())
}

/// Writes everything before it fails, so that all failures can be seen.
fn show(validation: &Validation, arguments: &ValidateArguments) -> Result<()> {
    let document = || Ok(report::validation(validation));
    present(arguments.format, arguments.output.file(), document, || report::validation_json(validation))?;
    let plots = [report::computed_against_measured(validation), report::reconstructed_speed(validation)];
    write_plots(VALIDATION_PLOTS, plots, arguments)?;
    let failures = validation.failures();
    match failures.first() {
        None => Ok(()),
        Some((first, _)) => Err(NoAnswer(format!(
            "{} of {} numbers that are claimed to reproduce do not; the first: {first}",
            failures.len(),
            validation.claimed()
        ))
        .into()),
    }
}

/// Refuses figures of only a part of the pairs, if Ctrl-C ended the run early.
fn all_of(done: usize, total: usize) -> Result<()> {
    if done < total {
        let ended = format!("ended early: the figures are those of the first {done} of {total} pairs");
        return Err(NoAnswer(ended).into());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::show;
    use crate::arguments::{Format, ValidateArguments};
    use crate::{NO_ANSWER, message, status};
    use report::PictureFormat;

    #[test]
    fn a_claim_that_fails_ends_with_status_1_after_the_page_is_written() {
        let page = std::env::temp_dir().join(format!("deltav-failing-{}.txt", std::process::id()));
        let output = page.clone().into();
        let arguments = ValidateArguments {
            format: Format::Text,
            output,
            field: Vec::new(),
            objects: false,
            recorders: None,
            other: false,
            prior: None,
            judge: None,
            seed: 1,
            threads: None,
            plots: None,
            plots_format: PictureFormat::Svg,
        };
        let mut validation = validation::validate(&validation::Data::built_in()).unwrap();
        assert!(show(&validation, &arguments).is_ok());
        validation.energies[3].normal.ours *= 1.02;
        let error = show(&validation, &arguments).unwrap_err();
        assert_eq!(
            error.to_string(),
            "1 of 240 numbers that are claimed to reproduce do not; the first: SAE 871993, Table 1, test 5, normal loss"
        );
        assert_eq!((message(&error), status(&error)), (format!("error: {error}"), NO_ANSWER));
        assert!(fs::read_to_string(&page).unwrap().contains("Failing: SAE 871993, Table 1, test 5, normal"));
        fs::remove_file(&page).unwrap();
    }
}
