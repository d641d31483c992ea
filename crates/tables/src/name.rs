//! Names of columns: the path of a key with its unit.
//!
//! `vehicle1.crush.width [in]`, or the same without dots and brackets, `vehicle1__crush__width__in`.

use case::{Dimension, Unit, read_unit};

/// The parts of a name.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Name {
    pub(crate) steps: Vec<Step>,
    /// The text in brackets at the end.
    pub(crate) unit: Option<String>,
}

/// A part of a path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Step {
    Key(String),
    /// Counted from zero; a name counts from one.
    Element(usize),
}

/// The maximum number of elements with columns of their own.
const MOST_ELEMENTS: usize = 1000;

impl Name {
    /// The parts of a name; one without dots and brackets may have a unit as its last step.
    pub(crate) fn of(name: &str) -> Self {
        let name = name.trim();
        let bracketed = name
            .strip_suffix(']')
            .and_then(|head| head.rsplit_once('['))
            .filter(|(_, inside)| !inside.trim().is_empty() && inside.trim().parse::<usize>().is_err());
        let (path, unit) = match bracketed {
            Some((path, unit)) => (path.trim_end(), Some(unit.trim().to_owned())),
            None => (name, None),
        };
        let separator = if path.contains('.') { "." } else { "__" };
        let mut steps = Vec::new();
        for part in path.split(separator) {
            if let Some(element) = element(part) {
                steps.push(Step::Element(element));
                continue;
            }
            match part.strip_suffix(']').and_then(|head| head.rsplit_once('[')) {
                Some((key, index)) if element(index).is_some() => {
                    steps.push(Step::Key(key.to_owned()));
                    steps.extend(element(index).map(Step::Element));
                }
                _ => steps.push(Step::Key(part.to_owned())),
            }
        }
        Self { steps, unit }
    }

    /// The path of its key, with dots.
    pub(crate) fn path(&self) -> String {
        let mut path = String::new();
        for step in &self.steps {
            match step {
                Step::Key(key) if path.is_empty() => path.push_str(key),
                Step::Key(key) => path.extend([".", key]),
                Step::Element(place) => path.push_str(&format!("[{}]", place + 1)),
            }
        }
        path
    }
}

fn element(text: &str) -> Option<usize> {
    let number: usize = text.trim().parse().ok()?;
    (1..=MOST_ELEMENTS).contains(&number).then(|| number - 1)
}

/// The unit of a dimension that a text spells, perhaps only in letters: `N_per_cm2`, `lb_ft_s2`.
pub(crate) fn unit(text: &str, dimension: Dimension) -> Option<&'static Unit> {
    read_unit(text, dimension).or_else(|| read_unit(&text.replace("_per_", "/").replace('_', " "), dimension))
}

#[cfg(test)]
mod tests {
    use super::{Name, Step, unit};
    use case::Dimension;

    #[test]
    fn a_name_is_a_path_with_its_unit() {
        let steps = |name: &str| {
            let Name { steps, unit } = Name::of(name);
            let steps: Vec<String> = steps
                .into_iter()
                .map(|step| match step {
                    Step::Key(key) => key,
                    Step::Element(index) => format!("#{index}"),
                })
                .collect();
            (steps.join(" "), unit)
        };
        let unit = |unit: &str| Some(unit.to_owned());
        assert_eq!(steps("vehicle1.mass"), ("vehicle1 mass".to_owned(), None));
        assert_eq!(steps("vehicle1.mass [lb]"), ("vehicle1 mass".to_owned(), unit("lb")));
        assert_eq!(steps("vehicle1.mass[lb]"), ("vehicle1 mass".to_owned(), unit("lb")));
        assert_eq!(
            steps("vehicle1.crush.depths[2] [in]"),
            ("vehicle1 crush depths #1".to_owned(), unit("in"))
        );
        assert_eq!(steps("vehicle1.crush.depths[2]"), ("vehicle1 crush depths #1".to_owned(), None));
        assert_eq!(
            steps("surface.zone[1].polygon[3].x [m]"),
            ("surface zone #0 polygon #2 x".to_owned(), unit("m"))
        );
        assert_eq!(steps("vehicle1__mass__lb"), ("vehicle1 mass lb".to_owned(), None));
        assert_eq!(steps("vehicle1__crush__depths__2__in"), ("vehicle1 crush depths #1 in".to_owned(), None));
        assert_eq!(steps("year"), ("year".to_owned(), None));
        assert_eq!(steps(" a.[0] "), ("a [0]".to_owned(), None));
        assert_eq!(steps(""), (String::new(), None));
    }

    #[test]
    fn a_unit_can_be_spelled_in_letters_alone() {
        for (text, dimension, spelling) in [
            ("N_per_cm2", Dimension::StiffnessB, "N/cm^2"),
            ("lb_ft_s2", Dimension::Inertia, "lb ft s^2"),
            ("km_per_h", Dimension::Speed, "km/h"),
            ("kph", Dimension::Speed, "km/h"),
            ("lb ft^2", Dimension::Inertia, "lb ft^2"),
        ] {
            assert_eq!(unit(text, dimension).map(|unit| unit.spelling()), Some(spelling), "{text}");
        }
        assert_eq!(unit("furlong", Dimension::Length), None);
    }
}
