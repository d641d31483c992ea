//! Where vehicles would have come to rest, compared with where they were found.

use kurbo::{Point, Rect, Vec2};

use crate::finished::Drawing;
use crate::font::{Anchor, SMALL};
use crate::footprint::Footprint;
use crate::legend::{self, EDGE, HEADER, Sample, ScaleUnit, WIDTH};
use crate::pens::{BLACK, GREY, MEASURED, OUTLINE, Pen};
use crate::plan::{Pose, View};
use crate::vector::{flipped, vec2};

/// (px) area of the drawing below the title, and its minimum height.
const ROOM: Rect = Rect::new(EDGE + 8.0, HEADER + 10.0, WIDTH - EDGE - 8.0, HEADER + 530.0);
/// (px/m) the largest scale.
const LARGEST: f64 = 80.0;
/// (px) radius of the dot of a draw.
const RADIUS: f64 = 1.6;
const DRAWS: [&str; 2] = ["#4a90c2", "#d9803f"];

/// A plan view of the rest positions of two vehicles.
#[derive(Clone, Debug, PartialEq)]
pub struct RestsPicture {
    /// The first part of the `id`s in its SVG.
    pub name: &'static str,
    /// Its title.
    pub title: String,
    /// The lines below it.
    pub subtitle: String,
    /// The picture described for readers who cannot see it.
    pub description: String,
    /// (m) the point of impact.
    pub impact: [f64; 2],
    /// The vehicles that were followed, each with its number, 0 or 1.
    pub vehicles: Vec<(usize, FoundAtRest)>,
    /// The unit of the scale bar.
    pub scale: ScaleUnit,
}

/// A vehicle at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundAtRest {
    /// Its label.
    pub label: String,
    /// Its body; `None` if unknown.
    pub footprint: Option<Footprint>,
    /// (m) where its CG was found; `None` if that was not measured.
    pub position: Option<[f64; 2]>,
    /// Its heading there; a unit vector.
    pub forward: [f64; 2],
    /// (m) where it would have come to rest.
    pub draws: Vec<[f64; 2]>,
    /// Legend entry of the draws.
    pub legend: String,
}

impl RestsPicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let bounds = self.bounds();
        let view = View::fit(ROOM, LARGEST, |scale| {
            let corners = [bounds.origin(), Point::new(bounds.x1, bounds.y1)]
                .map(|corner| flipped(corner.to_vec2()) * scale);
            Rect::from_points(corners[0].to_point(), corners[1].to_point())
        });
        let page = |place: [f64; 2]| view.origin + flipped(vec2(place)) * view.scale;
        let mut canvas = legend::page(self.name, WIDTH, &self.title, &self.subtitle);
        for (i, vehicle) in &self.vehicles {
            for draw in &vehicle.draws {
                canvas.dot("", page(*draw), RADIUS, None, DRAWS[i % 2]);
            }
        }
        for (i, vehicle) in &self.vehicles {
            let Some(position) = vehicle.position else { continue };
            let pose = Pose::new(position, vehicle.forward);
            let to_page = kurbo::Affine::translate(view.origin.to_vec2())
                * kurbo::Affine::FLIP_Y
                * kurbo::Affine::scale(view.scale)
                * pose.in_scene();
            if let Some(footprint) = &vehicle.footprint {
                canvas.path(
                    &format!("rest-{}", i + 1),
                    &(to_page * footprint.outline()),
                    Some(MEASURED),
                    "none",
                );
                if let Some(detail) = footprint.detail(None) {
                    let pen = Pen { dashes: "", width: 1.0, ..MEASURED };
                    canvas.path("", &(to_page * detail), Some(pen), "none");
                }
            }
            canvas.centre_of_gravity(&format!("cg-{}", i + 1), page(position));
            canvas.labels.label_of_point(page(position), &vehicle.label, OUTLINE[i % 2].colour);
        }
        let cross = legend::cross(page(self.impact), 7.0);
        let pen = Pen { colour: BLACK, width: 2.0, dashes: "" };
        canvas.path("impact", &cross, Some(pen), "none");
        canvas.labels.label_of_point(page(self.impact), "impact", GREY);
        canvas.place_labels(ROOM.inset(6.0));
        let base = ROOM.y1 + 22.0;
        legend::scale_bar(&mut canvas, "scale", Point::new(EDGE, base), view.scale, &self.scale, "");
        canvas.text(
            Point::new(WIDTH - EDGE, base + 4.5),
            "x to the right, as in the scene",
            SMALL,
            Anchor::End,
            GREY,
        );
        let mut entries: Vec<(Sample, String)> = self
            .vehicles
            .iter()
            .map(|(i, vehicle)| (Sample::Dot(None, DRAWS[i % 2]), vehicle.legend.clone()))
            .collect();
        entries.push((Sample::Line(MEASURED), "outline where it was found".to_owned()));
        entries.push((Sample::Cross(pen), "place of the impact".to_owned()));
        canvas.height = legend::legend(&mut canvas, ROOM.y1 + 40.0, 2, &entries) + 6.0;
        Drawing::new(self.title.clone(), self.description.clone(), canvas)
    }

    /// (m) the extent that has to fit.
    fn bounds(&self) -> Rect {
        let mut bounds = Rect::from_center_size(vec2(self.impact).to_point(), (2.0, 2.0));
        for (_, vehicle) in &self.vehicles {
            for draw in vehicle.draws.iter().copied() {
                bounds = bounds.union_pt(vec2(draw).to_point());
            }
            if let Some(position) = vehicle.position {
                let reach = vehicle.footprint.map_or(1.0, |footprint| 0.6 * footprint.length);
                let around = Vec2::new(reach, reach);
                let centre = vec2(position).to_point();
                bounds = bounds.union(Rect::from_points(centre - around, centre + around));
            }
        }
        bounds
    }
}
