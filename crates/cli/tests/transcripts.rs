//! What the program prints, word for word: the console blocks of README and guide, and the transcripts beside
//! this file.

#[test]
fn transcripts() {
    // These commands are run where their readers run them.
    std::env::set_current_dir("../..").unwrap();
    trycmd::TestCases::new()
        // How long a command takes is no part of what it prints.
        .env("DELTAV_PROGRESS", "off")
        .case("README.md")
        .case("docs/guide/*.md")
        .case("crates/cli/tests/transcripts/*.md");
}
