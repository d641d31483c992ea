//! A drawing that is made.

use crate::canvas::{Canvas, escaped};
use crate::number::px;
use crate::pdf;
use crate::pens::WHITE;
use crate::raster::{self, RenderError};

/// What a file of a drawing is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PictureFormat {
    /// Vectors, for pages of a browser.
    #[default]
    Svg,
    /// Pixels.
    Png,
    /// Vectors on a page of paper.
    Pdf,
}

impl PictureFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Png, Self::Pdf];

    /// What file names end in, without the point.
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
    name: &'static str,
    title: String,
    description: String,
    canvas: Canvas,
}

impl Drawing {
    pub(crate) fn new(name: &'static str, title: String, description: String, canvas: Canvas) -> Self {
        Self { name, title, description, canvas }
    }

    /// Drawings below each other on one page, each with the word that its `id`s have on it; none of them has
    /// a site plan.
    #[must_use]
    pub fn stacked(name: &'static str, title: String, drawings: &[(String, Self)]) -> Self {
        let width = drawings.iter().map(|(_, drawing)| drawing.canvas.page().width()).fold(0.0, f64::max);
        let mut canvas = Canvas::new(name, width, 0.0);
        let mut below = 0.0;
        let mut descriptions = Vec::new();
        for (place, drawing) in drawings {
            let page = drawing.canvas.page();
            let body = drawing.body_named(&format!("{name}-{place}"));
            let down = px(below - page.y0);
            canvas.element(&format!("<g transform=\"translate(0 {down})\">\n{body}</g>"));
            canvas.note_missing(drawing.missing_letters());
            below += page.height();
            descriptions.push(drawing.description.as_str());
        }
        canvas.set_height(below);
        let description = descriptions.join(" ");
        Self::new(name, title, description, canvas)
    }

    /// The word for what it shows, which is the first part of the `id`s in its SVG.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// One line.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// What a reader who cannot see it has to be told.
    #[must_use]
    pub fn description(&self) -> &str {
        &self.description
    }

    /// The drawing as SVG, with its title and description; it stands alone as a file or inside of HTML.
    #[must_use]
    pub fn svg(&self) -> String {
        self.svg_named(self.name)
    }

    /// The same with another word for [`name`](Self::name) in its `id`s: several drawings of one kind on one
    /// page have one each.
    #[must_use]
    pub fn svg_named(&self, name: &str) -> String {
        let page = self.canvas.page();
        let [top, width, height] = [page.y0, page.width(), page.height()].map(px);
        let ground = format!("<rect y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"{WHITE}\"/>\n");
        let backdrop = self.canvas.backdrop().map(|backdrop| backdrop.svg(name)).unwrap_or_default();
        self.svg_on(name, &format!("{ground}{backdrop}"))
    }

    /// What stands in front of the page and of its backdrop.
    fn foreground(&self) -> String {
        self.svg_on(self.name, "")
    }

    /// The shapes, with another word in their `id`s.
    fn body_named(&self, name: &str) -> String {
        let own = self.name;
        // No text has a quotation mark of its own: it is escaped.
        let body = self.canvas.body().replace(&format!(" id=\"{own}-"), &format!(" id=\"{name}-"));
        body.replace(&format!("=\"url(#{own}-"), &format!("=\"url(#{name}-"))
    }

    fn svg_on(&self, name: &str, ground: &str) -> String {
        let Self { title, description, canvas, .. } = self;
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

    /// Letters of the drawing that DejaVu Sans, which the program carries, has not. A PNG and a PDF have
    /// question marks in their place; of an SVG the reader's own fonts are asked.
    pub fn missing_letters(&self) -> impl Iterator<Item = char> {
        self.canvas.missing()
    }

    /// The drawing as PNG, twice as many pixels as the SVG has units. The letters are those of DejaVu Sans,
    /// which the program carries.
    ///
    /// # Errors
    /// [`RenderError`]: the picture is too large for the memory.
    pub fn png(&self) -> Result<Vec<u8>, RenderError> {
        raster::png(&self.foreground(), self.canvas.page().y0, self.canvas.backdrop())
    }

    /// The drawing as PDF: one page, as large as the SVG at 96 px to the inch. The letters are outlines of
    /// those of DejaVu Sans. No date is in it.
    ///
    /// # Errors
    /// [`RenderError`]: the letters could not be laid out.
    pub fn pdf(&self) -> Result<Vec<u8>, RenderError> {
        pdf::pdf(&self.foreground(), self.canvas.page().y0, self.canvas.backdrop(), &self.title)
    }

    /// The drawing in a format of one's choice.
    ///
    /// # Errors
    /// [`RenderError`], of a PNG or a PDF.
    pub fn write_as(&self, format: PictureFormat) -> Result<Vec<u8>, RenderError> {
        match format {
            PictureFormat::Svg => Ok(self.svg().into_bytes()),
            PictureFormat::Png => self.png(),
            PictureFormat::Pdf => self.pdf(),
        }
    }
}
