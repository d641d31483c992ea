//! Lines at values of a chart, with labels above them.

use kurbo::{Point, Rect};

use crate::canvas::Canvas;
use crate::chart::{Axis, Chart};
use crate::number::number;
use crate::pens::{AXIS, BLACK, BOUND, Pen};

/// (px) above the plot, for three rows of labels.
const STRIP: f64 = 74.0;
/// (px) from the labels to the ends of their lines, and to the frame.
const BESIDE: f64 = 2.0;

/// A marked value.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueMark {
    /// In the unit of the data.
    pub value: f64,
    /// The text before the value, such as `central:`.
    pub lead: String,
}

/// The lines at both ends of an interval and at a value between them, with their labels.
pub(crate) struct IntervalMarks<'a> {
    marks: [(&'static str, &'a ValueMark, Pen); 3],
    labels: [String; 3],
}

impl<'a> IntervalMarks<'a> {
    /// `central` is the value and its `id`; labels have `decimals`, or as many as the axis if it has more.
    pub(crate) fn new(
        [low, high]: &'a [ValueMark; 2],
        central: (&'static str, &'a ValueMark),
        (chart, across, most): (&Chart, &Axis, u8),
        decimals: usize,
    ) -> Self {
        let (_, ticks) = chart.ticks_across(across, most);
        let decimals = decimals.max(ticks);
        let marks = [("low", low, BOUND), (central.0, central.1, AXIS), ("high", high, BOUND)];
        let labels =
            marks.map(|(_, mark, _)| format!("{} {}", mark.lead, number(mark.value / across.unit, decimals)));
        Self { marks, labels }
    }

    /// The end of the upward axis that leaves room for the labels above the largest value.
    pub(crate) fn upward(area: Rect, greatest: f64) -> f64 {
        greatest * area.height() / (area.height() - STRIP)
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, chart: &Chart) {
        let strip = Rect { y1: chart.area.y0 + STRIP, ..chart.area };
        for ((id, mark, pen), label) in self.marks.iter().zip(&self.labels) {
            let bottom = chart.at(mark.value, 0.0);
            let top = Point::new(bottom.x, strip.y1);
            canvas.line(id, bottom, top, *pen);
            canvas.labels.protect(Rect::from_center_size(top, (BESIDE, BESIDE)));
            canvas.labels.label_of_point(top, label, BLACK);
        }
        // Above all lines, so that none runs through a label.
        canvas.place_labels(strip.inset(-BESIDE));
    }

    /// All labels, as one sentence without its full stop.
    pub(crate) fn words(&self) -> String {
        self.labels.join("; ")
    }
}
