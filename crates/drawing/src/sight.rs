//! Obstacles to the view before a collision, seen from above: the paths of both parties to the impact, and
//! the line along which the driver first sees the other one.

use kurbo::{Point, Rect};

use crate::finished::Drawing;
use crate::font::{self, Anchor, SMALL};
use crate::legend::{self, EDGE, HEADER, Sample, ScaleUnit, WIDTH};
use crate::pens::{BLACK, BOUND, GREY, OUTLINE, PALE, PATH, Pen, THIN};
use crate::plan::{View, extent};
use crate::vector::{flipped, polygon, polyline, vec2};

const NAME: &str = "sight";
/// (px) maximum width of the name of an obstacle.
const LONGEST_NAME: f64 = 240.0;
/// (px) area of the plan.
const ROOM: Rect = Rect::new(EDGE + 16.0, HEADER + 20.0, WIDTH - EDGE - 16.0, HEADER + 440.0);
/// (px/m) the largest scale.
const LARGEST: f64 = 60.0;

/// Obstacles and the paths of both parties. Positions are those of a scene with y to the left of x.
#[derive(Clone, Debug, PartialEq)]
pub struct SightPicture {
    /// Title of the case.
    pub title: String,
    /// The lines below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// (m) the corners of each obstacle, and its name.
    pub obstacles: Vec<(Vec<[f64; 2]>, String)>,
    /// (m) the places of both at equal times, the last one at the impact, each with the time as text.
    pub ways: [Vec<([f64; 2], String)>; 2],
    /// The legends of both paths.
    pub legend: [String; 2],
    /// (m) the ends of the line along which the view becomes free, with its legend.
    pub line: Option<([[f64; 2]; 2], String)>,
    /// The unit of the scale bar.
    pub scale: ScaleUnit,
}

impl SightPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let mut entries: Vec<(Sample, String)> =
            PATH.into_iter().map(Sample::Line).zip(self.legend.iter().cloned()).collect();
        if !self.obstacles.is_empty() {
            entries.push((Sample::Box(THIN, PALE.to_owned()), "obstacle".to_owned()));
        }
        entries.extend(self.line.iter().map(|(_, legend)| (Sample::Line(BOUND), legend.clone())));
        let mut canvas = legend::page(NAME, WIDTH, &self.title, &self.subtitle);
        let view = View::fit(ROOM, LARGEST, |scale| self.bounds(scale));
        let page = |at: [f64; 2]| view.at(vec2(at));
        for (k, (corners, name)) in self.obstacles.iter().enumerate() {
            let outline = polygon(corners.iter().map(|corner| page(*corner)));
            canvas.path(&format!("obstacle-{}", k + 1), &outline, Some(THIN), PALE);
            let middle = extent(corners.iter().map(|corner| page(*corner))).center();
            let room = 2.0 * (middle.x - EDGE).min(WIDTH - EDGE - middle.x);
            let name = font::cut(name, SMALL, room.min(LONGEST_NAME));
            canvas.text(Point::new(middle.x, middle.y + 4.5), &name, SMALL, Anchor::Middle, GREY);
        }
        for (i, way) in self.ways.iter().enumerate() {
            let points: Vec<Point> = way.iter().map(|(at, _)| page(*at)).collect();
            canvas.path(&format!("way-{}", i + 1), &polyline(points.iter().copied()), Some(PATH[i]), "none");
            for (k, (at, (_, time))) in points.iter().zip(way).enumerate() {
                canvas.dot(&format!("place-{}-{}", i + 1, k + 1), *at, 3.5, None, OUTLINE[i].colour);
                canvas.labels.label(*at, time, OUTLINE[i].colour);
            }
        }
        if let Some((ends, _)) = &self.line {
            let [eye, point] = ends.map(page);
            canvas.line("line", eye, point, BOUND);
            let ring = Pen { colour: BLACK, width: 1.6, dashes: "" };
            canvas.dot("eye", eye, 5.0, Some(ring), "#ffffff");
            canvas.dot("point", point, 5.0, Some(ring), "#ffffff");
        }
        canvas.place_labels(ROOM.inset(10.0));
        let base = ROOM.y1 + 26.0;
        legend::scale_bar(&mut canvas, "scale", Point::new(EDGE, base), view.scale, &self.scale, "");
        canvas.height = legend::legend(&mut canvas, ROOM.y1 + 46.0, 2, &entries) + 6.0;
        Drawing::new(self.title.clone(), self.description.clone(), canvas)
    }

    /// (px) the extent at a scale.
    fn bounds(&self, scale: f64) -> Rect {
        let corners = self.obstacles.iter().flat_map(|(corners, _)| corners);
        let places = self.ways.iter().flatten().map(|(at, _)| at);
        extent(corners.chain(places).map(|at| (flipped(vec2(*at)) * scale).to_point()))
    }
}
