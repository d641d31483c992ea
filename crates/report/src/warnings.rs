//! The sentence of each warning.

use analysis::{
    Analysis, Check, CheckedQuantity, DELTA_V_DIFFERENCE, Drive, ENERGY_DIFFERENCE, Evident, FAST_CLOSING,
    FASTEST_BACK, FASTEST_BELIEVED, HIGH_RESTITUTION, JumpSide, Magnitude, NEARLY_STOOD, POINT_MISSED, Seen,
    SeenWarning, Warning, Weighed,
};
use case::{Basis, Case, ContactSpread, StiffnessSource, TypicalStiffness, VehicleKind};
use crash3::Side;
use evidence::FLEET_YEARS;
use pim_core::{Switch, VehicleId};

use crate::basis::short;
use crate::document::{Block, Document};
use crate::units::{FOOT, Measure, Units, number};
use crate::words::quoted;
use crate::{axes, basis, words};

/// The reference to further information on a warning.
const MORE: &str = "`deltav explain CODE` says what a warning means for the answer and what to check; the code is in \
                    brackets.";

/// The warnings as a part of a document.
pub(crate) fn block(warnings: &[SeenWarning], units: Units) -> Block {
    let sentence = |seen: &&SeenWarning| (seen.warning().code(), message(seen, units));
    let (common, special): (Vec<_>, Vec<_>) = warnings.iter().partition(|seen| seen.warning().is_common());
    Block::Warnings { warnings: special.iter().chain(&common).map(sentence).collect(), more: MORE }
}

/// The warnings of an analysis alone; empty if it has none.
#[must_use]
pub fn warnings(case: &Case, analysis: &Analysis, units: Units) -> Document {
    let mut page = Document::new();
    page.blocks.extend(of_analysis(analysis, case, units));
    page
}

/// The same for documents made from an analysis: empty if it has no warnings.
pub(crate) fn of_analysis(analysis: &Analysis, case: &Case, units: Units) -> Vec<Block> {
    let seen = analysis.seen(case.axes);
    let warnings = &seen.warnings;
    let warned = (!warnings.is_empty()).then(|| block(warnings, units));
    left_aside(&analysis.left_aside, analysis.can_be_weighed).into_iter().chain(warned).collect()
}

/// The warnings on the answer, and those on an exact solution that is not the answer. All of the evidence,
/// `weighed`, may have warnings of its own.
pub(crate) fn of_answer(seen: &Seen, weighed: Option<&Weighed>, is_exact: bool) -> [Vec<SeenWarning>; 2] {
    let is_aside = |seen: &SeenWarning| !is_exact && seen.warning().is_of_exact_solution();
    let (aside, mut of_answer): (Vec<_>, Vec<_>) = seen.warnings.iter().cloned().partition(is_aside);
    let weighed = weighed.map_or(&[][..], |weighed| &weighed.estimated.warnings);
    of_answer.extend(
        weighed
            .iter()
            .filter(|warning| warning.is_of_exact_solution())
            .map(|warning| warning.seen(seen.axes)),
    );
    [of_answer, aside]
}

/// Names the evidence that an answer does not use, if there is any.
pub(crate) fn left_aside(keys: &[String], can_be_weighed: bool) -> Option<Block> {
    let words = || {
        let keys = quoted(keys, ", ");
        let who = if can_be_weighed {
            "`deltav estimate` weighs all of it."
        } else {
            "`deltav check` says what `deltav estimate` needs to weigh it."
        };
        format!("Evidence in the case that these figures do not use: {keys}. {who}")
    };
    (!keys.is_empty()).then(|| Block::Paragraph(words()))
}

/// The codes of the uncommon warnings, each once.
pub(crate) fn special_codes(warnings: &[SeenWarning]) -> Vec<&'static str> {
    let mut codes = Vec::new();
    for warning in warnings.iter().map(SeenWarning::warning).filter(|warning| !warning.is_common()) {
        if !codes.contains(&warning.code()) {
            codes.push(warning.code());
        }
    }
    codes
}

/// The number of warnings for the top of a report, with the codes of the uncommon ones and the heading that
/// lists them; `None` if all are common.
pub(crate) fn notice(warnings: &[SeenWarning], heading: Option<&'static str>) -> Option<Block> {
    let codes = special_codes(warnings);
    let count = match warnings.len() {
        1 => "1 warning".to_owned(),
        several => format!("{several} warnings"),
    };
    let some_are_common = warnings.iter().any(|seen| seen.warning().is_common());
    let named = codes.join(", ");
    let count =
        if some_are_common { format!("{count}, among them {named}") } else { format!("{count} ({named})") };
    (!codes.is_empty()).then_some(Block::Notice { count, heading })
}

/// The spread of a placed contact point in the samples of `uncertainty`: along the face and across it.
fn spread_of_contact([along, across]: [ContactSpread; 2], units: Units) -> String {
    let by = |spread: ContactSpread| match spread {
        ContactSpread::Default(sd) => {
            format!("with a standard deviation of {}", units.format(Measure::Crush, sd))
        }
        ContactSpread::OfInputs => "as the ranges of the damage do".to_owned(),
        ContactSpread::Exact => "not at all, as the file asks".to_owned(),
    };
    if [along, across] == [ContactSpread::Exact; 2] {
        return "`uncertainty` takes it as exact, as the file asks".to_owned();
    }
    format!("`uncertainty` varies it along the face {} and across it {}", by(along), by(across))
}

/// Why such a restitution is impossible.
fn why_not(restitution: f64) -> &'static str {
    if restitution < 0.0 {
        "below 0 the vehicles would have passed through each other"
    } else {
        "above 1 the vehicles would have parted faster than they met"
    }
}

/// A failed check of momentum, in words.
pub(crate) fn momentum_differs(check: &Check, units: Units) -> String {
    let angle = |si: f64| units.format(Measure::Angle, si);
    let energy = |si: f64| units.format(Measure::Energy, si);
    let rate = |si: f64| units.format(Measure::YawRateDegrees, si);
    match check.quantity {
        CheckedQuantity::MomentumEnergy { normal_work, crush_energy, tangential_share } => format!(
            "{} would be {}, but the crush energy is {}",
            match tangential_share {
                0.0 => "the normal work".to_owned(),
                share => basis::work_of_share(share),
            },
            energy(normal_work),
            energy(crush_energy)
        ),
        CheckedQuantity::MomentumAcross { vehicle, surplus } => format!(
            "across the heading of vehicle {vehicle} the vehicles had {} more momentum after the impact than before, which no \
             speed of vehicle {vehicle} explains",
            units.format(Measure::Impulse, surplus.abs())
        ),
        CheckedQuantity::MomentumBalance { difference, impulse } => format!(
            "the velocities after the impact imply impulses on the two vehicles that differ by {}, more than their mean of {}, \
             so they say nothing of the impact itself",
            units.format(Measure::Impulse, difference),
            units.format(Measure::Impulse, impulse)
        ),
        CheckedQuantity::PossibleRestitution { implied } => {
            format!(
                "the restitution would be {}, which is impossible: {}",
                number(implied, 2),
                why_not(implied)
            )
        }
        CheckedQuantity::MomentumRestitution { implied, given } => {
            let said = format!(
                "the restitution would be {}, but the case has {}",
                number(implied, 2),
                number(given, 2)
            );
            if (0.0..=1.0).contains(&implied) {
                said
            } else {
                format!("{said}; the former is impossible: {}", why_not(implied))
            }
        }
        CheckedQuantity::MomentumRatio { implied, critical } => format!(
            "the impulse ratio would be {}, but friction allows only 0 to {}",
            number(implied, 2),
            number(critical, 2)
        ),
        CheckedQuantity::MomentumYawRate { vehicle, implied, told } => format!(
            "the impulse at C would leave vehicle {vehicle} turning at {}, whereas the motion after the impact requires {}",
            rate(implied),
            rate(told)
        ),
        CheckedQuantity::MomentumPdof { vehicle, implied, given } => format!(
            "the PDOF of vehicle {vehicle} would be {}, but the case has {}",
            angle(implied),
            angle(given)
        ),
        CheckedQuantity::ForceBalance
        | CheckedQuantity::PdofsOpposite
        | CheckedQuantity::DamageEnergy { .. }
        | CheckedQuantity::Restitution
        | CheckedQuantity::Rotation { .. }
        | CheckedQuantity::PointMissed { .. }
        | CheckedQuantity::RestMissed { .. } => String::new(),
    }
}

/// The sentence of a warning, in the units of the reader.
#[must_use]
pub fn message(seen: &SeenWarning, units: Units) -> String {
    let (warning, axes) = (seen.warning(), seen.axes());
    let speed = |si: f64| units.speed(si);
    let angle = |si: f64| units.format(Measure::Angle, si);
    match warning {
        Warning::PlaneDoesNotSeparate => {
            "the crush plane through the contact point does not lie between the two \
            centres of gravity; check the crush plane's angle and the contact points"
                .to_owned()
        }
        Warning::ContactOutside { vehicle, distance } => format!(
            "the contact point lies {} outside the outline of vehicle {vehicle}, but the resultant impulse \
             acts within the damage",
            units.format(Measure::Length, *distance)
        ),
        Warning::HighRestitution { restitution, closing_speed } => format!(
            "a restitution of {} at a closing speed of {} is high: above {} m/s ({} ft/s), tests show \
             {HIGH_RESTITUTION} or less",
            short(*restitution, 4),
            speed(*closing_speed),
            number(FAST_CLOSING, 0),
            number(FAST_CLOSING / FOOT, 0)
        ),
        Warning::ForceBalance { forces: [f1, f2] } => {
            let factor = f1.max(*f2) / f1.min(*f2);
            let differ = if factor.is_finite() {
                format!(" by a factor of {}", number(factor, 2))
            } else {
                String::new()
            };
            format!(
                "the peak forces that follow from the crush differ{differ}: {} on vehicle 1, {} on vehicle \
                 2; by Newton's third law they must be equal, so check stiffness, damage width and depths",
                units.format(Measure::Force, *f1),
                units.format(Measure::Force, *f2)
            )
        }
        Warning::PdofDiffers { vehicle, given, computed, limit } => format!(
            "the PDOF given for vehicle {vehicle}, {}, differs from that of the impulse, {}, by more than {:.0}°",
            angle(*given),
            angle(*computed),
            limit.to_degrees()
        ),
        Warning::MomentumDiffers { checks } => {
            let said: Vec<String> = checks.iter().map(|check| momentum_differs(check, units)).collect();
            format!(
                "the velocities after the impact do not agree with the rest of the evidence: {}; \
                 check the rest positions, the drag and the friction, and then the damage, the contact \
                 points and the crush plane",
                said.join("; ")
            )
        }
        Warning::EvidenceDiffers { vehicle, evidence, given, found } => {
            let said = |si: f64| match evidence {
                Evident::DirectionAfter => angle(si),
                Evident::RecordedYawRate | Evident::YawRateAfter => units.format(Measure::YawRateDegrees, si),
                _ => speed(si),
            };
            format!(
                "{} of vehicle {vehicle}, {}, contradicts this answer, which gives {} without using it; \
                 check both, and let `deltav estimate` weigh them",
                words::evident(*evidence),
                said(*given),
                said(*found)
            )
        }
        Warning::BelowRecord { vehicle, recorded, found } => format!(
            "the recorder of vehicle {vehicle} had stored a ΔV of {} when its record ended, so the whole ΔV \
             is greater, but this answer gives at most {}; check the mass, the crush and the PDOF, and that \
             the record is of this impact",
            speed(*recorded),
            speed(*found)
        ),
        Warning::RestsOverlap { depth } => format!(
            "at rest, the outlines of the two vehicles overlap by {}, more than their crush explains; check both rest \
             positions and headings, and the dimensions of the bodies",
            units.format(Measure::Length, *depth)
        ),
        Warning::SkidAboveRecord { vehicle, recorded, found } => format!(
            "the skid of vehicle {vehicle} begins at {} or more, but its recorder stored at most {} before the impact; \
             check the length and the friction of the skid, that the marks are of this vehicle, and that the record \
             is of this impact",
            speed(*found),
            speed(*recorded)
        ),
        Warning::CategoryEnergy { of, share, is_alone, is_year_assumed } => {
            let cars = if *is_year_assumed {
                "cars of about 2010 (give `model_year` if it differs)"
            } else {
                "cars of the stated `model_year`"
            };
            let stiffness = format!(
                "the stiffness of {} is from a category of CRASH3's table, which describes cars of the 1970s: for {cars},",
                vehicles(*of)
            );
            let instead = "prefer a stiffness that was measured on this model, or stiffness = \"fleet\" for a newer car";
            too_small(&stiffness, *share, *is_alone, instead)
        }
        Warning::FleetEnergy { of, share, is_alone } => {
            let stiffness = format!("the stiffness of {} is that of the fleet:", vehicles(*of));
            too_small(&stiffness, *share, *is_alone, "prefer a stiffness that was measured on this model")
        }
        Warning::SkidDirection { vehicle, skid, course } => format!(
            "the skid marks of vehicle {vehicle} run from the place `from` to the impact in the direction {}, \
             but the vehicle travelled in the direction {}; check the place, the signs of its coordinates, and \
             the heading",
            angle(*skid),
            angle(*course)
        ),
        Warning::WreckAlone { vehicle } => format!(
            "vehicle {vehicle} is followed to its rest as if it moved alone, but it left as one wreck with \
             vehicle {}, which pulled and turned it, so its speed after the impact may be far off; give the \
             wreck's `speed` and `direction` in place of \
             `rest` and `points`: v = √(2 a S), with the length S of its path and the mean deceleration a of both together",
            vehicle.other()
        ),
        Warning::SkidOnGrade { vehicle } => format!(
            "the skid of vehicle {vehicle} before the impact is computed as on level ground: the grade of \
             [surface] applies only after the impact. Uphill, the vehicle lost more speed in the skid than \
             computed; downhill, less. Give the skid a `friction` of its own that includes the grade"
        ),
        Warning::SeveralStarts { vehicle, used, others } => {
            let told = |[v, rate]: [f64; 2]| {
                format!("{} at {}", speed(v), units.format(Measure::YawRateDegrees, rate))
            };
            let others: Vec<String> = others.iter().map(|&start| told(start)).collect();
            format!(
                "several motions after the impact bring vehicle {vehicle} to its rest: {} is used, and {} \
                 would fit as well; give a point of its path, or by how much it turned",
                told(*used),
                others.join(", ")
            )
        }
        Warning::PointMissed { vehicle, point, pass } => format!(
            "the path of vehicle {vehicle} to its rest misses point {point} by {}, more than {} % of \
             the path; check the point, the rest, the drag, the friction and the steer, and whether the vehicle \
             was struck again",
            words::pass(pass, units),
            number(100.0 * POINT_MISSED, 0)
        ),
        Warning::RestMissed { vehicle, miss, share } => format!(
            "the computed path of vehicle {vehicle} ends {} from its measured rest, {} % of the path, and \
             no motion with little yaw ends nearer; its speed after the impact is uncertain to the same \
             degree: check the \
             rest, the heading at rest, the drag and the steer",
            units.format(Measure::Length, *miss),
            number(100.0 * share, 0)
        ),
        Warning::AngleCapped { vehicle, oblique_angle } => format!(
            "the force meets the damaged side of vehicle {vehicle} at {} to its normal; CRASH3 limits that to 45°, \
             a correction factor of 2",
            angle(*oblique_angle)
        ),
        Warning::SideNotPushed { vehicle, oblique_angle } => format!(
            "the force on vehicle {vehicle} makes an angle of {} with the normal of the damaged side, so it \
             does not push on that side, and CRASH3 has no corrected energy, peak force or ΔV for it; check \
             side, PDOF and headings",
            angle(*oblique_angle)
        ),
        Warning::DeltaVDiffers { impact, crash3, restitution } => {
            let of_all = |values: &[Option<f64>; 2]| {
                let known: Vec<String> = values.iter().flatten().map(|&si| speed(si)).collect();
                known.join(" and ")
            };
            format!(
                "CRASH3's ΔV {} restitution, {}, differs by more than {} % from the impact's, {}",
                if *restitution { "with the same" } else { "without" },
                of_all(crash3),
                number(100.0 * DELTA_V_DIFFERENCE, 0),
                of_all(impact)
            )
        }
        Warning::SeveralSpeeds { answer, others } => {
            let all: Vec<String> = others.iter().map(|&si| speed(si)).collect();
            format!(
                "the damage fits several speeds: {}, which is the answer, but also {}; of those that \
                 certain_speed allows (without it, 0 to {}), the answer has the least motion of the vehicles \
                 relative to each other; the damage cannot show that it is right: give certain_speed, rest \
                 positions or marks if you have them",
                speed(*answer),
                all.join(", "),
                units.format(Measure::RoadSpeed, FASTEST_BELIEVED)
            )
        }
        Warning::MovesBackward { vehicle, speed: si, found: true } => format!(
            "the speed found for vehicle {vehicle} is {}, so it would have moved backwards; {} the heading, the \
             crush energy and what was measured after the impact",
            speed(*si),
            if *si > NEARLY_STOOD {
                "a stationary vehicle comes out like this if the inputs are slightly off; otherwise check"
            } else {
                "a stationary vehicle does not come out like this: check"
            }
        ),
        Warning::MovesBackward { vehicle, speed: si, found: false } => format!(
            "the speed given for vehicle {vehicle} is {}, so it moves backwards; check the sign and the \
             heading",
            speed(*si)
        ),
        Warning::RecordUncertain { vehicle, used, probability } => {
            let percent = number(100.0 * probability, 0);
            match used {
                Some(record) => format!(
                    "the recorder of vehicle {vehicle} has several records. The answer uses records[{record}] as that of this impact, with a \
                     probability of only {percent} %: compute the case with each record alone as well, and list the other impacts in \
                     `other_impacts`"
                ),
                None => format!(
                    "the recorder of vehicle {vehicle} has several records, and it is not known which one is \
                     of this impact (the most likely one with {percent} %), so none is used: give `pdof` or \
                     the damage, or list the other impacts in `other_impacts`"
                ),
            }
        }
        Warning::NotLocked { parting } => format!(
            "by `locked_together`, the vehicles left the impact as one body, whose centres of gravity keep their distance; by the velocities in their \
             `after` tables, these {} at {}. Leave out one of the velocities, so that it follows from the other, or leave out `locked_together`",
            if *parting > 0.0 { "part" } else { "close" },
            units.road_speed(parting.abs())
        ),
        Warning::MayHaveBacked { vehicle, speed: found } => format!(
            "vehicle {vehicle} may have moved backward{}, but the estimate excludes this unless the case allows it: to allow it, write \
             certain_speed = {{ at_least = \"-{:.0} km/h\" }} in [vehicle{vehicle}]",
            found.map_or_else(String::new, |found| {
                format!(" (an exact solution gives it {})", units.road_speed(found))
            }),
            3.6 * FASTEST_BACK
        ),
        Warning::ClassValues { vehicle, class, yaw_inertia, outline } => {
            let mut assumed = Vec::new();
            if let Some(inertia) = yaw_inertia {
                assumed.push(format!(
                    "a yaw inertia of {} (its radius of gyration may be ±{} % off)",
                    units.format(Measure::YawInertia, *inertia),
                    number(100.0 * crash3::CLASS_SPREAD, 0)
                ));
            }
            if let Some(outline) = outline {
                let [length, width, front] = outline.map(|si| units.format(Measure::Length, si));
                assumed.push(format!(
                    "a body of {length} by {width} with the centre of gravity {front} behind its front"
                ));
            }
            format!(
                "vehicle {vehicle} has typical values of CRASH3's size class {class} (SAE 870045): {}",
                assumed.join("; ")
            )
        }
        Warning::BurgInertia { vehicle, yaw_inertia } => format!(
            "the yaw inertia of vehicle {vehicle} was estimated from mass, wheelbase and length (Burg: I = 0.1269 × mass × wheelbase × length) as {}; \
             its radius of gyration may be ±{} % off",
            units.format(Measure::YawInertia, *yaw_inertia),
            number(100.0 * crash3::BURG_SPREAD, 0)
        ),
        Warning::InferredEnergy { vehicle, force, crush: [width, depth], energy, bounds } => {
            let crush = if *depth > 0.0 {
                format!("a uniform crush of {}", units.format(Measure::Crush, *depth))
            } else {
                "no residual crush, only elastic energy".to_owned()
            };
            let bounds = bounds.map_or_else(String::new, |bounds| {
                let [least, most] = bounds.map(|si| units.format(Measure::Energy, si));
                format!("; the width is not known, so the energy may be anywhere between {least} and {most}")
            });
            format!(
                "the crush of vehicle {vehicle} was not measured but inferred from the force of {} on the other vehicle: {crush} over {}, {}{bounds}",
                units.format(Measure::Force, *force),
                units.format(Measure::Crush, *width),
                units.format(Measure::Energy, *energy)
            )
        }
        Warning::DamageCentroid { vehicle, point: [forward, aside], side, offset_given } => {
            let assumed = if *offset_given {
                String::new()
            } else {
                let middle = words::undisplaced(*side);
                format!("; no offset is given, so the middle of the damage is assumed to lie {middle}")
            };
            format!(
                "the force on vehicle {vehicle} is assumed to act through the centroid of its damage, {} \
                 forward and {} {} of the \
                 centre of gravity{assumed}",
                units.format(Measure::Length, *forward),
                units.format(Measure::Length, *aside),
                axes::side_of_y(axes)
            )
        }
        Warning::ContactApart { distance, with_scene } => format!(
            "the contact point lies in two places, {} apart: {}; check the places, the headings and the \
             contact points: the vehicles touched at one point",
            units.format(Measure::Length, *distance),
            if *with_scene {
                "where [scene] has it, and where the `position` of a vehicle and its contact point put it"
            } else {
                "where the `position` of vehicle 1 and its contact point put it, and where those of vehicle 2 do"
            }
        ),
        Warning::ContactPlaced { vehicle, point: [forward, aside], spread } => format!(
            "the file gives no contact point for vehicle {vehicle}: C was placed at the centroid of its damage, \
             {} forward and {} {} of the centre of gravity, from side, width, depths and offset of the \
             damage and the outline; {}",
            units.format(Measure::Length, *forward),
            units.format(Measure::Length, *aside),
            axes::side_of_y(axes),
            spread_of_contact(*spread, units)
        ),
        Warning::PdofsNotOpposite { angle: off } => format!(
            "the two directions of force that the file gives are {} from opposite in the scene; by Newton's \
             third law they must be opposite, so check both PDOFs and headings",
            angle(*off)
        ),
        Warning::DamageEnergyDiffers { normal_work, crush_energy, basis, on_other_basis } => {
            let energy = |si: f64| units.format(Measure::Energy, si);
            let (is, other) = match basis {
                Basis::Dissipated | Basis::TangentialShare(_) => ("dissipated", "absorbed"),
                Basis::Absorbed => ("absorbed", "dissipated"),
            };
            let (bases, check) = match on_other_basis {
                Some(on_other) => (
                    format!(" on the energy basis `{is}` ({} on `{other}`)", energy(*on_other)),
                    "; also check `energy_basis` in [reconstruct]",
                ),
                None => (String::new(), ""),
            };
            format!(
                "{}, {}, differs by more than {} % from the value that follows from the crush energy, \
                 {}{bases}: the speeds and the damage are inconsistent with each other{check}",
                basis::work(*basis),
                energy(*normal_work),
                number(100.0 * ENERGY_DIFFERENCE, 0),
                energy(*crush_energy)
            )
        }
        Warning::RotationOpposes { vehicle, pdof, turned } => format!(
            "the impact changed the yaw rate of vehicle {vehicle} by {}, but a force with the PDOF {} \
             through its contact point would turn it the \
             other way; check PDOF, contact point and crush plane",
            units.format(Measure::YawRate, *turned),
            angle(*pdof)
        ),
        Warning::GivenSpeedUnused { vehicle, given, is_direction_used: true, found } => format!(
            "the file gives vehicle {vehicle} a velocity of {}, but only its direction was used: the speed \
             found along it is {}; to give the direction alone, write `sideslip` in place of `velocity`",
            speed(*given),
            speed(*found)
        ),
        Warning::GivenSpeedUnused { vehicle, given, is_direction_used: false, found } => format!(
            "the file gives vehicle {vehicle} a speed of {}, but it was not used: the speed found is {}",
            speed(*given),
            speed(*found)
        ),
        Warning::SlidingDriven { tangential_work, energy_loss, sliding, cause } => format!(
            "the work of the tangential impulse is {}, {} of the energy loss: {}",
            units.format(Measure::Energy, *tangential_work),
            share(*tangential_work, *energy_loss),
            drive(*cause, *sliding, units)
        ),
        Warning::RotationDriven { moment_work, energy_loss, moment_restitution } => format!(
            "the moment impulse drives the rotation: its work is {}, {} of the energy loss; {}",
            units.format(Measure::Energy, *moment_work),
            share(*moment_work, *energy_loss),
            if *moment_restitution > 0.0 {
                format!(
                    "a moment restitution of {moment_restitution} turns the vehicles beyond a common yaw \
                     rate, so give 0 or less"
                )
            } else {
                "the impulse at the contact point alone would reverse the relative rotation of the \
                 vehicles, and the moment that keeps them together then acts along that rotation; check \
                 contact points and yaw rates, or leave out `moment_restitution`"
                    .to_owned()
            }
        ),
        Warning::LargeImpulseRatio { impulse_ratio, limited } => format!(
            "with an impulse ratio μ of {} the surfaces pull along the crush plane harder than they push; a \
             ratio above 1 needs justification, such as interlocking parts: check the crush plane and the \
             contact points, {}",
            number(*impulse_ratio, 2),
            if *limited {
                "and the friction limit"
            } else {
                "or give a friction limit, `tangential = { friction = 0.5 }`, for surfaces that slide"
            }
        ),
        Warning::NearJump { border, given, sides: [one, other] } => {
            let (near, [here, there]) = match border {
                Switch::Limit(needed) => (
                    format!(
                        "the full impulse needs a friction limit of {}, which is within 1 % of the limit given, {}",
                        number(*needed, 4),
                        number(*given, 4)
                    ),
                    ["the full impulse", "sliding"],
                ),
                Switch::Direction(sliding) => (
                    format!(
                        "the normal impulse alone would just end a sliding velocity of u_t = {}, which is \
                         within 1 % of the one before the impact, {}",
                        speed(*sliding),
                        speed(*given)
                    ),
                    ["sliding as in the answer", "sliding the other way"],
                ),
            };
            format!(
                "{near}, and the answer of the law jumps there: {here} gives {}; {there} gives {}. Neither \
                 is more certain than the other, so report both",
                jump_side(one, units),
                jump_side(other, units)
            )
        }
        Warning::ContactOffDamage { vehicle, side, distance } => format!(
            "the contact point of vehicle {vehicle} lies {} beyond the end of the damage to its {}, as \
             placed by `offset` and width; the resultant impulse acts within the damage, so check the signs \
             of `contact` and `offset`",
            units.format(Measure::Crush, *distance),
            side_name(*side)
        ),
        Warning::ContactOtherHalf { vehicle, side, distance } => format!(
            "the contact point of vehicle {vehicle} lies {} {}, but the damage is to its {}; check the sign of `contact`{}",
            units.format(Measure::Crush, *distance),
            match side {
                Side::Front => "behind the centre of gravity",
                Side::Rear => "ahead of the centre of gravity",
                Side::Left => "to the right of the vehicle's axis",
                Side::Right => "to the left of the vehicle's axis",
            },
            side_name(*side),
            match side {
                Side::Left | Side::Right => ", and `axes` in [scene], which sets the positive side of y",
                Side::Front | Side::Rear => "",
            }
        ),
        Warning::ContactDepth { vehicle, side, distance } => format!(
            "the contact point of vehicle {vehicle} lies {} behind the deepest crush of its {}; `contact` is measured from the centre of gravity, so \
             check its unit, and that it is not measured from the {}",
            units.format(Measure::Crush, *distance),
            side_name(*side),
            match side {
                Side::Front | Side::Rear => "bumper",
                Side::Left | Side::Right => "side of the body",
            }
        ),
        Warning::DamageOutside { vehicle, side, distance } => format!(
            "the damage to the {} of vehicle {vehicle} reaches {} beyond the end of that side; check its width and `offset`",
            side_name(*side),
            units.format(Measure::Crush, *distance)
        ),
        Warning::Implausible { vehicle, magnitude, value, usual: [low, high], kind, others } => {
            let (name, quantity) = match magnitude {
                Magnitude::Mass => ("mass", Measure::Mass),
                Magnitude::YawRadius => ("radius of gyration √(I/m)", Measure::Length),
                Magnitude::Length => ("length", Measure::Length),
                Magnitude::BodyWidth => ("width", Measure::Length),
                Magnitude::Speed => ("speed", Measure::RoadSpeed),
                Magnitude::SpeedFound => ("speed found", Measure::RoadSpeed),
                Magnitude::CrushDepth => ("depth of crush", Measure::Crush),
                Magnitude::DamageWidth => ("width of the damage", Measure::Crush),
                Magnitude::TestMass => ("mass in the barrier test", Measure::Mass),
                Magnitude::TestSpeed => ("speed in the barrier test", Measure::RoadSpeed),
                Magnitude::TestDepth => ("depth of crush in the barrier test", Measure::Crush),
                Magnitude::TestWidth => ("width of the damage in the barrier test", Measure::Crush),
            };
            let remedy = match magnitude {
                Magnitude::SpeedFound => "check the units of depths, widths and stiffness, and the angles",
                _ => "check the unit",
            };
            // A bound is a judgement, and has no decimals.
            let bound = |si: f64| {
                let bound = units.value(quantity, si);
                number(bound, usize::from(bound < 20.0))
            };
            let usual = if *low > 0.0 {
                format!("{} to {}", bound(*low), bound(*high))
            } else {
                format!("at most {}", bound(*high))
            };
            format!(
                "the {name} of vehicle {vehicle} is {}, but {usual} {} is usual for {}; {remedy}{}",
                units.format(quantity, *value),
                units.name(quantity),
                words::kind_name(*kind),
                say_what_it_is(others)
            )
        }
        Warning::HighNoDamageSpeed { vehicle, speed: si, source } => format!(
            "the stiffness of vehicle {vehicle} implies no damage up to b_0 = {}, but for cars more than 15 \
             mph (24 km/h) is implausible: {}",
            units.road_speed(*si),
            stiffness_check(*source)
        ),
        Warning::LowNoDamageSpeed { vehicle, speed: si, source } => format!(
            "the stiffness of vehicle {vehicle} implies damage from as little as b_0 = {}, but for cars \
             less than 1 mph (1.6 km/h) is implausible: {}",
            units.road_speed(*si),
            stiffness_check(*source)
        ),
        Warning::UnlikeFleet { vehicle, model_year, widths } => {
            let year = model_year.map(|year| {
                format!(
                    "the stiffness of the fleet was fitted to cars of {} to {}, and vehicle {vehicle} is of {year}: no test shows \
                     how well it fits",
                    FLEET_YEARS.start(),
                    FLEET_YEARS.end()
                )
            });
            let width = widths.map(|[own, end]| {
                let [own, end] = [own, end].map(|si| units.format(Measure::Crush, si));
                format!(
                    "the depths of vehicle {vehicle} cover {own} of an end {end} wide, but the stiffness of the fleet was fitted to \
                     depths over the whole width: write them over the whole end, with zeros where it is undamaged"
                )
            });
            [year, width].into_iter().flatten().collect::<Vec<_>>().join("; ")
        }
        Warning::UnusualFriction { friction } => format!(
            "the friction limit is {friction}, but 0.3 to 1.0 is usual between vehicles; check the decimal \
             point, and that it is neither an angle nor a percentage"
        ),
        Warning::GroundFriction { path, friction, usual: [low, high] } => format!(
            "the friction of the ground `{path}` is {friction}, but {low} (smooth ice) to {high} (new dry asphalt) is usual; \
             check the decimal point"
        ),
        Warning::LargeAngle { path, turns, in_degrees } => format!(
            "the angle `{path}` is {} full turns; {}",
            number(*turns, 1),
            if *in_degrees { "check the number" } else { "did you mean deg?" }
        ),
        Warning::HangsOnAngle { vehicle, path, change, speed } => format!(
            "one degree of {} changes the speed of vehicle {vehicle}, {}, by {}, or {} %; {}",
            if path.ends_with(".rest") {
                format!("the direction from the impact to `{path}`")
            } else {
                format!("`{path}`")
            },
            units.road_speed(*speed),
            units.road_speed(*change),
            number(100.0 * change / speed.abs(), 0),
            if path.ends_with(".rest") {
                "so the exact solution hardly determines this speed; `deltav estimate` weighs the rests with their \
                 errors, and the other evidence with them"
            } else {
                "give the angle with its error, as in { value = …, sd = \"2 deg\" }, so that the interval includes its \
                 effect on the speed"
            }
        ),
        Warning::NoResidualCrush { vehicle, energy } => format!(
            "all depths of vehicle {vehicle} are zero, so its crush energy of {} comes from G alone; this \
             is an upper bound, because without residual crush the energy may have been anything less",
            units.format(Measure::Energy, *energy)
        ),
        Warning::ObjectPassed { vehicle, speeds } => {
            let [before, after] = speeds.map(|si| units.road_speed(si));
            format!(
                "vehicle {vehicle} had {before} before the impact and {after} after it, so it neither stopped \
                 at the object nor rebounded from it: the energy that such an object absorbs in a test does \
                 not apply to a vehicle that moves on"
            )
        }
    }
}

/// The remedy if the vehicle is not a car, but the file does not say so; `kinds` are those that fit.
fn say_what_it_is(kinds: &[VehicleKind]) -> String {
    let words: Vec<String> = kinds.iter().map(|kind| format!("`kind = \"{}\"`", kind.name())).collect();
    match words.join(" or ") {
        none if none.is_empty() => none,
        words => format!(", or give {words} if that is what the vehicle is"),
    }
}

/// Some vehicles, one at least.
pub(crate) fn vehicles(of: [bool; 2]) -> &'static str {
    match of {
        [true, true] => "both vehicles",
        [true, false] => "vehicle 1",
        _ => "vehicle 2",
    }
}

/// That crush energies by this stiffness show only a share of the impact's energy on average.
fn too_small(stiffness: &str, share: f64, is_alone: bool, instead: &str) -> String {
    let share = number(100.0 * share, 0);
    let so = if is_alone {
        format!("energy and EES are too small on average; {instead}")
    } else {
        "its speeds and ΔV are too low on average; `deltav estimate` corrects them".to_owned()
    };
    format!(
        "{stiffness} crush energies from it are on average {share} % of what the impact takes, and this answer takes them \
         as they are, so {so}"
    )
}

/// What to check if a stiffness is implausible for a car.
fn stiffness_check(source: StiffnessSource) -> &'static str {
    match source {
        StiffnessSource::Coefficients | StiffnessSource::Zones => {
            "check the units of A and B, and that they are not swapped"
        }
        StiffnessSource::Roots => "check the units of d0 and d1",
        StiffnessSource::Typical(TypicalStiffness::Category(_)) => "check the category and the damaged side",
        StiffnessSource::Typical(TypicalStiffness::Fleet) => "check the damaged side",
        StiffnessSource::Test(_) => "check the barrier test, its mass, width and no-damage speed",
    }
}

/// What a law gives on one side of a jump.
fn jump_side(side: &JumpSide, units: Units) -> String {
    let mut values = vec![format!("W_n = {}", units.format(Measure::Energy, side.normal_work))];
    values.extend(side.moment.map(|moment| format!("M = {}", units.format(Measure::MomentImpulse, moment))));
    values.extend(VehicleId::ALL.into_iter().zip(side.yaw_rates).filter_map(|(vehicle, rate)| {
        // Jumps of a few per cent do not show in two decimals.
        rate.map(|rate| format!("Ω_{vehicle} = {} rad/s", number(rate, 3)))
    }));
    values.join(", ")
}

fn share(work: f64, of: f64) -> String {
    format!("{} %", number(100.0 * work / of, 1))
}

fn side_name(side: Side) -> &'static str {
    match side {
        Side::Left => "left side",
        Side::Right => "right side",
        Side::Front | Side::Rear => words::side_name(side),
    }
}

/// Why a tangential impulse drives the sliding (m/s), and what to do.
fn drive(cause: Drive, sliding: f64, units: Units) -> String {
    let speed = |si: f64| units.speed(si);
    // The impulse opposes the sliding if it has the other sign.
    let opposes = if sliding > 0.0 { "negative" } else { "positive" };
    match cause {
        Drive::RatioAlong { impulse_ratio } => format!(
            "it drives the sliding, but friction cannot add energy; the ratio of {impulse_ratio} has the \
             sign of the sliding before the impact, u_t = {}. A ratio that opposes the sliding is \
             {opposes}, so check the sign, or give a friction limit",
            speed(sliding)
        ),
        Drive::RatioWithoutSliding { impulse_ratio } => format!(
            "it drives the sliding, but friction cannot add energy; before the impact there is no sliding \
             along the crush plane for a ratio of {impulse_ratio} to oppose, so give a friction limit or \
             `tangential = \"critical\"`"
        ),
        Drive::RatioBeyond { impulse_ratio, critical } => format!(
            "it drives the sliding, but friction cannot add energy; the ratio of {impulse_ratio} not only \
             ends the sliding before the impact, u_t = {}, but reverses it{}: give a smaller ratio, or a \
             friction limit",
            speed(sliding),
            critical.map_or_else(String::new, |critical| format!(
                ", beyond the critical ratio of {}",
                number(critical, 4)
            ))
        ),
        Drive::Change { change } => format!(
            "it drives the sliding, but friction cannot add energy; the tangential velocity change of {} \
             does not oppose the sliding before the impact, u_t = {}, or goes far beyond ending it: check \
             its sign and size",
            speed(change),
            speed(sliding)
        ),
        Drive::Coupling => format!(
            "the rest of the impulse alone would reverse the sliding before the impact, u_t = {}, and the \
             tangential impulse that prevents this acts along the sliding. No sign is wrong, but the normal \
             work is greater by the same amount; check crush plane and contact points",
            speed(sliding)
        ),
    }
}
