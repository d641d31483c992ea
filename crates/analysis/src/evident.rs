//! Evidence that an answer may not use.

/// Evidence that may contradict an answer which does not use it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Evident {
    /// (m/s) the recorder's speed before the impact.
    RecordedSpeed,
    /// (m/s) the recorder's ΔV along the vehicle.
    RecordedLongitudinal,
    /// (m/s) the recorder's ΔV across the vehicle.
    RecordedLateral,
    /// (m/s) the speed at impact by the recorder's table.
    TabledSpeed,
    /// (m/s) ΔV along the vehicle by the recorder's pulse.
    PulseLongitudinal,
    /// (m/s) ΔV across the vehicle by the recorder's pulse.
    PulseLateral,
    /// (rad/s) the yaw rate after the impact by the recorder.
    RecordedYawRate,
    /// (m/s) the speed at the start of its skid.
    SkidSpeed,
    /// (m/s) the speed after the impact.
    SpeedAfter,
    /// (rad) the direction of the velocity after the impact.
    DirectionAfter,
    /// (rad/s) the yaw rate after the impact.
    YawRateAfter,
    /// (m/s) a lower limit of its speed.
    AtLeast,
    /// (m/s) an upper limit of its speed.
    AtMost,
}

impl Evident {
    /// Its key in the table of the vehicle.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::RecordedSpeed => "recorder.speed",
            Self::RecordedLongitudinal => "recorder.delta_v_longitudinal",
            Self::RecordedLateral => "recorder.delta_v_lateral",
            Self::TabledSpeed => "recorder.pre_crash",
            Self::PulseLongitudinal | Self::PulseLateral => "recorder.pulse",
            Self::RecordedYawRate => "recorder.yaw_rate",
            Self::SkidSpeed => "before.speed",
            Self::SpeedAfter => "after.speed",
            Self::DirectionAfter => "after.direction",
            Self::YawRateAfter => "after.yaw_rate",
            Self::AtLeast => "certain_speed.at_least",
            Self::AtMost => "certain_speed.at_most",
        }
    }

    /// Whether its sign is that of the lateral axis.
    pub(crate) fn is_lateral(self) -> bool {
        matches!(
            self,
            Self::RecordedLateral
                | Self::PulseLateral
                | Self::DirectionAfter
                | Self::RecordedYawRate
                | Self::YawRateAfter
        )
    }
}
