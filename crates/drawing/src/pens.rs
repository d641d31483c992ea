//! The colours and lines of all drawings. Colours: M. Okabe and K. Ito, *Color Universal Design* (2008).

pub(crate) const BLACK: &str = "#111111";
pub(crate) const GREY: &str = "#595959";
pub(crate) const PALE: &str = "#d9d9d9";
pub(crate) const WHITE: &str = "#ffffff";
pub(crate) const BLUE: &str = "#0072b2";
pub(crate) const VERMILION: &str = "#d55e00";
pub(crate) const GREEN: &str = "#009e73";
pub(crate) const PURPLE: &str = "#cc79a7";

/// A line: colour, width (px) and dashes.
#[derive(Clone, Copy)]
pub(crate) struct Pen {
    pub(crate) colour: &'static str,
    pub(crate) width: f64,
    pub(crate) dashes: &'static str,
}

const fn pen(colour: &'static str, width: f64, dashes: &'static str) -> Pen {
    Pen { colour, width, dashes }
}

pub(crate) const OUTLINE: [Pen; 2] = [pen(BLUE, 2.0, ""), pen(VERMILION, 2.0, "")];
/// The outline of an undamaged body.
pub(crate) const fn undamaged(i: usize) -> Pen {
    Pen { width: 1.0, dashes: "5 4", ..OUTLINE[i] }
}
/// The edge of a bar of a class.
pub(crate) const CLASS: Pen = Pen { width: 1.0, ..OUTLINE[0] };
pub(crate) const FILL: [&str; 2] = ["#dcebf5", "#fae3d0"];
pub(crate) const PLANE: Pen = pen(GREY, 1.4, "10 4 2 4");
pub(crate) const AXIS: Pen = pen(BLACK, 1.6, "");
pub(crate) const THIN: Pen = pen(GREY, 1.0, "");
pub(crate) const HEADING: Pen = pen(GREY, 1.0, "2 3");
pub(crate) const BEFORE: Pen = pen(GREEN, 3.0, "");
pub(crate) const AFTER: Pen = pen(PURPLE, 3.0, "8 4");
pub(crate) const IMPULSE: Pen = pen(BLACK, 4.0, "");
pub(crate) const PDOF: Pen = pen(BLACK, 1.6, "1.5 3.5");
pub(crate) const CURVE: Pen = pen(BLUE, 2.5, "");
pub(crate) const LEVEL: Pen = pen(VERMILION, 2.0, "9 5");
pub(crate) const CRUSHED: Pen = pen(BLACK, 1.8, "");
pub(crate) const GRID: Pen = pen(PALE, 1.0, "");
/// The ends of an interval.
pub(crate) const BOUND: Pen = pen(BLACK, 1.6, "6 4");
/// The end of a curve that was computed.
pub(crate) const COMPUTED: Pen = pen(BLUE, 1.6, "3 3");
/// Where two numbers are equal.
pub(crate) const EQUALITY: Pen = pen(GREY, 1.4, "7 4");
/// The path of the CG of a motion, and the outlines along it.
pub(crate) const PATH: [Pen; 2] = [pen(BLUE, 1.8, ""), pen(VERMILION, 1.8, "")];
pub(crate) const PASSING: [Pen; 2] = [pen("#4a90c2", 1.0, ""), pen("#d9803f", 1.0, "")];
pub(crate) const APPROACH: Pen = pen(GREEN, 3.0, "");
/// The measured outline at rest.
pub(crate) const MEASURED: Pen = pen(BLACK, 1.6, "5 3");
/// The mark of a sliding wheel.
pub(crate) const MARK: Pen = pen("#333333", 1.2, "");
/// The measured skid mark of a locked wheel before the impact: broad and without dashes, because the marks of
/// front and rear wheels lie on one another.
pub(crate) const SKID: Pen = pen("#8c8c8c", 4.0, "");
pub(crate) const EDGE_OF_GROUND: Pen = pen(GREY, 1.2, "9 3 2 3");
/// Numbers of vehicles 1 and 2.
pub(crate) const OF_VEHICLE: [Pen; 2] = [pen(BLUE, 2.5, ""), pen(VERMILION, 2.0, "9 5")];
/// Runs before a collision: the actual one and other possible ones, in the order of their tables.
pub(crate) const COURSES: [Pen; 6] = [
    pen(BLUE, 3.0, ""),
    pen(GREY, 1.8, "5 5"),
    pen(PURPLE, 1.8, "9 4"),
    pen(GREY, 1.8, "9 4 2 4"),
    pen(GREEN, 2.2, "14 4"),
    pen(VERMILION, 2.6, "9 5"),
];
/// The path of the other party, and its time in the danger zone.
pub(crate) const OTHER_WAY: Pen = pen(BLACK, 1.6, "1.5 3.5");
pub(crate) const ZONE: &str = "#f2d9a8";
/// The place of the impact.
pub(crate) const PLACE: Pen = pen(BLACK, 1.4, "");
