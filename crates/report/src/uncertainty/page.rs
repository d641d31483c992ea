//! As text for people.

use std::f64::consts::PI;

use ::uncertainty::{Bar, End, Estimate, Index, SamplingMethod, Shape, Summary};
use analysis::{Output, REASONS, Reason, UncertainInput, UncertainOutput, Uncertainty};
use case::Case;
use crash3::principal_angle;

use super::{Histogram, method_name, quantity};
use crate::sensitivity::output_name;
use crate::units::{Quantity, Units, number, significant};
use crate::wrap::{LINE, first_cell, wrapped};

/// Classes of the histogram.
const CLASSES: u32 = 15;
/// (columns) of the longest bar of the histogram.
const LONGEST: usize = 50;
/// (columns) to each side of a tornado's middle.
const SIDE: usize = 13;
/// Bars of the tornado: beyond them none is worth a line.
const BARS: usize = 15;
/// (columns) of an end of an interval, without the blank before it.
const END: usize = 8;
/// Decimals beyond which no figure goes.
const MOST_DECIMALS: usize = 6;
/// (–) a cut that takes less away is not worth a line.
const NOTICED_CUT: f64 = 1e-6;

/// The uncertainty as tables and bars of at most 98 columns.
#[must_use]
pub fn uncertainty_text(case: &Case, uncertainty: &Uncertainty, units: Units) -> String {
    let mut page = Page { uncertainty, units, text: String::new() };
    page.head(case);
    page.failures();
    page.results();
    page.intervals();
    page.histogram();
    page.tornado();
    page.indices();
    page.inputs();
    page.text
}

struct Page<'a> {
    uncertainty: &'a Uncertainty,
    units: Units,
    text: String,
}

impl<'a> Page<'a> {
    fn line(&mut self, line: &str) {
        self.text.push_str(line.trim_end());
        self.text.push('\n');
    }

    fn paragraph(&mut self, words: &str) {
        self.text.push_str(&wrapped(words));
    }

    fn rule(&mut self) {
        self.line(&"─".repeat(LINE));
    }

    fn head(&mut self, case: &Case) {
        let uncertainty = self.uncertainty;
        self.line(case.title.as_deref().unwrap_or("Untitled case"));
        let propagation = &uncertainty.propagation;
        let method = match uncertainty.settings.method {
            SamplingMethod::MonteCarlo => "Monte Carlo",
            SamplingMethod::LatinHypercube => "Latin hypercube",
            SamplingMethod::Sobol => "scrambled Sobol' points",
            other => method_name(other),
        };
        let inputs = counted(uncertainty.inputs.len(), "uncertain input");
        self.line("");
        self.paragraph(&format!(
            "{} of {inputs}, {method}, seed {}; {} have an answer.",
            counted(propagation.evaluated(), "sample"),
            uncertainty.settings.seed,
            grouped(propagation.succeeded()),
        ));
        if propagation.evaluated() < propagation.requested() {
            self.paragraph(&format!(
                "Ended early: {} samples were asked for. The results are of those that were done.",
                grouped(propagation.requested())
            ));
        }
    }

    fn failures(&mut self) {
        let evaluated = self.uncertainty.propagation.evaluated();
        for reason in REASONS {
            let failed = self.uncertainty.failed(reason);
            if failed > 0 {
                #[expect(clippy::cast_precision_loss, reason = "a share for people")]
                let share = 100.0 * failed as f64 / evaluated as f64;
                let share = significant(share, 2);
                self.line(&format!("  {:>11} ({share} %) without: {}", grouped(failed), in_words(reason)));
            }
        }
    }

    /// Each output with its summary.
    fn rows(&self) -> Vec<(&'a UncertainOutput, Option<&'a Summary>)> {
        let summaries = self.uncertainty.propagation.summaries();
        self.uncertainty.outputs.iter().zip(summaries.iter().map(Option::as_ref)).collect()
    }

    fn label(&self, output: &UncertainOutput, quantity: Quantity) -> String {
        format!("{}, {}", output_name(output.output), self.units.name(quantity))
    }

    /// Where there is one line or column for the output.
    fn alone(&self, output: &UncertainOutput) -> Quantity {
        match quantity(output.output) {
            Quantity::Speed => self.units.speed_alone(),
            other => other,
        }
    }

    /// What a speed is repeated in.
    fn beside(&self, output: &UncertainOutput) -> Option<Quantity> {
        self.units.beside_speed().filter(|_| quantity(output.output) == Quantity::Speed)
    }

    /// ± the standard error, in the unit of the value, in at most so many columns.
    fn error(&self, output: &UncertainOutput, estimate: Estimate, columns: usize) -> String {
        estimate.standard_error.map_or_else(String::new, |error| {
            let error = self.units.value(quantity(output.output), error);
            // Two digits, and all that stand before the point; fewer where there is no room.
            let shown = if error < 10.0 { significant(error, 2) } else { number(error, 0) };
            let fits = |shown: &str| shown.chars().count() < columns;
            let shorter = || Some(significant(error, 1)).filter(|shown| error < 10.0 && fits(shown));
            let shown =
                if fits(&shown) { shown } else { shorter().unwrap_or_else(|| format!("{error:.0e}")) };
            format!("±{shown}")
        })
    }

    /// An SI value with decimals enough for two digits of a standard deviation (SI) that is not zero.
    fn resolved(&self, quantity: Quantity, sd: f64) -> impl Fn(f64) -> String + use<> {
        let units = self.units;
        let decimals =
            units.decimals(quantity).max(decimals_of(units.value(quantity, sd))).min(MOST_DECIMALS);
        move |si| number(units.value(quantity, si), decimals)
    }

    fn results(&mut self) {
        self.line("");
        let head = ["central", "mean", "median", "std. dev.", "first order", "differs"];
        let [central, mean, median, sd, first, differs] = head;
        self.line(&format!(
            "{:<30}{central:>11}{mean:>11}{median:>11}{sd:>12}{first:>13}{differs:>10}",
            "Results"
        ));
        self.rule();
        let mut apart = Vec::new();
        let mut lines = Vec::new();
        for (output, summary) in self.rows() {
            let sd = summary.map_or(output.first_order.sd, |summary| summary.sd.value);
            let sd = if output.varies(sd) { sd } else { 0.0 };
            let plain = self.resolved(quantity(output.output), sd);
            let central = plain(output.central);
            let first = plain(output.first_order.sd);
            let label = self.label(output, quantity(output.output));
            let Some(summary) = summary else {
                lines.push(format!("{label:<30}{central:>11}{:>11}{:>11}{:>12}{first:>13}", "–", "–", "–"));
                continue;
            };
            if !output.varies(summary.sd.value) {
                lines.push(format!("{label:<30}{central:>11}{:>58}", "does not vary"));
                continue;
            }
            let [mean, median, sd] = [summary.mean, summary.median, summary.sd];
            let of = |estimate: Estimate| plain(estimate.value);
            let by = 100.0 * (output.first_order.sd / sd.value - 1.0);
            let differs = if output.differs(sd.value) {
                apart.push(output_name(output.output));
                format!("{}{} %!", if by < 0.0 { "" } else { "+" }, number(by, 0))
            } else {
                "no".to_owned()
            };
            lines.push(format!(
                "{label:<30}{central:>11}{:>11}{:>11}{:>12}{first:>13}{differs:>10}",
                of(mean),
                of(median),
                of(sd)
            ));
            let error = |estimate: Estimate| self.error(output, estimate, 10);
            lines.push(format!("{:<41}{:>11}{:>11}{:>12}", "", error(mean), error(median), error(sd)));
            if let Some(road) = self.beside(output) {
                let of = self.resolved(road, sd.value);
                lines.push(format!(
                    "{:<30}{:>11}{:>11}{:>11}{:>12}{:>13}",
                    format!("  in {}", self.units.name(road)),
                    of(output.central),
                    of(mean.value),
                    of(median.value),
                    of(sd.value),
                    of(output.first_order.sd)
                ));
            }
        }
        lines.iter().for_each(|line| self.line(line));
        self.line("");
        self.paragraph(
            "± is the standard error that the number of samples leaves. The first-order standard deviation is that of the GUM (JCGM 100, equation 10), from the \
             exact derivatives at the central values.",
        );
        if !apart.is_empty() {
            self.paragraph(&format!(
                "Warning: the first-order standard deviation differs by more than 10 % from that of the samples for: {}. There the result is no straight \
                 line over the ranges of the inputs; trust the samples.",
                apart.join(", ")
            ));
        }
    }

    fn intervals(&mut self) {
        self.line("");
        self.line(&format!("{:<25}{:>18}{:>18}{:>18}{:>18}", "Intervals", "50 %", "90 %", "95 %", "99 %"));
        self.rule();
        let mut lines = Vec::new();
        for (output, summary) in self.rows() {
            let label = self.label(output, quantity(output.output));
            let Some(summary) = summary.filter(|summary| output.varies(summary.sd.value)) else { continue };
            // A blank before each: figures that run together are misread.
            let cell = |text: String| {
                let text = if text.chars().count() > END { text.replace(',', "") } else { text };
                format!(" {text:>END$}")
            };
            let ends = |low: String, high: String| cell(low) + &cell(high);
            let plain = self.resolved(quantity(output.output), summary.sd.value);
            let values =
                summary.intervals.map(|interval| ends(plain(interval.low.value), plain(interval.high.value)));
            let error = |estimate: Estimate| self.error(output, estimate, END);
            let errors = summary.intervals.map(|interval| ends(error(interval.low), error(interval.high)));
            lines.push(format!("{label:<25}{}", values.concat()));
            lines.push(format!("{:<25}{}", "", errors.concat()));
            if let Some(road) = self.beside(output) {
                let of = self.resolved(road, summary.sd.value);
                let values =
                    summary.intervals.map(|interval| ends(of(interval.low.value), of(interval.high.value)));
                let label = format!("  in {}", self.units.name(road));
                lines.push(format!("{label:<25}{}", values.concat()));
            }
        }
        lines.iter().for_each(|line| self.line(line));
        self.turned();
    }

    /// Of each PDOF whose intervals go through straight from behind.
    fn turned(&mut self) {
        for (output, summary) in self.rows() {
            let Some(summary) = summary.filter(|_| matches!(output.output, Output::Pdof { .. })) else {
                continue;
            };
            let mut ends = summary.intervals.iter().flat_map(|ends| [ends.low.value, ends.high.value]);
            let Some(end) = ends.find(|end| end.abs() > PI) else { continue };
            let [end, same] = [end, principal_angle(end)].map(|si| self.units.format(Quantity::Angle, si));
            self.line("");
            self.paragraph(&format!(
                "The {} goes through 180°, straight from behind. Its intervals are not broken there: an end at {end} is the direction {same}.",
                output_name(output.output)
            ));
        }
    }

    /// Of the first output.
    fn histogram(&mut self) {
        let Some(&(output, Some(summary))) = self.rows().first() else { return };
        let Some(column) = self.uncertainty.propagation.columns().first() else { return };
        if !output.varies(summary.sd.value) {
            return;
        }
        let Some(histogram) = Histogram::new(column, summary, CLASSES) else { return };
        let most = histogram.counts.iter().copied().max().unwrap_or_default();
        let alone = self.alone(output);
        let title = self.label(output, alone);
        let mut lines = Vec::new();
        for (class, &count) in (0_u32..).zip(&histogram.counts) {
            let low = histogram.low + f64::from(class) * histogram.width;
            let from = self.units.plain(alone, low);
            let to = self.units.plain(alone, low + histogram.width);
            let share = share(count, summary.samples);
            lines.push(format!("{from:>11} – {to:<11}{share:>8} %  {}", bar(count, most)));
        }
        self.line("");
        self.line(&title);
        self.rule();
        lines.iter().for_each(|line| self.line(line));
        let [below, above] = histogram.outside.map(|count| share(count, summary.samples));
        self.line(&format!("{:<25}{below:>8} % below, {above} % above", ""));
    }

    /// Of the first output.
    fn tornado(&mut self) {
        let Some(&(output, _)) = self.rows().first() else { return };
        let title = format!("What moves it: {}", output_name(output.output));
        let alone = self.alone(output);
        let unit = self.units.name(alone);
        let bars = self.uncertainty.tornado.ranked(0);
        let longest = bars
            .iter()
            .flat_map(|bar| [&bar.low, &bar.high])
            .filter_map(value)
            .fold(0.0_f64, |longest, value| longest.max((value - output.central).abs()));
        let mut lines = Vec::new();
        for bar in bars.iter().take(BARS) {
            let [low, high] = [&bar.low, &bar.high].map(|end| match &end.outputs {
                Ok(outputs) => self.units.plain(alone, outputs.first().copied().unwrap_or(f64::NAN)),
                Err(_) => "none".to_owned(),
            });
            let path = first_cell(&self.uncertainty.inputs[bar.input].input.path, 36);
            let share = number(100.0 * output.first_order.shares[bar.input], 1);
            lines.push(format!(
                "{path}{low:>10}{high:>10}  {}{share:>9} %",
                both_sides(bar, output.central, longest)
            ));
        }
        let rest = bars.len().saturating_sub(BARS);
        let next = bars.get(BARS).and_then(|bar| bar.swing(0));
        self.line("");
        self.line(&format!("{title:<36}{:>10}{:>10}{:>40}", format!("low, {unit}"), "high", "first order"));
        self.rule();
        lines.iter().for_each(|line| self.line(line));
        if let Some(next) = next {
            let next = self.units.format(alone, next.abs());
            self.line(&format!("{rest} more, each moving it by at most {next}"));
        }
        self.line("");
        self.paragraph(
            "One input at a time at its 2.5 % and its 97.5 % quantile, the others at their central values: ░ where it is low, █ where it is high. \"First order\" is \
             the share of the variance by the derivatives.",
        );
    }

    /// Of the first output.
    fn indices(&mut self) {
        let Some(indices) = &self.uncertainty.indices else { return };
        let Some(&(output, _)) = self.rows().first() else { return };
        let title = format!("Sobol' indices: {}", output_name(output.output));
        self.line("");
        self.line(&format!("{title:<36}{:>10}{:>20}{:>10}{:>20}", "first", "95 %", "total", "95 %"));
        self.rule();
        let Some(Some(all)) = indices.indices().first() else {
            self.paragraph("Too few rows have an answer, or the result does not vary.");
            return;
        };
        let mut ranked: Vec<_> = self.uncertainty.inputs.iter().zip(all).collect();
        ranked.sort_by(|(_, one), (_, other)| other.total.value.total_cmp(&one.total.value));
        let cells = |index: Index| {
            let interval = index
                .interval95()
                .map_or_else(String::new, |[low, high]| format!("{} to {}", number(low, 3), number(high, 3)));
            format!("{:>10}{interval:>20}", number(index.value, 3))
        };
        for (input, index) in ranked {
            let line = format!(
                "{}{}{}",
                first_cell(&input.input.path, 36),
                cells(index.first_order),
                cells(index.total)
            );
            self.line(&line);
        }
        self.line("");
        self.paragraph(&format!(
            "First: the share of the variance that would vanish if this input alone were known. Total: the share that would remain if all others were. Saltelli's \
             sampling with Jansen's estimators: {} in {}, of which {} have an answer throughout and count.",
            counted(indices.evaluations(), "evaluation"),
            counted(indices.rows(), "row"),
            grouped(indices.used())
        ));
    }

    fn inputs(&mut self) {
        self.line("");
        self.line(&format!("{:<36}{:>24}  {}", "Ranges", "central value", "distribution"));
        self.rule();
        for input in &self.uncertainty.inputs {
            let central = with_unit(input, &input.input.number.to_string());
            self.line(&format!(
                "{}{central:>24}  {}",
                first_cell(&input.input.path, 36),
                distribution(input)
            ));
        }
        let cut: Vec<&UncertainInput> = self
            .uncertainty
            .inputs
            .iter()
            .filter(|input| input.truncation().is_some_and(|cut| 1.0 - cut.kept > NOTICED_CUT))
            .collect();
        if !cut.is_empty() {
            self.line("");
            self.paragraph("Cut, since physics allows no more:");
        }
        for input in cut {
            let kept = input.truncation().map_or(1.0, |cut| cut.kept);
            let away = significant(100.0 * (1.0 - kept), 2);
            let mean = with_unit(input, &significant(input.distribution.mean(), 4));
            self.paragraph(&format!(
                "{}: {}; {away} % of the normal distribution is cut away, which moves its mean to {mean}",
                input.input.path, input.bounds
            ));
        }
    }
}

fn in_words(reason: Reason) -> &'static str {
    match reason {
        Reason::NotApproaching => "the contact points do not approach each other",
        Reason::NoRoot => "no speed makes crush and impact agree",
        Reason::EnergyCreated => "the coefficients would create energy",
        Reason::Jam => "the contact jams",
        Reason::Pulling => "the vehicles would have to pull at each other",
        Reason::NoDamageSpeed => "the speed without damage is not below that of the barrier test",
        Reason::LimitBelowStart => "the limit of the force per width is below A, at which crush begins",
        Reason::Other => "the numbers are impossible for another reason",
    }
}

fn distribution(input: &UncertainInput) -> String {
    let four = |value: f64| significant(value, 4);
    match input.distribution.shape() {
        Shape::Normal { sd, .. } => format!("normal, std. dev. {}", with_unit(input, &four(sd))),
        Shape::Uniform { low, high } => {
            format!("uniform, {} to {}", low, with_unit(input, &high.to_string()))
        }
        Shape::Triangular { low, high, .. } => {
            format!("triangular, {} to {}", low, with_unit(input, &high.to_string()))
        }
        _ => String::new(),
    }
}

fn with_unit(input: &UncertainInput, number: &str) -> String {
    input.input.unit.map_or_else(|| number.to_owned(), |unit| format!("{number} {unit}"))
}

fn value(end: &End) -> Option<f64> {
    end.outputs.as_ref().ok().and_then(|outputs| outputs.first().copied())
}

/// The decimals that two significant digits of a number need.
fn decimals_of(value: f64) -> usize {
    let scientific = format!("{:.1e}", value.abs());
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    let decimals = exponent.filter(|_| value != 0.0).map_or(0, |exponent| 1 - exponent);
    usize::try_from(decimals).unwrap_or_default()
}

/// (%)
fn share(count: usize, of: usize) -> String {
    #[expect(clippy::cast_precision_loss, reason = "a share for people")]
    let share = 100.0 * count as f64 / of as f64;
    number(share, 1)
}

fn grouped(count: usize) -> String {
    #[expect(clippy::cast_precision_loss, reason = "counts are below 2^53")]
    let count = count as f64;
    number(count, 0)
}

fn counted(count: usize, noun: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{} {noun}{s}", grouped(count))
}

/// A bar of up to [`LONGEST`] columns, in eighths of one.
fn bar(count: usize, most: usize) -> String {
    const EIGHTHS: [&str; 8] = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"];
    let eighths = (count * LONGEST * 8).checked_div(most).unwrap_or_default();
    format!("{}{}", "█".repeat(eighths / 8), EIGHTHS[eighths % 8])
}

/// Both ends of a bar beside the central value, on [`SIDE`] columns to each side.
fn both_sides(bar: &Bar, central: f64, longest: f64) -> String {
    let mut left = [' '; SIDE];
    let mut right = [' '; SIDE];
    for (end, fill) in [(&bar.low, '░'), (&bar.high, '█')] {
        let Some(value) = value(end) else { continue };
        let share = if longest > 0.0 { (value - central) / longest } else { 0.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to SIDE")]
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let columns = (share.abs() * SIDE as f64).round() as usize;
        let side = if share < 0.0 { &mut left } else { &mut right };
        // Where both ends move it to one side, the shorter stands before the longer.
        for place in side.iter_mut().take(columns) {
            *place = if *place == ' ' { fill } else { *place };
        }
    }
    let left: String = left.iter().rev().collect();
    let right: String = right.iter().collect();
    format!("{left}│{right}")
}
