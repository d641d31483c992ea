//! `Drawing`.

use std::path::PathBuf;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};
use report::PictureFormat;

/// A drawing: SVG, PNG or PDF. A notebook shows it.
///
/// Examples
/// --------
/// >>> drawing = pydeltav.Case.example().draw("energy")
/// >>> drawing.title
/// 'Intersection collision, GMC Jimmy and Nissan Altima: energy'
/// >>> drawing.png()[1:4]
/// b'PNG'
#[pyclass(name = "Drawing", module = "pydeltav", frozen)]
pub(crate) struct Picture {
    drawing: report::Drawing,
    /// The object that was drawn; below it, the call that draws it again.
    source: Py<PyAny>,
    again: Py<PyAny>,
}

impl Picture {
    /// From the source, the drawing, and the method of the source that drew it, with its arguments.
    pub(crate) fn new(
        source: &Bound<'_, PyAny>,
        drawing: report::Drawing,
        (method, what): (&str, &str),
        options: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let py = source.py();
        let again = py.import("operator")?.getattr("methodcaller")?.call((method, what), Some(options))?;
        Ok(Self { drawing, source: source.clone().unbind(), again: again.unbind() })
    }

    fn written(&self, py: Python<'_>, format: PictureFormat) -> PyResult<Vec<u8>> {
        let written = py.detach(|| self.drawing.write_as(format));
        written.map_err(|error| PyRuntimeError::new_err(error.to_string()))
    }
}

/// A drawing within HTML. The `id`s of an SVG would collide with those of another one on the page; in an
/// image of its own they do not.
pub(crate) fn image(drawing: &report::Drawing) -> String {
    let svg = STANDARD.encode(drawing.svg());
    let says = drawing.description().replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;");
    format!(
        "<img src=\"data:image/svg+xml;base64,{svg}\" alt=\"{says}\" style=\"max-width: 100%; background: #fff\">"
    )
}

#[pymethods]
impl Picture {
    /// Its heading.
    #[getter]
    fn title(&self) -> &str {
        self.drawing.title()
    }

    /// What it shows, in words: the alternative text of the picture.
    #[getter]
    fn description(&self) -> &str {
        self.drawing.description()
    }

    /// The drawing as SVG.
    ///
    /// Returns
    /// -------
    /// str
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().draw().svg()[:4]
    /// '<svg'
    fn svg(&self, py: Python<'_>) -> String {
        py.detach(|| self.drawing.svg())
    }

    /// The drawing as PNG.
    ///
    /// Returns
    /// -------
    /// bytes
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().draw().png()[1:4]
    /// b'PNG'
    fn png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.written(py, PictureFormat::Png)?))
    }

    /// The drawing as PDF: one page.
    ///
    /// Returns
    /// -------
    /// bytes
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().draw().pdf()[:4]
    /// b'%PDF'
    fn pdf<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.written(py, PictureFormat::Pdf)?))
    }

    /// Writes the drawing into a file.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     Its name ends in ``.svg``, ``.png`` or ``.pdf``, which selects the format.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the name ends in anything else.
    /// OSError
    ///     If the file cannot be written.
    ///
    /// Examples
    /// --------
    /// >>> import pathlib, tempfile
    /// >>> path = pathlib.Path(tempfile.mkdtemp(), "scene.svg")
    /// >>> pydeltav.Case.example().draw("scene").save(path)
    /// >>> path.exists()
    /// True
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
        let format = PictureFormat::ALL
            .into_iter()
            .find(|format| ending.as_deref().is_some_and(|ending| ending == format.extension()));
        let Some(format) = format else {
            let name = path.display().to_string();
            let problem =
                format!("{} must end in .svg, .png or .pdf: that selects the format", case::shown(&name));
            return Err(PyValueError::new_err(problem));
        };
        let written = self.written(py, format)?;
        Ok(py.detach(|| std::fs::write(path, written))?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> String {
        py.detach(|| image(&self.drawing))
    }

    fn __repr__(&self) -> String {
        format!("<pydeltav.Drawing {}: {}>", self.drawing.name(), self.drawing.title())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Py<PyAny>, Bound<'py, PyTuple>)> {
        Ok((self.again.clone_ref(py), (&self.source,).into_pyobject(py)?))
    }
}
