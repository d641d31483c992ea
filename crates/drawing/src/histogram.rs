//! A histogram with its interval and its central value.

use kurbo::Rect;

use crate::chart::{Axis, BELOW, Chart};
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample, WIDTH};
use crate::marks::{IntervalMarks, ValueMark};
use crate::pens::{AXIS, BOUND, CLASS, FILL};

const NAME: &str = "histogram";

/// (px) area of the plot.
const PLOT: Rect = Rect::new(EDGE + 48.0, HEADER + 34.0, WIDTH - EDGE - 16.0, HEADER + 394.0);
/// Maximum number of tick labels across and upward.
const MOST: [u8; 2] = [10, 6];

/// The distribution of a number: a bar for each class, and lines at the ends of an interval and at the
/// central value.
#[derive(Clone, Debug, PartialEq)]
pub struct HistogramPicture {
    /// The number, with its unit.
    pub title: String,
    /// The lines below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it; the labels of the lines are added to it.
    pub description: String,
    /// The horizontal axis, whose unit the labels use.
    pub across: Axis,
    /// Minimum number of decimals in the labels, which never have fewer than the axis.
    pub decimals: usize,
    /// Title of the vertical axis, which shows the shares.
    pub upward: String,
    /// The lower end of the first class, in the unit of the data.
    pub low: f64,
    /// The width of each class, more than zero.
    pub width: f64,
    /// (%) share of each class.
    pub shares: Vec<f64>,
    /// The ends of the interval.
    pub interval: [ValueMark; 2],
    /// The central value, which may lie beyond all classes.
    pub central: ValueMark,
    /// Legend entries of a class, of the interval and of the central value.
    pub legend: [String; 3],
}

impl HistogramPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let chart = self.chart();
        let on = (&chart, &self.across, MOST[0]);
        let marks = IntervalMarks::new(&self.interval, ("central", &self.central), on, self.decimals);

        let mut canvas = legend::page(NAME, WIDTH, &self.title, &self.subtitle);
        let upward = Axis { title: self.upward.clone(), unit: 1.0 };
        chart.draw(&mut canvas, &self.across, &upward, MOST);
        chart.bars(&mut canvas, self.low, self.width, &self.shares);
        marks.draw(&mut canvas, &chart);

        let [classes, interval, central] = self.legend.clone();
        let entries = [
            (Sample::Box(CLASS, FILL[0].to_owned()), classes),
            (Sample::Line(BOUND), interval),
            (Sample::Line(AXIS), central),
        ];
        canvas.height = legend::legend(&mut canvas, PLOT.y1 + BELOW, 3, &entries) + 6.0;
        let description = format!("{} {}.", self.description, marks.words());
        Drawing::new(format!("{}: histogram", self.title), description, canvas)
    }

    fn chart(&self) -> Chart {
        let high = self.shares.iter().fold(self.low, |high, _| high + self.width);
        let marks = [&self.interval[0], &self.interval[1], &self.central].map(|mark| mark.value);
        let across = [marks.into_iter().fold(self.low, f64::min), marks.into_iter().fold(high, f64::max)];
        let most = self.shares.iter().copied().fold(0.0, f64::max);
        let upward = [0.0, IntervalMarks::upward(PLOT, most)];
        Chart::new(PLOT, EDGE, across, upward)
    }
}
