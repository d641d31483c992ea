//! The energy: where the initial kinetic energy went.

use kurbo::{Point, Rect};

use crate::canvas::Canvas;
use crate::finished::Drawing;
use crate::font::{self, Anchor, SMALL};
use crate::legend::{self, EDGE, HEADER, WIDTH};
use crate::number::count;
use crate::pens::{BLACK, FILL, GREY, OUTLINE, PALE, Pen, THIN, WHITE};

const NAME: &str = "energy";

/// (px) left and right end of the bars: names are to the left, values to the right.
const LEFT: f64 = EDGE + 196.0;
const RIGHT: f64 = WIDTH - EDGE - 190.0;
/// (px) from bar to bar, and the height of a bar.
const STEP: f64 = 46.0;
const BAR: f64 = 28.0;

/// Bars from the initial kinetic energy to the energy that is left.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyPicture {
    /// Title of the case.
    pub title: String,
    /// Why this is not the answer, shown below the title; usually empty.
    pub caveat: String,
    /// Before the impact.
    pub initial: EnergyBar,
    /// The losses in order: each bar begins where the one above it ends.
    pub losses: Vec<(Loss, EnergyBar)>,
    /// The kinetic energy that is left.
    pub rest: EnergyBar,
    /// Text below the bars.
    pub note: String,
}

/// A loss of kinetic energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// The crush of vehicle 1, or its share of the normal work.
    Vehicle1,
    /// The same for vehicle 2.
    Vehicle2,
    /// The normal work, if it is not divided between the vehicles.
    Normal,
    /// The tangential work.
    Tangential,
    /// The moment work.
    Moment,
}

/// An energy and its labels.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyBar {
    /// Label to the left of the bar.
    pub name: String,
    /// (J)
    pub energy: f64,
    /// Label to the right of the bar.
    pub value: String,
    /// Text below the value.
    pub remark: Option<String>,
}

impl Loss {
    /// The id of its bar, the edge, and the stripes if it has any.
    fn look(self) -> (&'static str, Pen, Option<&'static str>) {
        match self {
            Self::Vehicle1 => ("crush-1", OUTLINE[0], Some("stripes-1")),
            Self::Vehicle2 => ("crush-2", OUTLINE[1], Some("stripes-2")),
            Self::Normal => ("normal", OUTLINE[0], Some("stripes-1")),
            Self::Tangential => ("tangential", EDGE_OF_BAR, Some("stripes-t")),
            Self::Moment => ("moment", EDGE_OF_BAR, None),
        }
    }
}

const EDGE_OF_BAR: Pen = Pen { colour: BLACK, width: 1.4, dashes: "" };

impl EnergyPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let Self { title, caveat, initial, losses, rest, note } = self;
        let bottom = HEADER + STEP * (count(losses.len()) + 2.0) + 6.0;
        let lines = font::lines(note, SMALL, WIDTH - 2.0 * EDGE);
        let mut canvas = Canvas::new(NAME, WIDTH);
        canvas.height = bottom + 18.0 * (count(lines.len()) + 1.0);
        canvas.define_stripes("stripes-1", OUTLINE[0].colour, FILL[0], 45, 7.0);
        canvas.define_stripes("stripes-2", OUTLINE[1].colour, FILL[1], -45, 7.0);
        canvas.define_stripes("stripes-t", GREY, WHITE, 90, 6.0);
        let below = format!("Energy: where the initial kinetic energy went\n{caveat}");
        legend::header(&mut canvas, title, &below);

        // Losses run from right to left, and what is left is the final motion. Work that returns energy runs
        // to the right.
        let highest = losses
            .iter()
            .scan(initial.energy, |left, (_, bar)| {
                *left -= bar.energy;
                Some(*left)
            })
            .fold(initial.energy.max(f64::MIN_POSITIVE), f64::max);
        let x = |joule: f64| LEFT + joule.max(0.0) / highest * (RIGHT - LEFT);
        let mut y = HEADER + STEP / 2.0;
        initial.draw(&mut canvas, "initial", [x(0.0), x(initial.energy)], y, (EDGE_OF_BAR, PALE));
        let mut left = initial.energy;
        for (loss, bar) in losses {
            let from = left;
            left -= bar.energy;
            let mark = Point::new(x(from), y + BAR / 2.0);
            y += STEP;
            canvas.grid(mark, Point::new(x(from), y - BAR / 2.0), THIN);
            let (id, edge, stripes) = loss.look();
            let fill = stripes.map_or_else(|| PALE.to_owned(), |name| canvas.pattern(name));
            bar.draw(&mut canvas, id, [x(left), x(from)], y, (edge, &fill));
        }
        let mark = Point::new(x(left), y + BAR / 2.0);
        y += STEP;
        canvas.grid(mark, Point::new(x(left), y - BAR / 2.0), THIN);
        rest.draw(&mut canvas, "final", [x(0.0), x(rest.energy)], y, (EDGE_OF_BAR, WHITE));

        for (k, line) in lines.iter().enumerate() {
            let y = bottom + 18.0 * (count(k) + 1.0);
            canvas.text(Point::new(EDGE, y), line, SMALL, Anchor::Start, GREY);
        }
        let bars = std::iter::once(initial).chain(losses.iter().map(|(_, bar)| bar)).chain([rest]);
        let parts: Vec<String> = bars.map(EnergyBar::words).collect();
        let description = format!(
            "Bars from the initial kinetic energy to what is left of it: {}. {note} {caveat}",
            parts.join("; ")
        );
        let description = description.trim_end().to_owned();
        Drawing::new(format!("{title}: energy"), description, canvas)
    }
}

impl EnergyBar {
    fn draw(&self, canvas: &mut Canvas, id: &str, [from, to]: [f64; 2], y: f64, (edge, fill): (Pen, &str)) {
        let area = Rect::new(from.min(to), y - BAR / 2.0, from.max(to), y + BAR / 2.0);
        canvas.rect(id, area, Some(edge), fill);
        let base = y + 4.5;
        canvas.text(Point::new(LEFT - 12.0, base), &self.name, SMALL, Anchor::End, BLACK);
        canvas.text(Point::new(RIGHT + 12.0, base), &self.value, SMALL, Anchor::Start, BLACK);
        if let Some(remark) = &self.remark {
            canvas.text(Point::new(RIGHT + 12.0, base + 17.0), remark, SMALL, Anchor::Start, BLACK);
        }
    }

    fn words(&self) -> String {
        let remark = self.remark.as_ref().map(|remark| format!(", {remark}")).unwrap_or_default();
        format!("{} {}{remark}", self.name, self.value)
    }
}
