//! The estimate from all the evidence of a case.

use ::estimate::DrawsSummary;
use ::uncertainty::{Distribution, Interval, Shape};
use analysis::quantities::{CRUSH_ENERGY, DELTA_V, SKID_SPEED, SPEED};
use analysis::{
    Agreement, Assumed, CONTRADICTS, DOUBTFUL, Estimated, EstimatedOutput, MISSED, NoEstimate, Output,
    PieceFound, SeenWarning, Stood, TOLD_BELOW, UnknownNumber, Weighed,
};
use case::{Axes, Case, SeverityPrior};
use evidence::{Piece, TestedClass};
use pim_core::VehicleId;

use super::uncertainty::{MOST_DECIMALS, decimals_of, short};
use crate::document::{Block, Column, Document, NONE, Table, Width};
use crate::estimates::{
    Asked, EIGHTY, HALF, NINETY, Question, WIDEST, contradictions, crush_words, doubt_words, ends, error,
    error_key, is_factor, median_and_interval, p_value, piece_name, source, told_speed, unknown_key, unused,
};
use crate::outputs::{label, output_name, pictured};
use crate::pictures;
use crate::units::{Measure, Units, grouped, number, significant};
use crate::warnings::{block, message, notice};
use crate::words::quoted;
use crate::writers::wrap::folded;

/// (columns) of an end of an interval, with the blank before it.
const END: usize = 9;
/// Islands of particles.
const ISLANDS: usize = ::estimate::ISLANDS;
/// The end of the key of another: the logarithm of a speed within certain limits.
const LN_SPEED: &str = ".ln_speed";

/// Whether no table shows an unknown number because the results have it, with its unit.
fn is_hidden(unknown: &UnknownNumber) -> bool {
    unknown.assumed == Some(Assumed::Speed)
}

/// The speeds with their intervals, the answers by each piece of evidence and whether it agrees with the
/// rest, and what is assumed. If the run has not converged, it has no interval.
#[must_use]
pub fn estimate(case: &Case, estimated: &Estimated, asked: &Asked, units: Units) -> Document {
    let mut page = Page { estimated, asked, units, document: Document::of_case(case) };
    page.lead();
    let warnings: Vec<SeenWarning> =
        estimated.warnings.iter().map(|warning| warning.seen(case.axes)).collect();
    page.document.blocks.extend(notice(&warnings, None));
    page.run();
    if estimated.doubts().is_empty() {
        page.pictures(case);
        page.questions();
        page.results();
        page.intervals();
    }
    page.evidence();
    page.errors();
    page.unused();
    page.assumed();
    if estimated.doubts().is_empty() {
        page.unknown();
    }
    if !warnings.is_empty() {
        page.document.push(block(&warnings, units));
    }
    page.limits();
    page.document
}

/// (–) a p-value below this is borderline, if no verdict follows from it: that of one right piece in 20.
const BORDERLINE: f64 = 0.05;

/// (–) a probability below this is not worth a line.
const WORTH_A_LINE: f64 = 0.005;

/// The head of the estimate: the speeds with their intervals, or why there are none; and the evidence that
/// the rest contradicts.
pub(crate) fn headline(estimated: &Estimated, asked: &Asked, units: Units) -> Vec<Block> {
    let mut page = Page { estimated, asked, units, document: Document::new() };
    page.lead();
    page.document.blocks
}

/// How probable each speed is, as pictures.
pub(crate) fn pictures(case: &Case, weighed: &Weighed, units: Units) -> Vec<Block> {
    if !weighed.is_answer() {
        return Vec::new();
    }
    let asked = Asked { plan: weighed.plan, questions: Vec::new() };
    let estimated = &weighed.estimated;
    let mut page = Page { estimated, asked: &asked, units, document: Document::new() };
    page.pictures(case);
    page.document.blocks
}

/// The real collisions on which such an interval was tested.
pub(super) fn tested(class: Option<&TestedClass>) -> String {
    let Some(TestedClass { collisions, quantity, n, inside95, rms, source, code: _ }) = class else {
        return "The method has not been tested on real crashes with this evidence and these assumptions, so it is unknown how \
                often such an interval is right."
            .to_owned();
    };
    let off = rms.map_or_else(String::new, |rms| {
        format!(", and the median was off by {} % rms", number(100.0 * rms, 0))
    });
    let with_error = if *quantity == "ΔV" {
        " Those intervals include the error of the recorder, and the ones above do not."
    } else {
        ""
    };
    // Eighteen of nineteen does not justify a percentage with a decimal.
    let share = number(100.0 * inside95, usize::from(*n >= 100));
    format!(
        "Tested on real collisions in which {collisions}: the 95 % interval contained {share} % of {n} \
         measured values of \
         {quantity}{off}.{with_error} Data: {source}."
    )
}

/// (–) of the width of an interval: an end with a greater standard error is not sure.
const LOOSE: f64 = 0.05;

/// The ends of the widest interval that are not sure, with their standard errors.
fn loose_ends(summary: &DrawsSummary) -> impl Iterator<Item = (&'static str, f64)> {
    let Interval { low, high, .. } = summary.intervals[WIDEST];
    let ends = [("lower", low.standard_error), ("upper", high.standard_error)];
    let most = LOOSE * (high.value - low.value);
    ends.into_iter().filter_map(|(name, error)| Some((name, error?))).filter(move |(_, error)| *error > most)
}

/// What is assumed about the severity before the evidence.
pub(super) fn severity(estimated: &Estimated) -> &'static str {
    match estimated.prior {
        SeverityPrior::Field if estimated.is_bound() => {
            "Before the evidence, the severity is at most that of collisions in which a vehicle was towed, because no \
             vehicle has residual crush; `--prior flat`, or `prior = \"flat\"` in [estimate], makes every speed \
             equally likely."
        }
        SeverityPrior::Field => {
            "Before the evidence, the severity is that of collisions in which a vehicle was towed; `--prior flat`, or \
             `prior = \"flat\"` in [estimate], makes every speed equally likely."
        }
        SeverityPrior::SeriousInjury => {
            "Before the evidence, the severity is that of collisions in which a vehicle was towed and somebody in \
             either vehicle was seriously hurt (MAIS 3 or more; risk by ΔV: DOT HS 813 219)."
        }
        SeverityPrior::Flat => "Every speed is as likely as any other before the evidence, as requested.",
    }
}

/// (m/s) 15 km/h: 19 % of the towed vehicles with a recorder had a smaller ΔV (docs/calibration.md: median 23
/// km/h, ln-sd 0.48).
const MINOR: f64 = 15.0 / 3.6;

/// The headline if the evidence contradicts itself.
pub(super) const NO_COLLISION: &str =
    "No collision reproduces all of the evidence, so no single answer can be given.";

/// The evidence that the nearest collisions miss, and what to do.
pub(super) fn missed(keys: &[String], certain: &[String]) -> String {
    let limits = if certain.is_empty() {
        String::new()
    } else {
        format!(" Nothing outweighs what counts as certain ({}): check that, too.", quoted(certain, " and "))
    };
    // Evidence on how the vehicles left the impact.
    let as_one = if keys.iter().any(|key| key.contains(".after")) {
        " If the vehicles left the impact as one wreck, `locked_together = true` in [scene] says so."
    } else {
        ""
    };
    format!(
        "Even the nearest collisions miss {} by more than {MISSED} standard deviations. Check what was \
         measured there, whether all of it is of this impact, the contact points and the crush \
         plane.{limits}{as_one}",
        quoted(keys, " and ")
    )
}

struct Page<'a> {
    estimated: &'a Estimated,
    asked: &'a Asked,
    units: Units,
    document: Document,
}

impl<'a> Page<'a> {
    fn find(&self, wanted: Output) -> Option<&'a EstimatedOutput> {
        self.estimated.output(wanted)
    }

    /// An SI value with enough decimals for the standard deviation of the result.
    fn figure(&self, of: &EstimatedOutput, si: f64) -> String {
        let measure = pictured(of.output);
        let decimals = if of.varies() || measure == Measure::Ratio {
            decimals_of(self.units.value(measure, of.posterior.sd.value)).min(MOST_DECIMALS)
        } else {
            self.units.decimals(measure)
        };
        number(self.units.value(measure, si), decimals)
    }

    /// Median and 95 % interval of a speed, with one decimal.
    fn speed(&self, summary: &DrawsSummary) -> [String; 2] {
        median_and_interval(summary, self.units)
    }

    fn lead(&mut self) {
        match self.estimated.no_answer() {
            None => self.answer(),
            Some(NoEstimate::Unconverged) => self.doubts(),
            Some(NoEstimate::Contradicted(keys)) => {
                let how = format!(
                    "{} The medians below are not an answer.",
                    missed(&keys, &self.estimated.certain)
                );
                self.document.push(Block::Answer { found: vec![NO_COLLISION.to_owned()], how });
            }
        }
        self.warnings();
    }

    /// A speed or a ΔV with its interval, in words.
    fn told(&self, found: &EstimatedOutput) -> String {
        format!("{}: {}", output_name(found.output), told_speed(found, self.units))
    }

    /// The probability that each vehicle stood still.
    fn stood(&self) -> Vec<String> {
        let percent = |share: f64| number(100.0 * share, 0);
        let words = |id: VehicleId| {
            let stood = self.estimated.stood[id.index()].filter(|stood| stood.after.value >= WORTH_A_LINE);
            let Stood { assumed, before, after } = stood?;
            let before = before.map_or_else(String::new, |before| {
                format!("; before the evidence, {} %", percent(before.value))
            });
            Some(format!(
                "Probability that vehicle {id} was stationary: {} %{before}. `stood` in [estimate] assumes {} %; cases in which the \
                 vehicles do not meet are left out.",
                percent(after.value),
                percent(assumed)
            ))
        };
        VehicleId::ALL.into_iter().filter_map(words).collect()
    }

    fn answer(&mut self) {
        let line = |output: Output| Some(self.told(self.find(output)?));
        let all = VehicleId::ALL.into_iter();
        let speeds = all
            .clone()
            .flat_map(|vehicle| [SPEED.of_vehicle(vehicle), SKID_SPEED.of_vehicle(vehicle)])
            .filter_map(line);
        let changes = all.filter_map(|vehicle| line(DELTA_V.of_vehicle(vehicle)));
        let found: Vec<String> = speeds.chain(changes).collect();
        let evidence: Vec<String> =
            self.estimated.pieces.iter().map(|piece| piece_name(piece.piece)).collect();
        let how = if evidence.is_empty() {
            "Medians and 95 % intervals without any evidence: only what such collisions are usually like."
                .to_owned()
        } else {
            format!("Medians and 95 % intervals from all evidence: {}.", evidence.join("; "))
        };
        let is_untold = |vehicle: VehicleId| {
            [SPEED.of_vehicle(vehicle), DELTA_V.of_vehicle(vehicle)]
                .into_iter()
                .any(|output| self.find(output).is_some_and(|found| !found.is_told()))
        };
        let untold = VehicleId::ALL.into_iter().any(is_untold);
        let stood = self.stood();
        self.document.push(Block::Answer { found, how });
        if untold {
            self.document.paragraph(format!(
                "The evidence does not determine a speed if its interval is more than {} % as wide as \
                 before the evidence: the interval then mostly reflects what was assumed about such collisions.",
                number(100.0 * TOLD_BELOW, 0)
            ));
        }
        self.bound();
        self.loose_ends();
        if !stood.is_empty() {
            self.document.push(Block::List(stood));
        }
        if self.is_minor() {
            self.document.paragraph(
                "Before the evidence, the severity is that of crashes after which a vehicle was towed, in which such a \
                 small ΔV is rare. If none was towed here, `deltav estimate CASE --prior flat` leaves that assumption out.",
            );
        }
        self.document.paragraph(tested(self.estimated.tested));
    }

    /// The ends of intervals near which few draws lie, as in a gap between two groups of collisions.
    fn loose_ends(&mut self) {
        let unit = self.units.name(Measure::RoadSpeed);
        let rows = [&SPEED, &SKID_SPEED, &DELTA_V].map(|row| VehicleId::ALL.map(|id| row.of_vehicle(id)));
        let mut told = Vec::new();
        for output in rows.into_iter().flatten() {
            let Some(found) = self.find(output).filter(|found| found.varies()) else { continue };
            for (name, error) in loose_ends(&found.posterior) {
                let error = significant(self.units.value(Measure::RoadSpeed, error), 2);
                told.push(format!("{}: {name} end ± {error} {unit}", output_name(output)));
            }
        }
        if !told.is_empty() {
            self.document.paragraph(
                "Few draws lie near some ends, as in a gap between two groups of collisions. With another seed these ends \
                 would differ (± is the standard error); more `--particles` make them surer:",
            );
            self.document.push(Block::List(told));
        }
    }

    /// What the damage excludes if no vehicle has residual crush: the speeds above the upper end of the 90 %
    /// interval, with a probability of 95 %.
    fn bound(&mut self) {
        if !self.estimated.is_bound() {
            return;
        }
        let unit = self.units.name(Measure::RoadSpeed);
        let most = |output: Output| {
            let found = self.find(output).filter(|found| found.varies())?;
            let [_, high] = ends(&found.posterior, WIDEST - 1);
            let most = number(self.units.value(Measure::RoadSpeed, high), 1);
            Some(format!("{}: at most {most} {unit}", output_name(output)))
        };
        let outputs = [&SPEED, &DELTA_V].map(|row| VehicleId::ALL.map(|id| row.of_vehicle(id)));
        let told: Vec<String> = outputs.into_iter().flatten().filter_map(most).collect();
        self.document.paragraph(
            "No vehicle has residual crush, so the damage only bounds the speeds from above. With a probability of 95 % \
             each:",
        );
        self.document.push(Block::List(told));
    }

    /// Whether ΔV is less than that of most crashes behind the assumed severity.
    fn is_minor(&self) -> bool {
        let mut changes =
            VehicleId::ALL.into_iter().filter_map(|id| self.find(DELTA_V.of_vehicle(id))).peekable();
        let severity = self.estimated.observed.severity;
        severity.is_some_and(|severity| severity.median > MINOR)
            && !self.estimated.is_bound()
            && changes.peek().is_some()
            && changes.all(|change| change.posterior.median.value < MINOR)
    }

    /// Why there is no answer, and what to do.
    fn doubts(&mut self) {
        self.document.push(Block::Answer {
            found: vec!["No answer: the run has not converged, so no interval is given.".to_owned()],
            how: "What the run shows:".to_owned(),
        });
        let words = self.estimated.doubts().iter().map(|doubt| doubt_words(doubt, self.estimated));
        self.document.push(Block::List(words.collect()));
        let used = self.estimated.posterior.count() / ISLANDS;
        self.document.paragraph(format!(
            "Run it again with more particles, such as `deltav estimate CASE --particles {}`. If that does not \
             help, hardly any collision agrees with all pieces of evidence: see below which of them \
             disagree, give larger errors to what is less certain than the case says, and look for a wrong \
             sign or unit.",
            2 * used
        ));
    }

    /// Evidence that contradicts the rest, and what counts twice.
    fn warnings(&mut self) {
        let mut lines = contradictions(&self.estimated.pieces);
        let doubts = self.estimated.warnings.iter().filter(|warning| warning.doubts_answer());
        lines.extend(doubts.map(|warning| {
            // They have nothing that depends on the axes.
            message(&warning.seen(Axes::ZUp), self.units)
        }));
        for same in &self.estimated.same_twice {
            let [one, other] = &same.keys;
            lines.push(format!(
                "`{one}` and `{other}` may state the same thing twice, if the first was derived from the \
                 second; the interval is then too narrow. Leave one out."
            ));
        }
        if !lines.is_empty() {
            let lines = lines.into_iter().map(|line| format!("Warning: {line}"));
            self.document.push(Block::List(lines.collect()));
        }
    }

    fn run(&mut self) {
        let estimated = self.estimated;
        let particles = estimated.posterior.count() / ISLANDS;
        let mut lines = vec![format!(
            "{ISLANDS} × {} particles, seed {}; effective sample size at least {}.",
            grouped(particles),
            self.asked.plan.seed,
            number(estimated.ess(), 0)
        )];
        if particles > self.asked.plan.particles {
            lines.push(format!(
                "The run did not converge with the {} particles requested, so it was repeated with more.",
                grouped(self.asked.plan.particles)
            ));
        }
        self.document.push(Block::List(lines));
    }

    fn pictures(&mut self, case: &Case) {
        for (name, drawing) in pictures::estimate::all(case, self.estimated, self.asked, self.units) {
            self.document.push(Block::Chart { name, drawing, instead: None });
        }
    }

    fn questions(&mut self) {
        if self.asked.questions.is_empty() {
            return;
        }
        let percent = |share: f64| number(100.0 * share, 1);
        let words = |question: &Question| {
            let probability = self.estimated.probability_above(question.output, question.limit)?;
            let error = probability
                .standard_error
                .map_or_else(String::new, |error| format!(" ± {}", significant(100.0 * error, 1)));
            let limit = match pictured(question.output) {
                Measure::Ratio => number(question.limit, 3),
                measure => self.units.format(measure, question.limit),
            };
            let is_told = self.find(question.output).is_none_or(EstimatedOutput::is_told);
            let caveat =
                if is_told { "" } else { " The evidence does not determine it: this is what was assumed." };
            Some(format!(
                "{} above {limit}: probability {}{error} %.{caveat}",
                output_name(question.output),
                percent(probability.value)
            ))
        };
        let lines: Vec<String> = self.asked.questions.iter().filter_map(words).collect();
        self.document.heading("Questions");
        self.document.push(Block::List(lines));
        self.document.paragraph("± is the standard error due to the number of draws.");
    }

    /// The results of the tables: a crush energy without a range has an error, but no interval.
    fn shown(&self) -> impl Iterator<Item = &'a EstimatedOutput> {
        let is_fixed = |found: &EstimatedOutput| found.output.is(&CRUSH_ENERGY) && !found.varies();
        self.estimated.outputs.iter().filter(move |found| !is_fixed(found))
    }

    fn results(&mut self) {
        let mut columns = vec![
            Column::words("", 34),
            Column::numbers("median", END + 1),
            Column::numbers("95 %", END),
            Column::numbers("", END),
            Column::numbers("before", END + 3),
            Column::numbers("95 %", END),
            Column::numbers("", END),
        ];
        for (column, unit) in columns.iter_mut().zip(["", "", "from", "to", "median", "from", "to"]) {
            unit.clone_into(&mut column.unit);
        }
        let mut table = Table::new("Results").columns(columns);
        for output in self.shown() {
            let of = |summary: &DrawsSummary| {
                let [low, high] = ends(summary, WIDEST);
                [summary.median.value, low, high].map(|si| short(self.figure(output, si)))
            };
            let before = output.prior.as_ref().map_or([NONE; 3].map(str::to_owned), of);
            let after = of(&output.posterior);
            let label = label(output.output, pictured(output.output), self.units);
            table.cells(std::iter::once(label).chain(after).chain(before));
        }
        self.document.push(table);
        let mut words =
            "\"Before\" shows such collisions without this evidence, within the limits that are certain."
                .to_owned();
        if self.estimated.outputs.iter().any(|output| output.prior.is_none()) {
            words.push_str(" The run without evidence has not converged, so these columns are empty.");
        }
        self.document.paragraph(words);
    }

    fn intervals(&mut self) {
        let mut columns = vec![Column::words("", 34)];
        for level in ["50 %", "80 %", "90 %"] {
            columns.push(Column::numbers(level, END + 1).unit("from"));
            columns.push(Column::numbers("", END).unit("to"));
        }
        let mut table = Table::new("Narrower intervals").columns(columns);
        for output in self.shown() {
            let cells = [HALF, EIGHTY, NINETY].map(|place| ends(&output.posterior, place)).concat();
            let cells = cells.into_iter().map(|si| short(self.figure(output, si)));
            table.cells(
                std::iter::once(label(output.output, pictured(output.output), self.units)).chain(cells),
            );
        }
        self.document.push(table);
    }

    fn evidence(&mut self) {
        let pieces = &self.estimated.pieces;
        if pieces.is_empty() {
            return;
        }
        let unit = self.units.name(Measure::RoadSpeed);
        // Known speeds would show nothing.
        let varies = |id: &VehicleId| self.find(SPEED.of_vehicle(*id)).is_some_and(EstimatedOutput::varies);
        let sought: Vec<VehicleId> = VehicleId::ALL.into_iter().filter(varies).collect();
        let is_judged = pieces.iter().any(|piece| piece.alone.is_some() || piece.without.is_some());
        let mut columns = vec![Column::words("", 30)];
        if is_judged {
            for what in ["alone", "without it"] {
                for vehicle in &sought {
                    columns.push(Column::numbers(what, 14).unit(format!("{vehicle}, {unit}")));
                }
            }
        }
        columns.push(Column::numbers("p-value", 12));
        let mut table = Table::new("Evidence").columns(columns);
        for (piece, agreement) in pieces.iter().zip(Agreement::of_all(pieces)) {
            let mut cells = vec![format!("{}\n  {}", piece_name(piece.piece), piece.key)];
            if is_judged {
                for speeds in [&piece.alone, &piece.without] {
                    cells.extend(sought.iter().map(|vehicle| {
                        let summary = speeds.as_ref().and_then(|speeds| speeds[vehicle.index()].as_ref());
                        summary.map_or(NONE.to_owned(), |summary| self.speed(summary).join("\n"))
                    }));
                }
            }
            let is_borderline = piece.p_value.is_some_and(|p| p.value < BORDERLINE);
            let verdict = match agreement {
                Some((Agreement::Agrees, _)) if is_borderline => "borderline",
                agreement => agreement.map_or(NONE, |(agreement, _)| agreement.name()),
            };
            let p = piece.p_value.map_or(NONE.to_owned(), |p| p_value(p.value));
            cells.push(format!("{p}\n{verdict}"));
            table.cells(cells);
        }
        self.document.push(table);
        let mut words = String::new();
        if is_judged {
            words.push_str(
                "Median and 95 % interval of the speed of each vehicle from one piece alone, and from all \
                 others. A dash marks a run that has not converged. Bounds and the points of a path have no \
                 p-value. If a rest disagrees, check the points of its path as well. ",
            );
        } else if pieces.iter().any(|piece| piece.p_value.is_none()) {
            words.push_str("A dash marks what only a run without the piece can show. ");
        }
        words.push_str(&format!(
            "The p-value is the probability, given all other evidence, of an observation at least this far \
             off. For the verdict it is multiplied by the number of pieces whose p-value is no smaller (Holm's \
             correction), so if all pieces are right, a warning appears in at most {} % of cases: if the \
             product is below {DOUBTFUL}, the piece is doubtful; if the p-value itself is also below \
             {CONTRADICTS}, the piece contradicts the other evidence. One right piece in 20 is borderline, \
             with a p-value below {BORDERLINE}.",
            number(100.0 * DOUBTFUL, 0)
        ));
        self.document.paragraph(words);
    }

    /// How far each piece may be off.
    fn errors(&mut self) {
        let observed = &self.estimated.observed;
        let mut table = Table::new("Errors of the evidence").columns([
            Column::words("", 30),
            Column::words("", Width::Share),
            Column::words("from", 12),
        ]);
        for piece in &self.estimated.pieces {
            let Some(words) = error(piece.piece, observed, self.units) else { continue };
            let key = error_key(piece);
            let is_default = |key: &String| {
                // That of a table follows from several errors.
                let of_table = key.strip_suffix("speed_error").map(|recorder| format!("{recorder}errors"));
                self.estimated.default_errors.iter().any(|one| one == key || Some(one) == of_table.as_ref())
            };
            let from = match &key {
                Some(key) if is_default(key) => "default",
                Some(_) => "the case",
                None => "default",
            };
            table.row([piece_name(piece.piece), words, from.to_owned()]);
        }
        if table.rows.is_empty() {
            return;
        }
        let defaults = &self.estimated.default_errors;
        if !defaults.is_empty() {
            table.note(format!("Default errors, because the case gives none: {}.", quoted(defaults, ", ")));
        }
        self.document.push(table);
        for words in crush_words(self.estimated) {
            self.document.paragraph(words);
        }
    }

    fn unused(&mut self) {
        if self.estimated.unused.is_empty() {
            return;
        }
        let mut table = Table::new("Given but not used").columns([
            Column::words("", 24),
            Column::words("why", 40),
            Column::words("write instead", Width::Share),
        ]);
        for given in &self.estimated.unused {
            let [_, why, instead] = unused(given.reason);
            let [why, instead] = [folded(why, 38), folded(instead, 32)];
            table.row([given.key.clone(), why, instead]);
        }
        self.document.push(table);
    }

    /// Uncertain numbers whose spread the case does not give.
    fn assumed(&mut self) {
        let mut table = Table::new("Assumed").columns([
            Column::words("", 34),
            Column::words("before the evidence", 32),
            Column::words("source", Width::Share),
        ]);
        if let Some(severity) = self.estimated.observed.severity {
            let median = self.units.format(Measure::RoadSpeed, severity.median);
            // With a fixed object, one vehicle moves.
            let alone = VehicleId::ALL.into_iter().filter(|id| self.find(DELTA_V.of_vehicle(*id)).is_some());
            let alone: Vec<VehicleId> = alone.collect();
            let (delta_v, speeds, weight) = match alone[..] {
                [id] => (format!("ΔV of vehicle {id}"), format!("speed of vehicle {id}"), "v²"),
                _ => (
                    "ΔV, geometric mean of both".to_owned(),
                    "speeds of both vehicles".to_owned(),
                    "(v₁² + v₂²)",
                ),
            };
            table.row([
                delta_v,
                folded(&format!("median {median}, std. dev. {} of ln", significant(severity.ln_sd, 2)), 30),
                "docs/calibration.md".to_owned(),
            ]);
            if severity.speed.is_finite() {
                let scale = self.units.format(Measure::RoadSpeed, severity.speed);
                table.row([
                    speeds,
                    folded(&format!("weight exp(−{weight}/2s²), s = {scale}: faster is rarer"), 30),
                    "docs/calibration.md".to_owned(),
                ]);
            }
        }
        for unknown in &self.estimated.unknown {
            let Some(assumed) = unknown.assumed else { continue };
            let prior = folded(&self.prior(unknown, assumed), 30);
            let key = match unknown.key.as_str() {
                "ln_relative_speed" => "relative speed".to_owned(),
                "speed_split" => "atan(speed 2/speed 1)".to_owned(),
                "vehicle1.ln_speed" => "speed 1".to_owned(),
                "vehicle2.ln_speed" => "speed 2".to_owned(),
                "vehicle1.crush_by_vehicle2" => "crush energy 1/crush energy 2".to_owned(),
                "vehicle2.crush_by_vehicle1" => "crush energy 2/crush energy 1".to_owned(),
                _ => unknown_key(unknown),
            };
            table.row([key, prior, folded(source(unknown, assumed), 31)]);
        }
        if !table.rows.is_empty() {
            self.document.push(table);
        }
        self.document.paragraph(severity(self.estimated));
        self.if_injured();
    }

    /// The speeds and ΔV if it was also known that somebody was seriously hurt.
    fn if_injured(&mut self) {
        if self.estimated.no_answer().is_some() {
            return;
        }
        let wanted = [&SPEED, &DELTA_V].map(|row| VehicleId::ALL.map(|id| row.of_vehicle(id)));
        let told = wanted.into_iter().flatten().filter_map(|wanted| {
            let found = self.find(wanted).filter(|found| found.varies())?;
            let [median, interval] = self.speed(found.if_injured.as_ref()?);
            let unit = self.units.name(Measure::RoadSpeed);
            let name = output_name(wanted);
            Some(if found.is_told() {
                format!("{name}: {median} {unit} (95 %: {interval} {unit})")
            } else {
                format!("{name}: not determined by the evidence (95 %: {interval} {unit})")
            })
        });
        let told: Vec<String> = told.collect();
        if told.is_empty() {
            return;
        }
        self.document.paragraph(
            "Collisions in which somebody in either vehicle was seriously hurt (MAIS 3 or more) are more \
             severe. With `--prior serious-injury`, or `prior = \"serious-injury\"` in [estimate], the answer is:",
        );
        self.document.push(Block::List(told));
    }

    /// The prior of a number, in words.
    fn prior(&self, unknown: &UnknownNumber, assumed: Assumed) -> String {
        let prior = &unknown.prior;
        match (assumed, prior.shape()) {
            (Assumed::Speed, Shape::Uniform { .. }) if unknown.key == "ln_relative_speed" => {
                "its logarithm uniform".to_owned()
            }
            (Assumed::Speed, Shape::Uniform { .. }) if unknown.key.ends_with(LN_SPEED) => {
                "its logarithm uniform within `certain_speed`".to_owned()
            }
            (Assumed::Speed, Shape::Uniform { low, high }) => {
                let measure = if unknown.key == "speed_split" { Measure::Angle } else { Measure::RoadSpeed };
                let [low, high] = [low, high].map(|si| self.units.format(measure, si));
                format!("uniform from {low} to {high}")
            }
            (_, Shape::LogNormal { median, ln_sd }) => {
                let lead = if is_factor(unknown) || assumed == Assumed::Estimate {
                    format!("× {}", significant(median, 3))
                } else {
                    format!("median {}", with_unit(unknown, median))
                };
                format!("{lead}, std. dev. of ln {}", significant(ln_sd, 2))
            }
            (_, Shape::Normal { mean, sd }) => {
                let cut = cut(prior);
                format!("{}, std. dev. {}{cut}", with_unit(unknown, mean), with_unit(unknown, sd))
            }
            (_, Shape::Uniform { low, high } | Shape::Triangular { low, high, .. }) => {
                format!("{} to {}", significant(low, 4), with_unit(unknown, high))
            }
            _ => String::new(),
        }
    }

    /// All unknown numbers before and after.
    fn unknown(&mut self) {
        let mut table = Table::new("Unknown numbers").columns([
            Column::words("", 42),
            Column::numbers("before: 95 %", 20),
            Column::numbers("median", 10),
            Column::numbers("95 %", 20),
        ]);
        for unknown in self.estimated.unknown.iter().filter(|unknown| !is_hidden(unknown)) {
            let summary = &unknown.posterior;
            let decimals = decimals_of(unknown.prior.sd()).min(MOST_DECIMALS);
            let of = |value: f64| number(value, decimals);
            let before = [0.025, 0.975].map(|share| of(unknown.prior.quantile(share))).join(" to ");
            let after = ends(summary, WIDEST).map(of).join(" to ");
            let unit = unknown.unit.map_or_else(String::new, |unit| format!(", {unit}"));
            table.row([format!("{}{unit}", unknown_key(unknown)), before, of(summary.median.value), after]);
        }
        if !table.rows.is_empty() {
            self.document.push(table);
        }
    }

    fn limits(&mut self) {
        let is_of_way = |piece: &PieceFound| {
            matches!(piece.piece, Piece::Severity | Piece::Limits(_) | Piece::Rest(_) | Piece::Points(_))
        };
        self.document.paragraph(if self.estimated.pieces.iter().all(is_of_way) {
            "The errors of rest positions and points are assumed, not fitted. The intervals include the errors \
             listed here, and no others."
        } else {
            "The errors of crush energies, PDOFs and recorders were fitted to 329 crashes of cars with \
             recorders in the United States in 2017 (docs/calibration.md): in other collisions they may be \
             larger. The intervals include the errors listed here, and no others."
        });
    }
}

/// A value in the unit of the case.
fn with_unit(unknown: &UnknownNumber, value: f64) -> String {
    let value = significant(value, 4);
    unknown.unit.map_or_else(|| value.clone(), |unit| format!("{value} {unit}"))
}

/// The limits of a truncated normal distribution, in words.
fn cut(prior: &Distribution) -> String {
    match prior.truncation() {
        Some(cut) if cut.low.is_finite() && cut.high.is_finite() => {
            format!(", between {} and {}", cut.low, cut.high)
        }
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use ::estimate::DrawsSummary;
    use ::uncertainty::{Estimate, Interval};

    use super::loose_ends;

    /// Ten wide: an end is named from a standard error of 0.5 on, one without an error is not.
    #[test]
    fn ends_that_few_draws_support_are_named() {
        let named = |errors: [Option<f64>; 2]| {
            let of = |value: f64, standard_error: Option<f64>| Estimate { value, standard_error };
            let interval = Interval { level: 0.95, low: of(20.0, errors[0]), high: of(30.0, errors[1]) };
            let centre = of(25.0, None);
            let summary = DrawsSummary { mean: centre, sd: centre, median: centre, intervals: [interval; 4] };
            loose_ends(&summary).collect::<Vec<_>>()
        };
        assert!(named([Some(0.49), Some(0.49)]).is_empty() && named([None, None]).is_empty());
        assert_eq!(named([Some(0.1), Some(2.0)]), [("upper", 2.0)]);
        assert_eq!(named([Some(0.6), None]), [("lower", 0.6)]);
    }
}
