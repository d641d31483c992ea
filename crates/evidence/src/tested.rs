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
/// The model years of these cars for which the age changes no figure, as it was not counted in the tests.
const YEARS: RangeInclusive<u16> = MODEL_YEARS[1]..=2018;

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
    /// Whether cars of this model year were tested with the figures that it now has; one that is not known
    /// may be.
    #[must_use]
    pub fn has_cars_of(model_year: Option<u16>) -> bool {
        model_year.is_none_or(|year| YEARS.contains(&year))
    }

    /// All of them.
    pub const ALL: [Self; 7] = [FRONTS, FRONT_SIDE, FRONT_REAR, WITH_RECORDER, ONE_CRUSH, OBJECT, AFTER];

    /// The class of an estimate of a vehicle of unknown speed whose front struck a fixed object, with the
    /// severity of such crashes: as [`of`](Self::of).
    #[must_use]
    pub fn of_object(energies: [Option<EnergyMethod>; 2], pieces: &[Piece]) -> Option<&'static Self> {
        let is_of_class = energies.into_iter().flatten().all(|method| method == EnergyMethod::Class);
        let is_tested = |piece: &Piece| matches!(piece, Piece::Severity | Piece::Crush | Piece::Pdof(_));
        let all = energies != [None; 2] && is_of_class && pieces.iter().all(is_tested);
        (all && has_pdof(pieces)).then_some(&OBJECT)
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
        let is_tested = |method: Option<EnergyMethod>| {
            matches!(method, None | Some(EnergyMethod::Class | EnergyMethod::Coefficients))
        };
        if !energies.into_iter().all(is_tested) || energies == [None; 2] {
            return None;
        }
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
        let is_of_class = energies.into_iter().flatten().all(|method| method == EnergyMethod::Class);
        let have_both = energies.into_iter().all(|method| method.is_some());
        match (after, recorders) {
            // In RICSAC the stiffness is given, in the field it is by category, and all PDOFs are coded.
            (true, [false, false]) if energies == [Some(EnergyMethod::Coefficients); 2] && all_after => {
                Some(&AFTER)
            }
            _ if !is_of_class || after || !is_pair || !has_pdof(pieces) => None,
            (false, [true, false] | [false, true]) if have_both => Some(&WITH_RECORDER),
            (false, [false, false]) if !have_both => Some(&ONE_CRUSH),
            (false, [false, false]) => match hit {
                [DamagedSide::Front, DamagedSide::Front] => Some(&FRONTS),
                [DamagedSide::Front, DamagedSide::Side] | [DamagedSide::Side, DamagedSide::Front] => {
                    Some(&FRONT_SIDE)
                }
                [DamagedSide::Front, DamagedSide::Rear] | [DamagedSide::Rear, DamagedSide::Front] => {
                    Some(&FRONT_REAR)
                }
                _ => None,
            },
            _ => None,
        }
    }
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
        let with = |piece: Piece| [&crush[..], &[piece]].concat();
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
        assert_eq!(of_object(given, &crush), None);
        assert_eq!(of_object(None, &crush[..1]), None);
        // No estimate without a PDOF was tested.
        assert_eq!(code([Front, Side], [CLASS; 2], &crush[..2]), None);
        assert_eq!(code([Front, Side], [CLASS, None], &crush[..2]), None);
        assert_eq!(of_object(CLASS, &crush[..2]), None);
    }
}
