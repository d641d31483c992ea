//! The damage: each vehicle with its crush profile in place.

use kurbo::{Affine, Point, Rect, Vec2};

use crate::canvas::Canvas;
use crate::finished::Drawing;
use crate::font::{self, Anchor, SMALL};
use crate::footprint::{BodyShape, CrushProfile, Footprint, placed};
use crate::legend::{self, EDGE, HEADER, Sample, ScaleUnit, WIDTH};
use crate::number::count;
use crate::pens::{BLACK, CRUSHED, FILL, GREY, OUTLINE, THIN, WHITE, undamaged};
use crate::plan::extent;
use crate::vector::polygon;

const NAME: &str = "damage";

/// (px) height of the area for the vehicles.
const ROOM: f64 = 430.0;
/// (px) margin around a vehicle, for the names of the stations.
const MARGIN: f64 = 44.0;
/// (px/m) the largest scale.
const LARGEST: f64 = 130.0;
/// (px) minimum distance between the names of two stations, for one digit and for more.
const APART: [f64; 2] = [19.0, 30.0];
/// (px) distance of the names of stations from the face.
const BESIDE: f64 = 20.0;
/// (px) radius of the dot of a station.
const DOT: f64 = 2.2;
/// (px) line height of the captions.
const ROW: f64 = 18.0;

/// Each damaged vehicle from above, with its crush profile.
#[derive(Clone, Debug, PartialEq)]
pub struct DamagePicture {
    /// Title of the case.
    pub title: String,
    /// Vehicles 1 and 2, if damaged.
    pub vehicles: [Option<DamagedVehicle>; 2],
    /// Unit of the scale bar.
    pub length: ScaleUnit,
}

/// A damaged vehicle, in its own axes (m): x forward, y left of the CG, or of any point if its outline is
/// unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct DamagedVehicle {
    /// Its outline; without one the profile is drawn alone.
    pub footprint: Option<Footprint>,
    /// Its damaged face.
    pub crush: CrushProfile,
    /// Whether the crush was measured at stations. If so, they are marked and named C1, C2 …, and the
    /// undamaged outline is dashed.
    pub has_stations: bool,
    /// Heads the caption.
    pub name: String,
    /// The sentences of the caption.
    pub caption: Vec<String>,
}

struct Panel<'a> {
    i: usize,
    vehicle: &'a DamagedVehicle,
}

impl DamagePicture {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let vehicles = self.vehicles.iter().enumerate();
        let panels: Vec<Panel> =
            vehicles.filter_map(|(i, vehicle)| Some(Panel { i, vehicle: vehicle.as_ref()? })).collect();
        let width = (WIDTH - 2.0 * EDGE) / count(panels.len().max(1));
        // The same scale for both: the vehicles can be compared.
        let scale = panels.iter().fold(LARGEST, |scale, panel| {
            let extent = panel.extent();
            scale.min((width - 2.0 * MARGIN) / extent.width()).min((ROOM - 2.0 * MARGIN) / extent.height())
        });
        let captions: Vec<Vec<String>> = panels.iter().map(|panel| panel.caption(width - 16.0)).collect();
        let rows = captions.iter().map(Vec::len).max().unwrap_or(0);
        let bottom = HEADER + ROOM + ROW * (count(rows) + 1.0);
        let mut canvas = Canvas::new(NAME, WIDTH);
        canvas.define_stripes("crushed", GREY, WHITE, 45, 6.0);

        let below = "Damage: crush profiles in place, to scale, forward is up";
        legend::header(&mut canvas, &self.title, below);
        let room = Rect::new(EDGE, HEADER, WIDTH - EDGE, HEADER + ROOM);
        for (k, (panel, caption)) in panels.iter().zip(&captions).enumerate() {
            let left = EDGE + count(k) * width;
            let middle = Point::new(left + width / 2.0, HEADER + ROOM / 2.0);
            panel.draw(&mut canvas, middle, scale);
            for (row, line) in caption.iter().enumerate() {
                let y = HEADER + ROOM + ROW * (count(row) + 1.0);
                canvas.text(Point::new(left + 4.0, y), line, SMALL, Anchor::Start, BLACK);
            }
        }
        canvas.place_labels(room);
        let at = Point::new(EDGE + 4.0, bottom + 14.0);
        legend::scale_bar(&mut canvas, "scale", at, scale, &self.length, "");
        let fill = canvas.pattern("crushed");
        let mut entries = vec![
            (Sample::Box(CRUSHED, fill), "crushed area of the side".to_owned()),
            (Sample::Line(CRUSHED), "profile through the stations C1, C2 …".to_owned()),
        ];
        let bodies = || panels.iter().filter_map(|panel| panel.vehicle.footprint.as_ref());
        if bodies().next().is_some() {
            entries.push((Sample::CentreOfGravity, "CG: centre of gravity".to_owned()));
        }
        if bodies().any(|footprint| footprint.shape == BodyShape::Car) {
            entries.push(legend::windscreen());
        }
        let has_both = |panel: &&Panel| panel.vehicle.has_stations && panel.vehicle.footprint.is_some();
        if let Some(panel) = panels.iter().find(has_both) {
            entries.push((Sample::Line(undamaged(panel.i)), "shape before the damage".to_owned()));
        }
        legend::legend(&mut canvas, bottom + 36.0, 3, &entries);
        canvas.height = bottom + 118.0;
        let description = captions.iter().map(|lines| lines.join(" ")).collect::<Vec<_>>().join(" ");
        Drawing::new(
            format!("{}: damage", self.title),
            format!("Each damaged vehicle from above, with its crush profile. {description}"),
            canvas,
        )
    }
}

fn points(points: &[[f64; 2]]) -> impl Iterator<Item = Point> {
    points.iter().map(|&[x, y]| Point::new(x, y))
}

impl Panel<'_> {
    /// Extent (m) of outline and damage: x to the right, y downwards.
    fn extent(&self) -> Rect {
        let there = self.there(Point::ZERO, 1.0);
        let CrushProfile { face, crushed, .. } = &self.vehicle.crush;
        let corners = self.vehicle.footprint.iter().flat_map(Footprint::corners);
        extent(corners.chain(points(face)).chain(points(crushed)).map(|point| there * point))
    }

    /// Forward is up.
    fn there(&self, cg: Point, scale: f64) -> Affine {
        placed(Vec2::new(0.0, 1.0), cg, scale)
    }

    fn draw(&self, canvas: &mut Canvas, middle: Point, scale: f64) {
        let Self { i, vehicle } = *self;
        let number = i + 1;
        let extent = self.extent();
        let cg = middle - extent.center().to_vec2() * scale;
        let there = self.there(cg, scale);
        if let Some(footprint) = &vehicle.footprint {
            let outline = there * footprint.outline();
            let crush = vehicle.has_stations.then_some(&vehicle.crush);
            let id = format!("outline-{number}");
            match crush {
                None => canvas.path(&id, &outline, Some(OUTLINE[i]), FILL[i]),
                Some(crush) => {
                    let damaged = there * footprint.damaged(crush);
                    canvas.path(&format!("damaged-{number}"), &damaged, Some(OUTLINE[i]), FILL[i]);
                    canvas.path(&id, &outline, Some(undamaged(i)), "none");
                }
            }
            if let Some(detail) = footprint.detail(crush) {
                let fill = if footprint.shape == BodyShape::Car { WHITE } else { "none" };
                canvas.path(&format!("front-{number}"), &(there * detail), Some(THIN), fill);
            }
        }
        let face: Vec<Point> = points(&vehicle.crush.face).map(|at| there * at).collect();
        let crushed: Vec<Point> = points(&vehicle.crush.crushed).map(|at| there * at).collect();
        let area = polygon(face.iter().chain(crushed.iter().rev()).copied());
        let fill = canvas.pattern("crushed");
        canvas.path(&format!("crush-{number}"), &area, Some(CRUSHED), &fill);
        if vehicle.footprint.is_some() {
            canvas.centre_of_gravity(&format!("cg-{number}"), cg);
            canvas.labels.label(cg, "CG", BLACK);
        }
        if vehicle.has_stations {
            self.stations(canvas, &face, &crushed);
        }
    }

    /// Draws the stations and as many of their names as have room, always the first and the last.
    fn stations(&self, canvas: &mut Canvas, face: &[Point], crushed: &[Point]) {
        let [forward, left] = self.vehicle.crush.outward;
        let outward = Vec2::new(-left, -forward);
        let shortest = face.windows(2).map(|pair| (pair[1] - pair[0]).hypot()).fold(f64::INFINITY, f64::min);
        let apart = if face.len() < 10 { APART[0] } else { APART[1] };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small positive number"
        )]
        let every = (apart / shortest.max(0.001)).ceil().max(1.0) as usize;
        let last = face.len().saturating_sub(1);
        let mut dotted: Option<Point> = None;
        for (j, (&on_face, &deep)) in face.iter().zip(crushed).enumerate() {
            // Stations closer together than the size of a dot would only make the line of the profile
            // thicker, and a scan has thousands of them.
            if j == last || dotted.is_none_or(|before| (on_face - before).hypot() >= DOT) {
                canvas.dot("", deep, DOT, None, BLACK);
                dotted = Some(on_face);
            }
            if j != last && (j % every != 0 || last - j < every) {
                continue;
            }
            let end = on_face + outward * (BESIDE - 8.0);
            canvas.grid(on_face, end, THIN);
            let name = format!("C{}", j + 1);
            // The baseline of the text lies below its middle.
            let at = on_face + outward * BESIDE + Vec2::new(0.0, 0.35 * SMALL);
            let anchor = if outward.x > 0.5 {
                Anchor::Start
            } else if outward.x < -0.5 {
                Anchor::End
            } else {
                Anchor::Middle
            };
            canvas.text(at, &name, SMALL, anchor, BLACK);
        }
    }

    fn caption(&self, most: f64) -> Vec<String> {
        let mut lines = vec![font::cut(&self.vehicle.name, SMALL, most)];
        lines.extend(self.vehicle.caption.iter().flat_map(|sentence| font::lines(sentence, SMALL, most)));
        lines
    }
}
