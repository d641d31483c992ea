//! The momentum polygon: the momenta before and after the impact, tip to tail, on their total.

use kurbo::{Point, Rect, Vec2};

use crate::canvas::Head;
use crate::finished::Drawing;
use crate::legend::{self, EDGE, HEADER, Sample, ScaleUnit, WIDTH};
use crate::number::count;
use crate::pens::{AFTER, BEFORE, BLACK, GRID, Pen, VERMILION};
use crate::plan::{self, View};
use crate::scene::SceneArrow;
use crate::vector::{flipped, unit, vec2};

const NAME: &str = "momentum";
const SUBTITLE: &str = "Momentum before and after the impact, tip to tail";

/// (px) height of the picture, below the title.
const HEIGHT: f64 = 470.0;
/// (px) margin around the outermost point, for labels.
const MARGIN: f64 = 44.0;
/// (px) maximum length of the longest momentum.
const LONGEST: f64 = 560.0;
/// (–) a polygon is drawn as a line if its corners lie no farther off that line than this share of its
/// longest side, because its sides would then lie on each other.
const FLAT: f64 = 0.04;
/// (px) from one arrow to the next in that case.
const ROW: f64 = 42.0;
/// (–) a vehicle whose momentum is shorter than this share of the longest is at rest.
const STANDS: f64 = 1e-6;

const TOTAL: Pen = Pen { colour: BLACK, width: 3.0, dashes: "" };
const CHANGE: Pen = Pen { colour: BLACK, width: 1.6, dashes: "1.5 3.5" };
const GAP: Pen = Pen { colour: VERMILION, width: 2.4, dashes: "" };

/// Momenta of both vehicles in the scene, in kg·m/s, with y to the left of x whichever axes are shown.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentumPicture {
    /// Title of the case.
    pub title: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// Why this is not the answer, shown below the title; usually empty.
    pub caveat: String,
    /// Whether the axes that are shown have y to the right.
    pub is_z_down: bool,
    /// (kg·m/s) of vehicles 1 and 2 before the impact.
    pub before: [SceneArrow; 2],
    /// (kg·m/s) of vehicles 1 and 2 after the impact.
    pub after: [SceneArrow; 2],
    /// (kg·m/s) total before the impact.
    pub total: SceneArrow,
    /// (kg·m/s) from the momentum of vehicle 1 before the impact to that after it.
    pub change: SceneArrow,
    /// (kg·m/s) from the total before the impact to that after it; `None` if they are equal.
    pub gap: Option<SceneArrow>,
    /// Unit of the scale bar.
    pub momentum: ScaleUnit,
}

/// A side of the polygon.
struct Side<'a> {
    id: &'static str,
    arrow: &'a SceneArrow,
    /// (kg·m/s) its start.
    from: Vec2,
    pen: Pen,
    head: Head,
}

impl MomentumPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let sides = self.sides();
        let longest = sides.iter().map(|side| vec2(side.arrow.vector).hypot()).fold(0.0, f64::max);
        // If nothing moves, there is no length to scale by.
        let longest = if longest > 0.0 { longest } else { self.momentum.size };
        let along = self.along(&sides);
        let across = Vec2::new(-along.y, along.x);
        let is_line = sides
            .iter()
            .flat_map(|side| [side.from, side.from + vec2(side.arrow.vector)])
            .all(|corner| corner.dot(across).abs() <= FLAT * longest);
        // Downwards on the page.
        let down = if flipped(across).y < 0.0 { -flipped(across) } else { flipped(across) };
        let row = |k: usize| if is_line { down * (ROW * count(k)) } else { Vec2::ZERO };

        let area = Rect::new(EDGE, HEADER, WIDTH - EDGE, HEADER + HEIGHT);
        let view = View::fit(area.inset(-MARGIN), LONGEST, |scale| {
            let corners = sides.iter().enumerate().flat_map(|(k, side)| {
                [side.from, side.from + vec2(side.arrow.vector)]
                    .map(|corner| (flipped(corner) * (scale / longest) + row(k)).to_point())
            });
            plan::extent(std::iter::once(Point::ZERO).chain(corners))
        });
        let per_momentum = view.scale / longest;
        let at = |corner: Vec2, k: usize| view.origin + flipped(corner) * per_momentum + row(k);

        let mut canvas = legend::page(NAME, WIDTH, &self.title, &format!("{SUBTITLE}\n{}", self.caveat));
        if is_line {
            // Where the polygon is a line, grid lines join the ends that form one corner.
            for (k, side) in sides.iter().enumerate() {
                for corner in [side.from, side.from + vec2(side.arrow.vector)] {
                    canvas.grid(at(corner, 0), at(corner, k.max(1)), GRID);
                }
            }
        }
        for (k, side) in sides.iter().enumerate() {
            let vector = vec2(side.arrow.vector);
            let [from, to] = [side.from, side.from + vector].map(|corner| at(corner, k));
            if vector.hypot() > STANDS * longest {
                canvas.arrow(side.id, from, to, side.pen, side.head);
                canvas.labels.label_beside(from.midpoint(to), &side.arrow.label, BLACK);
            } else {
                canvas.labels.label(from, &side.arrow.label, BLACK);
            }
        }
        if !is_line {
            canvas.dot("origin", at(Vec2::ZERO, 0), 3.0, None, BLACK);
        }
        plan::axes_in_corner(&mut canvas, area, self.is_z_down);
        canvas.labels.protect(Rect::new(area.x1 - 76.0, area.y1 - 76.0, area.x1, area.y1));
        canvas.place_labels(area);
        let bar_row = area.y1 + 30.0;
        let bar = Point::new(EDGE + 4.0, bar_row);
        legend::scale_bar(&mut canvas, "scale", bar, per_momentum, &self.momentum, "");
        let mut entries = vec![
            (Sample::Arrow(BEFORE, Head::Filled), "mv: momentum before the impact".to_owned()),
            (Sample::Arrow(AFTER, Head::Open), "mV: momentum after the impact".to_owned()),
            (Sample::Arrow(TOTAL, Head::Filled), "total of both vehicles".to_owned()),
            (Sample::Arrow(CHANGE, Head::Open), "m ΔV of vehicle 1; of 2 the opposite".to_owned()),
        ];
        if self.gap.is_some() {
            entries.push((Sample::Arrow(GAP, Head::Open), "what is left over after it".to_owned()));
        }
        canvas.height = legend::legend(&mut canvas, bar_row + 22.0, 3, &entries) + 10.0;
        let title = format!("{}: momentum polygon", self.title);
        Drawing::new(title, self.description.clone(), canvas)
    }

    /// The sides, in the order from top to bottom that they have if the polygon is a line.
    fn sides(&self) -> Vec<Side<'_>> {
        let [before, after] = [&self.before, &self.after].map(|[one, _]| vec2(one.vector));
        let side = |id, arrow, from, pen, head| Side { id, arrow, from, pen, head };
        let mut sides = vec![
            side("before-1", &self.before[0], Vec2::ZERO, BEFORE, Head::Filled),
            side("before-2", &self.before[1], before, BEFORE, Head::Filled),
            side("total", &self.total, Vec2::ZERO, TOTAL, Head::Filled),
            side("after-1", &self.after[0], Vec2::ZERO, AFTER, Head::Open),
            side("after-2", &self.after[1], after, AFTER, Head::Open),
            side("change", &self.change, before, CHANGE, Head::Open),
        ];
        let total = vec2(self.total.vector);
        sides.extend(self.gap.as_ref().map(|gap| side("gap", gap, total, GAP, Head::Open)));
        sides
    }

    /// The direction of the longest side; a unit vector.
    fn along(&self, sides: &[Side<'_>]) -> Vec2 {
        let vectors = sides.iter().map(|side| vec2(side.arrow.vector));
        unit(vectors.fold(vec2(self.total.vector), |longest, vector| {
            if vector.hypot() > longest.hypot() { vector } else { longest }
        }))
    }
}
