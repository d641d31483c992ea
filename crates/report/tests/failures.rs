//! Cases without an answer, in both unit systems.

use analysis::Failure;
use pim_core::{ImpactError, VehicleId};
use reconcile::{Iteration, MomentumError, ReconcileError};
use report::{Units, no_answer};

const BEYOND: Failure = Failure::NotReached {
    vehicle: VehicleId::One,
    energy: 135_581.795,
    tangential_share: 0.0,
    nearest: Ok(Iteration { speed: 44.704, normal_work: 13_558.179_5 }),
};

/// 1 ft·lb is 1.355 817 95 J, 1 mph is 0.447 04 m/s, 1 ft is 0.3048 m, 1 lb·s is 4.448 221 615 N·s.
#[test]
fn a_refusal_speaks_the_units_of_the_reader() {
    let too_fast = Failure::NotReached {
        vehicle: VehicleId::Two,
        energy: 135_581.795,
        tangential_share: 0.0,
        nearest: Ok(Iteration { speed: 4_470.4, normal_work: 135_581.795 }),
    };
    let with_share = Failure::NotReached {
        vehicle: VehicleId::One,
        energy: 135_581.795,
        tangential_share: 0.355,
        nearest: Ok(Iteration { speed: 44.704, normal_work: 13_558.179_5 }),
    };
    let both = Failure::Momentum(MomentumError::NotReached { energy: 135_581.795, tangential_share: 0.25 });
    let jam = Failure::Impact(ImpactError::Jam { impulse_ratio: -2.5, k_nn: 2.0, k_nt: 1.0 });
    let not_approaching = Failure::Impact(ImpactError::NotApproaching { u_n: 3.048 });
    let pulling = Failure::Impact(ImpactError::Pulling { normal_impulse: -4_448.221_615 });
    let created = ImpactError::EnergyCreated {
        loss: -1_355.817_95,
        normal_work: 2_711.635_9,
        tangential_work: -5_423.271_8,
        moment_work: 1_355.817_95,
    };
    let inadmissible = Failure::Reconcile(ReconcileError::Inadmissible {
        vehicle: VehicleId::Two,
        speed: 44.704,
        reason: created,
    });
    let too_great =
        Failure::Crush(crash3::CrushError::ForceTooGreat { force: 444_822.161_5, most: 222_411.080_8 });
    let above_limit = Failure::Crush(crash3::CrushError::ForceAboveLimit {
        force_per_width: 175_126.835,
        limit: 87_563.417_5,
    });
    for (failure, si, us) in [
        (
            &BEYOND,
            "equal to 135,582 J while the vehicles approach and push; the closest is 13,558 J, at 160.9 km/h (44.70 m/s);",
            "up to 3,281 ft/s makes the work of the normal impulse equal to 100,000 ft·lb while the vehicles approach and push; the closest is 10,000 ft·lb, at 100.00 mph (146.67 ft/s);",
        ),
        (
            &too_fast,
            "up to 1,000 m/s makes the work of the normal impulse equal to 135,582 J; it would take 16,093.4 km/h (4,470.40 m/s), which gives 135,582 J;",
            "up to 3,281 ft/s makes the work of the normal impulse equal to 100,000 ft·lb; it would take 10,000.00 mph (14,666.67 ft/s), which gives 100,000 ft·lb;",
        ),
        (
            &with_share,
            "makes the work of the normal impulse plus 35.5 % of that of the tangential impulse equal to 135,582 J while",
            "the tangential impulse equal to 100,000 ft·lb while",
        ),
        (
            &both,
            "make the work of the normal impulse plus 25 % of that of the tangential impulse equal to 135,582 J while",
            "the tangential impulse equal to 100,000 ft·lb while",
        ),
        (&jam, "needs μ above -2.0000:", "needs μ above -2.0000:"),
        (&not_approaching, "u_n is 3.05 m/s, but", "u_n is 10.00 ft/s, but"),
        (&pulling, "(P_n = -4,448 N·s)", "(P_n = -1,000 lb·s)"),
        (
            &inadmissible,
            "at 160.9 km/h (44.70 m/s) vehicle 2 would",
            "the energy loss would be -1,000 ft·lb (2,000 ft·lb is the work of the normal impulse, -4,000 \
             ft·lb that of the tangential impulse and 1,000 ft·lb that of the moment impulse);",
        ),
        (
            &too_great,
            "is 444.8 kN, but the damaged side can bear no more than 222.4 kN, even",
            "is 100,000 lb, but the damaged side can bear no more than 50,000 lb, even",
        ),
        (
            &above_limit,
            "1,751.3 N/cm of width, more than the limit of 875.6 N/cm",
            "1,000.0 lb/in of width, more than the limit of 500.0 lb/in",
        ),
    ] {
        for (units, expected) in [(Units::Si, si), (Units::Us, us)] {
            let sentence = no_answer(failure, units);
            assert!(sentence.contains(expected), "{sentence}");
            assert!(
                units == Units::Si
                    || ![" J", " m/s", " N·s", " kN", " N/"].iter().any(|si| sentence.contains(si)),
                "{sentence}"
            );
        }
    }
}
