//! The damage: each vehicle with its crush profile in place.

use analysis::{Analysis, Damage};
use case::Case;
use kurbo::{BezPath, Point, Rect, Vec2};

use super::canvas::{Anchor, Canvas, SMALL};
use super::legend::{self, EDGE, HEADER, Sample, WIDTH};
use super::pens::{BLACK, CRUSHED, FILL, GREY, OUTLINE, THIN, WHITE};
use super::vehicle::{Body, Outline, Profile, placed, profile};
use super::{Drawing, DrawingError, Subject, font};
use crate::Units;
use crate::units::Quantity;
use crate::words;

/// (px) height of the vehicles' room.
const ROOM: f64 = 430.0;
/// (px) white around a vehicle, for the names of the stations.
const MARGIN: f64 = 44.0;
/// (px/m)
const LARGEST: f64 = 130.0;
/// (px) the least distance between the names of two stations, with one figure and with more.
const APART: [f64; 2] = [19.0, 30.0];
/// (px) how far beyond the face the names of stations stand.
const BESIDE: f64 = 20.0;
/// (px) radius of a station.
const DOT: f64 = 2.2;
/// Stations whose depths the caption lists; of more it says between what they lie.
const LISTED: usize = 50;
/// (m) how far damage may reach beyond an outline before the caption says so: bodies have no sharp corners.
const BEYOND: f64 = 0.1;
/// (px) height of a line of the captions.
const ROW: f64 = 18.0;

struct Panel<'a> {
    number: usize,
    body: Body,
    profile: Profile,
    damage: &'a Damage,
}

pub(super) fn draw(case: &Case, analysis: &Analysis, units: Units) -> Result<Drawing, DrawingError> {
    let panels: Vec<Panel> = analysis
        .vehicles
        .iter()
        .enumerate()
        .filter_map(|(i, vehicle)| {
            let damage = vehicle.damage.as_ref()?;
            let body = Body::of(vehicle)?;
            let profile = profile(case, vehicle, &body, damage, i)?;
            Some(Panel { number: i + 1, body, profile, damage })
        })
        .collect();
    if panels.is_empty() {
        return Err(DrawingError::NoDamage);
    }
    #[expect(clippy::cast_precision_loss, reason = "there are two panels at most")]
    let width = (WIDTH - 2.0 * EDGE) / panels.len() as f64;
    // The same scale for both: the vehicles can be compared.
    let scale = panels.iter().fold(LARGEST, |scale, panel| {
        let extent = panel.extent();
        scale.min((width - 2.0 * MARGIN) / extent.width()).min((ROOM - 2.0 * MARGIN) / extent.height())
    });
    let captions: Vec<Vec<String>> =
        panels.iter().map(|panel| panel.caption(case, units, width - 16.0)).collect();
    let rows = captions.iter().map(Vec::len).max().unwrap_or(0);
    #[expect(clippy::cast_precision_loss, reason = "a caption has few lines")]
    let bottom = HEADER + ROOM + ROW * (rows as f64 + 1.0);
    let mut canvas = Canvas::new(Subject::Damage.name(), WIDTH, bottom + 118.0);
    canvas.define_stripes("crushed", GREY, WHITE, 45, 6.0);

    let title = case.title.as_deref().unwrap_or("Untitled case");
    legend::header(&mut canvas, title, "Damage: crush profiles in place, to scale, forward is up");
    let room = Rect::new(EDGE, HEADER, WIDTH - EDGE, HEADER + ROOM);
    for (k, (panel, caption)) in panels.iter().zip(&captions).enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "there are two panels at most")]
        let left = EDGE + k as f64 * width;
        let middle = Point::new(left + width / 2.0, HEADER + ROOM / 2.0);
        panel.draw(&mut canvas, middle, scale);
        for (row, line) in caption.iter().enumerate() {
            #[expect(clippy::cast_precision_loss, reason = "a caption has few lines")]
            let y = HEADER + ROOM + ROW * (row as f64 + 1.0);
            canvas.text(Point::new(left + 4.0, y), line, SMALL, Anchor::Start, BLACK);
        }
    }
    canvas.place_labels(room);
    let metre = units.size(Quantity::Length);
    let bar = (scale * metre, units.name(Quantity::Length), metre);
    legend::scale_bar(&mut canvas, "scale", Point::new(EDGE + 4.0, bottom + 14.0), bar, "");
    let fill = canvas.pattern("crushed");
    let entries = [
        (Sample::Box(CRUSHED, fill), "crushed area of the side".to_owned()),
        (Sample::Line(CRUSHED), "profile through the stations C1, C2 …".to_owned()),
        (Sample::CentreOfGravity, "CG: centre of gravity".to_owned()),
        legend::windscreen(),
    ];
    legend::legend(&mut canvas, bottom + 36.0, 3, &entries);
    let description = captions.iter().map(|lines| lines.join(" ")).collect::<Vec<_>>().join(" ");
    Ok(Drawing::new(
        Subject::Damage,
        format!("{title}: damage"),
        format!("Outline of each damaged vehicle from above, with its crush profile. {description}"),
        canvas,
    ))
}

impl Panel<'_> {
    /// (m) of outline and damage: x to the right, y downwards.
    fn extent(&self) -> Rect {
        let there = self.there(Point::ZERO, 1.0);
        let points = self.body.corners().into_iter().chain(self.profile.face.iter().copied());
        let start = there * self.body.middle();
        points.fold(Rect::from_points(start, start), |rect, point| rect.union_pt(there * point))
    }

    /// Forward is up.
    fn there(&self, cg: Point, scale: f64) -> kurbo::Affine {
        placed(Vec2::new(0.0, 1.0), cg, scale)
    }

    fn draw(&self, canvas: &mut Canvas, middle: Point, scale: f64) {
        let Self { number, body, profile, .. } = self;
        let extent = self.extent();
        let cg = middle - extent.center().to_vec2() * scale;
        let there = self.there(cg, scale);
        canvas.path(
            &format!("outline-{number}"),
            &(there * body.outline()),
            Some(OUTLINE[number - 1]),
            FILL[number - 1],
        );
        canvas.path("", &(there * body.windscreen()), Some(THIN), WHITE);
        let face: Vec<Point> = profile.face.iter().map(|&at| there * at).collect();
        let crushed: Vec<Point> = profile.crushed.iter().map(|&at| there * at).collect();
        let mut area = BezPath::new();
        for (k, &point) in face.iter().chain(crushed.iter().rev()).enumerate() {
            if k == 0 { area.move_to(point) } else { area.line_to(point) }
        }
        area.close_path();
        let fill = canvas.pattern("crushed");
        canvas.path(&format!("crush-{number}"), &area, Some(CRUSHED), &fill);
        canvas.centre_of_gravity(&format!("cg-{number}"), cg);
        canvas.label(cg, "CG", BLACK);
        if self.damage.inferred.is_none() {
            self.stations(canvas, &face, &crushed);
        }
    }

    /// The stations, and the names of as many as there is room for, the first and the last among them.
    fn stations(&self, canvas: &mut Canvas, face: &[Point], crushed: &[Point]) {
        let outward = Vec2::new(-self.profile.outward.y, -self.profile.outward.x);
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
            // Stations closer than a dot is large would only make the line of the profile thicker, and a scan has thousands of them.
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
            // The text's base line lies below its middle.
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

    fn caption(&self, case: &Case, units: Units, most: f64) -> Vec<String> {
        let Self { number, body, profile, damage } = self;
        let vehicle = &case.vehicles[number - 1];
        let name = vehicle.name.as_deref().map(|name| format!(" · {name}")).unwrap_or_default();
        let side = vehicle.crush.as_ref().map_or("", |crush| words::side_name(crush.side));
        let width = units.format(Quantity::Crush, damage.width);
        let mut sentences = vec![font::cut(&format!("Vehicle {number}{name}"), SMALL, most)];
        // The unit does not go to a line of its own.
        let unit = &format!(" {}", units.name(Quantity::Crush));
        let crush = match &damage.inferred {
            Some(inferred) => format!(
                "{side}, {width} wide; inferred from the force: {} deep",
                units.format(Quantity::Crush, inferred.crush.depth)
            ),
            None if damage.depths.len() > LISTED => format!(
                "{side}, {width} wide; C1 to C{}: {} to {} deep",
                damage.depths.len(),
                units.format(Quantity::Crush, damage.depths.iter().copied().fold(f64::INFINITY, f64::min)),
                units.format(Quantity::Crush, damage.depths.iter().copied().fold(0.0, f64::max)),
            ),
            None => format!(
                "{side}, {width} wide; C1 to C{}: {}",
                damage.depths.len(),
                units
                    .format_all(Quantity::Crush, &damage.depths)
                    .replace(unit, &format!("\u{a0}{}", unit.trim_start()))
            ),
        };
        sentences.extend(font::lines(&format!("Damage: {crush}."), SMALL, most));
        sentences.push(format!("Crush energy {}.", units.format(Quantity::Energy, damage.crush_energy)));
        if let Some(crush) = vehicle.crush.as_ref().filter(|crush| crush.offset.is_none()) {
            let middle = words::undisplaced(crush.side);
            sentences.extend(font::lines(&format!("No offset is given: drawn {middle}."), SMALL, most));
        }
        let outline = match body.outline {
            Outline::Given => None,
            Outline::OfClass(class) => Some(format!("Outline: typical of CRASH3's size class {class}.")),
            Outline::Nearest(class) => {
                Some(format!("Outline: CRASH3's size class {class}, assumed, nearest by radius of gyration."))
            }
        };
        let beyond: Vec<String> = body
            .beyond(profile.face.iter().chain(&profile.crushed).copied())
            .into_iter()
            .filter(|(_, by)| *by > BEYOND)
            .map(|(side, by)| {
                format!("{} past its {}", units.format(Quantity::Crush, by), words::side_name(side))
            })
            .collect();
        let beyond = (!beyond.is_empty())
            .then(|| format!("The damage reaches beyond the outline as drawn: {}.", beyond.join(", ")));
        for note in [outline, beyond].into_iter().flatten() {
            sentences.extend(font::lines(&note, SMALL, most));
        }
        sentences
    }
}
