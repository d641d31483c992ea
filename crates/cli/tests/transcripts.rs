//! The output of the program, word for word: the console blocks of README and guide, and the transcripts next
//! to this file.

#[test]
fn transcripts() {
    // These commands are run where their readers run them.
    std::env::set_current_dir("../..").unwrap();
    trycmd::TestCases::new()
        // The run time of a command is not part of its output.
        .env("DELTAV_PROGRESS", "off")
        .case("README.md")
        .case("docs/guide/*.md")
        .case("crates/cli/tests/transcripts/*.md");
}
