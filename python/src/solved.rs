//! Results.

use std::sync::{Arc, OnceLock};

use analysis::Reason;
use arrow_buffer::Buffer;
use bytes::Bytes;
use pyo3::exceptions::{PyAttributeError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple, PyType};
use report::{AvoidPicture, Document, DrawingRequest, Subject, Units};
use requests::{Answer, EstimateAnswer, Request, RequestOptions};
use uncertainty::SUCCEEDED;

use crate::columns::Columns;
use crate::errors::no_answer;
use crate::given::{Given, PyCase, units};
use crate::picture::{Picture, image};
use crate::request::{chosen, class, is_quick, no_page, unanswered, wrong_option};
use crate::run::{Ending, interruptible};

/// A case, the request, and the answer.
pub(crate) struct Solved {
    given: Arc<Given>,
    request: Request,
    threads: Option<usize>,
    /// Empty in a result that was pickled, until more of it is needed than its data.
    answer: OnceLock<Answer>,
    json: OnceLock<String>,
}

impl Solved {
    pub(crate) fn new(
        py: Python<'_>,
        given: Arc<Given>,
        request: Request,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let solved = Self { given, request, threads, answer: OnceLock::new(), json: OnceLock::new() };
        solved.answer(py)?;
        Ok(solved)
    }

    /// The answer, which is computed if there is none yet.
    fn answer(&self, py: Python<'_>) -> PyResult<&Answer> {
        if let Some(answer) = self.answer.get() {
            return Ok(answer);
        }
        let case = &self.given.file.case;
        let answer = |ending: &Ending| self.request.answer(case, &mut |_, _, _| ending.flow());
        let answer = if is_quick(&self.request) {
            match py.detach(|| self.request.begin(case)) {
                Ok(answer) => answer,
                Err(begun) => interruptible(py, self.threads, |ending| {
                    begun.finish(case, &mut |_, _, _| ending.flow())
                })?,
            }
        } else {
            interruptible(py, self.threads, answer)?
        };
        let answer = answer.map_err(|refused| unanswered(py, refused, &self.given.file))?;
        // Two threads that computed it at the same time have found the same.
        Ok(self.answer.get_or_init(|| answer))
    }

    fn json(&self, py: Python<'_>) -> PyResult<&str> {
        if let Some(json) = self.json.get() {
            return Ok(json);
        }
        let answer = self.answer(py)?;
        let json = py.detach(|| answer.json(&self.given.file));
        let json = json.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        Ok(self.json.get_or_init(|| json))
    }

    fn in_units(&self, asked: Option<&str>) -> PyResult<Units> {
        units(asked, &self.given.file)
    }

    /// The report of an analysis for its reader; for every other answer, the text that the program prints.
    fn report(&self, py: Python<'_>, units: Units) -> PyResult<Document> {
        let file = &self.given.file;
        let answer = self.answer(py)?;
        let site_plan = if answer.shows_site_plan() { self.given.site_plan(py)? } else { None };
        let page = interruptible(py, self.threads, |ending| {
            answer.page(file, site_plan.as_ref(), units, &mut |_, _, _| ending.flow())
        })?;
        page.map_err(|error| no_page(py, error, file))
    }

    /// The drawing that a notebook shows below the text.
    fn shown(&self, py: Python<'_>, units: Units) -> PyResult<Option<report::Drawing>> {
        let case = &self.given.file.case;
        match self.answer(py)? {
            Answer::Analysis(solved) => {
                let drawing = solved.first_subject().map(|subject| DrawingRequest { subject, plain: false });
                drawing.map(|drawing| self.given.draw(py, &solved.analysis, drawing, units)).transpose()
            }
            Answer::Uncertainty(uncertainty) => {
                let varies = 0..uncertainty.outputs.len();
                Ok(py.detach(|| {
                    varies.into_iter().find_map(|place| report::histogram(case, uncertainty, place, units))
                }))
            }
            Answer::Estimate(answer) => {
                let EstimateAnswer { estimated, asked } = &**answer;
                let outputs = &estimated.outputs;
                let density = |of: &analysis::EstimatedOutput| {
                    report::density(case, estimated, asked, of.output, units)
                };
                Ok(py.detach(|| outputs.iter().find_map(density)))
            }
            Answer::Avoidance(found) => {
                Ok(py.detach(|| AvoidPicture::PathTime.draw(case, found, units)).ok())
            }
            _ => Ok(None),
        }
    }
}

/// The memory of a column, which lives as long as a view of it.
struct Memory {
    solved: Arc<Solved>,
    place: usize,
}

impl AsRef<[u8]> for Memory {
    fn as_ref(&self) -> &[u8] {
        let column = match self.solved.answer.get() {
            Some(Answer::Uncertainty(uncertainty)) => {
                uncertainty.propagation.columns().get(self.place).map(Vec::as_slice)
            }
            Some(Answer::Estimate(answer)) => {
                report::draw_columns(&answer.estimated).get(self.place).map(|column| column.values)
            }
            _ => None,
        };
        bytemuck::cast_slice(column.unwrap_or_default())
    }
}

/// The samples or draws of a result.
fn columns(py: Python<'_>, solved: &Arc<Solved>) -> PyResult<Columns> {
    let memory = |place: usize| Buffer::from(Bytes::from_owner(Memory { solved: Arc::clone(solved), place }));
    match solved.answer(py)? {
        Answer::Uncertainty(uncertainty) => py.detach(|| {
            let reason =
                |code: &u8| (*code != SUCCEEDED).then(|| report::reason_name(Reason::of_code(*code)));
            let reasons = uncertainty.propagation.reasons().iter().map(reason).collect();
            let outputs = uncertainty.outputs.iter().enumerate();
            Columns::new(
                Some(reasons),
                outputs.map(|(place, output)| (output.output.path(), memory(place))).collect(),
            )
        }),
        Answer::Estimate(answer) => {
            if !answer.estimated.doubts().is_empty() {
                let problem =
                    "the run has not converged: print(result) says why, and its draws are not an answer";
                return Err(no_answer(py, problem.to_owned()));
            }
            py.detach(|| {
                let drawn = report::draw_columns(&answer.estimated).into_iter().enumerate();
                let columns = drawn.map(|(place, column)| {
                    let si = |value: &f64| value * column.factor;
                    let buffer = match column.factor {
                        1.0 => memory(place),
                        _ => Buffer::from_vec(column.values.iter().map(si).collect::<Vec<f64>>()),
                    };
                    (column.key, buffer)
                });
                Columns::new(None, columns.collect())
            })
        }
        _ => Err(PyValueError::new_err("the result has no samples")),
    }
}

/// The answer to a case.
///
/// Its attributes are the keys of the JSON document of the program, in SI units and radians:
/// ``result.found.value``, ``result.vehicle1.delta_v``; ``pydeltav.results`` has the types and units of all.
/// A key that is not a name is read as from a dict: ``result.outputs["vehicle1.speed"].interval95``.
/// ``result.program.version`` and ``result.case.sha256`` say what is needed to reproduce it.
///
/// Examples
/// --------
/// >>> result = pydeltav.Case.example().reconstruct()
/// >>> result.to_dict()["vehicle1"]["delta_v"] == result.vehicle1.delta_v
/// True
/// >>> result.case.sha256[:12]
/// '5c33d55cf7a1'
#[pyclass(name = "Result", module = "pydeltav", frozen, subclass)]
pub(crate) struct PyAnswered {
    solved: Arc<Solved>,
    record: PyOnceLock<Py<PyAny>>,
    /// The columns of a result that was pickled.
    columns: PyOnceLock<Py<Columns>>,
}

impl PyAnswered {
    fn loads<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        static LOADS: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        LOADS.import(py, "json", "loads")?.call1((self.solved.json(py)?,))
    }

    fn record<'py>(&self, py: Python<'py>) -> PyResult<&Bound<'py, PyAny>> {
        static DOCUMENT: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        let made = || {
            let document = DOCUMENT.import(py, "pydeltav.results", "_document")?;
            Ok::<_, PyErr>(document.call1((class(&self.solved.request), self.loads(py)?))?.unbind())
        };
        Ok(self.record.get_or_try_init(py, made)?.bind(py))
    }

    fn columns(&self, py: Python<'_>) -> PyResult<Py<Columns>> {
        let made = || Py::new(py, columns(py, &self.solved)?);
        // Not kept: it holds the result.
        self.columns.get(py).map_or_else(made, |columns| Ok(columns.clone_ref(py)))
    }
}

#[pymethods]
impl PyAnswered {
    /// The JSON document of the program as a dict: SI units and radians, the same bits.
    ///
    /// Returns
    /// -------
    /// dict
    ///     A new one at each call.
    ///
    /// Examples
    /// --------
    /// >>> sorted(pydeltav.Case.example().check().to_dict())[:3]
    /// ['answers_most', 'assumptions', 'axes']
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.loads(py)
    }

    /// The JSON document of the program.
    ///
    /// Returns
    /// -------
    /// str
    ///     Byte for byte what the program writes.
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().reconstruct().to_json().startswith("{")
    /// True
    fn to_json(&self, py: Python<'_>) -> PyResult<&str> {
        self.solved.json(py)
    }

    /// The text that the program prints.
    ///
    /// Parameters
    /// ----------
    /// units : {"si", "us", "uk"}, optional
    ///     By default those that most of the case uses.
    ///
    /// Returns
    /// -------
    /// str
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there are no such units.
    ///
    /// Examples
    /// --------
    /// >>> print(pydeltav.Case.example().reconstruct().text("si").splitlines()[0])
    /// Intersection collision, GMC Jimmy and Nissan Altima
    #[pyo3(signature = (units = None))]
    fn text(&self, py: Python<'_>, units: Option<&str>) -> PyResult<String> {
        let units = self.solved.in_units(units)?;
        let answer = self.solved.answer(py)?;
        Ok(py.detach(|| answer.document(&self.solved.given.file, units).text()))
    }

    /// The report of the program as one HTML file, without scripts.
    ///
    /// Parameters
    /// ----------
    /// units : {"si", "us", "uk"}, optional
    ///     By default those that most of the case uses.
    ///
    /// Returns
    /// -------
    /// str
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there are no such units.
    /// CaseError
    ///     If the site plan that the case names cannot be read.
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().reconstruct().html().startswith("<!DOCTYPE html>")
    /// True
    #[pyo3(signature = (units = None))]
    fn html(&self, py: Python<'_>, units: Option<&str>) -> PyResult<String> {
        let page = self.solved.report(py, self.solved.in_units(units)?)?;
        Ok(py.detach(|| page.html()))
    }

    /// The report of the program as Markdown.
    ///
    /// Parameters
    /// ----------
    /// units : {"si", "us", "uk"}, optional
    ///     By default those that most of the case uses.
    ///
    /// Returns
    /// -------
    /// str
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there are no such units.
    /// CaseError
    ///     If the site plan that the case names cannot be read.
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().reconstruct().markdown().startswith("#")
    /// True
    #[pyo3(signature = (units = None))]
    fn markdown(&self, py: Python<'_>, units: Option<&str>) -> PyResult<String> {
        let page = self.solved.report(py, self.solved.in_units(units)?)?;
        Ok(py.detach(|| page.markdown()))
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let units = self.solved.in_units(None)?;
        let answer = self.solved.answer(py)?;
        let drawing = self.solved.shown(py, units)?;
        Ok(py.detach(|| {
            let text = answer.document(&self.solved.given.file, units).html_fragment();
            let drawing = drawing.as_ref().map(image).unwrap_or_default();
            text + &drawing
        }))
    }

    #[pyo3(signature = (include = None, exclude = None))]
    fn _repr_mimebundle_<'py>(
        &self,
        py: Python<'py>,
        include: Option<&Bound<'py, PyAny>>,
        exclude: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        // IPython itself picks the formats that it needs.
        let _ = (include, exclude);
        let bundle = PyDict::new(py);
        let units = self.solved.in_units(None)?;
        let answer = self.solved.answer(py)?;
        let document = py.detach(|| answer.document(&self.solved.given.file, units));
        let plain = match document.headline() {
            [] => document.text(),
            headline => headline.join("\n"),
        };
        bundle.set_item("text/plain", plain)?;
        bundle.set_item("text/html", self._repr_html_(py)?)?;
        Ok(bundle)
    }

    fn __getattr__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let missing = || {
            let class = slf.get_type().name().map_or_else(|_| String::new(), |name| name.to_string());
            PyAttributeError::new_err(format!("'{class}' object has no attribute '{name}'"))
        };
        // Notebooks and copy ask for many such names; no key of the JSON is one.
        if name.starts_with('_') {
            return Err(missing());
        }
        slf.get().record(slf.py())?.get_item(name).map_err(|_| missing())
    }

    fn __getitem__<'py>(&self, py: Python<'py>, key: &str) -> PyResult<Bound<'py, PyAny>> {
        self.record(py)?.get_item(key)
    }

    fn __dir__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let names = py.import("builtins")?.getattr("object")?.call_method1("__dir__", (slf,))?;
        names.call_method1("extend", (slf.get().record(py)?.call_method0("keys")?,))?;
        Ok(names)
    }

    fn __str__(&self, py: Python<'_>) -> PyResult<String> {
        self.text(py, None)
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let title = slf.get().solved.given.file.case.title.as_ref();
        let title = title.map(|title| format!(" of \"{title}\"")).unwrap_or_default();
        Ok(format!("<pydeltav.{}{title}>", slf.get_type().name()?))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let restore = py.import("pydeltav._pydeltav")?.getattr("_restore_result")?;
        let case = Py::new(py, PyCase(Arc::clone(&self.solved.given)))?;
        let request = serde_json::to_string(&self.solved.request);
        let request = request.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        let columns = match self.solved.answer(py)? {
            Answer::Uncertainty(_) => Some(self.columns(py)?),
            Answer::Estimate(answer) if answer.estimated.doubts().is_empty() => Some(self.columns(py)?),
            _ => None,
        };
        let state = (VERSION, case, request, self.solved.json(py)?, columns);
        Ok((restore, state.into_pyobject(py)?))
    }
}

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A result that was pickled, with its data; everything else is computed again when it is needed.
#[pyfunction]
#[pyo3(name = "_restore_result")]
pub(crate) fn restore_result<'py>(
    py: Python<'py>,
    version: &str,
    case: &Bound<'py, PyCase>,
    request: &str,
    json: String,
    columns: Option<Py<Columns>>,
) -> PyResult<Bound<'py, PyAny>> {
    if version != VERSION {
        let problem =
            format!("the result was pickled by deltav {version}, and this is {VERSION}: compute it again");
        return Err(PyValueError::new_err(problem));
    }
    let wrong = |error: serde_json::Error| PyValueError::new_err(error.to_string());
    let written: serde_json::Value = serde_json::from_str(request).map_err(wrong)?;
    let command = written["command"].as_str().unwrap_or_default();
    let options = written.get("options").map(ToString::to_string).unwrap_or_default();
    let request = RequestOptions::read(&options).and_then(|options| Request::read(command, &options));
    let request = request.map_err(|error| wrong_option(&error))?;
    let given = Arc::clone(&case.get().0);
    let solved =
        Solved { given, request, threads: None, answer: OnceLock::new(), json: OnceLock::from(json) };
    let result = answered(py, solved)?;
    if let Some(columns) = columns {
        let base = result.cast::<PyAnswered>()?.get();
        // It is new, and has none.
        let _ = base.columns.set(py, columns);
    }
    Ok(result)
}

/// A result of the class of its answer.
pub(crate) fn answered(py: Python<'_>, solved: Solved) -> PyResult<Bound<'_, PyAny>> {
    let request = solved.request.clone();
    let base = PyAnswered { solved: Arc::new(solved), record: PyOnceLock::new(), columns: PyOnceLock::new() };
    let base = PyClassInitializer::from(base);
    Ok(match request {
        Request::Reconstruct(_) | Request::Impact | Request::Motion | Request::Crush => {
            Bound::new(py, base.add_subclass(PyAnalysis))?.into_any()
        }
        Request::Check => Bound::new(py, base.add_subclass(PyJudgement))?.into_any(),
        Request::Compare => Bound::new(py, base.add_subclass(PyComparison))?.into_any(),
        Request::Sensitivity(_) => Bound::new(py, base.add_subclass(PySensitivity))?.into_any(),
        Request::Uncertainty(_) => Bound::new(py, base.add_subclass(PyUncertainty))?.into_any(),
        Request::Estimate(_) => Bound::new(py, base.add_subclass(PyEstimate))?.into_any(),
        Request::Avoid(_) => Bound::new(py, base.add_subclass(PyAvoidance))?.into_any(),
        _ => Bound::new(py, base)?.into_any(),
    })
}

/// The answer of ``reconstruct``, ``impact``, ``motion`` and ``crush`` of a case.
///
/// Examples
/// --------
/// >>> result = pydeltav.Case.example().reconstruct()
/// >>> print(f"{result.vehicle1.delta_v:.2f} m/s, {result.impact.energy_loss / 1000:.0f} kJ")
/// 12.15 m/s, 188 kJ
#[pyclass(name = "Analysis", module = "pydeltav", frozen, extends = PyAnswered)]
pub(crate) struct PyAnalysis;

#[pymethods]
impl PyAnalysis {
    /// Draws the analysis.
    ///
    /// Parameters
    /// ----------
    /// what : {"scene", "motion", "motion-curves", "momentum", "damage", "reconciliation", "energy"}
    ///     What to draw; by default the most complete drawing.
    /// units : {"si", "us", "uk"}, optional
    ///     By default those that most of the case uses.
    /// plain : bool
    ///     Scene and motion for readers who are not engineers.
    ///
    /// Returns
    /// -------
    /// Drawing
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such drawing.
    /// NoAnswerError
    ///     If the analysis has nothing to show in this drawing.
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().reconstruct().draw().title
    /// 'Intersection collision, GMC Jimmy and Nissan Altima: plan view at impact'
    #[pyo3(signature = (what = None, *, units = None, plain = false))]
    fn draw(
        slf: &Bound<'_, Self>,
        what: Option<&str>,
        units: Option<&str>,
        plain: bool,
    ) -> PyResult<Picture> {
        let py = slf.py();
        let solved = &slf.as_super().get().solved;
        let in_units = solved.in_units(units)?;
        let Answer::Analysis(answer) = solved.answer(py)? else {
            return Err(PyRuntimeError::new_err("the result is not an analysis"));
        };
        let first = || Ok(answer.first_subject().unwrap_or(Subject::Damage));
        let subject = what.map_or_else(first, Given::subject)?;
        let drawing = solved.given.draw(py, &answer.analysis, DrawingRequest { subject, plain }, in_units)?;
        let options = PyDict::new(py);
        options.set_item("units", units)?;
        options.set_item("plain", plain)?;
        Picture::new(slf.as_any(), drawing, ("draw", subject.name()), &options)
    }
}

/// The answer of ``check`` of a case.
///
/// Examples
/// --------
/// >>> judgement = pydeltav.Case.example().check()
/// >>> [command.command for command in judgement.commands if command.runs][:2]
/// ['reconstruct', 'estimate']
#[pyclass(name = "Judgement", module = "pydeltav", frozen, extends = PyAnswered)]
pub(crate) struct PyJudgement;

/// The answer of ``compare`` of a case.
///
/// Examples
/// --------
/// >>> comparison = pydeltav.Case.example().compare()
/// >>> comparison.rows[0].law
/// 'Brach, common tangential velocity'
#[pyclass(name = "Comparison", module = "pydeltav", frozen, extends = PyAnswered)]
pub(crate) struct PyComparison;

/// The answer of ``sensitivity`` of a case.
///
/// Examples
/// --------
/// >>> sensitivity = pydeltav.Case.example().sensitivity()
/// >>> sensitivity.derivatives[0].output
/// 'vehicle1.speed'
#[pyclass(name = "Sensitivity", module = "pydeltav", frozen, extends = PyAnswered)]
pub(crate) struct PySensitivity;

/// The answer of ``uncertainty`` of a case.
///
/// Examples
/// --------
/// >>> low, high = uncertain.outputs["vehicle1.speed"].interval95
/// >>> low < uncertain.outputs["vehicle1.speed"].median < high
/// True
#[pyclass(name = "Uncertainty", module = "pydeltav", frozen, extends = PyAnswered)]
pub(crate) struct PyUncertainty;

#[pymethods]
impl PyUncertainty {
    /// All samples.
    ///
    /// Returns
    /// -------
    /// Columns
    ///     ``columns()["vehicle1.speed"]`` is a NumPy array, and the whole goes into Arrow; in SI units and
    ///     radians.
    ///
    /// Examples
    /// --------
    /// >>> uncertain.columns()["vehicle1.speed"].shape
    /// (1000,)
    fn columns(slf: &Bound<'_, Self>) -> PyResult<Py<Columns>> {
        slf.as_super().get().columns(slf.py())
    }

    /// Draws the histogram of an output.
    ///
    /// Parameters
    /// ----------
    /// output : str
    ///     A key of ``outputs``, such as ``"vehicle1.speed"``.
    /// units : {"si", "us", "uk"}, optional
    ///     By default those that most of the case uses.
    ///
    /// Returns
    /// -------
    /// Drawing
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such output.
    /// NoAnswerError
    ///     If the output does not vary.
    ///
    /// Examples
    /// --------
    /// >>> uncertain.histogram("vehicle1.speed").svg()[:4]
    /// '<svg'
    #[pyo3(signature = (output, *, units = None))]
    fn histogram(slf: &Bound<'_, Self>, output: &str, units: Option<&str>) -> PyResult<Picture> {
        spread(slf, ("histogram", output), units, report::histogram)
    }

    /// Draws the effect of each input alone on an output, the most influential first.
    ///
    /// Parameters
    /// ----------
    /// output : str
    ///     A key of ``outputs``, such as ``"vehicle1.speed"``.
    /// units : {"si", "us", "uk"}, optional
    ///     By default those that most of the case uses.
    ///
    /// Returns
    /// -------
    /// Drawing
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such output.
    /// NoAnswerError
    ///     If the output does not vary.
    ///
    /// Examples
    /// --------
    /// >>> uncertain.tornado("vehicle1.speed").svg()[:4]
    /// '<svg'
    #[pyo3(signature = (output, *, units = None))]
    fn tornado(slf: &Bound<'_, Self>, output: &str, units: Option<&str>) -> PyResult<Picture> {
        spread(slf, ("tornado", output), units, report::tornado)
    }
}

/// A plot of one output of an uncertainty.
type Plot = fn(&case::Case, &analysis::Uncertainty, usize, Units) -> Option<report::Drawing>;

fn spread(
    slf: &Bound<'_, PyUncertainty>,
    (method, output): (&str, &str),
    units: Option<&str>,
    plot: Plot,
) -> PyResult<Picture> {
    let py = slf.py();
    let solved = &slf.as_super().get().solved;
    let in_units = solved.in_units(units)?;
    let Answer::Uncertainty(uncertainty) = solved.answer(py)? else {
        return Err(PyRuntimeError::new_err("the result is not an uncertainty"));
    };
    let keys: Vec<String> = uncertainty.outputs.iter().map(|known| known.output.path()).collect();
    let place = keys.iter().position(|key| key == output).ok_or_else(|| unknown(output, &keys))?;
    let drawing = py.detach(|| plot(&solved.given.file.case, uncertainty, place, in_units));
    let drawing =
        drawing.ok_or_else(|| no_answer(py, format!("{output} does not vary: there is nothing to draw")))?;
    drawn(slf.as_any(), drawing, (method, output), units)
}

fn unknown(output: &str, keys: &[String]) -> PyErr {
    PyValueError::new_err(format!("output=\"{}\": the outputs are {}", case::shown(output), keys.join(", ")))
}

fn drawn(
    source: &Bound<'_, PyAny>,
    drawing: report::Drawing,
    method: (&str, &str),
    units: Option<&str>,
) -> PyResult<Picture> {
    let options = PyDict::new(source.py());
    options.set_item("units", units)?;
    Picture::new(source, drawing, method, &options)
}

/// The answer of ``estimate`` of a case.
///
/// Examples
/// --------
/// >>> low, high = estimated.outputs["vehicle1.speed"].interval95
/// >>> low < estimated.outputs["vehicle1.speed"].median < high
/// True
#[pyclass(name = "Estimate", module = "pydeltav", frozen, extends = PyAnswered)]
pub(crate) struct PyEstimate;

#[pymethods]
impl PyEstimate {
    /// All draws.
    ///
    /// Returns
    /// -------
    /// Columns
    ///     ``columns()["vehicle1.speed"]`` is a NumPy array, and the whole goes into Arrow; in SI units and
    ///     radians.
    ///
    /// Raises
    /// ------
    /// ``NoAnswerError``
    ///     If the run has not converged.
    ///
    /// Examples
    /// --------
    /// >>> estimated.columns().rows == estimated.draws
    /// True
    fn columns(slf: &Bound<'_, Self>) -> PyResult<Py<Columns>> {
        slf.as_super().get().columns(slf.py())
    }

    /// Draws the probability density of an output, before and after the evidence.
    ///
    /// Parameters
    /// ----------
    /// output : str
    ///     A key of ``outputs``, such as ``"vehicle1.speed"``.
    /// units : {"si", "us", "uk"}, optional
    ///     By default those that most of the case uses.
    ///
    /// Returns
    /// -------
    /// Drawing
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such output.
    /// NoAnswerError
    ///     If there is no density to draw.
    ///
    /// Examples
    /// --------
    /// >>> estimated.density("vehicle1.speed").svg()[:4]
    /// '<svg'
    #[pyo3(signature = (output, *, units = None))]
    fn density(slf: &Bound<'_, Self>, output: &str, units: Option<&str>) -> PyResult<Picture> {
        let py = slf.py();
        let solved = &slf.as_super().get().solved;
        let in_units = solved.in_units(units)?;
        let Answer::Estimate(answer) = solved.answer(py)? else {
            return Err(PyRuntimeError::new_err("the result is not an estimate"));
        };
        let EstimateAnswer { estimated, asked } = &**answer;
        let keys: Vec<String> = estimated.outputs.iter().map(|known| known.output.path()).collect();
        let place = keys.iter().position(|key| key == output).ok_or_else(|| unknown(output, &keys))?;
        let of = estimated.outputs[place].output;
        let drawing = py.detach(|| report::density(&solved.given.file.case, estimated, asked, of, in_units));
        let drawing =
            drawing.ok_or_else(|| no_answer(py, format!("there is no density of {output} to draw")))?;
        drawn(slf.as_any(), drawing, ("density", output), units)
    }
}

/// The answer of ``avoid`` of a case.
///
/// Examples
/// --------
/// >>> avoidance = pydeltav.Case.from_dict({"avoid": {
/// ...     "speed": "50 km/h", "limit": "30 km/h", "reaction_time": "1 s", "deceleration": "6.5 m/s^2",
/// ...     "demand": {"distance": "20 m"}}}).avoid()
/// >>> avoidance.avoid.spatial.avoidable_at_limit
/// True
#[pyclass(name = "Avoidance", module = "pydeltav", frozen, extends = PyAnswered)]
pub(crate) struct PyAvoidance;

#[pymethods]
impl PyAvoidance {
    /// Draws the answer.
    ///
    /// Parameters
    /// ----------
    /// what : {"path-time", "chance", "sight"}
    ///     Every run against time; the probability against the speed; both before the impact, seen from
    ///     above, and what obstacles hide.
    /// units : {"si", "us", "uk"}, optional
    ///     By default those that most of the case uses.
    ///
    /// Returns
    /// -------
    /// Drawing
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such drawing.
    /// NoAnswerError
    ///     If the case has nothing to show in this drawing.
    ///
    /// Examples
    /// --------
    /// >>> case = pydeltav.Case.from_dict({"avoid": {
    /// ...     "speed": "50 km/h", "limit": "30 km/h", "reaction_time": "1 s", "deceleration": "6.5 m/s^2",
    /// ...     "demand": {"distance": "20 m"}}})
    /// >>> case.avoid().draw("path-time").svg()[:4]
    /// '<svg'
    #[pyo3(signature = (what = "path-time", *, units = None))]
    fn draw(slf: &Bound<'_, Self>, what: &str, units: Option<&str>) -> PyResult<Picture> {
        let py = slf.py();
        let solved = &slf.as_super().get().solved;
        let picture = chosen("what", what, &AvoidPicture::WORDS)?;
        let in_units = solved.in_units(units)?;
        let Answer::Avoidance(found) = solved.answer(py)? else {
            return Err(PyRuntimeError::new_err("the result is not an avoidance"));
        };
        let drawing = py.detach(|| picture.draw(&solved.given.file.case, found, in_units));
        let drawing = drawing.map_err(|reason| no_answer(py, reason.to_owned()))?;
        drawn(slf.as_any(), drawing, ("draw", what), units)
    }
}

/// All classes of results.
pub(crate) fn classes(py: Python<'_>) -> [Bound<'_, PyType>; 8] {
    [
        py.get_type::<PyAnswered>(),
        py.get_type::<PyAnalysis>(),
        py.get_type::<PyJudgement>(),
        py.get_type::<PyComparison>(),
        py.get_type::<PySensitivity>(),
        py.get_type::<PyUncertainty>(),
        py.get_type::<PyEstimate>(),
        py.get_type::<PyAvoidance>(),
    ]
}
