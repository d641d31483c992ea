//! A site plan or an aerial picture, drawn to scale behind a plan view.

use std::fmt;
use std::sync::Arc;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use kurbo::{Affine, Rect};
use resvg::tiny_skia::{
    FillRule, FilterQuality, IntSize, Mask, PathBuilder, Pixmap, PixmapPaint, PixmapRef, Rect as Area,
    Transform,
};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::number::px;
use crate::vector::{unit, vec2};

/// Opacity of the plan, low enough that the drawing above it stands out.
pub(crate) const OPACITY: f32 = 0.5;
/// 200 MB in memory. Orthophotos of a junction with pixels of 1 cm to 2 cm have fewer.
const MOST_PIXELS: u64 = 50_000_000;
/// (px) the most that a JPEG can have.
const MOST_SIDE: usize = 65_535;

/// A PNG or a JPEG with its place in the scene.
#[derive(Clone, PartialEq)]
pub struct SitePlan {
    pub(crate) bytes: Arc<[u8]>,
    pub(crate) encoding: Encoding,
    /// (px) across and down.
    pub(crate) pixels: [u32; 2],
    place: PlanPlace,
}

/// The place of a site plan in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanPlace {
    /// (m) its lower left corner.
    pub corner: [f64; 2],
    /// From its lower left corner towards its lower right one; a vector of any length but zero.
    pub along: [f64; 2],
    /// (m) length of its lower edge. Its pixels are square.
    pub width: f64,
}

/// Why a site plan cannot be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SitePlanError {
    /// The first bytes are those of another kind of file.
    #[error("the site plan is neither a PNG nor a JPEG")]
    NotAPicture,
    /// It has no area.
    #[error("the site plan has no pixels: it is {width} wide and {height} high")]
    NoPixels {
        /// (px)
        width: u32,
        /// (px)
        height: u32,
    },
    /// It would take too much memory.
    #[error(
        "the site plan has {width} × {height} pixels, more than {} million; scale it down",
        most / 1_000_000
    )]
    TooLarge {
        /// (px)
        width: u32,
        /// (px)
        height: u32,
        /// The maximum number of pixels.
        most: u64,
    },
    /// The decoder failed.
    #[error("the site plan cannot be decoded: {0}")]
    Damaged(String),
    /// Its colours are for printing.
    #[error("the site plan is a JPEG of {0} colour components, such as CMYK; save it as RGB")]
    Components(u8),
    /// Programs disagree on whether such a picture is turned before it is shown.
    #[error("the site plan is to be turned before it is shown (Exif orientation {0}); save it upright")]
    Turned(u16),
    /// Its width gives it no place in the scene.
    #[error("the site plan is {0} m wide; give a width above zero")]
    Width(f64),
    /// Its corner gives it no place in the scene.
    #[error("the lower left corner of the site plan is at ({}, {}) m; give finite coordinates", .0[0], .0[1])]
    Corner([f64; 2]),
    /// Its direction vector is zero or not finite.
    #[error("the lower edge of the site plan points along ({}, {}); give a direction", .0[0], .0[1])]
    Along([f64; 2]),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    Png,
    /// With one colour component, or three.
    Jpeg {
        is_grey: bool,
    },
}

impl SitePlan {
    /// Reads a PNG or a JPEG.
    ///
    /// # Errors
    /// [`SitePlanError`], if it cannot be drawn at that place.
    pub fn new(bytes: Vec<u8>, place: PlanPlace) -> Result<Self, SitePlanError> {
        let PlanPlace { corner, along, width } = place;
        if !(width > 0.0 && width.is_finite()) {
            return Err(SitePlanError::Width(width));
        }
        if !corner.iter().all(|number| number.is_finite()) {
            return Err(SitePlanError::Corner(corner));
        }
        let length = vec2(along).hypot();
        if !(length > 0.0 && length.is_finite()) {
            return Err(SitePlanError::Along(along));
        }
        let (encoding, pixels) = match bytes.get(..3) {
            Some(b"\x89PN") => (Encoding::Png, png_size(&bytes)?),
            Some(b"\xff\xd8\xff") => jpeg_header(&bytes)?,
            _ => return Err(SitePlanError::NotAPicture),
        };
        let [width, height] = pixels;
        if width == 0 || height == 0 {
            return Err(SitePlanError::NoPixels { width, height });
        }
        if u64::from(width) * u64::from(height) > MOST_PIXELS {
            return Err(SitePlanError::TooLarge { width, height, most: MOST_PIXELS });
        }
        let plan = Self { bytes: bytes.into(), encoding, pixels, place };
        plan.decoded()?;
        Ok(plan)
    }

    /// Its pixels, on white where the picture is transparent.
    pub(crate) fn decoded(&self) -> Result<Pixmap, SitePlanError> {
        let mut pixels = match self.encoding {
            Encoding::Png => {
                Pixmap::decode_png(&self.bytes).map_err(|error| SitePlanError::Damaged(error.to_string()))?
            }
            Encoding::Jpeg { .. } => self.decoded_jpeg()?,
        };
        for pixel in pixels.data_mut().chunks_exact_mut(4) {
            // The colours are already multiplied by the opacity.
            let white = u8::MAX - pixel[3];
            for part in pixel {
                *part = part.saturating_add(white);
            }
        }
        Ok(pixels)
    }

    fn decoded_jpeg(&self) -> Result<Pixmap, SitePlanError> {
        let damaged = |error: &dyn fmt::Display| SitePlanError::Damaged(error.to_string());
        let options = jpeg_options().jpeg_set_out_colorspace(ColorSpace::RGB);
        let mut decoder = JpegDecoder::new_with_options(ZCursor::new(&self.bytes[..]), options);
        let rgb = decoder.decode().map_err(|error| damaged(&error))?;
        let rgba = rgb.chunks_exact(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], u8::MAX]).collect();
        let [width, height] = self.pixels;
        IntSize::from_wh(width, height)
            .and_then(|size| Pixmap::from_vec(rgba, size))
            .ok_or_else(|| damaged(&"it has another size than its header says"))
    }

    /// Transform from the unit square, whose y points downwards as in a picture, to the scene (m), whose y
    /// points upwards.
    fn in_scene(&self) -> Affine {
        let PlanPlace { corner, along, width } = self.place;
        let across = unit(vec2(along)) * width;
        let [columns, rows] = self.pixels.map(f64::from);
        let up = kurbo::Vec2::new(-across.y, across.x) * (rows / columns);
        let top = vec2(corner) + up;
        Affine::new([across.x, across.y, -up.x, -up.y, top.x, top.y])
    }
}

/// Without the bytes.
impl fmt::Debug for SitePlan {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { bytes, encoding, pixels, place } = self;
        formatter
            .debug_struct("SitePlan")
            .field("bytes", &bytes.len())
            .field("encoding", encoding)
            .field("pixels", pixels)
            .field("place", place)
            .finish()
    }
}

/// PNG specification, 5.2 and 11.2.1: the signature, then the chunk IHDR, which begins with width and height.
fn png_size(bytes: &[u8]) -> Result<[u32; 2], SitePlanError> {
    if !bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        return Err(SitePlanError::NotAPicture);
    }
    let number = |at: usize| {
        let bytes = bytes.get(at..at + 4).and_then(|bytes| <[u8; 4]>::try_from(bytes).ok());
        bytes.map(u32::from_be_bytes).ok_or_else(|| SitePlanError::Damaged("it ends too early".to_owned()))
    };
    Ok([number(16)?, number(20)?])
}

fn jpeg_options() -> DecoderOptions {
    // The total number of pixels is limited instead.
    DecoderOptions::default().set_max_width(MOST_SIDE).set_max_height(MOST_SIDE).set_strict_mode(true)
}

fn jpeg_header(bytes: &[u8]) -> Result<(Encoding, [u32; 2]), SitePlanError> {
    if let Some([width, height]) = jpeg_size(bytes).filter(|size| size.contains(&0)) {
        return Err(SitePlanError::NoPixels { width, height });
    }
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), jpeg_options());
    decoder.decode_headers().map_err(|error| SitePlanError::Damaged(error.to_string()))?;
    let info = decoder.info().ok_or_else(|| SitePlanError::Damaged("it has no header".to_owned()))?;
    let is_grey = match info.components {
        1 => true,
        3 => false,
        other => return Err(SitePlanError::Components(other)),
    };
    match info.exif_data.as_deref().and_then(exif_orientation) {
        None | Some(1) => {}
        Some(other) => return Err(SitePlanError::Turned(other)),
    }
    Ok((Encoding::Jpeg { is_grey }, [u32::from(info.width), u32::from(info.height)]))
}

/// ITU-T T.81, B.2.2: segments; the frame segment (SOF) contains height and width.
fn jpeg_size(bytes: &[u8]) -> Option<[u32; 2]> {
    let word = |at: usize| Some(u16::from_be_bytes([*bytes.get(at)?, *bytes.get(at + 1)?]));
    let mut at = 2;
    loop {
        let marker = word(at)?;
        match marker {
            // DHT, JPG and DAC lie between the frame markers but are not frames.
            0xffc4 | 0xffc8 | 0xffcc => {}
            0xffc0..=0xffcf => return Some([word(at + 7)?, word(at + 5)?].map(u32::from)),
            0xff00.. => {}
            _ => return None,
        }
        at += 2 + usize::from(word(at + 2)?);
    }
}

/// The tag Orientation (0x0112) of the first directory of Exif's TIFF (TIFF 6.0, section 2). 1 is upright.
fn exif_orientation(tiff: &[u8]) -> Option<u16> {
    let is_little = tiff.starts_with(b"II");
    let word = |at: usize| {
        let bytes = [*tiff.get(at)?, *tiff.get(at.checked_add(1)?)?];
        Some(if is_little { u16::from_le_bytes(bytes) } else { u16::from_be_bytes(bytes) })
    };
    let [high, low] = if is_little { [6, 4] } else { [4, 6] };
    let directory = usize::from(word(high)?) << 16 | usize::from(word(low)?);
    let entries = usize::from(word(directory)?);
    let mut entries = (0..entries).map(|k| directory + 2 + 12 * k);
    let orientation = entries.find(|&entry| word(entry) == Some(0x0112))?;
    word(orientation + 8)
}

/// A site plan on a page.
#[derive(Clone, Debug)]
pub(crate) struct Backdrop {
    pub(crate) plan: SitePlan,
    /// Transform from the unit square, whose y points downwards, to the page (px), as written to the SVG.
    pub(crate) page_of_plan: [f64; 6],
    /// (px) nothing outside this is visible.
    pub(crate) frame: Rect,
}

impl Backdrop {
    /// `page_of_scene` maps metres, y upwards, to the page.
    pub(crate) fn new(plan: &SitePlan, page_of_scene: Affine, frame: Rect) -> Self {
        let page_of_plan = (page_of_scene * plan.in_scene()).as_coeffs();
        // In hundredths of a pixel, as in an SVG, so that all formats agree.
        let page_of_plan = page_of_plan.map(|number| (number * 100.0).round() / 100.0);
        Self { plan: plan.clone(), page_of_plan, frame }
    }

    /// The `id`s of its shapes begin with `name`.
    pub(crate) fn svg(&self, name: &str) -> String {
        let Rect { x0, y0, .. } = self.frame;
        let [x, y, width, height] = [x0, y0, self.frame.width(), self.frame.height()].map(px);
        let kind = match self.plan.encoding {
            Encoding::Png => "png",
            Encoding::Jpeg { .. } => "jpeg",
        };
        format!(
            "<clipPath id=\"{name}-frame-of-plan\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/></clipPath>\n\
             <g clip-path=\"url(#{name}-frame-of-plan)\"><image id=\"{name}-site-plan\" width=\"1\" height=\"1\" preserveAspectRatio=\"none\" \
             opacity=\"{OPACITY}\" transform=\"matrix({})\" href=\"data:image/{kind};base64,{}\"/></g>\n",
            self.page_of_plan.map(px).join(" "),
            STANDARD.encode(&self.plan.bytes),
        )
    }

    /// Draws it onto a white page. `pixels_of_page` maps the page (px of the SVG) to its pixels.
    pub(crate) fn draw(&self, page: &mut Pixmap, pixels_of_page: Transform) -> Result<(), SitePlanError> {
        let plan = self.plan.decoded()?;
        #[expect(clippy::cast_possible_truncation, reason = "numbers of a page, in hundredths of a pixel")]
        let [a, b, c, d, e, f] = self.page_of_plan.map(|number| number as f32);
        let pixels_of_square = pixels_of_page.pre_concat(Transform::from_row(a, b, c, d, e, f));
        let Transform { sx, ky, .. } = pixels_of_square;
        let plan = shrunk(plan, (sx * sx + ky * ky).sqrt());
        #[expect(clippy::cast_precision_loss, reason = "no picture has as many pixels across")]
        let [columns, rows] = [plan.width(), plan.height()].map(|number| number as f32);
        let paint =
            PixmapPaint { opacity: OPACITY, quality: FilterQuality::Bilinear, ..PixmapPaint::default() };
        let transform = pixels_of_square.pre_scale(1.0 / columns, 1.0 / rows);
        let mask = self.mask(page.as_ref(), pixels_of_page);
        page.draw_pixmap(0, 0, plan.as_ref(), &paint, transform, mask.as_ref());
        Ok(())
    }

    fn mask(&self, page: PixmapRef, pixels_of_page: Transform) -> Option<Mask> {
        #[expect(clippy::cast_possible_truncation, reason = "numbers of a page")]
        let [x0, y0, x1, y1] =
            [self.frame.x0, self.frame.y0, self.frame.x1, self.frame.y1].map(|number| number as f32);
        let mut mask = Mask::new(page.width(), page.height())?;
        let frame = PathBuilder::from_rect(Area::from_ltrb(x0, y0, x1, y1)?);
        mask.fill_path(&frame, FillRule::Winding, true, pixels_of_page);
        Some(mask)
    }
}

/// Averages k × k pixels if the page shows less than half as many: otherwise a line of the plan that falls
/// between two pixels of the page would be lost.
fn shrunk(plan: Pixmap, across: f32) -> Pixmap {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a ratio of pixels, of which what is below one or has no number is one"
    )]
    let k = (plan.width() as f32 / across) as u32;
    let k = k.min(plan.width()).min(plan.height());
    let Some(mut small) = (k > 1).then(|| Pixmap::new(plan.width() / k, plan.height() / k)).flatten() else {
        return plan;
    };
    let (columns, stride) = (small.width() as usize, plan.width() as usize);
    let k = k as usize;
    let area = u32::try_from(k * k).unwrap_or(u32::MAX);
    for (i, pixel) in small.data_mut().chunks_exact_mut(4).enumerate() {
        let (left, top) = ((i % columns) * k, (i / columns) * k);
        for (part, mean) in pixel.iter_mut().enumerate() {
            let row = |y: usize| (left..left + k).map(move |x| 4 * (y * stride + x) + part);
            let sum: u32 = (top..top + k).flat_map(row).map(|at| u32::from(plan.data()[at])).sum();
            *mean = u8::try_from((sum + area / 2) / area).unwrap_or(u8::MAX);
        }
    }
    small
}
