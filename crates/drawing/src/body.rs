//! The drawn shape of a vehicle or a fixed object.

use crate::footprint::{CrushProfile, Footprint};

/// The known shape of a vehicle or a fixed object.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneBody {
    /// Its outline. If its crush is known, the damaged body is filled and the undamaged one dashed.
    Outline {
        /// The undamaged body.
        footprint: Footprint,
        /// The damaged face.
        crush: Option<CrushProfile>,
    },
    /// A pole or a tree, which the contact point touches.
    Pole {
        /// (m)
        diameter: f64,
    },
    /// A fixed object of unknown extent: a wall along the crush plane.
    Wall,
    /// A vehicle of unknown shape: its centre of gravity and its arrows are drawn, and no body.
    Unknown,
}
