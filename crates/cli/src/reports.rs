//! `deltav impact`, `motion`, `crush`, `check`, `compare`, `sensitivity` and `explain`.

use analysis::Sweep;
use anyhow::Result;
use case::Case;
use report::{Answer, Table};

use crate::arguments::{
    Arguments, CasesArguments, ExplainArguments, Format, ReportArguments, SensitivityArguments,
};
use crate::cases::{Analyse, of_cases};
use crate::files::case_file;
use crate::handover::handover;
use crate::live;
use crate::present::{answered, present, present_as, units};

pub(crate) fn or_rows(
    ReportArguments { cases, live, page }: ReportArguments,
    analyse: Analyse,
) -> Result<()> {
    if live {
        return live::report(cases, page.as_deref(), analyse, &|_, _, _| Ok(None));
    }
    let answer = |case: &Case| analyse(case).map(|analysis| Answer::Analysis(Box::new(analysis)));
    match of_cases(cases, Table::Analyses, &answer)? {
        Some(arguments) => report_analysis(&arguments, analyse),
        None => Ok(()),
    }
}

fn report_analysis(arguments: &Arguments, analyse: Analyse) -> Result<()> {
    let file = case_file(&arguments.case)?;
    let units = units(arguments.units, &file);
    let analysis = answered(analyse(&file.case), &file, units)?;
    let document = || match arguments.format {
        // In a terminal the results; the report to hand over has all steps and the case file besides.
        Format::Text | Format::Json => Ok(report::results(&file.case, &analysis, units)),
        Format::Html | Format::Markdown => handover(&arguments.case, &file, &analysis, None, None, units),
    };
    present(arguments, document, || report::json(&file, &analysis))
}

pub(crate) fn judgement(arguments: &Arguments) -> Result<()> {
    let file = case_file(&arguments.case)?;
    let judgement = analysis::judge(&file.case);
    let document = || Ok(report::judgement(&file, &judgement, units(arguments.units, &file)));
    present(arguments, document, || report::judgement_json(&file, &judgement))
}

pub(crate) fn explain(ExplainArguments { topic, format, output }: &ExplainArguments) -> Result<()> {
    let topic = match topic.as_slice() {
        [] => None,
        words => Some(report::topic(&words.join(" "))?),
    };
    let document = || Ok(topic.map_or_else(report::list_of_topics, report::explanation));
    present_as(*format, output.file(), document, || {
        topic.map_or_else(report::topics_json, report::topic_json)
    })
}

pub(crate) fn comparison(arguments: CasesArguments) -> Result<()> {
    let answer = |case: &Case| analysis::compare(case).map(|answer| Answer::Comparison(Box::new(answer)));
    let Some(arguments) = of_cases(arguments, Table::Comparisons, &answer)? else { return Ok(()) };
    let file = case_file(&arguments.case)?;
    let units = units(arguments.units, &file);
    let comparison = answered(analysis::compare(&file.case), &file, units)?;
    let document = || Ok(report::comparison(&file.case, &comparison, units));
    present(&arguments, document, || report::comparison_json(&file, &comparison))
}

pub(crate) fn sensitivity(
    SensitivityArguments { arguments, pdof_step, pdof_steps }: &SensitivityArguments,
) -> Result<()> {
    let file = case_file(&arguments.case)?;
    let sweep = Sweep { step: pdof_step.to_radians(), steps: *pdof_steps };
    let units = units(arguments.units, &file);
    let sensitivity = answered(analysis::sensitivity(&file.case, sweep), &file, units)?;
    let document = || Ok(report::sensitivity(&file.case, &sensitivity, units));
    present(arguments, document, || report::sensitivity_json(&file, &sensitivity))
}
