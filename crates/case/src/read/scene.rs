//! `[scene]` and `[surface]`: the axes, the place of the impact, and the ground.

use std::path::{Component, Path};

use super::tree::{Reader, Table};
use super::values::Place as Position;
use crate::schema::{Form, MOST_ZONES};
use inputs::{Axes, EdgeSide, GivenSitePlan, Grade, Place, Quantity, Surface, SurfaceRegion, SurfaceZone};

/// Error text for a range where none is allowed.
const EXACT_PLACE: &str = "a string with a number and a unit, because this place is exact";
/// The name of a shape with corners, and advice on another way to describe it.
#[derive(Clone, Copy)]
pub(super) struct Shape {
    name: &'static str,
    instead: &'static str,
}

const OF_ZONE: Shape =
    Shape { name: "a zone", instead: "; for a zone with one straight edge, write edge and side" };
pub(super) const OF_OBSTACLE: Shape = Shape { name: "an obstacle", instead: "" };
const POLYGON: &str =
    "[{ x = \"0 m\", y = \"6 m\" }, { x = \"50 m\", y = \"6 m\" }, { x = \"50 m\", y = \"9 m\" }]";
const EDGE: &str = "[{ x = \"0 m\", y = \"6 m\" }, { x = \"50 m\", y = \"6 m\" }]";
const EXACT_PLAN: &str = "a string with a number and a unit, because the place of a site plan is exact";

impl<'t> Reader<'t> {
    pub(super) fn axes(&mut self, scene: &Table<'t>) -> Option<Axes> {
        const FORMS: &str = "\"z-up\" (y to the left, angles positive counter-clockwise) or \"z-down\" (SAE J670: y to the right, angles positive \
                             clockwise)";
        self.choice_among(scene, "axes", &Axes::WORDS, FORMS)
    }

    /// `contact` of `[scene]`; the outer option is `None` if it is present but wrong.
    pub(super) fn scene_contact(&mut self, scene: &Table<'t>) -> Option<Option<Place>> {
        if !scene.has("contact") {
            return Some(None);
        }
        self.place_of(scene, "contact").map(Some)
    }

    /// `site_plan` of `[scene]`; the outer option is `None` if it is present but wrong.
    pub(super) fn site_plan(&mut self, scene: &Table<'t>) -> Option<Option<GivenSitePlan>> {
        const FORMS: &str = "site_plan = { file = \"aerial.jpg\", corner = { x = \"-20 m\", y = \"-15 m\" }, width = \"60 m\" }";
        if !scene.has("site_plan") {
            return Some(None);
        }
        let table = self.inline(scene, "site_plan", FORMS)?;
        self.require(&table, &["file", "corner", "width"]);
        let file = self.text(&table, "file");
        let corner = self.place_of(&table, "corner");
        let width = self.exact_quantity(&table, "width", EXACT_PLAN);
        let has_angle = table.has("angle");
        let angle = self.exact_quantity(&table, "angle", EXACT_PLAN);
        let (file, corner, width) = (file?, corner?, width?);
        if has_angle && angle.is_none() {
            return None;
        }
        // A case from somebody else must not choose files elsewhere on the computer.
        let is_within = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
        if !Path::new(file.as_given()).components().all(is_within) {
            let message = format!("\"{}\" is not in the folder of the case file", table.path_of("file"));
            let help = "put the picture next to the case file, or into a folder there, and write its name: \
                        file = \"aerial.jpg\"";
            return self.refuse(&table.path_of("file"), message, help);
        }
        Some(Some(GivenSitePlan { file, corner, width, angle }))
    }

    /// The point under a key.
    pub(super) fn place_of(&mut self, parent: &Table<'t>, key: &'static str) -> Option<Place> {
        let table = self.inline(parent, key, parent.schema.example(key))?;
        self.place(&table)
    }

    /// A point. The schema says whether its coordinates may be ranges.
    pub(super) fn place(&mut self, table: &Table<'t>) -> Option<Place> {
        self.require(table, &["x", "y"]);
        let [x, y] = ["x", "y"].map(|key| match table.schema.key(key)?.form {
            Form::Exact(..) => self.exact_quantity(table, key, EXACT_PLACE),
            _ => self.quantity(table, key),
        });
        Some(Place { x: x?, y: y? })
    }

    pub(super) fn surface(&mut self, table: &Table<'t>) -> Option<Surface> {
        self.require(table, &["friction"]);
        let friction = self.number(table, "friction");
        let grade = if table.has("grade") { self.grade(table).map(Some) } else { Some(None) };
        let zones = if table.has("zone") { self.surface_zones(table) } else { Some(Vec::new()) };
        Some(Surface { friction: friction?, grade: grade?, zones: zones? })
    }

    fn grade(&mut self, surface: &Table<'t>) -> Option<Grade> {
        const FORMS: &str =
            "grade = { slope = 0.03, uphill = \"90 deg\" }, which rises by 3 % in that direction";
        let table = self.inline(surface, "grade", FORMS)?;
        self.require(&table, &["slope", "uphill"]);
        let slope = self.number(&table, "slope");
        let uphill = self.quantity(&table, "uphill");
        Some(Grade { slope: slope?, uphill: uphill? })
    }

    fn surface_zones(&mut self, surface: &Table<'t>) -> Option<Vec<SurfaceZone>> {
        const FORMS: &str =
            "a table [[surface.zone]] with friction and polygon, or with friction, edge and side";
        let tables = self.tables(surface, "zone", FORMS, MOST_ZONES)?;
        // Every zone is read before the first fault ends it.
        let zones: Vec<Option<SurfaceZone>> = tables.iter().map(|table| self.surface_zone(table)).collect();
        zones.into_iter().collect()
    }

    fn surface_zone(&mut self, table: &Table<'t>) -> Option<SurfaceZone> {
        const FORMS: &str = "friction and polygon = [{ x = \"0 m\", y = \"6 m\" }, …], or friction, \
                             edge = [{ x = \"0 m\", y = \"6 m\" }, { x = \"50 m\", y = \"6 m\" }] and side = \"left\"";
        let name = self.text(table, "name");
        let friction = self.number(table, "friction");
        let polygon = self.places(table, "polygon", POLYGON);
        let edge = self.places(table, "edge", EDGE);
        let side = self.choice(table, "side", &EdgeSide::WORDS);
        let region = match table.given(&["friction", "polygon", "edge", "side"])[..] {
            ["friction", "polygon"] => SurfaceRegion::Polygon(self.outlined(table, polygon?, OF_ZONE)?),
            ["friction", "edge", "side"] => {
                SurfaceRegion::Beside { edge: self.edge(table, &edge?)?, side: side? }
            }
            _ => return self.no_form(table, FORMS),
        };
        Some(SurfaceZone { name, friction: friction?, region })
    }

    /// The corners of `polygon`, of which `shape` has three or more.
    pub(super) fn polygon(&mut self, table: &Table<'t>, shape: Shape) -> Option<Vec<Place>> {
        let corners = self.places(table, "polygon", POLYGON)?;
        self.outlined(table, corners, shape)
    }

    /// A list of places, with `forms` as an example of one.
    pub(super) fn places(
        &mut self,
        table: &Table<'t>,
        key: &'static str,
        forms: &'static str,
    ) -> Option<Vec<Place>> {
        let tables = self.tables(table, key, forms, MOST_ZONES)?;
        let places: Vec<Option<Place>> = tables.iter().map(|table| self.place(table)).collect();
        places.into_iter().collect()
    }

    pub(super) fn exact_quantity(
        &mut self,
        table: &Table<'t>,
        key: &'static str,
        wanted: &'static str,
    ) -> Option<Quantity> {
        self.certain_quantity(&Position::of_key(table, key)?, table.measure(key)?, wanted)
    }

    fn edge(&mut self, zone: &Table<'t>, edge: &[Place]) -> Option<[Place; 2]> {
        if let [first, second] = edge
            && at(first) != at(second)
        {
            return Some([*first, *second]);
        }
        let path = zone.path_of("edge");
        let message = match edge {
            [_, _] => format!("the two places of \"{path}\" are the same"),
            _ => format!("\"{path}\" has {} places, but an edge needs two", edge.len()),
        };
        let help = "give two different places on the edge of the zone, far apart; for a zone with corners, write polygon";
        self.refuse(&path, message, help)
    }

    /// The corners, if they enclose a part of the ground.
    fn outlined(&mut self, zone: &Table<'t>, corners: Vec<Place>, shape: Shape) -> Option<Vec<Place>> {
        let path = zone.path_of("polygon");
        let places: Vec<[f64; 2]> = corners.iter().map(at).collect();
        let count = places.len();
        if count < 3 {
            let message = format!("\"{path}\" has {count} corners, but {} needs three or more", shape.name);
            let help = format!("give all corners, in their order along the outline{}", shape.instead);
            return self.refuse(&path, message, &help);
        }
        let side = |index: usize| [places[index], places[(index + 1) % count]];
        if let Some(index) = (0..count).find(|index| side(*index)[0] == side(*index)[1]) {
            let message =
                format!("corners {} and {} of \"{path}\" are the same", index + 1, (index + 1) % count + 1);
            let help = "give each corner once; the outline closes by itself";
            return self.refuse(&path, message, help);
        }
        let crossing = (0..count)
            .flat_map(|first| (first + 2..count).map(move |second| (first, second)))
            // The last side ends where the first begins.
            .filter(|(first, second)| (second + 1) % count != *first)
            .find(|(first, second)| cross(side(*first), side(*second)));
        if let Some((first, second)) = crossing {
            let message = format!(
                "the outline of \"{path}\" crosses itself: its side after corner {} meets that after corner {}",
                first + 1,
                second + 1
            );
            let help = "list the corners in their order along the outline";
            return self.refuse(&path, message, help);
        }
        Some(corners)
    }
}

/// (m) the coordinates of a place.
fn at(place: &Place) -> [f64; 2] {
    [place.x.si(), place.y.si()]
}

/// Whether two line segments have a point in common.
fn cross([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    // (q − p) × (r − p): positive where r lies to the left of the line from p to q
    let turn =
        |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    let (of_c, of_d, of_a, of_b) = (turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b));
    // If they lie on one line, their extents decide.
    let overlap = |axis: usize| {
        a[axis].min(b[axis]) <= c[axis].max(d[axis]) && c[axis].min(d[axis]) <= a[axis].max(b[axis])
    };
    of_c * of_d <= 0.0 && of_a * of_b <= 0.0 && overlap(0) && overlap(1)
}
