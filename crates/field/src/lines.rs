//! The lines of a file on which the records of a table begin.

/// Lines of a text. The parser counts no line for the second half of CR LF, and none for empty lines.
pub(crate) struct Lines<'a> {
    text: &'a str,
    at: usize,
    line: u64,
}

impl<'a> Lines<'a> {
    pub(crate) fn of(text: &'a str) -> Self {
        Self { text, at: 0, line: 1 }
    }

    /// The line on which a record begins; records come in their order.
    pub(crate) fn place(&mut self, record: &csv::StringRecord) -> u64 {
        let start = record.position().and_then(|position| position.byte().try_into().ok()).unwrap_or(0);
        let bytes = self.text.as_bytes();
        let blank = bytes.iter().skip(start).take_while(|byte| matches!(byte, b'\r' | b'\n')).count();
        let begins = start + blank;
        let between = bytes.get(self.at..begins).unwrap_or_default();
        self.line += between.iter().filter(|byte| **byte == b'\n').count() as u64;
        self.at = begins;
        self.line
    }
}
