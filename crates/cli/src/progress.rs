//! The progress of a long run, and its end by Ctrl-C.

use std::io::{IsTerminal as _, Write as _, stderr};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::sink;

/// A shorter run needs no bar.
const LONG: Duration = Duration::from_secs(1);

/// Time between two lines if there is no terminal.
const EVERY: Duration = Duration::from_secs(10);

/// The variable that turns the lines off, for scripts that compare the output of the program.
const OFF: (&str, &str) = ("DELTAV_PROGRESS", "off");

/// Whether Ctrl-C was pressed, and whether the program listens to it.
static ENDED: AtomicBool = AtomicBool::new(false);
static LISTENS: AtomicBool = AtomicBool::new(false);

/// A bar on standard error if that is a terminal, else a line now and then; and whether Ctrl-C was pressed.
pub(crate) struct Progress {
    began: Instant,
    bar: Option<(&'static str, ProgressBar)>,
    /// When the last line was written, if lines are written.
    line: Option<Instant>,
}

impl Progress {
    /// From now on Ctrl-C, or a request to terminate, ends the run instead of the program; a second one ends
    /// the program.
    pub(crate) fn new() -> Result<Self> {
        if !LISTENS.swap(true, Ordering::Relaxed) {
            ctrlc::set_handler(|| {
                if ENDED.swap(true, Ordering::Relaxed) {
                    sink::remove_unfinished();
                    // As shells report a program that a signal ended: 128 and the number of the signal.
                    std::process::exit(130);
                }
            })
            .context("cannot listen to Ctrl-C")?;
        }
        let (name, off) = OFF;
        let has_lines = !stderr().is_terminal() && std::env::var_os(name).is_none_or(|set| set != off);
        let began = Instant::now();
        Ok(Self { began, bar: None, line: has_lines.then_some(began) })
    }

    /// Draws the bar, or writes a line, which names what is counted; breaks after Ctrl-C.
    pub(crate) fn at(&mut self, counted: &'static str, done: usize, total: usize) -> ControlFlow<()> {
        if let Some(line) = &mut self.line {
            if line.elapsed() > EVERY {
                *line = Instant::now();
                let seconds = self.began.elapsed().as_secs();
                // If nobody can read it, the run goes on.
                let _ = writeln!(stderr(), "{done} of {total} {counted} after {seconds} s");
            }
        } else if self.began.elapsed() > LONG {
            self.draw(counted, done as u64, total as u64);
        }
        if ENDED.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn draw(&mut self, counted: &'static str, done: u64, total: u64) {
        if let Some((drawn, bar)) = &self.bar
            && *drawn == counted
        {
            bar.set_position(done);
            return;
        }
        // Progress before the bar appears is not a measure of the speed from then on.
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr())
            .with_elapsed(self.began.elapsed())
            .with_position(done);
        let template =
            format!("{{wide_bar}} {{human_pos}} of {{human_len}} {counted}, {{eta}} left; Ctrl-C ends");
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style);
        }
        if let Some((_, before)) = self.bar.replace((counted, bar)) {
            before.finish_and_clear();
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((_, bar)) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
