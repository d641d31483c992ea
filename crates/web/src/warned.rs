//! The keys that a warning leads to.

use analysis::{Magnitude, Warning};

/// The keys to look at first, of a vehicle or of both. Without a catch-all, so that a new warning does not
/// compile until it has its keys.
pub(crate) fn keys(warning: &Warning) -> Vec<String> {
    let key = match warning {
        Warning::PlaneDoesNotSeparate => return vec!["impact.crush_plane".to_owned()],
        Warning::HighRestitution { .. } => return vec!["impact.restitution".to_owned()],
        Warning::SlidingDriven { .. }
        | Warning::LargeImpulseRatio { .. }
        | Warning::NearJump { .. }
        | Warning::UnusualFriction { .. } => return vec!["impact.tangential".to_owned()],
        Warning::RotationDriven { .. } => return vec!["impact.moment_restitution".to_owned()],
        Warning::SeveralSpeeds { .. } => return vec!["reconstruct.find".to_owned()],
        Warning::NotLocked { .. } => return vec!["scene.locked_together".to_owned()],
        Warning::LargeAngle { path, .. }
        | Warning::HangsOnAngle { path, .. }
        | Warning::GroundFriction { path, .. } => return vec![path.clone()],
        Warning::ContactOutside { .. }
        | Warning::ContactPlaced { .. }
        | Warning::ContactOffDamage { .. }
        | Warning::ContactOtherHalf { .. }
        | Warning::ContactDepth { .. } => "contact",
        Warning::PdofDiffers { .. }
        | Warning::PdofsNotOpposite { .. }
        | Warning::AngleCapped { .. }
        | Warning::DeltaVDiffers { .. } => "crush.pdof",
        Warning::SideNotPushed { .. } => "crush.side",
        Warning::ForceBalance { .. } | Warning::DamageEnergyDiffers { .. } => "crush.depths",
        Warning::InferredEnergy { .. } => "crush.width",
        Warning::DamageCentroid { .. } | Warning::DamageOutside { .. } => "crush.offset",
        Warning::CategoryEnergy { of, .. } | Warning::FleetEnergy { of, .. } => {
            let vehicles = [1, 2].into_iter().zip(of).filter(|(_, of)| **of);
            return vehicles.map(|(number, _)| format!("vehicle{number}.crush.stiffness")).collect();
        }
        Warning::HighNoDamageSpeed { .. } | Warning::LowNoDamageSpeed { .. } => "crush.stiffness",
        Warning::UnlikeFleet { model_year: Some(_), .. } => "model_year",
        Warning::UnlikeFleet { model_year: None, .. } => "crush.width",
        Warning::NoResidualCrush { .. } => "crush.depths",
        Warning::MovesBackward { .. } | Warning::GivenSpeedUnused { .. } => "speed",
        Warning::MayHaveBacked { .. } => "certain_speed",
        Warning::RecordUncertain { .. } => "recorder.records",
        Warning::ContactApart { .. } => "position",
        Warning::ClassValues { .. } => "class",
        Warning::BurgInertia { .. } => "yaw_inertia",
        Warning::MomentumDiffers { .. } => "after",
        Warning::EvidenceDiffers { evidence, .. } => evidence.key(),
        Warning::BelowRecord { .. } => "recorder",
        Warning::SkidDirection { .. } => "before.skid.from",
        Warning::SkidOnGrade { .. } | Warning::SkidAboveRecord { .. } => "before.skid",
        Warning::RestsOverlap { .. }
        | Warning::WreckAlone { .. }
        | Warning::SeveralStarts { .. }
        | Warning::RestMissed { .. }
        | Warning::RotationOpposes { .. } => "after.rest",
        Warning::PointMissed { .. } => "after.points",
        Warning::ObjectPassed { .. } => "heading",
        Warning::Implausible { magnitude, .. } => match magnitude {
            Magnitude::Mass => "mass",
            Magnitude::YawRadius => "yaw_inertia",
            Magnitude::Length => "length",
            Magnitude::BodyWidth => "width",
            Magnitude::Speed | Magnitude::SpeedFound => "speed",
            Magnitude::CrushDepth => "crush.depths",
            Magnitude::DamageWidth => "crush.width",
            Magnitude::TestMass => "crush.stiffness.test.mass",
            Magnitude::TestSpeed => "crush.stiffness.test.speed",
            Magnitude::TestDepth => "crush.stiffness.test.depths",
            Magnitude::TestWidth => "crush.stiffness.test.width",
        },
    };
    let vehicles = warning.vehicle().map_or(vec![1, 2], |vehicle| vec![vehicle.number()]);
    vehicles.into_iter().map(|vehicle| format!("vehicle{vehicle}.{key}")).collect()
}
