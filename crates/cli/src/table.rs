//! `deltav table`: a row for each row of a table, batch by batch.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Cursor, Read, Seek as _, SeekFrom, Write as _};
use std::panic;
use std::path::Path;
use std::sync::{Arc, Mutex};

use anyhow::{Context as _, Result, anyhow, bail};
use arrow_array::cast::AsArray as _;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{Array, ArrayRef, RecordBatch, StringArray};
use arrow_cast::display::{ArrayFormatter, FormatOptions};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use case::{Form, KeyInfo, key_tree};
use parquet::arrow::ArrowWriter;
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::basic::{Compression, ZstdLevel};
use parquet::errors::ParquetError;
use parquet::file::metadata::ParquetMetaData;
use parquet::file::properties::WriterProperties;
use tables::{
    Carried, Job, RowOptions, RowTemplate, TableError, assumed_units, columns_kept, read_number,
    result_schema, run_with_faults,
};

use crate::arguments::TableArguments;
use crate::batch::is_broken_pipe;
use crate::files::{named, read_text, write};
use crate::long_texts::{LONGEST, shortened};
use crate::present::NoAnswer;
use crate::progress::Progress;
use crate::sink::Sink;
use crate::threads::pool;

/// Rows that are in memory at a time, except for those of a row group of the output.
const AT_ONCE: usize = 8192;

/// Rows of a row group of a Parquet file, which stay in memory until it is written.
const ROW_GROUP: usize = 65_536;

const CANNOT_WRITE: &str = "cannot write the results";

pub(crate) fn table(arguments: &TableArguments) -> Result<()> {
    let &TableArguments { job, samples, seed, particles, prior, .. } = arguments;
    let options = RowOptions { samples, seed, particles, prior };
    let output = arguments.output.file();
    if arguments.schema {
        return write(output, keys());
    }
    if arguments.columns {
        return write(output, columns(job, &options));
    }
    let Some(cases) = &arguments.cases else { bail!("name the table, or - for CSV on standard input") };
    options.check(job)?;
    let template = match &arguments.template {
        Some(path) => {
            let (name, text) = read_text(path)?;
            RowTemplate::parse(&name, &text).map_err(|error| match error {
                TableError::Template(errors) => anyhow::Error::from(*errors),
                other => other.into(),
            })?
        }
        None => RowTemplate::default(),
    };
    let mut input = Input::open(cases, arguments.keep.as_deref(), &options, job)?;
    let pool = pool(arguments.threads)?;
    let written = rows(job, &mut input, &template, &options, &pool, output);
    match written {
        // The reader has read enough, as `head` does.
        Err(error) if is_broken_pipe(&error) => Ok(()),
        other => other,
    }
}

fn rows(
    job: Job,
    input: &mut Input,
    template: &RowTemplate,
    options: &RowOptions,
    pool: &rayon::ThreadPool,
    output: Option<&Path>,
) -> Result<()> {
    let cannot =
        || output.map_or(CANNOT_WRITE.to_owned(), |path| format!("{CANNOT_WRITE} to {}", named(path)));
    let results = result_schema(job, options);
    let carried = Carried::new(&input.schema, input.kept.clone(), &results).map_err(|error| match error {
        TableError::NameOfResult { .. } => {
            anyhow!("{error}, or leave it out of the columns that --keep names")
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
    let (mut said_units, mut left_out) = (false, 0);
    while let Some((batch, faults)) = input.next()? {
        if !said_units {
            say_units(&batch)?;
            said_units = true;
        }
        let results = pool.install(|| {
            run_with_faults(job, &batch, &faults, template, options, &|within, _| at(done + within))
        });
        let (results, ended) = match results {
            Ok(results) => (results, false),
            Err(TableError::Ended { finished, .. }) => (finished, true),
            Err(error) => return Err(error.into()),
        };
        done += results.num_rows();
        failed += results.column_by_name("error").map_or(0, |errors| errors.len() - errors.null_count());
        let (these, shortened) = shortened(&batch.slice(0, results.num_rows()), &input.kept)?;
        left_out += shortened;
        out.write(&carried.beside(&these, &results)?).with_context(cannot)?;
        if ended {
            // A table that was there before is worth more than an empty one.
            if done > 0 {
                out.finish().with_context(cannot)?;
            }
            let total = total.unwrap_or(done - these.num_rows() + batch.num_rows());
            let what = match done {
                0 => format!("none of {total} rows was finished, and nothing is written"),
                done => format!("the first {done} of {total} rows are written"),
            };
            return Err(NoAnswer(format!("ended early: {what}")).into());
        }
    }
    out.finish().with_context(cannot)?;
    if left_out > 0 {
        note(&format!(
            "note: {left_out} texts longer than {LONGEST} bytes are not carried over; a remark replaces them"
        ));
    }
    if failed > 0 {
        return Err(NoAnswer(format!("{failed} of {done} rows have an error: see the column error")).into());
    }
    Ok(())
}

/// Reports which numbers are taken as SI because nothing gives their unit.
fn say_units(batch: &RecordBatch) -> Result<()> {
    let assumed = assumed_units(batch)?;
    let Some((first, _)) = assumed.first() else { return Ok(()) };
    let each: Vec<String> =
        assumed.iter().map(|(column, unit)| format!("{} in {unit}", case::shown(column))).collect();
    note(&format!(
        "note: numbers without a unit are SI: {}; write another unit in the name, as in \"{} [unit]\"",
        each.join(", "),
        case::shown(first)
    ));
    Ok(())
}

/// A line for the user of the program, in addition to the results.
fn note(text: &str) {
    // If nobody can read it, the run goes on.
    let _ = writeln!(io::stderr(), "{text}");
}

/// The next rows, and the fault of each that was found on reading.
type Rows = (RecordBatch, Vec<Option<String>>);

/// A table that is read batch by batch.
struct Input {
    batches: Box<dyn Iterator<Item = Result<Rows>>>,
    /// The columns that are read.
    schema: SchemaRef,
    /// The places among them of those to carry over.
    kept: Vec<usize>,
    /// The number of rows, if the file gives it.
    total: Option<usize>,
}

impl Input {
    fn open(path: &Path, keep: Option<&[String]>, options: &RowOptions, job: Job) -> Result<Self> {
        let cannot = || format!("cannot read the table {}", named(path));
        if path == Path::new("-") {
            return Self::csv("standard input", Box::new(io::stdin()), keep, None)
                .context("cannot read the table from standard input");
        }
        if path.is_dir() {
            bail!("{} is a folder: name the table in it", named(path));
        }
        let name = named(path).to_string();
        let mut file = File::open(path).with_context(cannot)?;
        if !file.metadata().with_context(cannot)?.is_file() {
            return Self::csv(&name, Box::new(file), keep, None).with_context(cannot);
        }
        let mut begin = [0; 4];
        let is_parquet = file.read_exact(&mut begin).is_ok() && begin == *PARQUET;
        file.rewind().with_context(cannot)?;
        if is_parquet {
            Self::parquet(file, keep, options, job).with_context(cannot)
        } else if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("parquet")) {
            bail!("{} is not a Parquet file: it does not begin with PAR1", named(path))
        } else {
            // A first look counts the lines and reports wrong ones, which costs little compared with the
            // rest.
            let lines = look_through(&name, &file, cannot)?;
            file.rewind().with_context(cannot)?;
            Self::csv(&name, Box::new(file), keep, Some(lines)).with_context(cannot)
        }
    }

    fn parquet(file: File, keep: Option<&[String]>, options: &RowOptions, job: Job) -> Result<Self> {
        let builder = undamaged(|| Ok(ParquetRecordBatchReaderBuilder::try_new(file)?))?;
        let schema = builder.schema().clone();
        let others = columns_kept(&schema)?;
        let kept = kept(&schema, keep, &others)?;
        // Neither a key nor carried over: it is not even read.
        let is_read = |place: &usize| !others.contains(place) || kept.contains(place);
        let read: Vec<usize> = (0..schema.fields().len()).filter(is_read).collect();
        let schema = Arc::new(schema.project(&read)?);
        let mask = ProjectionMask::roots(builder.parquet_schema(), read.iter().copied());
        let total = usize::try_from(builder.metadata().file_metadata().num_rows()).ok();
        // Places are counted among the columns that are read.
        let kept = kept.iter().filter_map(|place| read.iter().position(|one| one == place)).collect();
        let is_slow = matches!(job, Job::Estimate | Job::Avoid);
        let at_once = if is_slow || options.samples.is_some() { AT_ONCE / 8 } else { AT_ONCE };
        let at_once = at_once.min(fits_in_memory(builder.metadata())?);
        let mut reader = undamaged(|| Ok(builder.with_projection(mask).with_batch_size(at_once).build()?))?;
        let batches = std::iter::from_fn(move || {
            undamaged(|| Ok(reader.next().transpose()?)).transpose().map(|batch| Ok((batch?, Vec::new())))
        });
        Ok(Self { batches: Box::new(batches), schema, kept, total })
    }

    /// Every column is a text: a number in it is read as a column of numbers would be.
    fn csv(name: &str, source: Box<dyn Read>, keep: Option<&[String]>, total: Option<usize>) -> Result<Self> {
        let Opened { reader, schema, called } = Opened::of(source)?;
        // Spreadsheets separate columns by semicolons where a comma is the decimal mark.
        let has_decimal_commas = called == Some(SEMICOLONS);
        if let Some(called) = called {
            let and = if has_decimal_commas { ", so a comma in a number is a decimal comma" } else { "" };
            note(&format!("note: the columns of {name} are separated by {called}{and}"));
        }
        let others = columns_kept(&schema)?;
        let kept = kept(&schema, keep, &others)?;
        let (of_batches, mut records, name) = (schema.clone(), reader.into_byte_records(), name.to_owned());
        let mut marks = Marks::default();
        let batches = std::iter::from_fn(move || {
            let mut columns: Vec<Vec<Option<String>>> = vec![Vec::new(); of_batches.fields().len()];
            let (mut faults, mut bytes) = (Vec::new(), 0);
            while faults.len() < AT_ONCE && bytes < BYTES_AT_ONCE {
                let record = match records.next() {
                    None => break,
                    Some(Ok(record)) => record,
                    Some(Err(error)) => return Some(Err(of_csv(error))),
                };
                bytes += record.as_slice().len();
                for (place, column) in columns.iter_mut().enumerate() {
                    let cell = record.get(place).and_then(|cell| std::str::from_utf8(cell).ok());
                    let cell = cell.filter(|cell| !cell.trim().is_empty());
                    column.push(cell.map(|cell| match has_decimal_commas && !others.contains(&place) {
                        true => {
                            marks.see(&name, &record, cell);
                            with_points(cell)
                        }
                        false => cell.to_owned(),
                    }));
                }
                faults.push(fault(&name, &record, of_batches.fields()));
            }
            let arrays = columns.into_iter().map(|column| Arc::new(StringArray::from(column)) as ArrayRef);
            (!faults.is_empty())
                .then(|| Ok((RecordBatch::try_new(of_batches.clone(), arrays.collect())?, faults)))
        });
        Ok(Self { batches: Box::new(batches), schema, kept, total })
    }

    fn next(&mut self) -> Result<Option<Rows>> {
        self.batches.next().transpose()
    }
}

/// The first bytes of a Parquet file.
const PARQUET: &[u8; 4] = b"PAR1";

/// (bytes) of texts that are in memory at a time.
const BYTES_AT_ONCE: usize = 1 << 26;

/// The separators of columns, and their names; the first is the usual one.
const SEPARATORS: [(u8, &str); 4] = [(b',', "commas"), (b';', SEMICOLONS), (b'\t', "tabs"), (b'|', "bars")];

const SEMICOLONS: &str = "semicolons";

/// A CSV table whose header is read.
struct Opened<R> {
    reader: csv::Reader<BufReader<io::Chain<Cursor<Vec<u8>>, R>>>,
    /// A text for each column.
    schema: SchemaRef,
    /// The separator of the columns, if that is not the usual one.
    called: Option<&'static str>,
}

impl<R: Read> Opened<R> {
    fn of(mut source: R) -> Result<Self> {
        let first = first_line(&mut source)?;
        if first.starts_with(PARQUET) {
            bail!("a Parquet file cannot come through a pipe: give its name");
        }
        let separator = separator(&first)?;
        let called =
            SEPARATORS.iter().skip(1).find(|(byte, _)| *byte == separator).map(|(_, called)| *called);
        let source = BufReader::new(Cursor::new(first).chain(source));
        let mut reader = csv::ReaderBuilder::new().delimiter(separator).flexible(true).from_reader(source);
        let header = reader.headers().context("its header is not UTF-8 text: save it as CSV in UTF-8")?;
        let names: Vec<&str> = header.iter().map(|name| name.trim_start_matches('\u{feff}')).collect();
        if names.iter().all(|name| name.trim().is_empty()) {
            bail!("it has no header: its first line names the columns");
        }
        if let Some(twice) = names.iter().enumerate().find(|(place, name)| names[..*place].contains(name)) {
            bail!("two columns are called \"{}\": rename one of them", case::shown(twice.1));
        }
        let fields: Vec<Field> = names.iter().map(|name| Field::new(*name, DataType::Utf8, true)).collect();
        Ok(Self { reader, schema: Arc::new(Schema::new(fields)), called })
    }
}

/// The first line, with its end, of a source that cannot be read twice.
fn first_line(source: &mut dyn Read) -> Result<Vec<u8>> {
    const LONGEST: u64 = 1 << 20;
    let mut line = Vec::new();
    let mut byte = [0];
    while line.last() != Some(&b'\n') && source.read(&mut byte)? == 1 {
        line.push(byte[0]);
        if line.len() as u64 >= LONGEST {
            bail!("its first line is longer than {LONGEST} bytes, so it is not a table");
        }
    }
    Ok(line)
}

/// The separator of the columns: the usual character that is most frequent in the header, outside of quotes.
fn separator(header: &[u8]) -> Result<u8> {
    if header.starts_with(&[0xff, 0xfe]) || header.starts_with(&[0xfe, 0xff]) {
        bail!("it is encoded in UTF-16: save it as CSV in UTF-8");
    }
    let mut counts = [0; SEPARATORS.len()];
    let mut is_quoted = false;
    for byte in header {
        is_quoted ^= *byte == b'"';
        if let Some(place) = SEPARATORS.iter().position(|(separator, _)| separator == byte)
            && !is_quoted
        {
            counts[place] += 1;
        }
    }
    // The first of equally frequent ones.
    let most = (0..SEPARATORS.len()).rev().max_by_key(|place| counts[*place]).unwrap_or_default();
    Ok(SEPARATORS[most].0)
}

/// A cell with points in place of decimal commas, if it holds numbers alone.
fn with_points(cell: &str) -> String {
    let pointed = cell.replace(',', ".");
    let is_numbers = pointed.split_whitespace().all(|word| read_number(word).is_some());
    if is_numbers { pointed } else { cell.to_owned() }
}

/// The decimal marks seen in a table whose numbers have decimal commas.
#[derive(Default)]
struct Marks {
    has_comma: bool,
    /// The place and text of the first number whose points may separate thousands.
    grouped: Option<(u64, String)>,
    is_told: bool,
}

impl Marks {
    /// Looks at a cell. Warns once if the table has both decimal commas and what may be thousands: "1.651".
    fn see(&mut self, name: &str, record: &csv::ByteRecord, cell: &str) {
        for word in cell.split_whitespace() {
            if word.contains(',') {
                self.has_comma |= read_number(&word.replace(',', ".")).is_some();
            } else if self.grouped.is_none()
                && let Some((whole, thousands)) = word.split_once('.')
                && whole.trim_start_matches('-').parse::<u16>().is_ok_and(|whole| (1..1000).contains(&whole))
                && thousands.len() == 3
                && thousands.bytes().all(|byte| byte.is_ascii_digit())
            {
                self.grouped = Some((record.position().map_or(0, csv::Position::line), word.to_owned()));
            }
        }
        if let Some((line, word)) = self.grouped.as_ref().filter(|_| self.has_comma && !self.is_told) {
            self.is_told = true;
            note(&format!(
                "warning: {name}:{line}: \"{word}\" is read with a decimal point, although other numbers of the \
                 table have decimal commas; write {} if the point separates thousands",
                word.replace('.', "")
            ));
        }
    }
}

/// The fault of a row, with its place.
fn fault(name: &str, record: &csv::ByteRecord, fields: &arrow_schema::Fields) -> Option<String> {
    let line = record.position().map_or(0, csv::Position::line);
    if record.len() != fields.len() {
        let count =
            |fields: usize| if fields == 1 { "1 field".to_owned() } else { format!("{fields} fields") };
        let called = |column: usize| case::shown(fields[column].name());
        let place = match record.get(fields.len()) {
            Some(beyond) => format!(
                "\"{}\" is beyond the last column, \"{}\"",
                case::shown(&String::from_utf8_lossy(beyond)),
                called(fields.len() - 1)
            ),
            None => format!("it ends before the column \"{}\"", called(record.len())),
        };
        return Some(format!(
            "{name}:{line}: the row has {}, and the header has {}: {place}; put double quotes around a cell \
             that holds the separator",
            count(record.len()),
            fields.len()
        ));
    }
    let (_, field) = record.iter().zip(fields).find(|(cell, _)| std::str::from_utf8(cell).is_err())?;
    Some(format!(
        "{name}:{line}: the column \"{}\" is not UTF-8 text: save the table in that encoding",
        case::shown(field.name())
    ))
}

/// The number of rows of a CSV file. Reports wrong rows before any row is computed.
fn look_through(name: &str, file: &File, cannot: impl Fn() -> String + Copy) -> Result<usize> {
    /// Maximum number of wrong rows that are reported one by one.
    const TOLD: usize = 3;
    let Opened { mut reader, schema, .. } = Opened::of(file).with_context(cannot)?;
    // A table without any readable row is refused as a whole.
    if columns_kept(&schema).is_err() {
        return Ok(0);
    }
    let (mut rows, mut wrong) = (0, 0);
    let mut record = csv::ByteRecord::new();
    // The line of the last row, if its last cell goes over several.
    let mut open = None;
    while reader.read_byte_record(&mut record).map_err(of_csv).with_context(cannot)? {
        rows += 1;
        let last = record.iter().next_back().unwrap_or_default();
        open = record.position().map(csv::Position::line).filter(|_| last.contains(&b'\n'));
        if let Some(fault) = fault(name, &record, schema.fields()) {
            wrong += 1;
            if wrong <= TOLD {
                note(&format!("warning: {fault}; it will have an error"));
            }
        }
    }
    if wrong > TOLD {
        note(&format!("warning: {} more rows are wrong like this", wrong - TOLD));
    }
    // A quote that is not closed makes one cell of all that follows.
    if let Some(line) = open.filter(|_| !ends_in_quote(file).unwrap_or(true)) {
        bail!(
            "{name}:{line}: the last cell of this row opens with a double quote that nothing closes, so it would hold all the \
             rows below: close it, or write a quote within a cell twice and the cell in quotes, as \"6\"\" long\""
        );
    }
    Ok(rows)
}

/// Whether the last byte of a file, line breaks apart, is a double quote.
fn ends_in_quote(mut file: &File) -> io::Result<bool> {
    const END: u64 = 64;
    let size = file.seek(SeekFrom::End(0))?;
    file.seek(SeekFrom::Start(size.saturating_sub(END)))?;
    let mut end = Vec::new();
    file.read_to_end(&mut end)?;
    Ok(end.iter().rev().find(|byte| !matches!(byte, b'\n' | b'\r')) == Some(&b'"'))
}

/// The result of reading a Parquet file; damaged ones make the library panic in places.
fn undamaged<T>(read: impl FnOnce() -> Result<T>) -> Result<T> {
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| ()));
    let read = panic::catch_unwind(panic::AssertUnwindSafe(read));
    panic::set_hook(hook);
    read.unwrap_or_else(|_| Err(anyhow!("the Parquet file is damaged")))
}

/// How many rows of a Parquet file may be in memory: a small file may hold very many values, or very long
/// ones very often.
fn fits_in_memory(metadata: &ParquetMetaData) -> Result<usize> {
    /// No key has a list as long.
    const MOST_VALUES: i64 = 10_000;
    let mut at_once = AT_ONCE;
    for group in metadata.row_groups() {
        for column in group.columns() {
            if column.num_values() > group.num_rows().saturating_mul(MOST_VALUES) {
                bail!(
                    "the column \"{}\" has {} values in {} rows, at most {MOST_VALUES} in one",
                    case::shown(&column.column_path().string()),
                    column.num_values(),
                    group.num_rows()
                );
            }
            // A text that is stored once in the file may be that of every row.
            if column.column_type() == parquet::basic::Type::BYTE_ARRAY {
                let longest = usize::try_from(column.uncompressed_size()).unwrap_or(usize::MAX).max(1);
                at_once = at_once.min((BYTES_AT_ONCE / longest).max(64));
            }
        }
    }
    Ok(at_once)
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
    let mut places = Vec::new();
    for name in names.iter().filter(|name| !name.is_empty()) {
        let place = place(name)?;
        if !places.contains(&place) {
            places.push(place);
        }
    }
    Ok(places)
}

/// The destination of the results.
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
            return ArrowWriter::try_new(sink, schema.clone(), Some(properties))
                .map(Self::Parquet)
                .map_err(of_parquet);
        }
        let mut writer = csv::Writer::from_writer(BufWriter::new(sink));
        let header = schema.fields().iter().map(|field| report::no_formula(field.name()));
        writer.write_record(header).map_err(of_csv)?;
        Ok(Self::Csv(writer))
    }

    fn write(&mut self, rows: &RecordBatch) -> Result<()> {
        match self {
            Self::Parquet(writer) => writer.write(rows).map_err(of_parquet),
            Self::Csv(writer) => {
                let columns = rows.columns().iter().map(Texts::of);
                let columns: Vec<Texts<'_>> = columns.collect::<Result<_>>()?;
                for row in 0..rows.num_rows() {
                    for column in &columns {
                        writer.write_field(column.cell(row)?).map_err(of_csv)?;
                    }
                    writer.write_record(None::<&[u8]>).map_err(of_csv)?;
                }
                Ok(())
            }
        }
    }

    fn finish(self) -> Result<()> {
        match self {
            Self::Parquet(writer) => Ok(writer.into_inner().map_err(of_parquet)?.finish()?),
            Self::Csv(writer) => {
                let buffer = writer.into_inner().map_err(|error| error.into_error())?;
                Ok(buffer.into_inner().map_err(io::IntoInnerError::into_error)?.finish()?)
            }
        }
    }
}

/// The cause itself, which identifies the end of a pipe.
fn of_csv(error: csv::Error) -> anyhow::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error.into(),
        other => anyhow::anyhow!("{other:?}"),
    }
}

/// The same for the other library.
fn of_parquet(error: ParquetError) -> anyhow::Error {
    match error {
        ParquetError::External(cause) => anyhow::Error::from_boxed(cause),
        other => other.into(),
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
                // As in the JSON of the other commands.
                let text = format!("{:?}", array.value(row));
                text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
            }
            Self::Wholes(array) if array.is_valid(row) => array.value(row).to_string(),
            Self::Lists(array) if array.is_valid(row) => {
                let words = array.value(row);
                words.as_string::<i32>().iter().flatten().collect::<Vec<_>>().join(" ")
            }
            Self::Others(array, formatter) if array.is_valid(row) => {
                let text = formatter.value(row).try_to_string()?;
                // A number that begins with a sign is not a formula.
                if text.trim().parse::<f64>().is_ok() { text } else { report::no_formula(&text) }
            }
            _ => String::new(),
        })
    }
}

/// The columns that a table can have, one in a line: name with the SI unit, kind of value, and meaning.
fn keys() -> String {
    let mut lines = String::new();
    add_keys(key_tree().keys, "", &mut lines);
    lines
}

fn add_keys(keys: &[KeyInfo], within: &str, lines: &mut String) {
    for key in keys {
        let path = format!("{within}{}", key.name);
        if !matches!(key.form, Form::Vehicle | Form::Table(_) | Form::Tables(..)) {
            let unit = key.form.dimension().map(|dimension| format!(" [{}]", dimension.si_unit()));
            let (unit, what) = (unit.unwrap_or_default(), held(key.form));
            let title = key.text().split(". ").next().unwrap_or_default().trim_end_matches('.');
            lines.push_str(&format!("{path}{unit}\t{what}\t{title}\n"));
        }
        let is_list = matches!(key.form, Form::Tables(..) | Form::QuantityOrTables(..));
        let element = if is_list { "[1]" } else { "" };
        add_keys(key.form.keys(), &format!("{path}{element}."), lines);
    }
}

/// The kind of value of a key.
fn held(form: Form) -> String {
    let words = || form.words().join(" | ");
    match form {
        Form::Quantity(..) | Form::Sourced(..) | Form::Number(_) | Form::QuantityOrTables(..) => {
            "number or range".to_owned()
        }
        Form::NumberOrTable(..) => "number, range or its keys".to_owned(),
        Form::Exact(..) | Form::Probability => "number".to_owned(),
        Form::Quantities(..) | Form::Numbers(_) => "numbers or ranges".to_owned(),
        Form::Count(first, last) => format!("{first} to {last}"),
        Form::Percent(_) => "per cent".to_owned(),
        Form::Words(_) | Form::Law(_) | Form::WordOrAll(_) => words(),
        Form::WordsOrTable(..) => format!("{}, or its keys", words()),
        Form::Wheels(..) => format!("number, range or {}; or four of these", words()),
        Form::AngleOrHour => "number, range or hour".to_owned(),
        Form::Flag => "true | false".to_owned(),
        Form::Keys(_) => "keys".to_owned(),
        Form::Text | Form::Deviation | Form::Value | Form::Values => "text".to_owned(),
        Form::Vehicle | Form::Table(_) | Form::Tables(..) => "its keys".to_owned(),
    }
}

/// The columns of results, one in a line: name and type.
fn columns(job: Job, options: &RowOptions) -> String {
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
