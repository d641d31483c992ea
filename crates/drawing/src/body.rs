//! The shape in which a vehicle or a fixed object is drawn.

use kurbo::BezPath;

use crate::canvas::Canvas;
use crate::footprint::{BodyShape, CrushProfile, Footprint};
use crate::legend::Sample;
use crate::pens::{FILL, OUTLINE, THIN};
use crate::plan::{self, Pose};

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

impl SceneBody {
    /// (m) its outline in the scene, damaged if its crush is known.
    pub(crate) fn outline_in(&self, pose: Pose) -> Option<BezPath> {
        let Self::Outline { footprint, crush } = self else { return None };
        Some(pose.in_scene() * footprint.left_by(crush.as_ref()))
    }

    /// Its sample in the legend as body `i`, with the ends (m) of a wall if the place of the contact is known.
    pub(crate) fn sample(&self, ends: Option<[f64; 2]>, i: usize, canvas: &Canvas) -> Sample {
        match (self, ends) {
            (Self::Outline { footprint, .. }, _) if footprint.shape != BodyShape::Fixed => {
                Sample::Box(OUTLINE[i], FILL[i].to_owned())
            }
            (Self::Wall, Some(ends)) if !plan::is_drawn(ends) => Sample::Nothing,
            (Self::Unknown, _) | (Self::Wall | Self::Pole { .. }, None) => Sample::Nothing,
            _ => Sample::Box(THIN, canvas.pattern("fixed")),
        }
    }
}
