//! The real collisions on which the intervals of estimates were tested.

use core::ops::RangeInclusive;

use pim_core::VehicleId;

use crate::fitted::{DamagedSide, EnergyMethod, MODEL_YEARS};
use crate::model::Piece;

/// A class of real collisions on which estimates were tested.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestedClass {
    /// Its key.
    pub code: &'static str,
    /// The collisions and the evidence.
    pub collisions: &'static str,
    /// The quantity that was tested: a ΔV or a speed.
    pub quantity: &'static str,
    /// Number of tested values.
    pub n: u32,
    /// (–) share of the true values inside their 95 % intervals.
    pub inside95: f64,
    /// (–) root mean square of ln(median/truth), where it is known.
    pub rms: Option<f64>,
    /// The source of the data, and how blind the test was.
    pub source: &'static str,
}

const HELD_OUT: &str = "cars of 1991 to 2018 in CISS 2017, with stiffnesses by category, each crash judged with figures \
                        fitted to other crashes";
const SEEN: &str =
    "cars of 1991 to 2018 in CISS 2017, with stiffnesses by category, to which the figures were fitted";
const FLEET_HELD_OUT: &str = "cars of 1991 to 2018 in CISS 2017, with the stiffness of the fleet, each crash judged with \
                              figures fitted to other crashes";
const FLEET_SEEN: &str =
    "cars of 1991 to 2018 in CISS 2017, with the stiffness of the fleet, to which the figures were fitted";
/// The model years of the cars to which the stiffness of the fleet was fitted.
pub const FLEET_YEARS: RangeInclusive<u16> = 1991..=2018;

/// docs/calibration.md, section Categories of CRASH3's table.
const FRONTS: TestedClass = TestedClass {
    code: "two-fronts",
    collisions: "two fronts met, and the crush of both and the PDOF were known",
    quantity: "ΔV",
    n: 64,
    inside95: 0.922,
    rms: Some(0.339),
    source: HELD_OUT,
};
const FRONT_SIDE: TestedClass = TestedClass {
    code: "front-side",
    collisions: "a front met a side, and the crush of both and the PDOF were known",
    quantity: "ΔV",
    n: 172,
    inside95: 0.959,
    rms: Some(0.340),
    source: HELD_OUT,
};
const FRONT_REAR: TestedClass = TestedClass {
    code: "front-rear",
    collisions: "a front met a rear, and the crush of both and the PDOF were known",
    quantity: "ΔV",
    n: 107,
    inside95: 0.925,
    rms: Some(0.369),
    source: HELD_OUT,
};
const WITH_RECORDER: TestedClass = TestedClass {
    code: "recorder",
    collisions: "the recorder of the other vehicle was known as well as crush and PDOF",
    quantity: "ΔV",
    n: 104,
    inside95: 0.952,
    rms: Some(0.250),
    source: HELD_OUT,
};
const ONE_CRUSH: TestedClass = TestedClass {
    code: "one-crush",
    collisions: "the crush of one vehicle alone and the PDOF were known",
    quantity: "ΔV",
    n: 348,
    inside95: 0.931,
    rms: Some(0.374),
    source: SEEN,
};
const OBJECT: TestedClass = TestedClass {
    code: "fixed-object",
    collisions: "a front struck an immovable object, and its crush and the PDOF were known",
    quantity: "ΔV",
    n: 94,
    inside95: 0.904,
    rms: Some(0.584),
    source: HELD_OUT,
};
/// The same by the stiffness of the fleet: sections Result and Fixed objects.
const FLEET_FRONTS: TestedClass = TestedClass {
    code: "two-fronts-fleet",
    inside95: 0.953,
    rms: Some(0.299),
    source: FLEET_HELD_OUT,
    ..FRONTS
};
const FLEET_FRONT_SIDE: TestedClass = TestedClass {
    code: "front-side-fleet",
    inside95: 0.959,
    rms: Some(0.324),
    source: FLEET_HELD_OUT,
    ..FRONT_SIDE
};
const FLEET_FRONT_REAR: TestedClass = TestedClass {
    code: "front-rear-fleet",
    inside95: 0.935,
    rms: Some(0.335),
    source: FLEET_HELD_OUT,
    ..FRONT_REAR
};
const FLEET_WITH_RECORDER: TestedClass = TestedClass {
    code: "recorder-fleet",
    inside95: 0.933,
    rms: Some(0.248),
    source: FLEET_HELD_OUT,
    ..WITH_RECORDER
};
const FLEET_ONE_CRUSH: TestedClass = TestedClass {
    code: "one-crush-fleet",
    inside95: 0.945,
    rms: Some(0.365),
    source: FLEET_SEEN,
    ..ONE_CRUSH
};
const FLEET_OBJECT: TestedClass = TestedClass {
    code: "fixed-object-fleet",
    inside95: 0.936,
    rms: Some(0.581),
    source: FLEET_HELD_OUT,
    ..OBJECT
};
/// The same, section Staged collisions.
const AFTER: TestedClass = TestedClass {
    code: "velocities-after",
    collisions: "the velocities of both vehicles after the impact were known as well as the crush",
    quantity: "speed",
    n: 19,
    inside95: 18.0 / 19.0,
    rms: None,
    source: "RICSAC's staged collisions, to which no figure was fitted",
};

impl TestedClass {
    /// Whether cars of this model year were tested with the figures that they now have; one that is not known
    /// may be.
    #[must_use]
    pub fn has_cars_of(method: EnergyMethod, model_year: Option<u16>) -> bool {
        let is_tested = |year: u16| match method {
            // The age, which was not counted in the tests, changes no figure from here on.
            EnergyMethod::Class => (MODEL_YEARS[1]..=*FLEET_YEARS.end()).contains(&year),
            EnergyMethod::Fleet => FLEET_YEARS.contains(&year),
            EnergyMethod::Coefficients | EnergyMethod::Test | EnergyMethod::Ees | EnergyMethod::OfObject => {
                true
            }
        };
        model_year.is_none_or(is_tested)
    }

    /// All of them.
    pub const ALL: [Self; 13] = [
        FRONTS,
        FRONT_SIDE,
        FRONT_REAR,
        WITH_RECORDER,
        ONE_CRUSH,
        OBJECT,
        FLEET_FRONTS,
        FLEET_FRONT_SIDE,
        FLEET_FRONT_REAR,
        FLEET_WITH_RECORDER,
        FLEET_ONE_CRUSH,
        FLEET_OBJECT,
        AFTER,
    ];

    /// The class of an estimate of a vehicle of unknown speed whose front struck a fixed object, with the
    /// severity of such crashes: as [`of`](Self::of).
    #[must_use]
    pub fn of_object(energies: [Option<EnergyMethod>; 2], pieces: &[Piece]) -> Option<&'static Self> {
        let is_tested = |piece: &Piece| matches!(piece, Piece::Severity | Piece::Crush | Piece::Pdof(_));
        if !pieces.iter().all(is_tested) || !has_pdof(pieces) {
            return None;
        }
        match only_method(energies)? {
            EnergyMethod::Class => Some(&OBJECT),
            EnergyMethod::Fleet => Some(&FLEET_OBJECT),
            _ => None,
        }
    }

    /// The class to which an estimate belongs, of two vehicles whose speeds are both unknown and whose
    /// severity is that of the field; `None` if no such collisions with such evidence were tested.
    ///
    /// `hit` is where the vehicles were hit, `energies` how the crush energy of each was obtained, `pieces`
    /// all evidence.
    #[must_use]
    pub fn of(
        hit: [DamagedSide; 2],
        energies: [Option<EnergyMethod>; 2],
        pieces: &[Piece],
    ) -> Option<&'static Self> {
        let method = only_method(energies)?;
        let is_pair = hit.contains(&DamagedSide::Front);
        let (mut after, mut recorders) = (false, [false; 2]);
        for piece in pieces {
            match piece {
                Piece::Severity | Piece::Crush | Piece::Pdof(_) => {}
                Piece::SpeedAfter(_) | Piece::DirectionAfter(_) | Piece::YawRateAfter(_) => after = true,
                Piece::RecordedDeltaV(id) | Piece::RecordedDirection(id) => recorders[id.index()] = true,
                Piece::Rest(_)
                | Piece::Points(_)
                | Piece::LeastDeltaV(_)
                | Piece::RecordedSpeed(_)
                | Piece::RecordedYawRate(_)
                | Piece::SkidSpeed(_)
                | Piece::Limits(_)
                | Piece::NoResidualCrush => return None,
            }
        }
        // As in RICSAC.
        let velocities = VehicleId::ALL.map(|id| [Piece::SpeedAfter(id), Piece::DirectionAfter(id)]);
        let all_after = velocities.iter().flatten().all(|piece| pieces.contains(piece));
        let have_both = energies.into_iter().all(|method| method.is_some());
        if method == EnergyMethod::Coefficients {
            // In RICSAC the stiffness is given, in the field it is typical, and all PDOFs are coded.
            return (all_after && have_both && recorders == [false; 2]).then_some(&AFTER);
        }
        let [fronts, front_side, front_rear, with_recorder, one_crush] = match method {
            EnergyMethod::Class => [&FRONTS, &FRONT_SIDE, &FRONT_REAR, &WITH_RECORDER, &ONE_CRUSH],
            EnergyMethod::Fleet => {
                [&FLEET_FRONTS, &FLEET_FRONT_SIDE, &FLEET_FRONT_REAR, &FLEET_WITH_RECORDER, &FLEET_ONE_CRUSH]
            }
            _ => return None,
        };
        if after || !is_pair || !has_pdof(pieces) {
            return None;
        }
        match recorders {
            [true, false] | [false, true] if have_both => Some(with_recorder),
            [false, false] if !have_both => Some(one_crush),
            [false, false] => match hit {
                [DamagedSide::Front, DamagedSide::Front] => Some(fronts),
                [DamagedSide::Front, DamagedSide::Side] | [DamagedSide::Side, DamagedSide::Front] => {
                    Some(front_side)
                }
                [DamagedSide::Front, DamagedSide::Rear] | [DamagedSide::Rear, DamagedSide::Front] => {
                    Some(front_rear)
                }
                _ => None,
            },
            _ => None,
        }
    }
}

/// How all known crush energies were obtained; `None` without one, and if they differ in that.
fn only_method(energies: [Option<EnergyMethod>; 2]) -> Option<EnergyMethod> {
    let mut known = energies.into_iter().flatten();
    let first = known.next()?;
    known.all(|method| method == first).then_some(first)
}

fn has_pdof(pieces: &[Piece]) -> bool {
    pieces.iter().any(|piece| matches!(piece, Piece::Pdof(_)))
}

#[cfg(test)]
mod tests {
    use pim_core::VehicleId::{One, Two};

    use super::TestedClass;
    use crate::fitted::{DamagedSide, EnergyMethod};
    use crate::model::Piece;

    const CLASS: Option<EnergyMethod> = Some(EnergyMethod::Class);
    const FLEET: Option<EnergyMethod> = Some(EnergyMethod::Fleet);

    fn code(
        hit: [DamagedSide; 2],
        energies: [Option<EnergyMethod>; 2],
        pieces: &[Piece],
    ) -> Option<&'static str> {
        TestedClass::of(hit, energies, pieces).map(|class| class.code)
    }

    #[test]
    fn an_estimate_belongs_to_what_was_judged_or_to_nothing() {
        use DamagedSide::{Front, Rear, Side};
        let crush = [Piece::Severity, Piece::Crush, Piece::Pdof(One)];
        assert_eq!(code([Front, Side], [CLASS; 2], &crush), Some("front-side"));
        assert_eq!(code([Side, Front], [CLASS; 2], &crush), Some("front-side"));
        assert_eq!(code([Rear, Front], [CLASS; 2], &crush), Some("front-rear"));
        assert_eq!(code([Front, Front], [CLASS; 2], &crush), Some("two-fronts"));
        assert_eq!(code([Side, Side], [CLASS; 2], &crush), None);
        assert_eq!(code([Front, Side], [CLASS, None], &crush), Some("one-crush"));
        assert_eq!(code([Front, Side], [FLEET; 2], &crush), Some("front-side-fleet"));
        assert_eq!(code([Rear, Front], [FLEET; 2], &crush), Some("front-rear-fleet"));
        assert_eq!(code([Front, Front], [FLEET; 2], &crush), Some("two-fronts-fleet"));
        assert_eq!(code([Front, Side], [None, FLEET], &crush), Some("one-crush-fleet"));
        assert_eq!(code([Front, Side], [FLEET, CLASS], &crush), None);
        let with = |piece: Piece| [&crush[..], &[piece]].concat();
        assert_eq!(
            code([Front, Side], [FLEET; 2], &with(Piece::RecordedDeltaV(Two))),
            Some("recorder-fleet")
        );
        assert_eq!(code([Front, Side], [CLASS; 2], &with(Piece::RecordedDeltaV(Two))), Some("recorder"));
        let both = [&with(Piece::RecordedDeltaV(Two))[..], &[Piece::RecordedDeltaV(One)]].concat();
        assert_eq!(code([Front, Side], [CLASS; 2], &both), None);
        let given = Some(EnergyMethod::Coefficients);
        let speeds = [One, Two].map(|id| [Piece::SpeedAfter(id), Piece::DirectionAfter(id)]);
        let velocities = [&crush[..], speeds.as_flattened()].concat();
        assert_eq!(code([Front, Side], [given; 2], &velocities), Some("velocities-after"));
        assert_eq!(code([Front, Side], [given; 2], &velocities[..6]), None);
        assert_eq!(code([Side, Side], [CLASS, None], &crush), None);
        assert_eq!(code([Front, Side], [CLASS; 2], &with(Piece::SpeedAfter(One))), None);
        assert_eq!(code([Front, Side], [given; 2], &crush), None);
        assert_eq!(code([Front, Side], [Some(EnergyMethod::Ees), CLASS], &crush), None);
        for piece in [Piece::Rest(One), Piece::RecordedSpeed(Two), Piece::SkidSpeed(One), Piece::Limits(One)]
        {
            assert_eq!(code([Front, Side], [CLASS; 2], &with(piece)), None, "{piece:?}");
        }
        assert_eq!(code([Front, Side], [None; 2], &crush[..1]), None);
        let of_object =
            |energy, pieces: &[Piece]| TestedClass::of_object([energy, None], pieces).map(|class| class.code);
        assert_eq!(of_object(CLASS, &crush), Some("fixed-object"));
        assert_eq!(of_object(CLASS, &with(Piece::RecordedDeltaV(One))), None);
        assert_eq!(of_object(FLEET, &crush), Some("fixed-object-fleet"));
        assert_eq!(of_object(given, &crush), None);
        assert_eq!(of_object(None, &crush[..1]), None);
        // No estimate without a PDOF was tested.
        assert_eq!(code([Front, Side], [CLASS; 2], &crush[..2]), None);
        assert_eq!(code([Front, Side], [CLASS, None], &crush[..2]), None);
        assert_eq!(of_object(CLASS, &crush[..2]), None);
    }
}
