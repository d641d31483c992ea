//! A finished drawing and its file formats.

use crate::canvas::{Canvas, escaped};
use crate::number::px;
use crate::pdf;
use crate::pens::WHITE;
use crate::raster::{self, RenderError};

/// The file format of a drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PictureFormat {
    /// Vectors, for web pages.
    #[default]
    Svg,
    /// Pixels.
    Png,
    /// Vectors, for paper.
    Pdf,
}

impl PictureFormat {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Png, Self::Pdf];

    /// The file name extension, without the dot.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Pdf => "pdf",
        }
    }
}

/// A finished drawing.
#[derive(Clone, Debug)]
pub struct Drawing {
    title: String,
    description: String,
    canvas: Canvas,
}

impl Drawing {
    pub(crate) fn new(title: String, description: String, canvas: Canvas) -> Self {
        Self { title, description, canvas }
    }

    /// Stacks drawings on one page, each with its word in its `id`s there. None of them may have a site plan.
    #[must_use]
    pub fn stacked(name: &'static str, title: String, drawings: &[(String, Self)]) -> Self {
        let width = drawings.iter().map(|(_, drawing)| drawing.canvas.page().width()).fold(0.0, f64::max);
        let mut canvas = Canvas::new(name, width);
        let mut descriptions = Vec::new();
        for (place, drawing) in drawings {
            let page = drawing.canvas.page();
            let body = drawing.body_named(&format!("{name}-{place}"));
            let down = px(canvas.height - page.y0);
            canvas.element(&format!("<g transform=\"translate(0 {down})\">\n{body}</g>"));
            canvas.missing.extend(drawing.missing_letters());
            canvas.height += page.height();
            descriptions.push(drawing.description.as_str());
        }
        Self::new(title, descriptions.join(" "), canvas)
    }

    /// The name of its subject, which is the first part of the `id`s in its SVG.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.canvas.prefix
    }

    /// Its title, one line.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The drawing described for readers who cannot see it.
    #[must_use]
    pub fn description(&self) -> &str {
        &self.description
    }

    /// The drawing as SVG, with its title and description, for a file of its own or inside HTML.
    #[must_use]
    pub fn svg(&self) -> String {
        self.svg_named(self.name())
    }

    /// The same with another [`name`](Self::name) in its `id`s, so that several drawings of one kind can be
    /// on one page.
    #[must_use]
    pub fn svg_named(&self, name: &str) -> String {
        let page = self.canvas.page();
        let [top, width, height] = [page.y0, page.width(), page.height()].map(px);
        let ground = format!("<rect y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"{WHITE}\"/>\n");
        let backdrop = self.canvas.backdrop.as_ref().map(|backdrop| backdrop.svg(name)).unwrap_or_default();
        self.svg_on(name, &format!("{ground}{backdrop}"))
    }

    /// The drawing in front of the page and its backdrop.
    fn foreground(&self) -> String {
        self.svg_on(self.name(), "")
    }

    /// The shapes, with another name in their `id`s.
    fn body_named(&self, name: &str) -> String {
        let own = self.name();
        // Quotation marks in texts are escaped, so no text matches.
        let body = self.canvas.body.replace(&format!(" id=\"{own}-"), &format!(" id=\"{name}-"));
        body.replace(&format!("=\"url(#{own}-"), &format!("=\"url(#{name}-"))
    }

    fn svg_on(&self, name: &str, ground: &str) -> String {
        let Self { title, description, canvas } = self;
        let body = self.body_named(name);
        let page = canvas.page();
        let [top, width, height] = [page.y0, page.width(), page.height()].map(px);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 {top} {width} {height}\" role=\"img\" \
             aria-labelledby=\"{name}-title {name}-description\" font-family=\"Arial, Helvetica, 'DejaVu Sans', sans-serif\">\n\
             <title id=\"{name}-title\">{}</title>\n<desc id=\"{name}-description\">{}</desc>\n\
             {ground}{body}</svg>\n",
            escaped(title),
            escaped(description),
        )
    }

    /// Characters of the drawing that are missing from DejaVu Sans, the built-in font. PNG and PDF show
    /// question marks in their place; an SVG uses the reader's own fonts.
    pub fn missing_letters(&self) -> impl Iterator<Item = char> {
        self.canvas.missing.iter().copied()
    }

    /// The drawing as PNG, with two pixels for each unit of the SVG. Its font is the built-in DejaVu Sans.
    ///
    /// # Errors
    /// [`RenderError`]: the picture is too large for the memory.
    pub fn png(&self) -> Result<Vec<u8>, RenderError> {
        raster::png(&self.foreground(), self.canvas.page().y0, self.canvas.backdrop.as_ref())
    }

    /// The drawing as PDF: one page, as large as the SVG at 96 px to the inch. The letters are outlines from
    /// DejaVu Sans, and the file contains no date.
    ///
    /// # Errors
    /// [`RenderError`]: the letters could not be laid out.
    pub fn pdf(&self) -> Result<Vec<u8>, RenderError> {
        pdf::pdf(&self.foreground(), self.canvas.page().y0, self.canvas.backdrop.as_ref(), &self.title)
    }

    /// The drawing in the given format.
    ///
    /// # Errors
    /// [`RenderError`], for a PNG or a PDF.
    pub fn write_as(&self, format: PictureFormat) -> Result<Vec<u8>, RenderError> {
        match format {
            PictureFormat::Svg => Ok(self.svg().into_bytes()),
            PictureFormat::Png => self.png(),
            PictureFormat::Pdf => self.pdf(),
        }
    }
}
