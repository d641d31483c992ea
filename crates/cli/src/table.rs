//! `deltav table`: a row for each row of a table, batch by batch.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek as _};
use std::path::Path;
use std::sync::{Arc, Mutex};

use anyhow::{Context as _, Result, anyhow, bail};
use arrow_array::cast::AsArray as _;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{Array, ArrayRef, RecordBatch, StringArray};
use arrow_cast::display::{ArrayFormatter, FormatOptions};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use case::{KeyForm, KeyInfo, key_tree};
use parquet::arrow::ArrowWriter;
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::basic::{Compression, ZstdLevel};
use parquet::file::properties::WriterProperties;
use tables::{Carried, Job, Options, TableError, Template, columns_kept, result_schema, run};

use crate::arguments::{TableArguments, TableJob};
use crate::batch::{Incomplete, is_broken_pipe};
use crate::progress::Progress;
use crate::sink::Sink;
use crate::{named, pool, read_text};

/// Rows that are in memory at a time, but for those of a row group of the output.
const AT_ONCE: usize = 8192;

/// Rows of a row group of a Parquet file: what is in memory until it is written.
const ROW_GROUP: usize = 65_536;

const CANNOT_WRITE: &str = "cannot write the results";

pub(crate) fn table(arguments: &TableArguments) -> Result<()> {
    let job = match arguments.job {
        TableJob::Reconstruct => Job::Reconstruct,
        TableJob::Impact => Job::Impact,
        TableJob::Crush => Job::Crush,
        TableJob::Estimate => Job::Estimate,
    };
    let options = Options {
        samples: arguments.samples,
        seed: arguments.seed,
        particles: arguments.particles,
        prior: arguments.prior.map(Into::into),
    };
    let output = arguments.output.file();
    if arguments.schema {
        return crate::write(output, keys());
    }
    if arguments.columns {
        return crate::write(output, columns(job, &options));
    }
    let Some(cases) = &arguments.cases else { bail!("name the table, or - for CSV on standard input") };
    let template = match &arguments.template {
        Some(path) => {
            let (name, text) = read_text(path)?;
            Template::parse(&name, &text).map_err(|error| match error {
                TableError::Template(errors) => anyhow::Error::from(*errors),
                other => other.into(),
            })?
        }
        None => Template::default(),
    };
    let mut input = Input::open(cases, arguments.keep.as_deref(), &options, job)?;
    let pool = pool(arguments.threads)?;
    let written = rows(job, &mut input, &template, &options, &pool, output);
    match written {
        // Whoever reads has read enough, as `head` does.
        Err(error) if is_broken_pipe(&error) => Ok(()),
        other => other,
    }
}

fn rows(
    job: Job,
    input: &mut Input,
    template: &Template,
    options: &Options,
    pool: &rayon::ThreadPool,
    output: Option<&Path>,
) -> Result<()> {
    let cannot =
        || output.map_or(CANNOT_WRITE.to_owned(), |path| format!("{CANNOT_WRITE} to {}", named(path)));
    let results = result_schema(job, options);
    let carried = Carried::new(&input.schema, input.kept.clone(), &results).map_err(|error| match error {
        TableError::NameOfResult { .. } => {
            anyhow!("{error}, or name the columns to carry over by --keep, without it")
        }
        other => other.into(),
    })?;
    let mut out = Output::open(output, carried.schema()).with_context(cannot)?;
    let progress = Mutex::new(Progress::new()?);
    let total = input.total;
    let (mut done, mut failed) = (0, 0);
    let at = |rows: usize| {
        let mut progress = progress.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        progress.at("rows", rows, total.unwrap_or(rows))
    };
    while let Some(batch) = input.next()? {
        let results = pool.install(|| run(job, &batch, template, options, &|within, _| at(done + within)));
        let results = match results {
            Ok(results) => results,
            Err(TableError::Ended { .. }) => {
                out.finish().with_context(cannot)?;
                let total = total.unwrap_or(done + batch.num_rows());
                return Err(Incomplete::EndedTable { done, total }.into());
            }
            Err(error) => return Err(error.into()),
        };
        done += results.num_rows();
        failed += results.column_by_name("error").map_or(0, |errors| errors.len() - errors.null_count());
        out.write(&carried.beside(&batch, &results)?).with_context(cannot)?;
    }
    out.finish().with_context(cannot)?;
    if failed > 0 { Err(Incomplete::FailedRows { failed, total: done }.into()) } else { Ok(()) }
}

/// A table that is read batch by batch.
struct Input {
    batches: Box<dyn Iterator<Item = Result<RecordBatch>>>,
    /// The columns that are read.
    schema: SchemaRef,
    /// The places among them of those to carry over.
    kept: Vec<usize>,
    /// How many rows there are, where the file says so.
    total: Option<usize>,
}

impl Input {
    fn open(path: &Path, keep: Option<&[String]>, options: &Options, job: Job) -> Result<Self> {
        let cannot = || format!("cannot read the table {}", named(path));
        if path == Path::new("-") {
            return Self::csv(Box::new(io::stdin()), keep, None)
                .context("cannot read the table from standard input");
        }
        if path.is_dir() {
            bail!("{} is a folder: name the table in it", named(path));
        }
        let mut file = File::open(path).with_context(cannot)?;
        let mut begin = [0; 4];
        let is_parquet = file.read_exact(&mut begin).is_ok() && begin == *b"PAR1";
        file.rewind().with_context(cannot)?;
        if is_parquet {
            Self::parquet(file, keep, options, job).with_context(cannot)
        } else if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("parquet")) {
            bail!("{} is no Parquet file: it does not begin with PAR1", named(path))
        } else {
            // The lines are counted by a first look, which costs little beside the rest.
            let lines =
                csv::ReaderBuilder::new().from_reader(BufReader::new(&file)).into_byte_records().count();
            file.rewind().with_context(cannot)?;
            Self::csv(Box::new(file), keep, Some(lines)).with_context(cannot)
        }
    }

    fn parquet(file: File, keep: Option<&[String]>, options: &Options, job: Job) -> Result<Self> {
        let builder = ParquetRecordBatchReaderBuilder::try_new(file)?;
        let schema = builder.schema().clone();
        let others = columns_kept(&schema)?;
        let kept = kept(&schema, keep, &others)?;
        // Neither a key nor carried over: it is not even read.
        let is_read = |place: &usize| !others.contains(place) || kept.contains(place);
        let read: Vec<usize> = (0..schema.fields().len()).filter(is_read).collect();
        let schema = Arc::new(schema.project(&read)?);
        let mask = ProjectionMask::roots(builder.parquet_schema(), read.iter().copied());
        let total = usize::try_from(builder.metadata().file_metadata().num_rows()).ok();
        // Whatever is read, its place is that among what is read.
        let kept = kept.iter().filter_map(|place| read.iter().position(|one| one == place)).collect();
        let at_once = if job == Job::Estimate || options.samples.is_some() { AT_ONCE / 8 } else { AT_ONCE };
        let reader = builder.with_projection(mask).with_batch_size(at_once).build()?;
        let batches = reader.map(|batch| Ok(batch?));
        Ok(Self { batches: Box::new(batches), schema, kept, total })
    }

    /// Every column is a text: a number in it is read as a column of numbers would be.
    fn csv(source: Box<dyn Read>, keep: Option<&[String]>, total: Option<usize>) -> Result<Self> {
        let mut reader = csv::ReaderBuilder::new().from_reader(BufReader::new(source));
        let header = reader.headers()?.clone();
        let names = header.iter().map(|name| name.trim_start_matches('\u{feff}'));
        let fields: Vec<Field> = names.map(|name| Field::new(name, DataType::Utf8, true)).collect();
        let schema = Arc::new(Schema::new(fields));
        let kept = kept(&schema, keep, &columns_kept(&schema)?)?;
        let (of_batches, mut records) = (schema.clone(), reader.into_records());
        let batches = std::iter::from_fn(move || {
            let mut columns: Vec<Vec<Option<String>>> = vec![Vec::new(); of_batches.fields().len()];
            let mut rows = 0;
            for record in records.by_ref().take(AT_ONCE) {
                let record = match record {
                    Ok(record) => record,
                    Err(error) => return Some(Err(error.into())),
                };
                for (column, cell) in columns.iter_mut().zip(&record) {
                    column.push((!cell.trim().is_empty()).then(|| cell.to_owned()));
                }
                rows += 1;
            }
            let arrays = columns.into_iter().map(|column| Arc::new(StringArray::from(column)) as ArrayRef);
            (rows > 0).then(|| Ok(RecordBatch::try_new(of_batches.clone(), arrays.collect())?))
        });
        Ok(Self { batches: Box::new(batches), schema, kept, total })
    }

    fn next(&mut self) -> Result<Option<RecordBatch>> {
        self.batches.next().transpose()
    }
}

/// The places of the columns to carry over: those that are named, or all that give no key.
fn kept(schema: &Schema, keep: Option<&[String]>, others: &[usize]) -> Result<Vec<usize>> {
    let Some(names) = keep else { return Ok(others.to_vec()) };
    let place = |name: &String| match schema.index_of(name) {
        Ok(place) => Ok(place),
        Err(_) => {
            let known: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
            let near = case::nearest_names(name, known.iter().copied());
            let help = match near.first() {
                Some(near) => format!("did you mean \"{}\"?", case::shown(near)),
                None => format!("its columns are {}", case::shown(&known.join(", "))),
            };
            bail!("--keep {}: the table has no such column; {help}", case::shown(name))
        }
    };
    names.iter().filter(|name| !name.is_empty()).map(place).collect()
}

/// Where the results go.
enum Output {
    Parquet(ArrowWriter<Sink>),
    Csv(csv::Writer<BufWriter<Sink>>),
}

impl Output {
    fn open(path: Option<&Path>, schema: &SchemaRef) -> Result<Self> {
        let sink = Sink::open(path)?;
        let is_parquet =
            path.and_then(Path::extension).is_some_and(|ending| ending.eq_ignore_ascii_case("parquet"));
        if is_parquet {
            let properties = WriterProperties::builder()
                .set_compression(Compression::ZSTD(ZstdLevel::default()))
                .set_max_row_group_row_count(Some(ROW_GROUP))
                .build();
            return Ok(Self::Parquet(ArrowWriter::try_new(sink, schema.clone(), Some(properties))?));
        }
        let mut writer = csv::Writer::from_writer(BufWriter::new(sink));
        writer.write_record(schema.fields().iter().map(|field| field.name()))?;
        Ok(Self::Csv(writer))
    }

    fn write(&mut self, rows: &RecordBatch) -> Result<()> {
        match self {
            Self::Parquet(writer) => Ok(writer.write(rows)?),
            Self::Csv(writer) => {
                let columns = rows.columns().iter().map(Texts::of);
                let columns: Vec<Texts<'_>> = columns.collect::<Result<_>>()?;
                for row in 0..rows.num_rows() {
                    for column in &columns {
                        writer.write_field(column.cell(row)?)?;
                    }
                    writer.write_record(None::<&[u8]>).map_err(of_csv)?;
                }
                Ok(())
            }
        }
    }

    fn finish(self) -> Result<()> {
        match self {
            Self::Parquet(writer) => Ok(writer.into_inner()?.finish()?),
            Self::Csv(writer) => {
                let buffer = writer.into_inner().map_err(|error| error.into_error())?;
                Ok(buffer.into_inner().map_err(io::IntoInnerError::into_error)?.finish()?)
            }
        }
    }
}

/// The cause itself, by which the end of a pipe is told.
fn of_csv(error: csv::Error) -> anyhow::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error.into(),
        other => anyhow::anyhow!("{other:?}"),
    }
}

/// The cells of a column as texts: a number is the shortest that reads back as the same, the words of a list
/// have spaces between them, and null is nothing.
enum Texts<'a> {
    Numbers(&'a arrow_array::PrimitiveArray<Float64Type>),
    Wholes(&'a arrow_array::PrimitiveArray<Int64Type>),
    Lists(&'a arrow_array::ListArray),
    Others(&'a dyn Array, ArrayFormatter<'a>),
}

impl<'a> Texts<'a> {
    fn of(array: &'a ArrayRef) -> Result<Self> {
        Ok(match array.data_type() {
            DataType::Float64 => Self::Numbers(array.as_primitive()),
            DataType::Int64 => Self::Wholes(array.as_primitive()),
            DataType::List(item) if *item.data_type() == DataType::Utf8 => Self::Lists(array.as_list()),
            _ => {
                static OPTIONS: std::sync::LazyLock<FormatOptions<'static>> =
                    std::sync::LazyLock::new(FormatOptions::default);
                Self::Others(array.as_ref(), ArrayFormatter::try_new(array.as_ref(), &OPTIONS)?)
            }
        })
    }

    fn cell(&self, row: usize) -> Result<String> {
        Ok(match self {
            Self::Numbers(array) if array.is_valid(row) => {
                // As the JSON of the other commands has it.
                let text = format!("{:?}", array.value(row));
                text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
            }
            Self::Wholes(array) if array.is_valid(row) => array.value(row).to_string(),
            Self::Lists(array) if array.is_valid(row) => {
                let words = array.value(row);
                words.as_string::<i32>().iter().flatten().collect::<Vec<_>>().join(" ")
            }
            Self::Others(array, formatter) if array.is_valid(row) => formatter.value(row).try_to_string()?,
            _ => String::new(),
        })
    }
}

/// The columns that a table can have, one in a line: name with the SI unit, what it holds, and its meaning.
fn keys() -> String {
    let mut lines = String::new();
    add_keys(key_tree(), "", &mut lines);
    lines
}

fn add_keys(keys: &[KeyInfo], within: &str, lines: &mut String) {
    for key in keys {
        let path = format!("{within}{}", key.name);
        let inner: Option<(String, &[KeyInfo])> = match &key.form {
            KeyForm::Table(keys) | KeyForm::WordOrTable(_, keys) | KeyForm::NumberOrTable(keys) => {
                Some((format!("{path}."), keys))
            }
            KeyForm::Tables(keys) | KeyForm::QuantityOrTables(_, keys) => Some((format!("{path}[1]."), keys)),
            _ => None,
        };
        if !matches!(key.form, KeyForm::Table(_) | KeyForm::Tables(_)) {
            let (unit, what) = held(&key.form);
            let unit = unit.map_or_else(String::new, |unit| format!(" [{unit}]"));
            let title = key.text.split(". ").next().unwrap_or(key.text).trim_end_matches('.');
            lines.push_str(&format!("{path}{unit}\t{what}\t{title}\n"));
        }
        if let Some((within, keys)) = inner {
            add_keys(keys, &within, lines);
        }
    }
}

/// The SI unit of a key, and what it holds.
fn held(form: &KeyForm) -> (Option<&'static str>, String) {
    let unit = match form {
        KeyForm::Quantity(dimension)
        | KeyForm::Exact(dimension)
        | KeyForm::Quantities(dimension)
        | KeyForm::QuantityOrTables(dimension, _) => Some(dimension.si_unit()),
        KeyForm::AngleOrHour => Some("rad"),
        _ => None,
    };
    let what = match form {
        KeyForm::Quantity(_) | KeyForm::Number | KeyForm::QuantityOrTables(..) => {
            "number or range".to_owned()
        }
        KeyForm::NumberOrTable(_) => "number, range or its keys".to_owned(),
        KeyForm::Exact(_) | KeyForm::Probability => "number".to_owned(),
        KeyForm::Quantities(_) | KeyForm::Numbers => "numbers or ranges".to_owned(),
        KeyForm::Count(last) => format!("1 to {last}"),
        KeyForm::Percent => "per cent".to_owned(),
        KeyForm::Word(words) | KeyForm::WordOrAll(words) => words.join(" | "),
        KeyForm::WordOrTable(words, _) => format!("{}, or its keys", words.join(" | ")),
        KeyForm::Wheels(words) => format!("number, range or {}; or four of these", words.join(" | ")),
        KeyForm::AngleOrHour => "number, range or hour".to_owned(),
        KeyForm::Flag => "true | false".to_owned(),
        KeyForm::Names => "keys".to_owned(),
        KeyForm::Text | KeyForm::Deviation | KeyForm::Value | KeyForm::Values => "text".to_owned(),
        KeyForm::Table(_) | KeyForm::Tables(_) => "its keys".to_owned(),
    };
    (unit, what)
}

/// The columns of results, one in a line: name and type.
fn columns(job: Job, options: &Options) -> String {
    let schema = result_schema(job, options);
    let word = |data_type: &DataType| match data_type {
        DataType::Float64 => "number",
        DataType::Int64 => "whole number",
        DataType::Boolean => "true | false",
        DataType::List(_) => "texts",
        _ => "text",
    };
    schema.fields().iter().map(|field| format!("{}\t{}\n", field.name(), word(field.data_type()))).collect()
}
