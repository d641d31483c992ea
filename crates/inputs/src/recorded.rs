//! The tables of a recorder: the data that it stored before the impact and during it.

use std::fmt::Display;

use recorder::{
    Apart, Channel, CrashPulse, ImpactSpeedErrors, PreCrash, PreCrashFault, PulseFault, RecorderTable,
    TextPlace, TextRefusal, columns_table, read_rows,
};

use crate::quantity::Quantity;
use crate::text::Text;
use crate::units::STANDARD_GRAVITY;
use crate::walk::{Key, Walk};

/// The source of a recorder's table.
#[derive(Clone, Debug, PartialEq)]
pub enum SeriesSource {
    /// `text`: copied out of a printed report, or the lines of a CSV.
    Text(Text),
    /// `file`: the name of a text file next to the case file.
    File(Text),
    /// `time`, `speed` and so on: a text of values with their unit for each column.
    Columns(Vec<(Channel, Text)>),
}

/// Why a case cannot use a table.
#[derive(Clone, Debug, PartialEq)]
pub enum SeriesRefusal {
    /// The text cannot be read.
    Text(TextRefusal),
    /// The column cannot be read.
    Column(Channel, TextRefusal),
    /// The text has tables, but none of this kind.
    NoneOfKind {
        /// The kind that was wanted, in words.
        wanted: &'static str,
        /// The columns of that kind, in words.
        columns: &'static str,
        /// The headings of the tables, with what they were taken for.
        found: String,
    },
    /// The text has a table of the other kind.
    OtherKind {
        /// The kind of the table, in words.
        kind: &'static str,
        /// The key of a recorder to which it belongs.
        key: &'static str,
        /// The kind that was wanted, in words.
        wanted: &'static str,
        /// As in [`NoneOfKind`](Self::NoneOfKind).
        found: String,
    },
    /// The table is no record before an impact; with the place of the row, if a row is the reason.
    PreCrash(PreCrashFault, Option<TextPlace>),
    /// The table is no pulse.
    Pulse(PulseFault),
}

impl Display for SeriesRefusal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Text(refusal) | Self::Column(_, refusal) => write!(f, "{}", refusal.fault),
            Self::NoneOfKind { wanted, columns, found } => {
                write!(f, "no table of {wanted}, with {columns}, was found: the program read {found}")
            }
            Self::OtherKind { kind, key: _, wanted, found } => {
                write!(f, "this is a table of {kind}, not of {wanted}: the program read {found}")
            }
            Self::PreCrash(fault, _) => fault.fmt(f),
            Self::Pulse(fault) => fault.fmt(f),
        }
    }
}

impl SeriesRefusal {
    /// Its place in the text, if it has one.
    #[must_use]
    pub fn place(&self) -> Option<TextPlace> {
        match self {
            Self::Text(refusal) | Self::Column(_, refusal) => refusal.place,
            Self::PreCrash(_, place) => *place,
            Self::NoneOfKind { .. } | Self::OtherKind { .. } | Self::Pulse(_) => None,
        }
    }

    /// What to do about it, if that is more than to correct what it says.
    #[must_use]
    pub fn advice(&self) -> Option<String> {
        match self {
            Self::OtherKind { key, .. } => Some(format!("give it as `{key}`")),
            _ => None,
        }
    }
}

/// A table of `[vehicleN.recorder]`, and its content.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenSeries<R> {
    /// Its source.
    pub source: SeriesSource,
    /// Which rows of a long table of NHTSA: `VEHNO 1, EDREVENTNO 2`.
    pub rows: Option<Text>,
    /// What was recognised in it: one table, or one for each axis of a pulse. Empty for a file that is not
    /// read yet.
    pub tables: Vec<RecorderTable>,
    /// Its content; `None` for a file that is not read yet.
    pub record: Option<R>,
}

/// `pre_crash`: the data stored before the impact.
pub type GivenPreCrash = GivenSeries<PreCrash>;

/// `pulse`: ΔV over time. Lateral ΔV is positive to the right, as recorders store it.
pub type GivenPulse = GivenSeries<CrashPulse>;

/// The content of the tables of a recorder.
pub trait OfTables: Sized {
    /// The tables of this kind, and their content.
    ///
    /// # Errors
    ///
    /// [`SeriesRefusal`].
    fn of_tables(tables: Vec<RecorderTable>) -> Result<(Vec<RecorderTable>, Self), SeriesRefusal>;
}

/// The tables of a text; of a long table, those of these rows.
fn of_text(text: &str, rows: Option<&Text>) -> Result<Vec<RecorderTable>, SeriesRefusal> {
    read_rows(text, rows.map_or("", Text::as_given)).map_err(SeriesRefusal::Text)
}

impl SeriesSource {
    fn tables(&self, rows: Option<&Text>) -> Result<Option<Vec<RecorderTable>>, SeriesRefusal> {
        match self {
            Self::Text(text) => of_text(text.as_given(), rows).map(Some),
            Self::File(_) => Ok(None),
            Self::Columns(columns) => {
                let columns: Vec<(Channel, &str)> =
                    columns.iter().map(|(channel, text)| (*channel, text.as_given())).collect();
                let table = columns_table(&columns);
                table
                    .map(|table| Some(vec![table]))
                    .map_err(|(of, refusal)| SeriesRefusal::Column(of, refusal))
            }
        }
    }
}

/// A kind of table that a recorder has.
struct TableKind {
    /// In words.
    name: &'static str,
    /// The columns that make it one.
    columns: &'static str,
    /// The key of a recorder that takes it.
    key: &'static str,
    is: fn(&RecorderTable) -> bool,
}

const SPEEDS: TableKind = TableKind {
    name: "speeds before the impact",
    columns: "times and speeds",
    key: "pre_crash",
    is: RecorderTable::is_pre_crash,
};

const PULSE: TableKind = TableKind {
    name: "ΔV over time",
    columns: "times and a longitudinal or lateral ΔV",
    key: "pulse",
    is: RecorderTable::is_pulse,
};

/// The refusal of tables that are all of another kind than the wanted one.
fn none_of_kind(wanted: &TableKind, other: &TableKind, tables: &[RecorderTable]) -> SeriesRefusal {
    let headings: Vec<String> = tables.iter().map(RecorderTable::headings).collect();
    let found = if headings.is_empty() { "nothing".to_owned() } else { headings.join("; ") };
    if tables.iter().any(other.is) {
        SeriesRefusal::OtherKind { kind: other.name, key: other.key, wanted: wanted.name, found }
    } else {
        SeriesRefusal::NoneOfKind { wanted: wanted.name, columns: wanted.columns, found }
    }
}

impl<R: OfTables> GivenSeries<R> {
    /// Reads its tables, unless they are in a file.
    ///
    /// # Errors
    ///
    /// [`SeriesRefusal`].
    pub fn read(source: SeriesSource, rows: Option<Text>) -> Result<Self, SeriesRefusal> {
        match source.tables(rows.as_ref())? {
            Some(tables) => Self::of(source, rows, tables),
            None => Ok(Self { source, rows, tables: Vec::new(), record: None }),
        }
    }

    /// Reads its tables from the text of its file.
    ///
    /// # Errors
    ///
    /// As [`read`](Self::read).
    pub fn read_file(&self, text: &str) -> Result<Self, SeriesRefusal> {
        Self::of(self.source.clone(), self.rows.clone(), of_text(text, self.rows.as_ref())?)
    }

    fn of(
        source: SeriesSource,
        rows: Option<Text>,
        tables: Vec<RecorderTable>,
    ) -> Result<Self, SeriesRefusal> {
        let (tables, record) = R::of_tables(tables)?;
        Ok(Self { source, rows, tables, record: Some(record) })
    }
}

impl OfTables for PreCrash {
    fn of_tables(tables: Vec<RecorderTable>) -> Result<(Vec<RecorderTable>, Self), SeriesRefusal> {
        let none = none_of_kind(&SPEEDS, &PULSE, &tables);
        let of_speeds = tables.iter().position(SPEEDS.is).ok_or(none)?;
        let mut others = tables;
        let mut table = others.remove(of_speeds);
        for other in others {
            match other.not_before_impact().or_else(|| table.not_with(&other)) {
                None => table.join(other),
                Some(reason) => table.leave(other, reason),
            }
        }
        let record = Self::from_table(&table).map_err(|fault| {
            let row = fault.sample().and_then(|sample| table.rows.get(sample - 1).copied());
            SeriesRefusal::PreCrash(fault, row)
        })?;
        Ok((vec![table], record))
    }
}

impl OfTables for CrashPulse {
    fn of_tables(tables: Vec<RecorderTable>) -> Result<(Vec<RecorderTable>, Self), SeriesRefusal> {
        let none = none_of_kind(&PULSE, &SPEEDS, &tables);
        let (pulses, others): (Vec<_>, Vec<_>) = tables.into_iter().partition(PULSE.is);
        let mut tables: Vec<RecorderTable> = Vec::new();
        for next in pulses {
            let same = tables.iter_mut().find(|table| table.shares_a_quantity(&next));
            match same {
                Some(table) => match table.not_with(&next) {
                    None => table.join(next),
                    Some(reason) => table.leave(next, reason),
                },
                None => tables.push(next),
            }
        }
        if let Some(first) = tables.first_mut() {
            others.into_iter().for_each(|other| first.leave(other, Apart::HasNoDeltaV));
        }
        let along = tables.iter().find(|table| table.column(Channel::DeltaVLongitudinal).is_some());
        let across = tables.iter().find(|table| table.column(Channel::DeltaVLateral).is_some());
        let first = along.or(across).ok_or(none)?;
        let mut pulse = Self::from_table(first).map_err(SeriesRefusal::Pulse)?;
        if let Some(across) = across.filter(|across| !std::ptr::eq(*across, first)) {
            pulse = pulse.with(&Self::from_table(across).map_err(SeriesRefusal::Pulse)?);
        }
        Ok((tables, pulse))
    }
}

/// `errors` of `[vehicleN.recorder]`: those of the stored speed as the speed at impact, in place of the
/// defaults of [`ImpactSpeedErrors`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GivenSpeedErrors {
    /// (m/s) step in which speeds are stored.
    pub step: Option<Quantity>,
    /// (%) relative error by which a stored speed is too low while the wheels roll.
    pub steady_low: Option<f64>,
    /// (%) standard deviation of that share.
    pub steady_sd: Option<f64>,
    /// (%) standard deviation of the relative error of a speed with worn or different tyres.
    pub tyre_sd: Option<f64>,
    /// (m/s) how much a speed reads low in hard braking.
    pub slip_low: Option<Quantity>,
    /// (m/s) standard deviation of that.
    pub slip_sd: Option<Quantity>,
    /// (%) drag factor of hard braking.
    pub friction: Option<f64>,
    /// (% of g) greatest acceleration and deceleration with the brake off.
    pub coasting: Option<f64>,
    /// (%) probability that the brake came on within half a second of the gap.
    pub brake_comes_on: Option<f64>,
    /// (%) probability that a driver who braked kept his deceleration.
    pub keeps_braking: Option<f64>,
    /// (s) greatest age of a stored speed.
    pub latency: Option<Quantity>,
    /// (%) probability that the last speed belongs to the impact itself if it fell by more than 1 g.
    pub last_is_of_impact: Option<f64>,
}

impl GivenSpeedErrors {
    /// The errors with the defaults for those that are not given; the drag factor is that of the ground, if
    /// the case gives it, and the step that of the record, if there is one.
    #[must_use]
    pub fn errors(&self, ground: Option<f64>, record: Option<&PreCrash>) -> ImpactSpeedErrors {
        let usual = ImpactSpeedErrors::default();
        let si = |given: Option<Quantity>, usual: f64| given.as_ref().map_or(usual, Quantity::si);
        let share = |given: Option<f64>, usual: f64| given.map_or(usual, |percent| percent / 100.0);
        ImpactSpeedErrors {
            step: si(self.step, record.map_or(usual.step, PreCrash::step)),
            steady_low: share(self.steady_low, usual.steady_low),
            steady_sd: share(self.steady_sd, usual.steady_sd),
            tyre_sd: share(self.tyre_sd, usual.tyre_sd),
            slip_low: si(self.slip_low, usual.slip_low),
            slip_sd: si(self.slip_sd, usual.slip_sd),
            friction: share(self.friction, ground.unwrap_or(usual.friction)),
            coasting: self.coasting.map_or(usual.coasting, |percent| percent / 100.0 * STANDARD_GRAVITY),
            brake_comes_on: share(self.brake_comes_on, usual.brake_comes_on),
            keeps_braking: share(self.keeps_braking, usual.keeps_braking),
            latency: si(self.latency, usual.latency),
            last_is_of_impact: share(self.last_is_of_impact, usual.last_is_of_impact),
        }
    }
}

impl<U> Walk<'_, U> {
    pub(crate) fn series<R>(&mut self, table: &dyn Display, given: Option<&GivenSeries<R>>) {
        let Some(GivenSeries { source, rows, .. }) = given else { return };
        let mut text = |key: &str, text: &Text| {
            self.text(&Key(table, key), Some(text));
        };
        match source {
            SeriesSource::Text(given) => text("text", given),
            SeriesSource::File(given) => text("file", given),
            SeriesSource::Columns(columns) => {
                for (channel, given) in columns {
                    text(channel.key(), given);
                }
            }
        }
        self.text(&Key(table, "rows"), rows.as_ref());
    }

    pub(crate) fn speed_errors(&mut self, table: &dyn Display, errors: &GivenSpeedErrors) {
        let quantities = [
            ("step", errors.step),
            ("slip_low", errors.slip_low),
            ("slip_sd", errors.slip_sd),
            ("latency", errors.latency),
        ];
        for (key, quantity) in quantities {
            self.exact_if(&Key(table, key), quantity.as_ref());
        }
        let shares = [
            ("steady_low", errors.steady_low),
            ("steady_sd", errors.steady_sd),
            ("tyre_sd", errors.tyre_sd),
            ("friction", errors.friction),
            ("coasting", errors.coasting),
            ("brake_comes_on", errors.brake_comes_on),
            ("keeps_braking", errors.keeps_braking),
            ("last_is_of_impact", errors.last_is_of_impact),
        ];
        for (key, share) in shares {
            self.percent_if(&Key(table, key), share);
        }
    }
}
