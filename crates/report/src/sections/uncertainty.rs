//! The spread of the results due to ranges in the case.

use std::f64::consts::PI;

use ::uncertainty::{Bar, Classes, End, Estimate, FIRST_ORDER_LIMIT, Index, SamplingMethod, Shape, Summary};
use analysis::quantities::{DELTA_V, PDOF, SPEED};
use analysis::{
    Doubt, Doubtful, ExactValue, FAST_CLOSING, HIGH_RESTITUTION, REASONS, Reason, TakenAsExact,
    UncertainInput, UncertainOutput, Uncertainty,
};
use case::{
    Case, DAMAGE_LENGTH_SD, DEPTH_SD, EstimatedInput, FaceAxis, Input, OFFSET_SD, Origin, TypicalStiffness,
    YAW_RADIUS_CONFIDENCE,
};
use crash3::principal_angle;

use crate::document::{Block, Column, Document, NONE, Table, Undrawn, Width};
use crate::outputs::{
    estimate_name, estimate_source, input_name, label, output_name, output_quantity, pictured, reason_words,
};
use crate::pictures;
use crate::understood::amount;
use crate::units::{Measure, Units, grouped, number, percent, significant};
use crate::warnings;
use crate::words::not_the_answer;
use crate::worth::{BARRIER_TESTS, SMITH_NOGA, Worth, worth};

/// (columns) of the longest bar of the histogram.
const LONGEST: usize = 50;
/// (columns) to each side of a tornado's middle.
const SIDE: usize = 13;
/// Maximum number of bars of a tornado; further ones are not worth a line.
const BARS: usize = 15;
/// (columns) of an end of an interval, without the blank before it.
const END: usize = 8;
/// Maximum number of decimals of a figure.
pub(super) const MOST_DECIMALS: usize = 6;
/// How a default spread is switched off.
const SWITCH_OFF: &str = "List the key under `exact` in [uncertainty] to switch this off.";
/// (–) a cut that removes less is not worth a line.
const NOTICED_CUT: f64 = 1e-6;

/// The summary of each output as tables and bars, the inputs that drive it, and the warnings of the case as
/// it stands.
#[must_use]
pub fn uncertainty(case: &Case, uncertainty: &Uncertainty, units: Units) -> Document {
    let mut page = Page { case, uncertainty, units, document: Document::of_case(case) };
    page.head();
    page.results();
    page.intervals();
    page.histogram();
    page.more_histograms();
    for place in page.answers() {
        page.tornado(place);
    }
    for place in page.answers() {
        page.indices(place);
    }
    page.inputs();
    page.default_spreads();
    page.taken_as_exact();
    let Page { mut document, .. } = page;
    document.blocks.extend(warnings::of_analysis(&uncertainty.nominal, case, units));
    document
}

struct Page<'a> {
    case: &'a Case,
    uncertainty: &'a Uncertainty,
    units: Units,
    document: Document,
}

impl<'a> Page<'a> {
    fn head(&mut self) {
        let uncertainty = self.uncertainty;
        let propagation = &uncertainty.propagation;
        let method = match uncertainty.settings.method {
            SamplingMethod::MonteCarlo => "Monte Carlo",
            SamplingMethod::LatinHypercube => "Latin hypercube",
            SamplingMethod::Sobol => "scrambled Sobol' points",
            other => other.name(),
        };
        let inputs = counted(uncertainty.inputs.len(), "uncertain input");
        let mut lines = Vec::new();
        lines.extend(not_the_answer("intervals", &uncertainty.nominal));
        lines.push(format!(
            "{} of {inputs}, {method}, seed {}; {} have an answer.",
            counted(propagation.evaluated(), "sample"),
            uncertainty.settings.seed,
            grouped(propagation.succeeded()),
        ));
        if propagation.evaluated() < propagation.requested() {
            lines.push(format!(
                "Ended early: {} samples were requested. The results cover only the samples that were \
                 completed.",
                grouped(propagation.requested())
            ));
        }
        if analysis::is_searched_back(self.case) {
            lines.push(
                "Each sample needs a search back from the rest positions, so there are fewer than usual: \
                 `deltav uncertainty --samples N` draws N."
                    .to_owned(),
            );
        }
        let nominal = &uncertainty.nominal;
        if nominal.is_reconstruction() {
            let others = counted(uncertainty.taken_as_exact.len(), "input");
            lines.push(format!(
                "The intervals include only the ranges listed here: the other {others}, the impact law and the \
                 method itself are taken as exact. `deltav estimate` includes their errors, too."
            ));
        }
        lines.extend(self.failures());
        lines.extend(self.doubts());
        self.document.push(Block::List(lines));
    }

    /// How many samples have no answer, by reason.
    fn failures(&self) -> Vec<String> {
        let evaluated = self.uncertainty.propagation.evaluated();
        let of = |reason: Reason| {
            let failed = self.uncertainty.failed(reason);
            #[expect(clippy::cast_precision_loss, reason = "a share for people")]
            let share = percent(failed as f64 / evaluated as f64);
            (failed > 0)
                .then(|| format!("{} ({share} %) without: {}", grouped(failed), reason_words(reason)[1]))
        };
        REASONS.into_iter().filter_map(of).collect()
    }

    /// How many samples would raise a warning as a single case.
    fn doubts(&self) -> Vec<String> {
        let of = |doubtful: &Doubtful| {
            #[expect(clippy::cast_precision_loss, reason = "a share for people")]
            let share = percent(doubtful.samples as f64 / doubtful.of as f64);
            let among = if doubtful.doubt == Doubt::SeveralSpeeds {
                format!(" of the first {}", grouped(doubtful.of))
            } else {
                String::new()
            };
            let says = match doubtful.doubt {
                Doubt::FoundBackward { vehicle } => {
                    format!("find a negative speed of vehicle {vehicle}, which then moves backward")
                }
                Doubt::GivenBackward { vehicle } => {
                    format!("have a negative speed of vehicle {vehicle}, which then moves backward")
                }
                Doubt::FoundTooFast { vehicle, limit } => format!(
                    "find a speed of vehicle {vehicle} above {}, which is implausible",
                    self.units.format(Measure::RoadSpeed, limit)
                ),
                Doubt::SeveralSpeeds => {
                    "have several speeds that agree with the crush energy; as for the central values, the slowest \
                     approach counts, or the speed nearest to the one chosen there"
                        .to_owned()
                }
                Doubt::HighRestitution => format!(
                    "have a restitution above {HIGH_RESTITUTION} at more than {}, which is unusual",
                    self.units.format(Measure::RoadSpeed, FAST_CLOSING)
                ),
            };
            format!("{} ({share} %){among} {says}", grouped(doubtful.samples))
        };
        let doubts: Vec<String> = self.uncertainty.doubtful.iter().map(of).collect();
        if doubts.is_empty() {
            return doubts;
        }
        let lead = "Samples whose answer would cause a warning in a single case; the intervals include them:";
        std::iter::once(lead.to_owned()).chain(doubts).collect()
    }

    /// Each output with its summary.
    fn rows(&self) -> Vec<(&'a UncertainOutput, Option<&'a Summary>)> {
        let summaries = self.uncertainty.propagation.summaries();
        self.uncertainty.outputs.iter().zip(summaries.iter().map(Option::as_ref)).collect()
    }

    fn label(&self, output: &UncertainOutput, quantity: Measure) -> String {
        label(output.output, quantity, self.units)
    }

    /// The measure in which a speed is repeated.
    fn beside(output: &UncertainOutput) -> Option<Measure> {
        (output_quantity(output.output) == Measure::Speed).then_some(Measure::Speed)
    }

    /// ± the standard error, in the unit of the value, in fewer than `columns` characters.
    fn error(&self, output: &UncertainOutput, estimate: Estimate, columns: usize) -> String {
        estimate.standard_error.map_or_else(String::new, |error| {
            let error = self.units.value(pictured(output.output), error);
            // Two digits, or all digits before the point if those are more; fewer if there is no room.
            let shown = if error < 10.0 { significant(error, 2) } else { number(error, 0) };
            let fits = |shown: &str| shown.chars().count() < columns;
            let shorter = || Some(significant(error, 1)).filter(|shown| error < 10.0 && fits(shown));
            let shown =
                if fits(&shown) { shown } else { shorter().unwrap_or_else(|| format!("{error:.0e}")) };
            format!("±{shown}")
        })
    }

    /// An SI value with enough decimals for two digits of a standard deviation (SI) that is not zero.
    fn resolved(&self, quantity: Measure, sd: f64) -> impl Fn(f64) -> String + use<> {
        let units = self.units;
        let decimals =
            units.decimals(quantity).max(decimals_of(units.value(quantity, sd))).min(MOST_DECIMALS);
        move |si| number(units.value(quantity, si), decimals)
    }

    fn results(&mut self) {
        let mut table = Table::new("Results").columns([
            Column::words("", 30),
            Column::numbers("central", 11),
            Column::numbers("mean", 11),
            Column::numbers("median", 11),
            Column::numbers("std. dev.", 12),
            Column::numbers("first order", 13),
            Column::numbers("differs", 10),
        ]);
        let none = || NONE.to_owned();
        let mut apart = Vec::new();
        for (output, summary) in self.rows() {
            let sd = summary.map_or(output.first_order.sd, |summary| summary.sd.value);
            let sd = if output.varies(sd) { sd } else { 0.0 };
            let plain = self.resolved(pictured(output.output), sd);
            let central = plain(output.central);
            let first = plain(output.first_order.sd);
            let label = self.label(output, pictured(output.output));
            let Some(summary) = summary else {
                table.row([label, central, none(), none(), none(), first, String::new()]);
                continue;
            };
            if !output.varies(summary.sd.value) {
                let [mean, median, sd, first] = [const { String::new() }; 4];
                table.row([label, central, mean, median, sd, first, "does not vary".to_owned()]);
                continue;
            }
            let [mean, median, sd] = [summary.mean, summary.median, summary.sd];
            let by = 100.0 * (output.first_order.sd / sd.value - 1.0);
            let differs = if output.differs(sd.value) {
                apart.push(output_name(output.output));
                format!("{}{} %!", if by < 0.0 { "" } else { "+" }, number(by, 0))
            } else {
                "no".to_owned()
            };
            // The standard error is below the value.
            let of = |estimate: Estimate| {
                format!("{}\n{}", plain(estimate.value), self.error(output, estimate, 10))
            };
            table.row([label, central, of(mean), of(median), of(sd), first, differs]);
            if let Some(beside) = Self::beside(output) {
                let of = self.resolved(beside, sd.value);
                table.row([
                    format!("  in {}", self.units.name(beside)),
                    of(output.central),
                    of(mean.value),
                    of(median.value),
                    of(sd.value),
                    of(output.first_order.sd),
                    String::new(),
                ]);
            }
        }
        self.document.push(table);
        self.document.paragraph(
            "± is the standard error due to the number of samples. The first-order standard deviation \
             follows the GUM (JCGM 100, equation 10), with the exact derivatives at the central values.",
        );
        if !apart.is_empty() {
            self.document.paragraph(format!(
                "Warning: the first-order standard deviation differs by more than {} % from that of the \
                 samples for: {}. There the result is not linear over the ranges of the inputs; trust the \
                 samples.",
                number(100.0 * FIRST_ORDER_LIMIT, 0),
                apart.join(", ")
            ));
        }
    }

    fn intervals(&mut self) {
        let mut columns = vec![Column::words("", 25)];
        for level in ["50 %", "90 %", "95 %", "99 %"] {
            columns.push(Column::numbers("", END + 1));
            columns.push(Column::numbers(level, END + 1));
        }
        let mut table = Table::new("Intervals").columns(columns);
        for (output, summary) in self.rows() {
            let label = self.label(output, pictured(output.output));
            let Some(summary) = summary.filter(|summary| output.varies(summary.sd.value)) else { continue };
            let ends = summary.intervals.map(|interval| [interval.low, interval.high]);
            let plain = self.resolved(pictured(output.output), summary.sd.value);
            let cell =
                |end: Estimate| format!("{}\n{}", short(plain(end.value)), self.error(output, end, END));
            table.cells(std::iter::once(label).chain(ends.into_iter().flatten().map(cell)));
            if let Some(beside) = Self::beside(output) {
                let of = self.resolved(beside, summary.sd.value);
                let cells = ends.into_iter().flatten().map(|end| short(of(end.value)));
                let label = format!("  in {}", self.units.name(beside));
                table.cells(std::iter::once(label).chain(cells));
            }
        }
        self.document.push(table);
        self.document.paragraph(
            "An interval includes the errors from the ranges below. It does not include those of the numbers \
             taken as exact, which are also listed below, nor the error of the method itself.",
        );
        self.turned();
    }

    /// A note on each PDOF whose intervals pass through straight from behind.
    fn turned(&mut self) {
        for (output, summary) in self.rows() {
            let Some(summary) = summary.filter(|_| output.output.is(&PDOF)) else {
                continue;
            };
            let mut ends = summary.intervals.iter().flat_map(|ends| [ends.low.value, ends.high.value]);
            let Some(end) = ends.find(|end| end.abs() > PI) else { continue };
            let [end, same] = [end, principal_angle(end)].map(|si| self.units.format(Measure::Angle, si));
            let turned = format!(
                "The {} passes through 180°, straight from behind. Its intervals are not cut there: an end \
                 at {end} is the direction {same}.",
                output_name(output.output)
            );
            self.document.paragraph(turned);
        }
    }

    /// The histogram of the first output.
    fn histogram(&mut self) {
        let Some(&(output, Some(summary))) = self.rows().first() else { return };
        if !output.varies(summary.sd.value) {
            return;
        }
        let Some(histogram) = self.uncertainty.propagation.histogram(0, Classes::Coarse) else { return };
        let most = histogram.counts.iter().copied().max().unwrap_or_default();
        let alone = pictured(output.output);
        let title = self.label(output, alone);
        let mut table = Table::new(title).columns([
            Column::words("", 25),
            Column::numbers("", 10),
            Column::bars("", Width::Share),
        ]);
        for (class, &count) in (0_u32..).zip(&histogram.counts) {
            let low = histogram.low + f64::from(class) * histogram.width;
            let from = self.units.plain(alone, low);
            let to = self.units.plain(alone, low + histogram.width);
            let share = format!("{} %", share(count, summary.samples));
            table.row([format!("{from:>11} – {to}"), share, bar(count, most)]);
        }
        let [below, above] = histogram.outside.map(|count| share(count, summary.samples));
        table.note(format!("{below} % lie below and {above} % above."));
        match pictures::histogram_picture(self.case, self.uncertainty, 0, self.units) {
            Some(picture) => self.document.push(Block::Chart {
                name: "histogram-0".to_owned(),
                drawing: Undrawn::new(move || picture.draw()),
                instead: Some(table),
            }),
            None => self.document.push(table),
        }
    }

    /// The places of the outputs whose drivers are shown: the first, and both speeds if both are found.
    fn answers(&self) -> Vec<usize> {
        let is_speed = |output: &UncertainOutput| output.output.is(&SPEED);
        let outputs = self.uncertainty.outputs.iter().enumerate();
        outputs.filter(|(place, output)| *place == 0 || is_speed(output)).map(|(place, _)| place).collect()
    }

    /// In pictures only: the histograms of the other vehicle's speed and of both ΔV, besides that of the
    /// first output.
    fn more_histograms(&mut self) {
        for (place, (output, _)) in self.rows().into_iter().enumerate().skip(1) {
            if (output.output.is(&SPEED) || output.output.is(&DELTA_V))
                && let Some(picture) =
                    pictures::histogram_picture(self.case, self.uncertainty, place, self.units)
            {
                self.document.chart(format!("histogram-{place}"), move || picture.draw());
            }
        }
    }

    fn tornado(&mut self, place: usize) {
        let Some(&(output, summary)) = self.rows().get(place) else { return };
        // Nothing drives a result that does not vary: its bars would be rounding.
        if !output.varies(summary.map_or(output.first_order.sd, |summary| summary.sd.value)) {
            return;
        }
        if let Some(picture) = pictures::tornado_picture(self.case, self.uncertainty, place, self.units) {
            self.document.chart(format!("tornado-{place}"), move || picture.draw());
        }
        let title = format!("Main drivers: {}", output_name(output.output));
        let alone = pictured(output.output);
        let unit = self.units.name(alone);
        let bars = self.uncertainty.tornado.ranked(place);
        let longest = bars
            .iter()
            .flat_map(|bar| [&bar.low, &bar.high])
            .filter_map(|end| value(end, place))
            .fold(0.0_f64, |longest, value| longest.max((value - output.central).abs()));
        let mut table = Table::new(title).columns([
            Column::words("", 36),
            Column::numbers(format!("low, {unit}"), 10),
            Column::numbers("high", 10),
            Column::bars("", 2 * SIDE + 3),
            Column::numbers("first order", 11),
        ]);
        for bar in bars.iter().take(BARS) {
            let [low, high] = [&bar.low, &bar.high].map(|end| match &end.outputs {
                Ok(outputs) => self.units.plain(alone, outputs.get(place).copied().unwrap_or(f64::NAN)),
                Err(_) => "none".to_owned(),
            });
            let path = input_name(&self.uncertainty.inputs[bar.input].input);
            let share = number(100.0 * output.first_order.shares[bar.input], 1);
            table.row([
                path,
                low,
                high,
                both_sides(bar, place, output.central, longest),
                format!("{share} %"),
            ]);
        }
        let rest = bars.len().saturating_sub(BARS);
        if let Some(next) = bars.get(BARS).and_then(|bar| bar.swing(place)) {
            let next = self.units.format(alone, next.abs());
            table.note(format!("{rest} more, each with an effect of at most {next}"));
        }
        self.document.push(table);
        self.document.paragraph(
            "Each input in turn is set to its 2.5 % and its 97.5 % quantile, with the others at their \
             central values: ░ the input is low, █ the input is high. \"First order\" is the share of the \
             variance from the derivatives.",
        );
    }

    fn indices(&mut self, place: usize) {
        let Some(indices) = &self.uncertainty.indices else { return };
        let Some(&(output, _)) = self.rows().get(place) else { return };
        let title = format!("Sobol' indices: {}", output_name(output.output));
        let Some(Some(all)) = indices.indices().get(place) else {
            self.document.heading(title);
            self.document.paragraph("Too few rows have an answer, or the result does not vary.");
            return;
        };
        let mut table = Table::new(title).columns([
            Column::words("", 36),
            Column::numbers("first", 10),
            Column::numbers("95 %", 20),
            Column::numbers("total", 10),
            Column::numbers("95 %", 20),
        ]);
        let mut ranked: Vec<_> = self.uncertainty.inputs.iter().zip(all).collect();
        ranked.sort_by(|(_, one), (_, other)| other.total.value.total_cmp(&one.total.value));
        let cells = |index: Index| {
            let interval = index
                .interval95()
                .map_or_else(String::new, |[low, high]| format!("{} to {}", number(low, 3), number(high, 3)));
            [number(index.value, 3), interval]
        };
        for (input, index) in ranked {
            let cells = [cells(index.first_order), cells(index.total)].concat();
            table.cells(std::iter::once(input_name(&input.input)).chain(cells));
        }
        self.document.push(table);
        self.document.paragraph(format!(
            "First: the share of the variance that would vanish if this input alone were known exactly. Total: \
             the share that would remain if all others were. Saltelli's sampling with Jansen's estimators: {} \
             in {}; {} of these have an answer throughout and are used.",
            counted(indices.evaluations(), "evaluation"),
            counted(indices.rows(), "row"),
            grouped(indices.used())
        ));
    }

    fn inputs(&mut self) {
        let mut table = Table::new("Ranges").columns([
            Column::words("", 36),
            Column::numbers("central value", 24),
            Column::words("", 2),
            Column::words("distribution", Width::Share),
        ]);
        let mut cut = Vec::new();
        for input in &self.uncertainty.inputs {
            let central = with_unit(input, &input.input.number.to_string());
            table.row([input_name(&input.input), central, String::new(), distribution(input)]);
            let kept = input.truncation().map_or(1.0, |cut| cut.kept);
            if 1.0 - kept > NOTICED_CUT {
                let away = percent(1.0 - kept);
                let mean = with_unit(input, &significant(input.distribution.mean(), 4));
                cut.push(format!(
                    "{}: {}; {away} % of the normal distribution is cut away, which moves its mean to {mean}",
                    input_name(&input.input),
                    input.bounds
                ));
            }
        }
        self.document.push(table);
        if !cut.is_empty() {
            self.document.paragraph("Distributions cut at physical limits:");
            self.document.push(Block::List(cut));
        }
    }

    /// Inputs that have a spread although the file gives no range.
    fn default_spreads(&mut self) {
        let (mut yaw_radius, mut contact) = (Vec::new(), Vec::new());
        // By category and of the fleet: the names, and how far A may differ.
        let mut stiffnesses = [(Vec::new(), None), (Vec::new(), None)];
        for input in &self.uncertainty.inputs {
            let Origin::Estimate(estimate) = input.input.origin else { continue };
            match estimate {
                EstimatedInput::Stiffness { typical, .. } => {
                    let (names, spread) = &mut stiffnesses[usize::from(typical == TypicalStiffness::Fleet)];
                    names.push(estimate_name(estimate));
                    let times = [0.025, 0.975].map(|share| input.distribution.quantile(share));
                    *spread = Some((typical, times));
                }
                EstimatedInput::YawRadius { source, .. } => {
                    let within = number(100.0 * source.within(), 0);
                    yaw_radius.push(format!("{}, within {within} %", estimate_name(estimate)));
                }
                EstimatedInput::Contact { axis, .. } => {
                    let sd = input.distribution.sd() * input.input.factor();
                    let sd = self.units.format(Measure::Crush, sd);
                    contact.push((axis, format!("{}, std. dev. {sd}", estimate_name(estimate))));
                }
            }
        }
        for (names, spread) in stiffnesses {
            let Some((typical, times)) = spread else { continue };
            let [low, high] = times.map(|factor| significant(factor, 2));
            let [of_a, of_b] = typical.ln_sds();
            let (many, its, source, remark) = match typical {
                TypicalStiffness::Category(_) => (
                    "A category covers many vehicles",
                    "the table's value",
                    BARRIER_TESTS,
                    " The tests were of fronts; the spread is used for all sides.",
                ),
                TypicalStiffness::Fleet => {
                    ("The fleet covers cars of all makes", "that of the fleet", "docs/calibration.md", "")
                }
            };
            self.document.paragraph(format!(
                "Spread by default: {}. {many}; A of a single one lies between {low} and {high} times {its} with a \
                 probability of 95 %. The standard deviation is {of_a} for ln A and {of_b} for ln B, which vary together, \
                 and G with them ({source}).{remark} {SWITCH_OFF}",
                names.join("; ")
            ));
        }
        if !yaw_radius.is_empty() {
            self.document.paragraph(format!(
                "Spread by default: {}. The radius of gyration k is that close to its estimate with a \
                 probability of {} % (theory 5). {SWITCH_OFF}",
                yaw_radius.join("; "),
                100.0 * YAW_RADIUS_CONFIDENCE
            ));
        }
        self.spread_of_contact(&contact);
    }

    /// The spread of contact points that the program placed, each with its direction and in words.
    fn spread_of_contact(&mut self, contact: &[(FaceAxis, String)]) {
        if contact.is_empty() {
            return;
        }
        let has = |wanted: FaceAxis| contact.iter().any(|(axis, _)| *axis == wanted);
        let length = |si: f64| self.units.format(Measure::Crush, si);
        let parts = [
            has(FaceAxis::Along).then(|| {
                format!(
                    "along the face, that of the middle of the damage: the root of the sum of squares of {} \
                     for its offset and half of {} for its length",
                    length(OFFSET_SD),
                    length(DAMAGE_LENGTH_SD)
                )
            }),
            has(FaceAxis::Inward).then(|| format!("across it, that of one depth, {}", length(DEPTH_SD))),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        let list: Vec<&str> = contact.iter().map(|(_, words)| words.as_str()).collect();
        self.document.paragraph(format!(
            "Spread by default: {}. The file gives no contact point, so C is at the centroid of the damage. \
             Its error is {} ({SMITH_NOGA}). A range of `offset`, `width` or `depths` replaces its part. \
             How far the force acts from the centroid is unknown and not in the spread. {SWITCH_OFF}",
            list.join("; "),
            parts.join("; ")
        ));
    }

    /// Values that all samples share.
    fn taken_as_exact(&mut self) {
        let exact = &self.uncertainty.taken_as_exact;
        if exact.is_empty() {
            self.document.paragraph("Taken as exact: no number of the case.");
            return;
        }
        let mut table = Table::new("Taken as exact").columns([
            Column::words("", 34),
            Column::words("value", 26),
            Column::words("how well it is usually known", Width::Share),
        ]);
        let mut sources = Vec::new();
        for TakenAsExact { key, value } in exact {
            let value = match value {
                ExactValue::Numbers(numbers) => exact_value(numbers),
                ExactValue::Estimate(estimate) => estimate_source(*estimate),
                ExactValue::Word(word) => (*word).to_owned(),
            };
            let worth = worth(key).map_or_else(
                || NONE.to_owned(),
                |Worth { error, source }| {
                    let known = sources.iter().position(|other| *other == source);
                    let number = known.unwrap_or_else(|| {
                        sources.push(source);
                        sources.len() - 1
                    }) + 1;
                    format!("{error} [{number}]")
                },
            );
            table.row([key.clone(), value, worth]);
        }
        self.document.push(table);
        let sources: Vec<String> =
            (1..).zip(sources).map(|(number, source)| format!("[{number}] {source}")).collect();
        let sources = if sources.is_empty() { String::new() } else { format!(" {}.", sources.join("; ")) };
        self.document.paragraph(format!(
            "Every sample uses these values, so no interval contains their error. Give a range for each that \
             you do not know exactly.{sources}"
        ));
    }
}

/// A number with its unit; for a list, the smallest and the largest.
fn exact_value(numbers: &[Input]) -> String {
    match numbers {
        [] => NONE.to_owned(),
        [input] => amount(input.number, input.unit),
        [first, rest @ ..] => {
            let (mut low, mut high) = (first, first);
            for input in rest {
                low = if input.si() < low.si() { input } else { low };
                high = if input.si() > high.si() { input } else { high };
            }
            let [least, most] = [low, high].map(|input| amount(input.number, input.unit));
            let least = if low.unit == high.unit { low.number.to_string() } else { least };
            format!("{} values, {least} to {most}", numbers.len())
        }
    }
}

/// A figure for a narrow column: without commas if it is too long with them.
pub(super) fn short(figure: String) -> String {
    if figure.chars().count() > END { figure.replace(',', "") } else { figure }
}

fn distribution(input: &UncertainInput) -> String {
    let four = |value: f64| significant(value, 4);
    match input.distribution.shape() {
        Shape::Normal { sd, .. } => format!("normal, std. dev. {}", with_unit(input, &four(sd))),
        Shape::LogNormal { ln_sd, .. } => format!("log-normal, std. dev. of ln {ln_sd}"),
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
    match input.input.origin {
        Origin::Estimate(_) if input.input.unit.is_none() => format!("× {number}"),
        // A percentage of each of its numbers.
        Origin::Shared(_) if input.input.number == 1.0 => format!("× {number}"),
        Origin::Given | Origin::Estimate(_) | Origin::Shared(_) => {
            input.input.unit.map_or_else(|| number.to_owned(), |unit| format!("{number} {unit}"))
        }
    }
}

fn value(end: &End, place: usize) -> Option<f64> {
    end.outputs.as_ref().ok().and_then(|outputs| outputs.get(place).copied())
}

/// The decimals that two significant digits of a number need.
pub(super) fn decimals_of(value: f64) -> usize {
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

pub(super) fn counted(count: usize, noun: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{} {noun}{s}", grouped(count))
}

/// A bar of up to [`LONGEST`] columns, in eighths of one.
fn bar(count: usize, most: usize) -> String {
    const EIGHTHS: [&str; 8] = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"];
    let eighths = (count * LONGEST * 8).checked_div(most).unwrap_or_default();
    format!("{}{}", "█".repeat(eighths / 8), EIGHTHS[eighths % 8])
}

/// Both ends of a bar around the central value, on [`SIDE`] columns to each side.
fn both_sides(bar: &Bar, place: usize, central: f64, longest: f64) -> String {
    let mut left = [' '; SIDE];
    let mut right = [' '; SIDE];
    for (end, fill) in [(&bar.low, '░'), (&bar.high, '█')] {
        let Some(value) = value(end, place) else { continue };
        let share = if longest > 0.0 { (value - central) / longest } else { 0.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to SIDE")]
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let columns = (share.abs() * SIDE as f64).round() as usize;
        let side = if share < 0.0 { &mut left } else { &mut right };
        // If both ends lie on one side, the first one drawn keeps its columns.
        for place in side.iter_mut().take(columns) {
            *place = if *place == ' ' { fill } else { *place };
        }
    }
    let left: String = left.iter().rev().collect();
    let right: String = right.iter().collect();
    format!("{left}│{right}")
}
