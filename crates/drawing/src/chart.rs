//! Axes with ticks, for all pictures that plot one number against another.

use kurbo::{Point, Rect};

use crate::canvas::Canvas;
use crate::font::{self, Anchor, SMALL};
use crate::number::number;
use crate::pens::{BLACK, CLASS, FILL, GREY, GRID, THIN};
use crate::ticks;

/// (px) from a chart to the tick labels on its left.
const BESIDE: f64 = 8.0;
/// (px) how far a tick label below a chart may extend past its right end: the room left on the page.
const BEYOND: f64 = 38.0;
/// (px) gap between two tick labels below a chart.
const BETWEEN: f64 = 10.0;

/// (px) from a chart to the legend.
pub(crate) const BELOW: f64 = 58.0;

/// Title and unit of an axis of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Its title, with the unit of its numbers.
    pub title: String,
    /// The unit of its numbers, in units of the data.
    pub unit: f64,
}

/// The place of the data on a page.
pub(crate) struct Chart {
    pub(crate) area: Rect,
    /// (px) where the title of the upward axis begins, above the area.
    pub(crate) left: f64,
    /// The ends of both axes, in the units of the data.
    pub(crate) across: [f64; 2],
    pub(crate) upward: [f64; 2],
}

/// An interval that has a width: around its end, or from 0 to 1, if the data give none.
fn with_width([low, high]: [f64; 2]) -> [f64; 2] {
    let least = 1e-13 * low.abs().max(high.abs());
    match high - low {
        width if width.is_finite() && width > least => [low, high],
        _ if low.is_finite() && high.is_finite() => {
            let half = (0.5 * low.abs()).max(0.5);
            [low - half, low + half]
        }
        _ => [0.0, 1.0],
    }
}

impl Chart {
    pub(crate) fn new(area: Rect, left: f64, across: [f64; 2], upward: [f64; 2]) -> Self {
        Self { area, left, across: with_width(across), upward: with_width(upward) }
    }

    pub(crate) fn at(&self, across: f64, upward: f64) -> Point {
        let share = |[low, high]: [f64; 2], value: f64| (value - low) / (high - low);
        Point::new(
            self.area.x0 + share(self.across, across) * self.area.width(),
            self.area.y1 - share(self.upward, upward) * self.area.height(),
        )
    }

    /// Draws the frame, the grid with at most `most` tick labels across and upward, and both axis titles.
    pub(crate) fn draw(&self, canvas: &mut Canvas, across: &Axis, upward: &Axis, most: [u8; 2]) {
        let Self { area, left, .. } = *self;
        canvas.rect("", area, Some(THIN), "none");
        let (values, decimals) = self.ticks_across(across, most[0]);
        let x = |value: f64| self.at(value * across.unit, self.upward[0]).x;
        // If the first label begins below the lowest one of the upward axis, all labels move down.
        let begins = |value: &f64| x(*value) - font::width(&number(*value, decimals), SMALL) / 2.0;
        let is_below = values.first().map(begins).is_some_and(|begins| begins <= area.x0 - BESIDE);
        let base = area.y1 + if is_below { 21.0 } else { 18.0 };
        for &value in &values {
            let x = x(value);
            canvas.grid(Point::new(x, area.y0), Point::new(x, area.y1), GRID);
            canvas.text(Point::new(x, base), &number(value, decimals), SMALL, Anchor::Middle, BLACK);
        }
        let (values, decimals) =
            ticks::between(self.upward[0] / upward.unit, self.upward[1] / upward.unit, f64::from(most[1]));
        for value in values {
            let y = self.at(self.across[0], value * upward.unit).y;
            canvas.grid(Point::new(area.x0, y), Point::new(area.x1, y), GRID);
            let at = Point::new(area.x0 - BESIDE, y + 4.5);
            canvas.text(at, &number(value, decimals), SMALL, Anchor::End, BLACK);
        }
        let below = Point::new(area.center().x, area.y1 + 40.0);
        canvas.text(below, &across.title, SMALL, Anchor::Middle, GREY);
        let above = Point::new(left, area.y0 - 16.0);
        canvas.text(above, &upward.title, SMALL, Anchor::Start, GREY);
    }

    /// Draws a bar of the given width for each class, side by side from `low` on.
    pub(crate) fn bars(&self, canvas: &mut Canvas, low: f64, width: f64, heights: &[f64]) {
        let mut left = low;
        for (class, &height) in (1_usize..).zip(heights) {
            let area = Rect::from_points(self.at(left, 0.0), self.at(left + width, height));
            canvas.rect(&format!("class-{class}"), area, Some(CLASS), FILL[0]);
            left += width;
        }
    }

    /// As many ticks as have room for their labels, next to each other and on the page.
    pub(crate) fn ticks_across(&self, axis: &Axis, most: u8) -> (Vec<f64>, usize) {
        let [low, high] = self.across.map(|end| end / axis.unit);
        let has_room = |(values, decimals): &(Vec<f64>, usize)| {
            values.windows(2).all(|pair| {
                let [one, other] =
                    [pair[0], pair[1]].map(|value| font::width(&number(value, *decimals), SMALL));
                let apart = (pair[1] - pair[0]) / (high - low) * self.area.width();
                (one + other) / 2.0 + BETWEEN <= apart
            })
        };
        let all = (1..=most).rev().map(|most| ticks::between(low, high, f64::from(most)));
        let (mut values, decimals) = all.into_iter().find(has_room).unwrap_or_default();
        let end = |value: f64| {
            self.at(value * axis.unit, self.upward[0]).x + font::width(&number(value, decimals), SMALL) / 2.0
        };
        values.retain(|&value| end(value) <= self.area.x1 + BEYOND);
        (values, decimals)
    }
}
