//! Drawings of a case to scale, as SVG: the scene, the damage, the reconciliation and the energy.
//!
//! # Conventions of all four
//!
//! Colours are those of Okabe and Ito, which people with any kind of colour vision tell apart; what colour says is said by dashes, heads and
//! hatching as well, so that the drawings read in grey. Labels are placed where they cover neither each other nor, as far as there is room, a line.
//! Coordinates are written with two decimals of a pixel, so that the bytes are the same on every machine.
//!
//! Arrows carry an `id` such as `scene-velocity-before-1`, and `data-from` and `data-to`; a scale bar such as `scene-scale` has `data-si` as well, what it stands for in SI units.

mod canvas;
mod damage;
mod energy;
pub(crate) mod font;
mod legend;
mod pens;
mod raster;
mod reconciliation;
mod scene;
pub(crate) mod ticks;
mod vehicle;

use analysis::{Analysis, Failure};
use case::CaseFile;

use crate::Units;
use canvas::Canvas;

/// What to draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Plan view at impact: outlines, contact point, crush plane, impulse, velocities, PDOF.
    Scene,
    /// Each damaged vehicle with its crush profile in place.
    Damage,
    /// Work of the normal impulse over the speed sought, with the crush energy.
    Reconciliation,
    /// Where the initial kinetic energy went.
    Energy,
}

impl Subject {
    /// All of them, in the order of a report.
    pub const ALL: [Self; 4] = [Self::Scene, Self::Damage, Self::Reconciliation, Self::Energy];

    /// Its name on the command line, and the first part of the `id`s in its SVG.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Damage => "damage",
            Self::Reconciliation => "reconciliation",
            Self::Energy => "energy",
        }
    }
}

/// A finished drawing.
#[derive(Clone, Debug)]
pub struct Drawing {
    subject: Subject,
    title: String,
    description: String,
    canvas: Canvas,
}

/// Why there is no drawing.
#[derive(Debug, thiserror::Error)]
pub enum DrawingError {
    /// The scene and the energy are those of an impact.
    #[error("there is no {} to draw: the case has no impact; give it an [impact] table and the speeds, or draw the damage", subject.name())]
    NoImpact {
        /// What was asked for.
        subject: Subject,
    },
    /// Nothing is damaged.
    #[error("there is no damage to draw: no vehicle of the case has a crush table")]
    NoDamage,
    /// No speed was sought.
    #[error("there is no reconciliation to draw: the case has no [reconstruct] table")]
    NoReconciliation,
    /// The curve of the reconciliation could not be computed.
    #[error(transparent)]
    Analysis(#[from] Failure),
    /// The SVG could not be turned into pixels.
    #[error("the drawing could not be turned into a PNG: {0}")]
    Png(String),
}

/// Draws one subject of an analysis, in the units of the reader.
///
/// # Errors
/// [`DrawingError`]: mostly that the analysis has nothing of this kind.
pub fn drawing(
    file: &CaseFile,
    analysis: &Analysis,
    units: Units,
    subject: Subject,
) -> Result<Drawing, DrawingError> {
    match subject {
        Subject::Scene => scene::draw(&file.case, analysis, units),
        Subject::Damage => damage::draw(&file.case, analysis, units),
        Subject::Reconciliation => reconciliation::draw(file, analysis, units),
        Subject::Energy => energy::draw(&file.case, analysis, units),
    }
}

impl Drawing {
    fn new(subject: Subject, title: String, description: String, canvas: Canvas) -> Self {
        Self { subject, title, description, canvas }
    }

    /// What it shows.
    #[must_use]
    pub fn subject(&self) -> Subject {
        self.subject
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
        let Self { subject, title, description, canvas } = self;
        let name = subject.name();
        let (width, height) = canvas.size();
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-labelledby=\"{name}-title {name}-description\" font-family=\"Arial, Helvetica, 'DejaVu Sans', sans-serif\">\n\
             <title id=\"{name}-title\">{}</title>\n<desc id=\"{name}-description\">{}</desc>\n{}</svg>\n",
            canvas::escaped(title),
            canvas::escaped(description),
            canvas.body(),
        )
    }

    /// The drawing as PNG, twice as many pixels as the SVG has units. The letters are those of DejaVu Sans, which the program carries.
    ///
    /// # Errors
    /// [`DrawingError::Png`].
    pub fn png(&self) -> Result<Vec<u8>, DrawingError> {
        raster::png(&self.svg())
    }
}
