//! The questions to an estimate, and the names of its results, unknown numbers, pieces of evidence and
//! doubts.

mod contradiction;
mod question;

use ::estimate::{DrawnQuantity, DrawsSummary, LEVELS, SamplerDoubt};
use analysis::{
    Assumed, EstimatePlan, Estimated, EstimatedOutput, Output, PieceFound, UnknownNumber, UnusedReason,
};
use evidence::{
    CrushErrors, EnergyError, EnergyMethod, FITTED, Measured, MeasuredSpeed, Observed, Piece, ShownSpeed,
};
use pim_core::VehicleId;

pub(crate) use self::contradiction::{contradictions, p_value};
use crate::units::{Measure, Units, number, percent, significant};
use crate::worth::{BARRIER_TESTS, SMITH_NOGA, STAGED_MOTION};

/// A reader's request for an estimate.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The plan of the estimate.
    pub plan: EstimatePlan,
    /// Probabilities to report.
    pub questions: Vec<Question>,
}

/// How probable is it that a result is above a limit?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// Which result.
    pub output: Output,
    /// (SI) the limit.
    pub limit: f64,
}

/// The indices of the intervals of 50, 80, 90 and 95 % in a summary.
pub(crate) const HALF: usize = 0;
pub(crate) const EIGHTY: usize = 1;
pub(crate) const NINETY: usize = 2;
pub(crate) const WIDEST: usize = {
    assert!(LEVELS[0] == 0.5 && LEVELS[1] == 0.8 && LEVELS[2] == 0.9 && LEVELS[3] == 0.95);
    3
};

/// (SI) the ends of the interval with such an index.
pub(crate) fn ends(summary: &DrawsSummary, place: usize) -> [f64; 2] {
    let interval = &summary.intervals[place];
    [interval.low.value, interval.high.value]
}

/// Median and 95 % interval of a speed, with one decimal.
pub(crate) fn median_and_interval(summary: &DrawsSummary, units: Units) -> [String; 2] {
    let of = |si: f64| number(units.value(Measure::RoadSpeed, si), 1);
    let [low, high] = ends(summary, WIDEST);
    [of(summary.median.value), format!("{} to {}", of(low), of(high))]
}

/// A speed or a ΔV with its interval, like `40.5 km/h (95 %: 37.7 to 43.5 km/h)`.
pub(crate) fn told_speed(found: &EstimatedOutput, units: Units) -> String {
    let unit = units.name(Measure::RoadSpeed);
    let [median, interval] = median_and_interval(&found.posterior, units);
    if found.is_given && !found.varies() {
        return format!("{median} {unit}, as given");
    }
    let [low, high] = ends(&found.posterior, WIDEST);
    let range = if low == 0.0 {
        format!("up to {} {unit}", number(units.value(Measure::RoadSpeed, high), 1))
    } else {
        format!("{interval} {unit}")
    };
    if found.is_told() && found.posterior.median.value == 0.0 && high > 0.0 {
        return format!("probably stationary (95 %: {range})");
    }
    // A reader would take the median of such a wide interval, which starts at zero, for a speed that was
    // found.
    let is_far_below = low == 0.0 && (1e-9..high / FAR_ABOVE).contains(&found.posterior.median.value);
    match (found.is_told(), is_far_below) {
        (true, true) => format!("{range} (95 %)"),
        (true, false) => format!("{median} {unit} (95 %: {range})"),
        (false, _) => format!("not determined by the evidence (95 %: {range})"),
    }
}

/// (–) if an interval begins at zero and ends above this many times the median, only its end is shown.
const FAR_ABOVE: f64 = 4.0;

/// Whether the unknown number is a factor on the value that its key names.
pub(crate) fn is_factor(unknown: &UnknownNumber) -> bool {
    matches!(unknown.assumed, Some(Assumed::Ground | Assumed::Drag))
}

/// The key of an unknown number in data.
pub(crate) fn unknown_key(unknown: &UnknownNumber) -> String {
    if is_factor(unknown) { format!("{}.factor", unknown.key) } else { unknown.key.clone() }
}

/// (SI) the size of its unit.
pub(crate) fn factor(unknown: &UnknownNumber) -> f64 {
    unknown.unit.map_or(1.0, case::Unit::factor)
}

pub(crate) fn piece_name(piece: Piece) -> String {
    let (name, vehicle) = match piece {
        Piece::Severity => return "severity of such collisions".to_owned(),
        Piece::Crush => return "crush energy".to_owned(),
        Piece::NoResidualCrush => return "no residual crush (upper bound)".to_owned(),
        Piece::Pdof(id) => ("PDOF", id),
        Piece::SpeedAfter(id) => ("speed after", id),
        Piece::DirectionAfter(id) => ("direction after", id),
        Piece::YawRateAfter(id) => ("yaw rate after", id),
        Piece::RecordedDeltaV(id) => ("recorder's ΔV", id),
        Piece::LeastDeltaV(id) => ("recorder's ΔV (lower bound)", id),
        Piece::RecordedDirection(id) => ("direction of recorder's ΔV", id),
        Piece::Rest(id) => ("rest", id),
        Piece::Points(id) => ("points passed", id),
        Piece::RecordedSpeed(id) => ("recorder's speed", id),
        Piece::RecordedYawRate(id) => ("recorder's yaw rate", id),
        Piece::SkidSpeed(id) => ("speed before the skid", id),
        Piece::Limits(id) => ("certain speed", id),
    };
    format!("{name}, vehicle {vehicle}")
}

/// The error that the estimate gives a piece of evidence, in words; `None` if it has none.
pub(crate) fn error(piece: Piece, observed: &Observed, units: Units) -> Option<String> {
    let of = |id: VehicleId| &observed.vehicles[id.index()];
    let percent = |share: f64| format!("{} %", percent(share));
    let angle = |si: f64| units.format(Measure::Angle, si);
    let rate = |si: f64| units.format(Measure::YawRateDegrees, si);
    let length = |si: f64| units.format(Measure::Length, si);
    // A speed of zero has an error, too.
    let at_zero = |least: f64| match least {
        least if least > 0.0 => format!(", and {} at zero", units.format(Measure::RoadSpeed, least)),
        _ => String::new(),
    };
    let speed = |measured: &MeasuredSpeed| match measured.ln_sd {
        ln_sd if ln_sd > 0.0 => format!("std. dev. {}{}", percent(ln_sd), at_zero(measured.least)),
        _ => format!("std. dev. {}", units.format(Measure::RoadSpeed, measured.least)),
    };
    Some(match piece {
        Piece::Severity | Piece::Limits(_) => return None,
        Piece::Crush | Piece::NoResidualCrush => crush_error(observed)?,
        Piece::Pdof(id) => {
            format!("scale {}, Student's t with 2 degrees of freedom", angle(of(id).pdof?.scale))
        }
        Piece::SpeedAfter(id) => speed(&of(id).after.speed?),
        Piece::DirectionAfter(id) => format!("std. dev. {}", angle(of(id).after.direction?.sd)),
        Piece::YawRateAfter(id) => format!("std. dev. {}", rate(of(id).after.yaw_rate?.sd)),
        Piece::RecordedDeltaV(id) | Piece::LeastDeltaV(id) => {
            let recorder = &of(id).recorder;
            let whole = recorder.delta_v.map(|delta_v| (delta_v.ln_scale, delta_v.least));
            let part = recorder.longitudinal.map(|part| (part.ln_scale, part.least));
            let (scale, least) = whole.or(part)?;
            format!("scale {}{}, Student's t with 3 degrees of freedom", percent(scale), at_zero(least))
        }
        Piece::RecordedDirection(id) => {
            let scale = of(id).recorder.direction?.scale;
            format!("scale {}, Student's t with 2 degrees of freedom", angle(scale))
        }
        Piece::Rest(id) => {
            let rest = of(id).rest?;
            format!(
                "std. dev. {} each way at the measured distance, heading {}: the errors of the computed path \
                 (`rest_error`, `rest_least_error`, `rest_heading_error` of [estimate]) and the range of the case",
                length(rest.position_sd()),
                angle(rest.heading_sd)
            )
        }
        Piece::Points(id) => {
            let greatest = of(id).points.iter().copied().fold(0.0, f64::max);
            format!("std. dev. up to {}", length(greatest))
        }
        Piece::RecordedSpeed(id) => match of(id).recorder.speed? {
            ShownSpeed::One(measured) => speed(&measured),
            ShownSpeed::Either(two) => {
                let road = |si: f64| units.format(Measure::RoadSpeed, si);
                let [one, two] = two.map(|(probability, Measured { value, sd })| {
                    format!(
                        "{} (std. dev. {}) with a probability of {}",
                        road(value),
                        road(sd),
                        percent(probability)
                    )
                });
                format!("{one}, or {two}")
            }
        },
        Piece::RecordedYawRate(id) => format!("std. dev. {}", rate(of(id).recorder.yaw_rate?.sd)),
        Piece::SkidSpeed(id) => speed(&of(id).skid_speed?),
    })
}

/// The error of crush energies, and the factor by which they are multiplied first.
fn crush_error(observed: &Observed) -> Option<String> {
    let CrushErrors([one, two]) = observed.crush?;
    let [first, second] = VehicleId::ALL.map(|id| observed.shared_ln_sd(id));
    let of = |error: &EnergyError, shared: f64| {
        let own = match error.own_ln_sd {
            own if own > 0.0 => format!(" of the method and {} of the vehicle", significant(own, 2)),
            _ => String::new(),
        };
        let first = match error.bias {
            0.0 => String::new(),
            _ => format!(", after multiplying by {}", significant(error.factor(), 3)),
        };
        format!("std. dev. of ln: {}{own}{first}", significant(shared, 2))
    };
    let [one, two] = [of(&one, first?), of(&two, second?)];
    Some(if one == two { one } else { format!("vehicle 1: {one}; vehicle 2: {two}") })
}

/// The error of energies by a typical stiffness.
const AS_FOUND: &str = "Their error is that found in crashes with recorders.";

/// What the error of an energy by the stiffness of the car does not include, where a front struck a fixed
/// object.
const AT_OBJECT: &str = " Crush at a fixed object says less about the energy than crush between two vehicles: with the stiffness \
                         of the fleet, its error in crashes with recorders was three times as great. This error does not \
                         include that; `crush_error` sets a larger one.";

/// The correction and the error of crush energies, for each method that gave one, and why.
pub(crate) fn crush_words(estimated: &Estimated) -> Vec<String> {
    let Some(CrushErrors(errors)) = estimated.observed.crush else { return Vec::new() };
    let misfit = if estimated.is_at_object { FITTED.objects.misfit } else { FITTED.crush_misfit(&[]) };
    let is_default = |key: &str| estimated.default_errors.iter().any(|defaulted| defaulted == key);
    let mut words: Vec<String> = Vec::new();
    for id in VehicleId::ALL {
        let Some(method) = estimated.energies[id.index()] else { continue };
        let error = &errors[id.index()];
        let bias = error.bias;
        let shown = percent(1.0 / error.factor());
        let times = significant(error.factor(), 3);
        // Two cars of different model years have different biases.
        let of_other = estimated.energies[id.other().index()].filter(|other| *other == method);
        let whose = match of_other {
            Some(_) if errors[id.other().index()].bias != bias => format!(" of vehicle {id}"),
            _ => String::new(),
        };
        let (energies, usual_error) = match method {
            EnergyMethod::Class if bias == 0.0 => ("by CRASH3's categories", AS_FOUND),
            EnergyMethod::Class => (
                "by CRASH3's categories",
                "Their error is that found in crashes with recorders, in which ΔV was still a fifth too low on average \
                 where a vehicle was crushed 45 cm or more (docs/calibration.md).",
            ),
            EnergyMethod::Fleet => ("by the stiffness of the fleet", AS_FOUND),
            EnergyMethod::Coefficients => (
                "from the stiffness that the case gives",
                "Their error is the part of the error in real crashes that is not due to the stiffness and, \
                 if the case gives no range for the stiffness, the error of the stiffness (RICSAC).",
            ),
            EnergyMethod::Test => (
                "from a barrier test of the car",
                "Their error is that of CRASH3 on car-to-car tests (Lenard 2000).",
            ),
            EnergyMethod::Ees => (
                "from an EES",
                "Their error is chosen: 10 % of the speed for the method and, if the EES has no range, \
                 another 10 % for each vehicle.",
            ),
            EnergyMethod::OfObject => {
                words.push(object_words(estimated, id));
                continue;
            }
        };
        let energies = format!("Energies{whose} {energies}");
        let bias_words = match (is_default("estimate.crush_bias"), bias == 0.0) {
            (true, false) => format!(
                "{energies} are on average {shown} % of what such an impact takes; they are multiplied by {times} \
                 (docs/calibration.md; {} it).",
                if method == EnergyMethod::Class {
                    "`model_year` and `crush_bias` change"
                } else {
                    "`crush_bias` changes"
                }
            ),
            (true, true) if matches!(method, EnergyMethod::Coefficients | EnergyMethod::Test) => format!(
                "{energies} are taken as right on average, which no crash with a recorder has tested: with the stiffness of \
                 the fleet by barrier tests, energies were on average {} % of what such an impact takes \
                 (docs/calibration.md; `crush_bias` sets such a share).",
                percent(misfit.shown())
            ),
            (true, true) => format!("{energies} are taken as right on average."),
            (false, _) => format!(
                "{energies} are on average {shown} % of the energy of the impact, by `crush_bias` of the case; \
                 they are multiplied by {times}."
            ),
        };
        let is_usual = is_default("estimate.crush_error");
        let error_words = if is_usual { usual_error } else { "Their error is `crush_error` of the case." };
        let is_own = matches!(method, EnergyMethod::Coefficients | EnergyMethod::Test);
        let at_object = if is_usual && is_own && estimated.is_at_object { AT_OBJECT } else { "" };
        let sentence = format!("{bias_words} {error_words}{at_object}");
        if !words.contains(&sentence) {
            words.push(sentence);
        }
    }
    words
}

/// The error of the energy that object `id` absorbed, which is not that of the crush.
fn object_words(estimated: &Estimated, id: VehicleId) -> String {
    let key = format!("vehicle{id}.deformation_energy");
    let has_range = estimated.unknown.iter().any(|unknown| unknown.key == key);
    let error = FITTED.energy_error(EnergyMethod::OfObject, FITTED.objects.misfit, None, has_range);
    let [method, own] = [error.shared_ln_sd, error.own_ln_sd].map(percent);
    if has_range {
        return format!(
            "The energy that deformed the object has the range that the case gives, and the method's error is \
             chosen: {method} %."
        );
    }
    format!(
        "The energy that deformed the object has no range, so its error is chosen: {method} % for the method and \
         {own} % for the object."
    )
}

/// The key of the case that gives the error of a piece; `None` if no key can.
pub(crate) fn error_key(piece: &PieceFound) -> Option<String> {
    Some(match piece.piece {
        Piece::Severity | Piece::Limits(_) => return None,
        Piece::Rest(_) | Piece::Points(_) => "estimate.rest_error".to_owned(),
        Piece::Crush | Piece::NoResidualCrush => "estimate.crush_error".to_owned(),
        Piece::RecordedDeltaV(_)
        | Piece::LeastDeltaV(_)
        | Piece::RecordedSpeed(_)
        | Piece::RecordedYawRate(_) => format!("{}_error", piece.key),
        Piece::RecordedDirection(id) => format!("vehicle{id}.recorder.direction_error"),
        _ => piece.key.clone(),
    })
}

/// The code of the reason why the estimate does not use a value of the case, its words, and what to write
/// instead.
pub(crate) fn unused(reason: UnusedReason) -> [&'static str; 3] {
    match reason {
        UnusedReason::Sought => [
            "sought",
            "`find` of [reconstruct] seeks this speed",
            "leave [reconstruct] out if the speed is known",
        ],
        UnusedReason::Inferred => [
            "inferred",
            "it was not measured but follows from the other vehicle's force",
            "its own depths, or leave it out",
        ],
        UnusedReason::NoEnergy => [
            "no_energy",
            "the crush of both vehicles absorbed no energy, and no speed follows from zero",
            "depths or an EES above zero; crush = \"none\" if there is no damage",
        ],
        UnusedReason::NoCrush => [
            "no_crush",
            "the crush of the vehicle that struck the object is not known",
            "the crush of that vehicle, too; crush = \"none\" if it has no damage",
        ],
        UnusedReason::NoDirection => [
            "no_direction",
            "a vehicle that was stationary after the impact left in no direction",
            "a speed above zero, or leave it out",
        ],
        UnusedReason::OneWreck => [
            "one_wreck",
            "vehicles locked together do not rebound (e = 0) and do not slip on each other at the end (μ = μ_c)",
            "nothing: `locked_together` decides it",
        ],
        UnusedReason::OtherLaw => [
            "other_law",
            "its law, not Brach's, decides whether the vehicles separate",
            "law = \"brach\" in [impact], or no law",
        ],
        UnusedReason::WithMoment => [
            "with_moment",
            "the law with `moment_restitution` decides whether the vehicles separate",
            "no `moment_restitution` in [impact]",
        ],
        UnusedReason::NoImpact => [
            "no_impact",
            "the record holds no ΔV of an impact",
            "nothing: `deltav recorder` shows what it holds",
        ],
        UnusedReason::OnlyLateral => [
            "only_lateral",
            "only the lateral part of ΔV is known, and its error alone was never tested",
            "the longitudinal part as well",
        ],
        UnusedReason::OtherImpact => [
            "other_impact",
            "it is not likely to be of this impact, or less likely than another record",
            "this record alone, without `records`, if it is of this impact: `deltav recorder` weighs them",
        ],
        UnusedReason::StoodByRecord => [
            "stood_by_record",
            "according to it the vehicle was stationary or crawling, and the error of such a speed is not \
             proportional to it",
            "speed = \"0 km/h\" in the table of the vehicle",
        ],
        UnusedReason::Phases => [
            "phases",
            "only `deltav avoid` uses the phases before the impact",
            "the speed to which they lead as `speed` of the vehicle, with its range",
        ],
        UnusedReason::OtherPdof => [
            "other_pdof",
            "both PDOFs are one observation: the one with the smaller error counts, or the mean of two with the same",
            "nothing: they are counted once",
        ],
        UnusedReason::PdofsDiffer => [
            "pdofs_differ",
            "the two PDOFs cannot belong to one force (see the warning); for each collision drawn, the PDOF \
             nearer to it counts",
            "the correct PDOF or heading; one of them is wrong",
        ],
        UnusedReason::Wreck => [
            "wreck",
            "each vehicle is followed to its rest as if it moved alone, but this one was joined to the other",
            "`speed` and `direction` of the wreck in its table `after`: v = √(2 a S), with the length S of its path \
             and the mean deceleration a of both together",
        ],
        UnusedReason::NotFollowed => [
            "not_followed",
            "the vehicle cannot be followed to its rest",
            "`friction` of [surface] and `drag` of its table `after`",
        ],
        UnusedReason::NoPlace => [
            "no_place",
            "it counts only for a vehicle that is followed to its rest or points",
            "`rest` or `points` in the table `after`, or leave this out",
        ],
        UnusedReason::NoRest => [
            "no_rest",
            "it counts only for a vehicle that is followed to its rest",
            "`rest` in the table `after`, or leave this out",
        ],
        UnusedReason::NoCrushEnergy => [
            "no_crush_energy",
            "no crush energy is used here",
            "`crush` or an EES in the table of a vehicle, or leave this out",
        ],
        UnusedReason::NoSpeeds => [
            "no_speeds",
            "these are the errors of a table of speeds, which this recorder does not give",
            "`pre_crash`; `speed_error` for a single speed",
        ],
        UnusedReason::NoneStood => [
            "none_stood",
            "the speed of each vehicle is known, or it certainly moved",
            "nothing: leave this out",
        ],
        UnusedReason::FlatPrior => [
            "flat_prior",
            "the flat prior has no severity: every speed is as likely as any other",
            "another `prior`, or leave this out",
        ],
        _ => ["other", "the estimate does not use it", "nothing"],
    }
}

/// The source of the assumption about an unknown number.
pub(crate) fn source(unknown: &UnknownNumber, assumed: Assumed) -> &'static str {
    match assumed {
        Assumed::Heading | Assumed::CrushPlane | Assumed::Contact => "how well it is usually known; chosen",
        Assumed::Mass => SMITH_NOGA,
        Assumed::Load => "a share of it, because few loads are weighed; chosen",
        Assumed::Estimate if unknown.key.contains("stiffness") => BARRIER_TESTS,
        Assumed::Estimate => "as `deltav uncertainty` varies it",
        Assumed::Speed => "before the severity and the weight of the speeds are applied; chosen",
        Assumed::Coefficient if unknown.key == "impact.restitution" => {
            "about the value of the case; spread: Brach, Smith and Tsongas, Rose"
        }
        Assumed::Coefficient => "about the value of the case; spread chosen",
        Assumed::Friction => "chosen",
        Assumed::TangentialShare => "RICSAC (theory 6)",
        Assumed::OtherCrush => "329 crashes of 2017 (CISS); docs/calibration.md",
        Assumed::Ground | Assumed::Drag => STAGED_MOTION,
        _ => "",
    }
}

/// The name of a doubt in data.
pub(crate) fn doubt_code(doubt: &SamplerDoubt) -> &'static str {
    match doubt {
        SamplerDoubt::Unfinished { .. } => "unfinished",
        SamplerDoubt::HardlyPossible { .. } => "hardly_possible",
        SamplerDoubt::EvidenceSpread { .. } => "evidence_spread",
        SamplerDoubt::Disagreement { .. } => "disagreement",
        SamplerDoubt::FewDraws { .. } => "few_draws",
        SamplerDoubt::Extremes { .. } => "extremes",
        SamplerDoubt::FewAncestors(_) => "few_ancestors",
        SamplerDoubt::StoodStill { .. } => "stood_still",
        _ => "other",
    }
}

/// The key of the quantity that a doubt is about.
pub(crate) fn doubted(doubt: &SamplerDoubt, estimated: &Estimated) -> Option<String> {
    let quantity = match doubt {
        SamplerDoubt::Disagreement { quantity, .. }
        | SamplerDoubt::FewDraws { quantity, .. }
        | SamplerDoubt::Extremes { quantity, .. } => *quantity,
        SamplerDoubt::FewAncestors(mode) => mode.quantity,
        _ => return None,
    };
    match quantity {
        DrawnQuantity::Value(place) => estimated.unknown.get(place).map(unknown_key),
        DrawnQuantity::Output(place) => estimated.outputs.get(place).map(|output| output.output.path()),
    }
}

/// A doubt as a sentence without its full stop.
pub(crate) fn doubt_words(doubt: &SamplerDoubt, estimated: &Estimated) -> String {
    let key = doubted(doubt, estimated).unwrap_or_default();
    match doubt {
        SamplerDoubt::Unfinished { temperature } => format!(
            "the sampler could use only {} % of the evidence, which is too precise for it",
            percent(*temperature)
        ),
        SamplerDoubt::HardlyPossible { possible, drawn, .. } => {
            format!("of {drawn} collisions drawn before the evidence, only {possible} are possible at all")
        }
        SamplerDoubt::EvidenceSpread { .. } => {
            "independent runs differ in how well the evidence fits, so a few of them dominate the answer"
                .to_owned()
        }
        SamplerDoubt::Disagreement { r_hat, .. } => {
            format!(
                "independent runs disagree on `{key}` (R̂ is {}, and may be at most 1.01)",
                significant(*r_hat, 4)
            )
        }
        SamplerDoubt::FewDraws { ess, .. } => format!(
            "the draws of `{key}` are worth only {ess:.0} independent ones, but {} are needed",
            ::estimate::ESS_LIMIT
        ),
        SamplerDoubt::Extremes { ess, .. } => format!(
            "the extremes of `{key}` are worth only {ess:.0} independent draws, but {} are needed",
            ::estimate::EXTREME_ESS_LIMIT
        ),
        SamplerDoubt::FewAncestors(mode) => format!(
            "{} % of the draws form a separate cluster in `{key}` that draws before the evidence rarely \
            reach",
            percent(mode.share)
        ),
        SamplerDoubt::StoodStill { unmoved } => {
            format!("{} % of the particles did not move at the end", percent(*unmoved))
        }
        other => other.to_string(),
    }
}
