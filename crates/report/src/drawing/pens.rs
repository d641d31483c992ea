//! The colours and lines of all drawings. Colours: M. Okabe and K. Ito, *Color Universal Design* (2008).

pub(super) const BLACK: &str = "#111111";
pub(super) const GREY: &str = "#595959";
pub(super) const PALE: &str = "#d9d9d9";
pub(super) const WHITE: &str = "#ffffff";
const BLUE: &str = "#0072b2";
const VERMILION: &str = "#d55e00";
const GREEN: &str = "#009e73";
const PURPLE: &str = "#cc79a7";

/// A line: colour, width (px) and dashes.
#[derive(Clone, Copy)]
pub(super) struct Pen {
    pub(super) colour: &'static str,
    pub(super) width: f64,
    pub(super) dashes: &'static str,
}

const fn pen(colour: &'static str, width: f64, dashes: &'static str) -> Pen {
    Pen { colour, width, dashes }
}

pub(super) const OUTLINE: [Pen; 2] = [pen(BLUE, 2.0, ""), pen(VERMILION, 2.0, "")];
pub(super) const FILL: [&str; 2] = ["#dcebf5", "#fae3d0"];
pub(super) const PLANE: Pen = pen(GREY, 1.4, "10 4 2 4");
pub(super) const AXIS: Pen = pen(BLACK, 1.6, "");
pub(super) const THIN: Pen = pen(GREY, 1.0, "");
pub(super) const HEADING: Pen = pen(GREY, 1.0, "2 3");
pub(super) const BEFORE: Pen = pen(GREEN, 3.0, "");
pub(super) const AFTER: Pen = pen(PURPLE, 3.0, "8 4");
pub(super) const IMPULSE: Pen = pen(BLACK, 4.0, "");
pub(super) const PDOF: Pen = pen(BLACK, 1.6, "1.5 3.5");
pub(super) const CURVE: Pen = pen(BLUE, 2.5, "");
pub(super) const LEVEL: Pen = pen(VERMILION, 2.0, "9 5");
pub(super) const CRUSHED: Pen = pen(BLACK, 1.8, "");
pub(super) const GRID: Pen = pen(PALE, 1.0, "");
