//! A drawing that is made.

use crate::canvas::{Canvas, escaped};
use crate::raster::{self, PngError};

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
        let Self { name, title, description, canvas } = self;
        let (width, height) = canvas.size();
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-labelledby=\"{name}-title {name}-description\" font-family=\"Arial, Helvetica, 'DejaVu Sans', sans-serif\">\n\
             <title id=\"{name}-title\">{}</title>\n<desc id=\"{name}-description\">{}</desc>\n{}</svg>\n",
            escaped(title),
            escaped(description),
            canvas.body(),
        )
    }

    /// The drawing as PNG, twice as many pixels as the SVG has units. The letters are those of DejaVu Sans,
    /// which the program carries.
    ///
    /// # Errors
    /// [`PngError`]: the picture is too large for the memory.
    pub fn png(&self) -> Result<Vec<u8>, PngError> {
        raster::png(&self.svg())
    }
}
