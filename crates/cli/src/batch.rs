//! Many cases at once: a row each, in the order of the arguments.

use std::collections::VecDeque;
use std::io::{self, ErrorKind, IsTerminal as _, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::mpsc;

use anyhow::{Context as _, Result};
use case::CaseFile;
use rayon::ThreadPool;
use report::{Csv, PROGRAM, Refused, Row, RowError};
use requests::{Request, RowRefusal, read_records_beside};

use crate::files::{named, read};
use crate::present::NoAnswer;
use crate::progress::Progress;
use crate::sink::Sink;

/// Cases per thread that are begun ahead of the next row to be written: enough that no thread waits for a
/// slow one, and few enough to keep in memory.
const AHEAD: usize = 16;

const CANNOT_WRITE: &str = "cannot write the rows";

/// The form of a row.
#[derive(Clone, Copy)]
pub(crate) enum Rows {
    Csv(Csv),
    Jsonl,
}

impl Rows {
    fn header(self) -> Result<String, RowError> {
        match self {
            Self::Csv(csv) => csv.header(),
            Self::Jsonl => Ok(String::new()),
        }
    }

    fn row(self, row: Row<'_>) -> Result<String, RowError> {
        match self {
            Self::Csv(csv) => csv.row(row),
            Self::Jsonl => report::jsonl_row(row),
        }
    }
}

/// A row, and whether it is an error's.
type Written = (Result<String, RowError>, bool);

/// Writes a row, or several, for each case.
pub(crate) fn write(
    cases: &[PathBuf],
    (request, format): (&Request, Rows),
    pool: &ThreadPool,
    output: Option<&Path>,
) -> Result<()> {
    let cannot = || {
        output.map_or(CANNOT_WRITE.to_owned(), |path| format!("cannot write the output to {}", named(path)))
    };
    let mut sink = Sink::open(output).with_context(cannot)?;
    // Rows that appear on the terminal show themselves how far it is, and a bar would run into them.
    let mut progress = match output.is_none() && io::stdout().is_terminal() {
        true => None,
        false => Some(Progress::new()?),
    };
    let written = rows(cases, (request, format), pool, &mut sink, &mut |done| {
        progress.as_mut().is_some_and(|progress| progress.at("case files", done, cases.len()).is_break())
    });
    match written {
        // The reader has read enough, as `head` does.
        Err(error) if is_broken_pipe(&error) => Ok(()),
        // The rows that there are.
        Err(error) if error.is::<NoAnswer>() => sink.finish().with_context(cannot).and(Err(error)),
        Err(error) => Err(error),
        Ok(()) => sink.finish().with_context(cannot),
    }
}

pub(crate) fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == ErrorKind::BrokenPipe)
}

/// Writes each row as soon as all before it are written. `ends` receives the number of rows written, and
/// returns whether that is enough.
fn rows(
    cases: &[PathBuf],
    (request, format): (&Request, Rows),
    pool: &ThreadPool,
    sink: &mut dyn Write,
    ends: &mut dyn FnMut(usize) -> bool,
) -> Result<()> {
    let total = cases.len();
    let ahead = AHEAD * pool.current_num_threads();
    sink.write_all(format.header()?.as_bytes()).context(CANNOT_WRITE)?;
    pool.in_place_scope(|scope| {
        let mut left = cases.iter();
        let mut begun = VecDeque::new();
        let (mut done, mut failed) = (0, 0);
        loop {
            while begun.len() < ahead
                && let Some(path) = left.next()
            {
                let (send, receive) = mpsc::sync_channel::<Written>(1);
                scope.spawn(move |_| {
                    // Sending fails if the writing has ended.
                    let _ = send.send(row(path, request, format));
                });
                begun.push_back(receive);
            }
            let Some(next) = begun.pop_front() else { break };
            let (row, is_error) = next.recv().context("a thread ended before its work was done")?;
            let row = row?;
            sink.write_all(row.as_bytes()).and_then(|()| sink.flush()).context(CANNOT_WRITE)?;
            done += 1;
            failed += usize::from(is_error);
            if ends(done) && done < total {
                let ended =
                    format!("ended early: rows of the first {done} of {total} case files are written");
                return Err(NoAnswer(ended).into());
            }
        }
        if failed > 0 {
            return Err(
                NoAnswer(format!("{failed} of {total} cases failed; see the error in their rows")).into()
            );
        }
        Ok(())
    })
}

fn row(path: &Path, request: &Request, format: Rows) -> Written {
    let name = path.display().to_string();
    let read = read(path);
    let bytes = read.as_ref().ok().map(|(_, bytes)| bytes.as_slice());
    let unread = |error: &anyhow::Error| RowRefusal::sentence(&format!("{error:#}"));
    let answer = read.as_ref().map_err(unread).and_then(|(name, bytes)| {
        let of_case = |errors| RowRefusal::of_case(errors, &PROGRAM);
        let mut file = CaseFile::parse_bytes(name, bytes).map_err(of_case)?;
        read_records_beside(path, &mut file, &PROGRAM).map_err(of_case)?;
        let answer = request.answer(&file.case, &mut |_, _, _| ControlFlow::Continue(()));
        let answer = answer.map_err(|refused| RowRefusal::of(&refused, &file, &PROGRAM))?;
        Ok((file, answer))
    });
    let refused = |error, help| Refused { error, help, bytes };
    let row = match &answer {
        Ok((file, answer)) => answer.row().map(|row| (file, row)).ok_or(refused("there is no row", "")),
        Err(RowRefusal { error, help }) => Err(refused(error, help)),
    };
    (format.row(Row { file: &name, answer: row }), answer.is_err())
}
