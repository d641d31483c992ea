//! A live report: the page of the program with the report embedded as it was handed over.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use case::CaseFile;
use serde::Serialize;

use crate::data::{escaped_where, sha256};
use crate::words::file_name;

/// The place for a report in the page.
const SLOT: &str = "<script type=\"application/json\" id=\"deltav-live\">null</script>";
/// The beginning of the tag that names the engine in the page.
const ENGINE: &str = "<meta name=\"deltav-engine\" content=\"";

/// Why a report cannot be put into a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotLive {
    /// It does not have exactly one place for a report.
    #[error(
        "this is not the page deltav.html: it has no place for a report; take the one that belongs to the program"
    )]
    NoSlot,
    /// It does not name the engine in it.
    #[error(
        "this is not the page deltav.html: it does not say which engine is in it; take the one that belongs to the program"
    )]
    NoEngine,
}

#[derive(Serialize)]
struct Live<'a> {
    /// Name of the case file.
    name: &'a str,
    /// Text of the case file.
    text: &'a str,
    report_base64: String,
    report_sha256: String,
    engine_sha256: &'a str,
}

/// The page `deltav.html` with a report in it, verbatim, and with its case, so that its reader can change a
/// number and see what follows. It names the SHA-256 of the report and of the engine.
///
/// # Errors
/// [`NotLive`] if this is not that page.
pub fn live(page: &str, report: &str, file: &CaseFile) -> Result<String, NotLive> {
    let (before, after) = page.split_once(SLOT).ok_or(NotLive::NoSlot)?;
    if after.contains(SLOT) {
        return Err(NotLive::NoSlot);
    }
    let is_digest = |digest: &&str| digest.len() == 64 && digest.bytes().all(|byte| byte.is_ascii_hexdigit());
    let engine = page.split_once(ENGINE).and_then(|(_, rest)| rest.split('"').next());
    let name = file_name(file.source.name());
    let live = Live {
        name: name.as_given(),
        text: file.source.text(),
        report_base64: STANDARD.encode(report),
        report_sha256: sha256(report.as_bytes()),
        engine_sha256: engine.filter(is_digest).ok_or(NotLive::NoEngine)?,
    };
    // All of it is text, so this cannot fail.
    let json = serde_json::to_string(&live).unwrap_or_else(|_| "null".to_owned());
    let slot = SLOT.replace("null", &inert(&json));
    Ok([before, &slot, after].concat())
}

/// Equivalent JSON in which no text can end the element of the page that contains it.
fn inert(json: &str) -> String {
    escaped_where(json, |letter| matches!(letter, '<' | '>' | '&' | '\u{2028}' | '\u{2029}'))
}

#[cfg(test)]
mod tests {
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    use case::CaseFile;
    use serde_json::Value;

    use super::{NotLive, live};

    const ENGINE: &str = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

    fn page() -> String {
        format!(
            "<!doctype html><meta name=\"deltav-engine\" content=\"{ENGINE}\">\n\
             <script type=\"application/json\" id=\"deltav-live\">null</script>\n<script>run()</script>\n"
        )
    }

    fn file(text: &str) -> CaseFile {
        CaseFile::parse("cases/my case.toml", text).unwrap()
    }

    /// The text of the script as a browser reads it: everything up to the first end of an element.
    fn filled(live: &str) -> Value {
        let (_, rest) = live.split_once("id=\"deltav-live\">").unwrap();
        let (json, after) = rest.split_once("</script").unwrap();
        assert_eq!(after, ">\n<script>run()</script>\n");
        assert!(!json.contains(['<', '>', '&']), "{json}");
        serde_json::from_str(json).unwrap()
    }

    #[test]
    fn the_report_and_the_case_are_in_the_page_letter_for_letter() {
        let text = "title = \"ΔV — μ\"\n[vehicle1]\nmass = \"1 t\"\n";
        let report = "<!DOCTYPE html>\n<p>ΔV\r\n</p>";
        let live = live(&page(), report, &file(text)).unwrap();
        let filled = filled(&live);
        assert_eq!(filled["name"], "my case.toml");
        assert_eq!(filled["text"], text);
        let bytes = STANDARD.decode(filled["report_base64"].as_str().unwrap()).unwrap();
        assert_eq!(bytes, report.as_bytes());
        // By sha256sum of those bytes.
        let digest = "533404d1bbe441585c0116580d1b70aef1075084fc025bbae2ea1c3fc424945e";
        assert_eq!(filled["report_sha256"], digest);
        assert_eq!(filled["engine_sha256"], ENGINE);
    }

    #[test]
    fn no_text_of_a_case_ends_the_script() {
        let title = "</script><script>alert(1)</script><!--<script>&amp;\u{2028}";
        let text = format!("title = \"{title}\"\n[vehicle1]\nmass = \"1 t\"\n");
        let live = live(&page(), "<p></script></p>", &file(&text)).unwrap();
        assert_eq!(filled(&live)["text"], text);
        assert_eq!(live.matches("<script").count(), page().matches("<script").count());
    }

    #[test]
    fn what_is_no_such_page_is_refused() {
        let file = file("[vehicle1]\nmass = \"1 t\"\n");
        assert_eq!(live("<html></html>", "", &file), Err(NotLive::NoSlot));
        assert_eq!(live(&page().repeat(2), "", &file), Err(NotLive::NoSlot));
        assert_eq!(live(&page().replace("deltav-engine", "engine"), "", &file), Err(NotLive::NoEngine));
        assert_eq!(live(&page().replace("ba78", "ba7\"8"), "", &file), Err(NotLive::NoEngine));
        // A report that is already in the page is not overwritten.
        let once = live(&page(), "", &file).unwrap();
        assert_eq!(live(&once, "", &file), Err(NotLive::NoSlot));
    }
}
