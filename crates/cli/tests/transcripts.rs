//! What the program prints, word for word: the README's console blocks and the transcripts beside this file.

#[test]
fn transcripts() {
    // The README's commands are run where its readers run them.
    std::env::set_current_dir("../..").unwrap();
    trycmd::TestCases::new().case("README.md").case("crates/cli/tests/transcripts/*.md");
}
