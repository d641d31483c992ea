//! The data that the program carries.

/// What is compared: texts, so that a reader can change one and see what follows.
#[derive(Clone, Debug)]
pub struct Data {
    /// The staged collisions: the number of the test, and its case file.
    pub cases: Vec<(u8, &'static str)>,
    /// The case of the paper's appendix.
    pub example: &'static str,
    /// What the papers print.
    pub published: &'static str,
    /// What is published of the motion after the impact.
    pub motion: &'static str,
}

macro_rules! ricsac {
    ($($test:literal: $file:literal),* $(,)?) => {
        vec![$(($test, include_str!(concat!("../ricsac/", $file)))),*]
    };
}

impl Data {
    /// `ricsac/*.toml` beside `src`, which `fixtures/ricsac` leads to, and [`case::EXAMPLE`], as they were
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
