//! The axes in words.

use case::Axes;

/// The direction in which y points.
pub(crate) fn side_of_y(axes: Axes) -> &'static str {
    match axes {
        Axes::ZUp => "left",
        Axes::ZDown => "right",
    }
}

/// The sense in which angles and yaw rates are positive.
pub(crate) fn sense(axes: Axes) -> &'static str {
    match axes {
        Axes::ZUp => "counter-clockwise",
        Axes::ZDown => "clockwise",
    }
}

/// What a reader has to know about the signs.
pub(crate) fn conventions(axes: Axes) -> &'static str {
    match axes {
        Axes::ZUp => "Angles and yaw rates are counter-clockwise positive, PDOF and α clockwise",
        Axes::ZDown => {
            "The axes are z-down (SAE J670): y points to the right; angles and yaw rates are clockwise positive, and so are PDOF and α"
        }
    }
}
