//! Templates: case files to start from.

use inputs::UnitSystem;

/// A commented, runnable case of one kind. The numbers are invented.
///
/// ```
/// use case::{CaseFile, Template, UnitSystem};
///
/// let file = CaseFile::parse("case.toml", Template::Barrier.text(UnitSystem::Us))?;
/// assert!(file.case.vehicles[1].fixed);
/// # Ok::<(), case::Diagnostics>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Template {
    /// The front of one vehicle against the side of the other, at an intersection.
    FrontSide,
    /// Two fronts, offset.
    HeadOn,
    /// A front against the rear of a stationary vehicle.
    RearEnd,
    /// A front against the rear of a waiting vehicle, both rest positions known and neither speed.
    RearEndRest,
    /// Two vehicles that cross, both rest positions known and neither speed.
    Intersection,
    /// A vehicle against a fixed object.
    Barrier,
    /// Two vehicles that scrape along each other.
    Sideswipe,
    /// Two cars with known energy equivalent speeds.
    Ees,
    /// A car against a heavy truck with negligible damage.
    HeavyTruck,
    /// The damage of one vehicle alone.
    OneVehicle,
    /// Whether a collision with a pedestrian was avoidable.
    Avoid,
    /// Two cars whose event data recorders stored the seconds before the impact.
    Recorder,
}

/// Gives each template its name and the files of that name.
macro_rules! named {
    ($($template:ident $name:literal),+) => {
        impl Template {
            /// Each under its name in one word.
            pub const WORDS: [(&str, Self); 12] = [$(($name, Self::$template)),+];

            /// The case file in the given unit system. Its numbers are round in those units, so the two files
            /// describe two similar collisions, not the same one.
            #[must_use]
            pub fn text(self, units: UnitSystem) -> &'static str {
                match (self, units) {$(
                    (Self::$template, UnitSystem::Si) => {
                        include_str!(concat!("../templates/si/", $name, ".toml"))
                    }
                    (Self::$template, UnitSystem::Us) => {
                        include_str!(concat!("../templates/us/", $name, ".toml"))
                    }
                )+}
            }
        }
    };
}

impl Template {
    /// The case file in SI units except for its speeds, which are in mph, as on the roads of the United
    /// Kingdom. Its comments do not state the answer, because speeds rounded in mph are not quite those in
    /// km/h.
    #[must_use]
    pub fn text_with_mph(self) -> String {
        let line = |line: &str| {
            match line {
            stated if stated.starts_with("# As it stands") => {
                "# With `--units uk`, every command prints speeds in mph, even where none stands in the file.\n".to_owned()
            }
            line => in_mph(line),
        }
        };
        self.text(UnitSystem::Si).split_inclusive('\n').map(line).collect()
    }
}

/// A line with its numbers in km/h, alone or in a list, as the nearest whole numbers in mph.
fn in_mph(line: &str) -> String {
    const KMH: &str = " km/h";
    let is_of_list = |c: char| c.is_ascii_digit() || matches!(c, ' ' | '-');
    let mut out = String::with_capacity(line.len());
    let mut rest = line;
    while let Some(end) = rest.find(KMH) {
        let before = rest[..end].trim_end_matches(is_of_list);
        let numbers = rest[before.len()..end].split(' ').map(|number| {
            // 1 mph = 1.609344 km/h, by definition of the mile
            number.parse::<f64>().map_or(number.to_owned(), |kmh| format!("{:.0}", kmh / 1.609_344))
        });
        out.push_str(before);
        out.push_str(&numbers.collect::<Vec<_>>().join(" "));
        out.push_str(" mph");
        rest = &rest[end + KMH.len()..];
    }
    out + rest
}

named! {
    FrontSide "front-side",
    HeadOn "head-on",
    RearEnd "rear-end",
    RearEndRest "rear-end-rest",
    Intersection "intersection",
    Barrier "barrier",
    Sideswipe "sideswipe",
    Ees "ees",
    HeavyTruck "heavy-truck",
    OneVehicle "one-vehicle",
    Avoid "avoid",
    Recorder "recorder"
}
