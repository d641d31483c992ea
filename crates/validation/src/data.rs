//! The built-in data.

/// The data of the comparison: texts, so that a reader can change one and see the effect.
#[derive(Clone, Debug, PartialEq)]
pub struct Data {
    /// The staged collisions: the number of each test, and its case file.
    pub cases: Vec<(u8, &'static str)>,
    /// The case of the paper's appendix.
    pub example: &'static str,
    /// The printed numbers of the papers.
    pub published: &'static str,
    /// The published data on the motion after the impact.
    pub motion: &'static str,
}

macro_rules! ricsac {
    ($($test:literal: $file:literal),* $(,)?) => {
        vec![$(($test, include_str!(concat!("../ricsac/", $file)))),*]
    };
}

impl Data {
    /// Every text, in one order.
    #[must_use]
    pub fn texts(&self) -> Vec<&'static str> {
        let cases = self.cases.iter().map(|(_, text)| *text);
        cases.chain([self.example, self.published, self.motion]).collect()
    }

    /// `ricsac/*.toml` next to `src`, to which `fixtures/ricsac` links, and [`case::EXAMPLE`], as they were
    /// when the program was built.
    #[must_use]
    pub fn built_in() -> Self {
        Self {
            cases: ricsac![
                1: "01.toml", 3: "03.toml", 4: "04.toml", 5: "05.toml", 6: "06.toml", 7: "07.toml",
                8: "08.toml", 9: "09.toml", 10: "10.toml", 11: "11.toml", 12: "12.toml",
            ],
            example: case::EXAMPLE,
            published: include_str!("../ricsac/published.toml"),
            motion: include_str!("../ricsac/motion/published.toml"),
        }
    }
}
