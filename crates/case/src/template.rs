//! Case files to begin with.

/// A commented case that runs as it is, of one kind of collision. The numbers are invented.
///
/// ```
/// use case::{Case, Template};
///
/// let file = Case::parse("case.toml", Template::Barrier.text())?;
/// assert!(file.case.vehicles[1].fixed);
/// # Ok::<(), case::Diagnostics>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Template {
    /// The front of one vehicle against the side of the other, at an intersection.
    FrontSide,
    /// Two fronts, offset.
    HeadOn,
    /// A front against the rear of a waiting vehicle.
    RearEnd,
    /// A vehicle against a fixed object.
    Barrier,
    /// Two vehicles that scrape along each other.
    Sideswipe,
}

impl Template {
    /// All templates.
    pub const ALL: [Self; 5] = [Self::FrontSide, Self::HeadOn, Self::RearEnd, Self::Barrier, Self::Sideswipe];

    /// Its name in one word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::FrontSide => "front-side",
            Self::HeadOn => "head-on",
            Self::RearEnd => "rear-end",
            Self::Barrier => "barrier",
            Self::Sideswipe => "sideswipe",
        }
    }

    /// The case file.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::FrontSide => include_str!("../templates/front-side.toml"),
            Self::HeadOn => include_str!("../templates/head-on.toml"),
            Self::RearEnd => include_str!("../templates/rear-end.toml"),
            Self::Barrier => include_str!("../templates/barrier.toml"),
            Self::Sideswipe => include_str!("../templates/sideswipe.toml"),
        }
    }
}
