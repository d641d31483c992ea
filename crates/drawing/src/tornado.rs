//! A tornado diagram: the effect of each single input on a result.

use kurbo::{Point, Rect};

use crate::canvas::Canvas;
use crate::finished::Drawing;
use crate::font::{self, Anchor, SMALL};
use crate::legend::{self, EDGE, HEADER, Sample, WIDTH};
use crate::number::count;
use crate::pens::{BLACK, FILL, OUTLINE, Pen, THIN};

const NAME: &str = "tornado";

/// (px) minimum length of the longest bar.
const REACH: f64 = 180.0;
/// (px) from a bar to its label, and from column to column.
const BESIDE: f64 = 6.0;
/// (px) from bar to bar, and the height of a bar.
const STEP: f64 = 24.0;
const BAR: f64 = 14.0;
/// (px) from the middle of a line of letters to its baseline.
const BASE: f64 = 4.5;
/// (px) below the bars, for the central value.
const BELOW: f64 = 42.0;

/// Bars from the central value of a result to the values that a single input gives it, at the low and at the
/// high end of its range.
#[derive(Clone, Debug, PartialEq)]
pub struct TornadoPicture {
    /// The result, with its unit.
    pub title: String,
    /// The lines below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// The result with all inputs at their central values.
    pub central: f64,
    /// The text below the bars.
    pub central_label: String,
    /// The change of the result that is drawn as the longest bar. If it is 0, there are no bars.
    pub longest: f64,
    /// From top to bottom.
    pub bars: Vec<TornadoBar>,
    /// Legend entries of the low and of the high end of an input.
    pub legend: [String; 2],
}

/// The effect of an input.
#[derive(Clone, Debug, PartialEq)]
pub struct TornadoBar {
    /// Name of the input.
    pub name: String,
    /// The result at the low and at the high end of the input, if it has one.
    pub ends: [Option<f64>; 2],
    /// Results with their labels, which are at the end of the bar.
    pub labels: Vec<(f64, String)>,
    /// Text to the right of all bars.
    pub remark: Option<String>,
}

const LOW: Pen = Pen { width: 1.0, ..OUTLINE[1] };
const HIGH: Pen = Pen { width: 1.0, ..OUTLINE[0] };

/// (px) positions of the columns: names, labels to the left, bars, labels to the right, remarks.
struct Columns {
    /// The right end of the names.
    names: f64,
    middle: f64,
    reach: f64,
    remarks: f64,
    page: f64,
}

impl TornadoPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let columns = self.columns();
        let bottom = HEADER + STEP * count(self.bars.len()) + BESIDE;
        let mut canvas = Canvas::new(NAME, columns.page);
        canvas.define_stripes("stripes", LOW.colour, FILL[1], 45, 6.0);
        legend::header(&mut canvas, &self.title, &self.subtitle);
        let stripes = canvas.pattern("stripes");
        let mut y = HEADER + STEP / 2.0;
        for (row, bar) in (1_usize..).zip(&self.bars) {
            self.bar(&mut canvas, &columns, (row, bar), y, &stripes);
            y += STEP;
        }
        let middle = columns.middle;
        canvas.line("central", Point::new(middle, HEADER - BESIDE), Point::new(middle, bottom), THIN);
        canvas.text(Point::new(middle, bottom + 20.0), &self.central_label, SMALL, Anchor::Middle, BLACK);
        let [low, high] = self.legend.clone();
        let entries = [(Sample::Box(LOW, stripes), low), (Sample::Box(HIGH, FILL[0].to_owned()), high)];
        canvas.height = legend::legend(&mut canvas, bottom + BELOW, 3, &entries) + 6.0;
        Drawing::new(format!("{}: tornado", self.title), self.description.clone(), canvas)
    }

    fn columns(&self) -> Columns {
        let widest = |texts: &mut dyn Iterator<Item = &String>| {
            texts.map(|text| font::width(text, SMALL)).fold(0.0, f64::max)
        };
        let names = widest(&mut self.bars.iter().map(|bar| &bar.name));
        let labels = widest(&mut self.bars.iter().flat_map(|bar| &bar.labels).map(|(_, label)| label));
        let remark = widest(&mut self.bars.iter().filter_map(|bar| bar.remark.as_ref()));
        let beside = names + remark + 2.0 * labels + 5.0 * BESIDE + 2.0 * EDGE;
        let reach = (0.5 * (WIDTH - beside)).max(REACH);
        let names = EDGE + names;
        let middle = names + 2.0 * BESIDE + labels + reach;
        let remarks = middle + reach + labels + 3.0 * BESIDE;
        Columns { names, middle, reach, remarks, page: beside + 2.0 * reach }
    }

    fn bar(
        &self,
        canvas: &mut Canvas,
        columns: &Columns,
        (row, bar): (usize, &TornadoBar),
        y: f64,
        stripes: &str,
    ) {
        let base = y + BASE;
        canvas.text(Point::new(columns.names, base), &bar.name, SMALL, Anchor::End, BLACK);
        let across = |end: f64| {
            let share = if self.longest > 0.0 { (end - self.central) / self.longest } else { 0.0 };
            columns.middle + share * columns.reach
        };
        let mut drawn = [("low", bar.ends[0], LOW, stripes), ("high", bar.ends[1], HIGH, FILL[0])];
        // The longer one first, so that it does not hide the shorter one if both are on one side.
        let length = |end: Option<f64>| end.map_or(0.0, |end| (end - self.central).abs());
        drawn.sort_by(|(_, one, ..), (_, other, ..)| length(*other).total_cmp(&length(*one)));
        for (id, end, pen, fill) in drawn {
            let Some(end) = end.filter(|_| self.longest > 0.0) else { continue };
            let area = Rect::new(columns.middle, y - BAR / 2.0, across(end), y + BAR / 2.0).abs();
            canvas.rect(&format!("{id}-{row}"), area, Some(pen), fill);
        }
        for (end, label) in &bar.labels {
            let (anchor, away) =
                if *end < self.central { (Anchor::End, -BESIDE) } else { (Anchor::Start, BESIDE) };
            canvas.text(Point::new(across(*end) + away, base), label, SMALL, anchor, BLACK);
        }
        if let Some(remark) = &bar.remark {
            canvas.text(Point::new(columns.remarks, base), remark, SMALL, Anchor::Start, BLACK);
        }
    }
}
