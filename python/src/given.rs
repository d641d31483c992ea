//! `Case`.

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use analysis::{Analysis, AvoidPlan, EstimatePlan};
use case::{CaseFile, SeverityPrior};
use pyo3::exceptions::{PyOSError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyInt, PyString, PyTuple};
use report::{DrawingRequest, SitePlan, Subject, Units};
use requests::{
    AvoidOptions, EstimateOptions, ReconstructOptions, Request, SensitivityOptions, UncertaintyOptions,
    read_records_beside, site_plan_beside,
};
use uncertainty::SamplingMethod;

use crate::dict;
use crate::errors::{METHODS, failed, not_drawn, wrong_case, wrong_value};
use crate::picture::Picture;
use crate::request::{chosen, wrong_option};
use crate::solved::{Solved, answered};

/// A case that was read, and its source.
pub(crate) struct Given {
    pub(crate) file: CaseFile,
    /// The path, if the case is from a file: the pictures that it names are in the same folder.
    path: Option<PathBuf>,
}

/// The data of a collision: a case file that was read and checked.
///
/// ``Case.read`` takes a file, ``Case.parse`` a text and ``Case.from_dict`` a dict. All are checked at
/// once, and ``CaseError`` says what is wrong, where, and what to write instead. The methods give the same
/// answers, bit for bit, as the commands of the same name of the program ``deltav``.
///
/// Examples
/// --------
/// >>> case = pydeltav.Case.example()
/// >>> print(f"{case.reconstruct().found.value:.1f} m/s")
/// 22.9 m/s
#[pyclass(name = "Case", module = "pydeltav", frozen)]
pub(crate) struct PyCase(pub(crate) Arc<Given>);

/// The units of a text or a drawing: those that are asked for, or else those that most of the case uses.
pub(crate) fn units(asked: Option<&str>, file: &CaseFile) -> PyResult<Units> {
    asked.map_or_else(|| Ok(Units::of_case(&file.case)), |asked| chosen("units", asked, &Units::WORDS))
}

/// A whole number that is not negative.
pub(crate) struct Whole<T>(pub(crate) T);

impl<T: TryFrom<i128>> FromPyObject<'_, '_> for Whole<T> {
    type Error = PyErr;

    fn extract(number: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        // If it is not a whole number, Python itself gives the error.
        let number = number.extract::<Bound<'_, PyInt>>()?;
        let wrong = || {
            let bits = 8 * size_of::<T>();
            PyValueError::new_err(format!("{number} is given: give a whole number from 0 to 2**{bits} - 1"))
        };
        T::try_from(number.extract::<i128>().map_err(|_| wrong())?).map(Self).map_err(|_| wrong())
    }
}

/// Whether a text is on one line and has no key and no table, and so is not a case file.
pub(crate) fn is_one_word(text: &str) -> bool {
    let text = text.trim();
    !text.is_empty() && !text.contains(['\n', '=']) && !text.starts_with(['[', '#', '\u{feff}'])
}

/// Whether a text is the path of a case file, and not the text of one.
pub(crate) fn is_path(text: &str) -> bool {
    is_one_word(text) && text.to_ascii_lowercase().ends_with(".toml")
}

/// The bytes of a case file, up to one more than are allowed.
pub(crate) fn bytes_of(py: Python<'_>, path: &Path) -> PyResult<Vec<u8>> {
    let name = path.display().to_string();
    let unreadable = |error: std::io::Error| match error.raw_os_error() {
        // From the number, Python selects the subclass, such as FileNotFoundError.
        Some(number) => {
            let said = py.import("os").and_then(|os| os.call_method1("strerror", (number,)));
            said.map_or_else(|error| error, |said| PyOSError::new_err((number, said.unbind(), name.clone())))
        }
        None => PyOSError::new_err(format!("{name}: {error}")),
    };
    let mut bytes = Vec::new();
    let most = CaseFile::LARGEST_FILE as u64 + 1;
    let read = py.detach(|| File::open(path).and_then(|file| file.take(most).read_to_end(&mut bytes)));
    read.map_err(unreadable)?;
    Ok(bytes)
}

impl Given {
    pub(crate) fn parsed(
        py: Python<'_>,
        name: &str,
        bytes: &[u8],
        path: Option<PathBuf>,
    ) -> PyResult<PyCase> {
        let read = || {
            let mut file = CaseFile::parse_bytes(name, bytes)?;
            // A case from a text alone has no folder in which a file could lie.
            if let Some(path) = &path {
                read_records_beside(path, &mut file, &METHODS)?;
            }
            Ok(file)
        };
        let file = py.detach(read).map_err(|errors| wrong_case(py, errors))?;
        Ok(PyCase(Arc::new(Self { file, path })))
    }

    /// The picture that `site_plan` of `[scene]` names, counted from the folder of the case file.
    pub(crate) fn site_plan(&self, py: Python<'_>) -> PyResult<Option<SitePlan>> {
        let path = self.path.as_deref().unwrap_or(Path::new(""));
        site_plan_beside(path, &self.file, &METHODS).map_err(|errors| wrong_case(py, errors))
    }

    /// The subject of a drawing by its name, or by `_` in place of `-`.
    pub(crate) fn subject(what: &str) -> PyResult<Subject> {
        let choices = Subject::ALL.map(|subject| (subject.name(), subject));
        chosen("what", &what.replace('_', "-"), &choices)
    }

    pub(crate) fn draw(
        &self,
        py: Python<'_>,
        analysis: &Analysis,
        request: DrawingRequest,
        units: Units,
    ) -> PyResult<report::Drawing> {
        if !request.can_be() {
            let problem =
                "plain=True is a form of the scene and of the motion: give what=\"scene\", or leave it out";
            return Err(PyValueError::new_err(problem));
        }
        let site_plan = if request.subject == Subject::Motion { self.site_plan(py)? } else { None };
        let file = &self.file;
        let drawing = py.detach(|| request.draw(file, analysis, None, units, site_plan));
        drawing.map_err(|error| not_drawn(py, error, file))
    }
}

impl PyCase {
    fn asked<'py>(
        &self,
        py: Python<'py>,
        request: Request,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyAny>> {
        request.check().map_err(|error| wrong_option(&error))?;
        answered(py, Solved::new(py, Arc::clone(&self.0), request, threads)?)
    }
}

#[pymethods]
impl PyCase {
    #[new]
    #[pyo3(signature = (*args, **kwargs))]
    fn new(args: &Bound<'_, PyTuple>, kwargs: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let _ = (args, kwargs);
        Err(PyTypeError::new_err(
            "use Case.read(path) for a file, Case.parse(text) for a text, or Case.from_dict(dict)",
        ))
    }

    /// Reads a case file (TOML).
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file.
    ///
    /// Returns
    /// -------
    /// Case
    ///
    /// Raises
    /// ------
    /// OSError
    ///     If the file cannot be read.
    /// CaseError
    ///     If it is not a valid case.
    ///
    /// Examples
    /// --------
    /// >>> import pathlib, tempfile
    /// >>> path = pathlib.Path(tempfile.mkdtemp(), "case.toml")
    /// >>> _ = path.write_text(pydeltav.Case.example().text, "utf-8")
    /// >>> pydeltav.Case.read(path).title
    /// 'Intersection collision, GMC Jimmy and Nissan Altima'
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let name = path.display().to_string();
        if name.contains('\n') {
            let problem = "read() takes the path of a case file: Case.parse(text) takes its text";
            return Err(PyValueError::new_err(problem));
        }
        let bytes = bytes_of(py, &path)?;
        Given::parsed(py, &name, &bytes, Some(path))
    }

    /// Reads the text of a case file (TOML).
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     The text; ``Case.read`` takes a path.
    /// name : str
    ///     Its name in errors and results.
    ///
    /// Returns
    /// -------
    /// Case
    ///
    /// Raises
    /// ------
    /// CaseError
    ///     If it is not a valid case.
    ///
    /// Examples
    /// --------
    /// >>> case = pydeltav.Case.parse('[vehicle1]\nmass = "1500 kg"\n[vehicle2]\nfixed = true')
    /// >>> pydeltav.Case.parse('[vehicle1]\nmass = 1500\n[vehicle2]\nfixed = true')
    /// Traceback (most recent call last):
    ///     ...
    /// pydeltav.CaseError: error: "vehicle1.mass" is the bare number 1500, but needs a unit
    /// ...
    #[staticmethod]
    #[pyo3(signature = (text, name = "text"))]
    fn parse(text: &Bound<'_, PyAny>, name: &str) -> PyResult<Self> {
        let py = text.py();
        let Ok(text) = text.cast::<PyString>() else {
            let problem = format!(
                "parse() takes the text of a case file, not {}: Case.read(path) reads a file, and \
                 Case.from_dict(dict) a dict",
                text.get_type().name()?
            );
            return Err(PyTypeError::new_err(problem));
        };
        let text = text.to_str()?;
        if is_path(text) {
            let shown = case::shown(text);
            let problem = format!("\"{shown}\" is not the text of a case file, but the path of one");
            return Err(wrong_value(py, "", &problem, &format!("Case.read(\"{shown}\") reads the file")));
        }
        Given::parsed(py, name, text.as_bytes(), None)
    }

    /// Reads a case from a dict with the tables and keys of the case file.
    ///
    /// Numbers keep their bits; a value with a unit is a text, as in the file. ``case.text`` is the file
    /// that it makes.
    ///
    /// Parameters
    /// ----------
    /// case : Mapping
    ///     Tables as dicts, texts, numbers, flags, lists, and arrays of NumPy.
    /// name : str
    ///     Its name in errors and results.
    ///
    /// Returns
    /// -------
    /// Case
    ///
    /// Raises
    /// ------
    /// CaseError
    ///     If it is not a valid case.
    ///
    /// Examples
    /// --------
    /// >>> case = pydeltav.Case.from_dict({
    /// ...     "vehicle1": {
    /// ...         "mass": "1500 kg",
    /// ...         "class": 3,
    /// ...         "crush": {"ees": "36 km/h", "pdof": "0 deg", "moment_arm": "0 m"},
    /// ...     },
    /// ...     "vehicle2": {"fixed": True},
    /// ... })
    /// >>> case.crush().vehicle1.ees
    /// 10.0
    #[staticmethod]
    #[pyo3(signature = (case, name = "dict"))]
    fn from_dict(case: &Bound<'_, PyAny>, name: &str) -> PyResult<Self> {
        Given::parsed(case.py(), name, dict::as_toml(case)?.as_bytes(), None)
    }

    /// The example of SAE 980025: what was the speed of the GMC Jimmy?
    ///
    /// Returns
    /// -------
    /// Case
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().name
    /// 'sae-980025.toml'
    #[staticmethod]
    fn example(py: Python<'_>) -> PyResult<Self> {
        Given::parsed(py, "sae-980025.toml", case::EXAMPLE.as_bytes(), None)
    }

    /// The text of the case file.
    #[getter]
    fn text(&self) -> &str {
        self.0.file.source.text()
    }

    /// The name under which it was read.
    #[getter]
    fn name(&self) -> &str {
        self.0.file.source.name().as_given()
    }

    /// The title of the case, or None.
    #[getter]
    fn title(&self) -> Option<&str> {
        self.0.file.case.title.as_ref().map(case::Text::as_given)
    }

    /// The case as a dict, which ``Case.from_dict`` reads.
    ///
    /// Returns
    /// -------
    /// dict
    ///     A new one at each call.
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().to_dict()["vehicle2"]["speed"]
    /// '10 mph'
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = PyString::new(py, self.text().trim_start_matches('\u{feff}'));
        py.import("tomllib")?.call_method1("loads", (text,))
    }

    /// Finds the speed at which impact and crush agree, or both speeds, and gives the whole reconstruction.
    ///
    /// If the case has more evidence than this exact solution uses, or crush energies that are too small on
    /// average, all the evidence is weighed as by ``estimate``, in about a second. The answer is then
    /// ``headline``; ``found``, ``impact`` and the vehicles are those of the exact solution.
    ///
    /// Parameters
    /// ----------
    /// exact : bool
    ///     Whether to skip the weighing: ``headline.by`` is then ``"exact"`` or ``"none"``.
    /// threads : int, optional
    ///     By default one for each processor. The results do not depend on it, bit for bit.
    ///
    /// Returns
    /// -------
    /// Analysis
    ///     With ``headline``, ``found``, ``impact``, ``vehicle1`` and ``vehicle2``; SI units and radians.
    ///
    /// Raises
    /// ------
    /// CaseError
    ///     If the case lacks something that is needed; the message says what.
    /// NoAnswerError
    ///     If no collision fits the case.
    ///
    /// Examples
    /// --------
    /// >>> result = pydeltav.Case.example().reconstruct()
    /// >>> result.found.method, round(result.vehicle1.delta_v, 2)
    /// ('closed form', 12.15)
    #[pyo3(signature = (*, exact = false, threads = None), text_signature = "(self, *, exact=False, threads=None)")]
    fn reconstruct<'py>(
        &self,
        py: Python<'py>,
        exact: bool,
        threads: Option<Whole<usize>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = ReconstructOptions { weigh: !exact, ..ReconstructOptions::default() };
        self.asked(py, Request::Reconstruct(options), threads.map(|threads| threads.0))
    }

    /// Computes an impact from two known speeds.
    ///
    /// Returns
    /// -------
    /// Analysis
    ///     With ``impact``, ``vehicle1`` and ``vehicle2``; SI units and radians.
    ///
    /// Raises
    /// ------
    /// CaseError
    ///     If the case lacks something that is needed; the message says what.
    /// NoAnswerError
    ///     If no collision fits the case.
    ///
    /// Examples
    /// --------
    /// >>> numbers = pydeltav.Case.example().to_dict()
    /// >>> numbers["vehicle1"]["speed"] = "50 mph"
    /// >>> result = pydeltav.Case.from_dict(numbers).impact()
    /// >>> print(f"{result.vehicle2.delta_v:.1f} m/s")
    /// 12.9 m/s
    fn impact<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.asked(py, Request::Impact, None)
    }

    /// Follows each vehicle from the impact to rest, or finds its departure from the rest position.
    ///
    /// Returns
    /// -------
    /// Analysis
    ///     With ``start``, ``rest`` and ``path`` of ``vehicle1`` and ``vehicle2``; SI units and radians.
    ///
    /// Raises
    /// ------
    /// CaseError
    ///     If the case lacks something that is needed; the message says what.
    /// NoAnswerError
    ///     If no collision fits the case.
    ///
    /// Examples
    /// --------
    /// >>> after = {"speed": "10 m/s", "direction": "0 deg", "yaw_rate": "0 rad/s", "drag": 0.7}
    /// >>> car = {"mass": "1500 kg", "yaw_inertia": "2500 kg m^2", "heading": "0 deg", "wheelbase": "2.6 m",
    /// ...        "track": "1.5 m", "cg_to_front_axle": "1.2 m", "contact": {"x": "2 m", "y": "0 m"}}
    /// >>> motion = pydeltav.Case.from_dict({
    /// ...     "surface": {"friction": 0.7},
    /// ...     "scene": {"contact": {"x": "0 m", "y": "0 m"}},
    /// ...     "vehicle1": {**car, "after": after},
    /// ...     "vehicle2": {"fixed": True},
    /// ... }).motion()
    /// >>> print(f"{motion.vehicle1.rest.distance:.2f} m in {motion.vehicle1.rest.time:.2f} s")
    /// 7.28 m in 1.46 s
    fn motion<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.asked(py, Request::Motion, None)
    }

    /// Computes crush energy and ΔV from damage and PDOF alone (CRASH3).
    ///
    /// Returns
    /// -------
    /// Analysis
    ///     With ``crash3`` and the damage of ``vehicle1`` and ``vehicle2``; SI units and radians.
    ///
    /// Raises
    /// ------
    /// CaseError
    ///     If the case lacks something that is needed; the message says what.
    /// NoAnswerError
    ///     If no collision fits the case.
    ///
    /// Examples
    /// --------
    /// >>> crush = {"ees": "36 km/h", "pdof": "0 deg", "moment_arm": "0 m"}
    /// >>> car = {"mass": "1500 kg", "class": 3, "crush": crush}
    /// >>> result = pydeltav.Case.from_dict({"vehicle1": car, "vehicle2": {"fixed": True}}).crush()
    /// >>> print(f"{result.crash3.crush_energy / 1000:.0f} kJ, ΔV {result.crash3.delta_v[0]:.1f} m/s")
    /// 75 kJ, ΔV 10.0 m/s
    fn crush<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.asked(py, Request::Crush, None)
    }

    /// Shows what the case allows, what is assumed where it gives nothing, and the warnings, without
    /// solving it.
    ///
    /// Returns
    /// -------
    /// Judgement
    ///     With ``commands``, ``inputs``, ``assumptions`` and ``warnings``.
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().check().answers_most
    /// 'reconstruct'
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.asked(py, Request::Check, None)
    }

    /// Compares the answers of every impact law and of CRASH3, and those of damage and momentum.
    ///
    /// Returns
    /// -------
    /// Comparison
    ///     With ``rows`` and ``evidence``; SI units and radians.
    ///
    /// Raises
    /// ------
    /// CaseError
    ///     If the case lacks something that is needed; the message says what.
    /// NoAnswerError
    ///     If no collision fits the case.
    ///
    /// Examples
    /// --------
    /// >>> for row in pydeltav.Case.example().compare().rows[:2]:
    /// ...     print(f"{row.law}: {row.found:.1f} m/s")
    /// Brach, common tangential velocity: 22.9 m/s
    /// Brach, friction limit: 22.9 m/s
    fn compare<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.asked(py, Request::Compare, None)
    }

    /// Gives the derivatives of the answer with respect to each input, and sweeps the PDOF to both sides.
    ///
    /// Parameters
    /// ----------
    /// pdof_step : float
    ///     (degrees) a step of the sweep, above 0 and up to 180.
    /// pdof_steps : int
    ///     (–) steps to each side, up to 180.
    ///
    /// Returns
    /// -------
    /// Sensitivity
    ///     With ``derivatives`` (SI per SI) and ``pdof_sweep``.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the step or the number of steps is not valid.
    /// CaseError
    ///     If the case lacks something that is needed; the message says what.
    /// NoAnswerError
    ///     If no collision fits the case.
    ///
    /// Examples
    /// --------
    /// >>> rows = pydeltav.Case.example().sensitivity(pdof_step=2.0, pdof_steps=1).pdof_sweep
    /// >>> [round(row.change, 4) for row in rows]
    /// [-0.0349, 0.0, 0.0349]
    #[pyo3(
        signature = (*, pdof_step = 5.0, pdof_steps = Whole(2)),
        text_signature = "($self, *, pdof_step=5.0, pdof_steps=2)"
    )]
    fn sensitivity<'py>(
        &self,
        py: Python<'py>,
        pdof_step: f64,
        pdof_steps: Whole<u32>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = SensitivityOptions { pdof_step, pdof_steps: pdof_steps.0 };
        self.asked(py, Request::Sensitivity(options), None)
    }

    /// Propagates the ranges of the case to the results. Ctrl-C ends it.
    ///
    /// Parameters
    /// ----------
    /// samples : int, optional
    ///     (–) by default 100,000, or 1000 if the vehicles are searched back from their rests.
    /// seed : int
    ///     (–) of the random numbers; the same seed gives the same bits.
    /// method : {"monte-carlo", "latin-hypercube", "sobol"}
    ///     How the samples are drawn.
    /// sobol : int, optional
    ///     (–) rows, such as 4096, from which Sobol' indices are computed.
    /// threads : int, optional
    ///     By default one for each processor. The results do not depend on it, bit for bit.
    ///
    /// Returns
    /// -------
    /// Uncertainty
    ///     With ``outputs`` by key (SI units and radians), and ``columns()`` with all samples.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If a number or the method is not valid.
    /// CaseError
    ///     If the case lacks something that is needed; the message says what.
    /// NoAnswerError
    ///     If no collision fits the case.
    ///
    /// Examples
    /// --------
    /// >>> case = pydeltav.Case.parse(pydeltav.Case.example().text.replace(
    /// ...     '"10 mph"', '{ low = "8 mph", high = "12 mph" }'))
    /// >>> result = case.uncertainty(1000, seed=7)
    /// >>> low, high = result.outputs["vehicle1.speed"].interval95
    /// >>> low < result.outputs["vehicle1.speed"].central < high
    /// True
    #[pyo3(
        signature =
            (samples = None, seed = Whole(1), *, method = "monte-carlo", sobol = None, threads = None),
        text_signature = "($self, samples=None, seed=1, *, method='monte-carlo', sobol=None, threads=None)"
    )]
    fn uncertainty<'py>(
        &self,
        py: Python<'py>,
        samples: Option<Whole<usize>>,
        seed: Whole<u64>,
        method: &str,
        sobol: Option<Whole<usize>>,
        threads: Option<Whole<usize>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = UncertaintyOptions {
            samples: samples.map(|samples| samples.0),
            seed: seed.0,
            method: chosen("method", method, &SamplingMethod::WORDS)?,
            indices: sobol.map(|rows| rows.0),
            outputs: None,
        };
        self.asked(py, Request::Uncertainty(options), threads.map(|threads| threads.0))
    }

    /// Estimates the speeds, with their probabilities, from all evidence. Ctrl-C ends it.
    ///
    /// Parameters
    /// ----------
    /// particles : int
    ///     (–) of each of 16 islands, a multiple of 128.
    /// seed : int
    ///     (–) of the random numbers; the same seed gives the same bits.
    /// prior : {"field", "serious-injury", "flat"}, optional
    ///     The severity before the evidence, in place of that of the case.
    /// pieces : bool
    ///     Whether to compute the answer by each piece of evidence alone, which takes most of the time.
    /// above : sequence of str
    ///     Questions such as ``"vehicle1.speed 50 km/h"``: how probable is it that the result is above?
    /// threads : int, optional
    ///     By default one for each processor. The results do not depend on it, bit for bit.
    ///
    /// Returns
    /// -------
    /// Estimate
    ///     With ``outputs`` by key (SI units and radians), and ``columns()`` with all draws. Where the run
    ///     has not converged, ``converged`` is False and no interval is given.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If a number, the prior or a question is not valid.
    /// CaseError
    ///     If the case lacks something that is needed; the message says what.
    /// NoAnswerError
    ///     If no collision fits the case.
    ///
    /// Examples
    /// --------
    /// >>> ask = {"pieces": False, "above": ["vehicle1.speed 40 mph"]}
    /// >>> result = pydeltav.Case.example().estimate(particles=128, **ask)
    /// >>> result.converged, result.questions[0].probability > 0.5
    /// (True, True)
    #[pyo3(
        signature = (
            *, particles = Whole(EstimatePlan::PARTICLES), seed = Whole(1), prior = None, pieces = true, above = Vec::new(), threads = None
        ),
        text_signature = "($self, *, particles=256, seed=1, prior=None, pieces=True, above=(), threads=None)"
    )]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn estimate<'py>(
        &self,
        py: Python<'py>,
        particles: Whole<usize>,
        seed: Whole<u64>,
        prior: Option<String>,
        pieces: bool,
        above: Vec<String>,
        threads: Option<Whole<usize>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let prior = prior.map(|prior| chosen("prior", &prior, &SeverityPrior::WORDS)).transpose()?;
        let options = EstimateOptions { particles: particles.0, seed: seed.0, prior, pieces, above };
        self.asked(py, Request::Estimate(options), threads.map(|threads| threads.0))
    }

    /// What the event data recorders give on their own: the speed at impact with its error, the distance
    /// to it from each sample, the pulse.
    ///
    /// Returns
    /// -------
    /// Result
    ///     With ``vehicles``, a record or ``None`` for each: ``recognised``, ``speed_at_impact``,
    ///     ``samples`` and ``pulse``; SI units. The last of the samples is the impact, at time 0. Of the
    ///     pulse, ``longitudinal`` and ``lateral`` are as stored, lateral to the right;
    ///     ``delta_v_at_recorder`` and ``delta_v_at_center`` are along the vehicle and across it in the axes
    ///     of the case, the latter ``None`` unless the case has ``at`` and ``yaw_rate``.
    ///
    /// Raises
    /// ------
    /// CaseError
    ///     If the case has no table of a recorder; the message says what to write.
    ///
    /// Examples
    /// --------
    /// >>> table = {"time": "-1 -0.5 0 s", "speed": "58 58 58 km/h", "brake": "off off off"}
    /// >>> case = pydeltav.Case.from_dict({
    /// ...     "vehicle1": {"recorder": {"pre_crash": table}}, "vehicle2": {"fixed": True}})
    /// >>> speed = case.recorder()["vehicles"][0]["speed_at_impact"]
    /// >>> print(f"{speed['stored'] * 3.6:.0f} km/h stored, {speed['mean'] * 3.6:.0f} driven")
    /// 58 km/h stored, 59 driven
    fn recorder<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.asked(py, Request::Recorder, None)
    }

    /// Whether the collision was avoidable: at the limit, with a reaction in time, with full braking.
    ///
    /// Parameters
    /// ----------
    /// samples : int
    ///     (–) if numbers of the case are ranges.
    /// seed : int
    ///     (–) of the random numbers; the same seed gives the same bits.
    /// exact : bool
    ///     Take the speed of the exact solution, even if there is more evidence.
    /// threads : int, optional
    ///     By default one for each processor. The results do not depend on it, bit for bit.
    ///
    /// Returns
    /// -------
    /// Avoidance
    ///     With ``avoid``: ``speed``, ``demand``, ``spatial``, ``temporal``, ``at_limit``,
    ///     ``probability`` and ``runs``; SI units.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If a number is not valid.
    /// CaseError
    ///     If the case lacks something that is needed, such as a reaction time; the message says what.
    /// NoAnswerError
    ///     If no collision fits the case.
    ///
    /// Examples
    /// --------
    /// >>> case = pydeltav.Case.from_dict({"avoid": {
    /// ...     "speed": "50 km/h",
    /// ...     "limit": "30 km/h",
    /// ...     "reaction_time": "1 s",
    /// ...     "deceleration": "6.5 m/s^2",
    /// ...     "demand": {"distance": "20 m"},
    /// ... }})
    /// >>> print(f"{case.avoid().avoid.spatial.speed * 3.6:.1f} km/h")
    /// 39.2 km/h
    #[pyo3(
        signature = (*, samples = Whole(AvoidPlan::SAMPLES), seed = Whole(1), exact = false, threads = None),
        text_signature = "($self, *, samples=100000, seed=1, exact=False, threads=None)"
    )]
    fn avoid<'py>(
        &self,
        py: Python<'py>,
        samples: Whole<usize>,
        seed: Whole<u64>,
        exact: bool,
        threads: Option<Whole<usize>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = AvoidOptions { samples: samples.0, seed: seed.0, exact };
        self.asked(py, Request::Avoid(options), threads.map(|threads| threads.0))
    }

    /// Draws the most complete analysis that the case allows.
    ///
    /// If the case has more evidence than that uses, the drawing says so below its title.
    ///
    /// Parameters
    /// ----------
    /// what : {"scene", "motion", "motion-curves", "momentum", "damage", "reconciliation", "energy"}
    ///     What to draw.
    /// units : {"si", "us", "uk"}, optional
    ///     By default those that most of the case uses.
    /// plain : bool
    ///     Scene and motion for readers who are not engineers; without speeds where only ``estimate()`` has
    ///     them.
    ///
    /// Returns
    /// -------
    /// Drawing
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such drawing.
    /// CaseError
    ///     If the case lacks something that is needed; the message says what.
    /// NoAnswerError
    ///     If no collision fits the case.
    ///
    /// Examples
    /// --------
    /// >>> pydeltav.Case.example().draw("scene").svg()[:4]
    /// '<svg'
    #[pyo3(signature = (what = "scene", *, units = None, plain = false))]
    fn draw(slf: &Bound<'_, Self>, what: &str, units: Option<&str>, plain: bool) -> PyResult<Picture> {
        let py = slf.py();
        let given = &slf.get().0;
        let subject = Given::subject(what)?;
        let in_units = self::units(units, &given.file)?;
        let analysis = py.detach(|| subject.analysis(&given.file.case));
        let analysis = analysis.map_err(|failure| failed(py, failure, &given.file))?;
        let drawing = given.draw(py, &analysis, DrawingRequest { subject, plain }, in_units)?;
        let again = PyDict::new(py);
        again.set_item("units", units)?;
        again.set_item("plain", plain)?;
        Picture::new(slf.as_any(), drawing, ("draw", what), &again)
    }

    fn __repr__(&self) -> String {
        let title = self.title().map(|title| format!(" \"{}\"", case::shown(title))).unwrap_or_default();
        format!("<pydeltav.Case{title} from {}>", self.0.file.source.name())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let restore = py.import("pydeltav._pydeltav")?.getattr("_restore_case")?;
        let bytes = PyBytes::new(py, self.text().as_bytes());
        Ok((restore, (self.name(), bytes, self.0.path.clone()).into_pyobject(py)?))
    }
}

/// A case that was pickled.
#[pyfunction]
#[pyo3(name = "_restore_case")]
pub(crate) fn restore_case(
    py: Python<'_>,
    name: &str,
    text: &[u8],
    path: Option<PathBuf>,
) -> PyResult<PyCase> {
    Given::parsed(py, name, text, path)
}
