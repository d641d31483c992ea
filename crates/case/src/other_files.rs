//! Recognises files that cannot be a case file: other formats, other encodings, too many bytes.

use crate::case_problem::CaseProblem;

/// The first bytes of some kinds of file.
const MAGIC: [(&[u8], &str); 8] = [
    (b"%PDF-", "a PDF file"),
    (b"PK\x03\x04", "a ZIP archive, such as a Word or Excel file"),
    (b"\xD0\xCF\x11\xE0", "a Word or Excel file"),
    (b"{\\rtf", "a rich text (RTF) file"),
    (b"\x89PNG", "a PNG image"),
    (b"\xFF\xD8\xFF", "a JPEG image"),
    (b"GIF8", "a GIF image"),
    (b"\x1F\x8B", "a compressed file"),
];

const SAVE_AS_UTF_8: &str = "save it as UTF-8; most editors offer the encoding when saving under a new name";

/// The text of a case of at most `limit` bytes; one that is longer may have been cut off.
pub(crate) fn text(bytes: &[u8], limit: usize) -> Result<&str, CaseProblem> {
    if is_utf_16(bytes) {
        return Err(CaseProblem::Utf16 { help: SAVE_AS_UTF_8 });
    }
    let other = |kind| Err(CaseProblem::OtherFile { kind });
    if let Some((_, kind)) = MAGIC.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return other(kind);
    }
    if bytes.len() > limit {
        return Err(CaseProblem::TooLarge { limit });
    }
    if bytes.contains(&0) {
        return other("a binary file");
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let (before, _) = bytes.split_at(error.valid_up_to());
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        CaseProblem::NotUtf8 { line, help: SAVE_AS_UTF_8 }
    })?;
    if text.trim_start_matches('\u{feff}').trim().is_empty() {
        return Err(CaseProblem::Empty);
    }
    markup(text).map_or(Ok(text), other)
}

/// Recognised by its byte order mark or, without one, by the zero that every Latin letter has in one of its
/// two bytes.
fn is_utf_16(bytes: &[u8]) -> bool {
    const LOOKED_AT: usize = 200;
    if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") {
        return true;
    }
    let pairs = bytes[..bytes.len().min(LOOKED_AT)].chunks_exact(2);
    let count = pairs.len();
    let [first, second] = pairs.fold([0, 0], |[first, second], pair| {
        [first + usize::from(pair[0] == 0), second + usize::from(pair[1] == 0)]
    });
    // Most letters of a case are Latin, and no pair is two zeros.
    count > 0 && (first == 0 || second == 0) && 2 * (first + second) > count
}

fn markup(text: &str) -> Option<&'static str> {
    const LOOKED_AT: usize = 1000;
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if text.starts_with('<') {
        let begin: String = text.chars().take(LOOKED_AT).collect::<String>().to_lowercase();
        if begin.contains("<html") || begin.starts_with("<!doctype html") {
            Some("an HTML page")
        } else if begin.contains("<svg") {
            Some("an SVG drawing")
        } else {
            Some("an XML file")
        }
    } else {
        // Neither can begin a file in TOML, where a bracket is followed by the name of a table.
        let is_list = text.strip_prefix('[').is_some_and(|rest| rest.trim_start().starts_with('{'));
        (text.starts_with('{') || is_list).then_some("a JSON file")
    }
}

#[cfg(test)]
mod tests {
    use super::text;
    use crate::case_problem::CaseProblem;

    const CASE: &str = "# Straße\n[vehicle1]\nmass = \"1 t\"\n";

    fn utf_16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(bytes).collect()
    }

    #[test]
    fn another_kind_of_file_is_named() {
        let marked = format!("\u{feff}{CASE}");
        for (bytes, kind) in [
            (b"%PDF-1.7\n\0".to_vec(), "a PDF file"),
            (b"PK\x03\x04\x14\0".to_vec(), "a ZIP archive, such as a Word or Excel file"),
            (b"\x89PNG\r\n".to_vec(), "a PNG image"),
            (b"[vehicle1]\0".to_vec(), "a binary file"),
            (b"\x7FELF\x02\0\0".to_vec(), "a binary file"),
            (b"\n <!DOCTYPE html><p>".to_vec(), "an HTML page"),
            (b"<?xml version=\"1.0\"?><svg>".to_vec(), "an SVG drawing"),
            (b"\xEF\xBB\xBF<report/>".to_vec(), "an XML file"),
            (b"{ \"title\": 1 }".to_vec(), "a JSON file"),
            (b"[\n  { \"title\": 1 }]".to_vec(), "a JSON file"),
        ] {
            let problem = text(&bytes, 1000).unwrap_err();
            assert_eq!(problem.to_string(), format!("this is {kind}, not a case file"));
        }
        for bytes in [
            utf_16(CASE, u16::to_le_bytes),
            utf_16(CASE, u16::to_be_bytes),
            utf_16(&marked, u16::to_le_bytes),
            utf_16(&marked, u16::to_be_bytes),
        ] {
            let problem = text(&bytes, 1000).unwrap_err();
            assert_eq!(problem.to_string(), "this is text in UTF-16, but a case file must be UTF-8");
        }
    }

    #[test]
    fn text_in_another_encoding_is_told_by_its_line() {
        // Latin-1
        assert!(matches!(text(b"# a\n# Stra\xDFe\n", 1000), Err(CaseProblem::NotUtf8 { line: 2, .. })));
    }

    #[test]
    fn a_case_is_text() {
        let marked = format!("\u{feff}{CASE}");
        for case in [CASE, &marked, "[vehicle1]", "[[vehicle1]]", "[ vehicle1 ]", "[\"vehicle1\"]", "a", "ab"]
        {
            assert_eq!(text(case.as_bytes(), 1000), Ok(case));
        }
    }
}
