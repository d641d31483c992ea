//! Places in the scene, and the ground of the table `[surface]`.

use std::fmt::Display;

use pim_core::Vector2;
use real::Real;

use crate::choices;
use crate::quantity::Quantity;
use crate::text::Text;
use crate::walk::{Element, Key, Walk};

/// A point: in the scene, in the coordinates of its survey, or in a vehicle, from its centre of gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place<T = f64> {
    /// (m) along the scene's x, or forward.
    pub x: Quantity<T>,
    /// (m) along the scene's y, or across, in the sense of the axes.
    pub y: Quantity<T>,
}

impl<T: Copy> Place<T> {
    /// The same with other quantities.
    pub(crate) fn map_quantities<U>(self, mut of: impl FnMut(Quantity<T>) -> Quantity<U>) -> Place<U> {
        Place { x: of(self.x), y: of(self.y) }
    }
}

/// (m) a displacement forward and left from a CG, in the directions of the scene.
pub(crate) fn in_scene<T: Real>([forward, left]: [T; 2], heading: T) -> Vector2<T> {
    let (sin, cos) = heading.sin_cos();
    // (f cos θ − l sin θ, f sin θ + l cos θ)
    Vector2::new(forward * cos - left * sin, forward * sin + left * cos)
}

/// A picture of the scene from above, to scale: `site_plan` of `[scene]`. Its numbers are exact.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenSitePlan {
    /// Path of a PNG or a JPEG, relative to the folder of the case file.
    pub file: Text,
    /// The position of its lower left corner.
    pub corner: Place,
    /// (m) length of its lower edge.
    pub width: Quantity,
    /// (rad) from the scene's x axis to its lower edge, in the sense of the axes; 0 if absent.
    pub angle: Option<Quantity>,
}

/// The ground: the table `[surface]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface<T = f64> {
    /// (–) coefficient of friction between tyre and ground, outside all zones.
    pub friction: T,
    /// The slope of the ground; level if absent.
    pub grade: Option<Grade<T>>,
    /// Zones of the ground with their own friction. Where two overlap, the later one counts.
    pub zones: Vec<SurfaceZone<T>>,
}

/// A slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grade<T = f64> {
    /// (–) rise per horizontal distance: 0.03 is a grade of 3 %.
    pub slope: T,
    /// (rad) scene angle of the direction in which the ground rises, in the sense of the axes.
    pub uphill: Quantity<T>,
}

/// A zone of the ground: an entry of `[[surface.zone]]`.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceZone<T = f64> {
    /// Its name, such as "wet shoulder".
    pub name: Option<Text>,
    /// (–) coefficient of friction.
    pub friction: T,
    /// Its area. Its corners are exact.
    pub region: SurfaceRegion,
}

/// The area of a zone.
#[derive(Clone, Debug, PartialEq)]
pub enum SurfaceRegion {
    /// Everything on one side of a line through two points.
    Beside {
        /// The two points.
        edge: [Place; 2],
        /// The side, going from the first point to the second, seen from above.
        side: EdgeSide,
    },
    /// The inside of a polygon with three or more corners.
    Polygon(Vec<Place>),
}

choices! {
    /// One side of a line, going along it, seen from above.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum EdgeSide {
        /// `"left"`.
        Left = "left",
        /// `"right"`.
        Right = "right",
    }
}

impl<U> Walk<'_, U> {
    pub(crate) fn place(&mut self, path: &dyn Display, place: &Place) -> Place<U> {
        Place { x: self.quantity(&Key(path, "x"), &place.x), y: self.quantity(&Key(path, "y"), &place.y) }
    }

    pub(crate) fn site_plan(&mut self, plan: &GivenSitePlan) -> GivenSitePlan {
        self.text(&"scene.site_plan.file", Some(&plan.file));
        self.exact_place(&"scene.site_plan.corner", &plan.corner);
        self.exact(&"scene.site_plan.width", &plan.width);
        self.exact_if(&"scene.site_plan.angle", plan.angle.as_ref());
        plan.clone()
    }

    pub(crate) fn surface(&mut self, surface: &Surface) -> Surface<U> {
        Surface {
            friction: self.number(&"surface.friction", surface.friction),
            grade: surface.grade.as_ref().map(|grade| Grade {
                slope: self.number(&"surface.grade.slope", grade.slope),
                uphill: self.quantity(&"surface.grade.uphill", &grade.uphill),
            }),
            zones: self.each(&"surface.zone", &surface.zones, Self::surface_zone),
        }
    }

    fn surface_zone(&mut self, table: &dyn Display, zone: &SurfaceZone) -> SurfaceZone<U> {
        let at = |key| Key(table, key);
        let name = self.text(&at("name"), zone.name.as_ref());
        let friction = self.number(&at("friction"), zone.friction);
        match &zone.region {
            SurfaceRegion::Polygon(corners) => self.exact_places(&at("polygon"), corners),
            SurfaceRegion::Beside { edge, side } => {
                self.exact_places(&at("edge"), edge);
                self.choice(&at("side"), &EdgeSide::WORDS, *side);
            }
        }
        SurfaceZone { name, friction, region: zone.region.clone() }
    }

    /// Places that do not vary: their values are only listed.
    pub(crate) fn exact_places(&mut self, list: &dyn Display, places: &[Place]) {
        for (index, place) in places.iter().enumerate() {
            self.exact_place(&Element(list, index), place);
        }
    }

    pub(crate) fn exact_place(&mut self, path: &dyn Display, place: &Place) {
        self.exact(&Key(path, "x"), &place.x);
        self.exact(&Key(path, "y"), &place.y);
    }
}
