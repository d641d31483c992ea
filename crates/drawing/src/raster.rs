//! From SVG to PNG.

use std::sync::Arc;

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb::Database};

use crate::font;
use crate::site_plan::Backdrop;

/// The drawing could not be turned into a PNG or a PDF.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the drawing could not be rendered: {0}")]
pub struct RenderError(pub(crate) String);

/// Pixels for each unit of the SVG.
const SCALE: f32 = 2.0;

/// The drawing as read by resvg, with the built-in font only: the fonts of the machine have no influence.
pub(crate) fn tree(svg: &str) -> Result<Tree, RenderError> {
    let mut fonts = Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    let options =
        Options { fontdb: Arc::new(fonts), font_family: "DejaVu Sans".to_owned(), ..Options::default() };
    Tree::from_str(&font::with_known_letters(svg), &options).map_err(|error| RenderError(error.to_string()))
}

/// The drawing on a white page, whose top is at the given y (px).
pub(crate) fn png(svg: &str, top: f64, backdrop: Option<&Backdrop>) -> Result<Vec<u8>, RenderError> {
    let tree = tree(svg)?;
    let size =
        tree.size().to_int_size().scale_by(SCALE).ok_or_else(|| RenderError("it has no size".to_owned()))?;
    let mut pixels = Pixmap::new(size.width(), size.height())
        .ok_or_else(|| RenderError("there is no memory for it".to_owned()))?;
    pixels.fill(Color::WHITE);
    if let Some(backdrop) = backdrop {
        #[expect(clippy::cast_possible_truncation, reason = "a number of the page")]
        let page = Transform::from_scale(SCALE, SCALE).pre_translate(0.0, -top as f32);
        backdrop.draw(&mut pixels, page).map_err(|error| RenderError(error.to_string()))?;
    }
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| RenderError(error.to_string()))
}
