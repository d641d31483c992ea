//! The notes of a release, from the changelog.

/// The section of this version, or, before the first release, all of the changelog below its heading.
pub(super) fn of(changes: &str, version: &str) -> String {
    let is_heading = |line: &&str| line.starts_with("## ");
    let is_ours = |line: &&str| {
        let name = line.trim_start_matches("## ").trim_start_matches('[');
        is_heading(line) && name.strip_prefix(version).is_some_and(|rest| !rest.starts_with(['.', '-']))
    };
    let lines: Vec<&str> = changes.lines().collect();
    let begin = lines.iter().position(is_ours);
    let rest = begin.map_or_else(
        || lines.iter().skip_while(|line| line.starts_with("# ")).copied().collect::<Vec<_>>(),
        |begin| lines[begin + 1..].to_vec(),
    );
    let section: Vec<&str> = rest.into_iter().take_while(|line| !is_heading(line)).collect();
    section.join("\n").trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_notes_are_the_section_of_the_version() {
        let changes = "# Changelog\n\nFrom the start.\n\n## [0.2.0.1] x\n\n- no\n\n## [0.2.0] - 2026\n\n\
            - new\n\n## 0.1.0\n- old";
        assert_eq!(of(changes, "0.2.0"), "- new");
        assert_eq!(of(changes, "0.1.0"), "- old");
        assert_eq!(of(changes, "9.0.0"), "From the start.");
    }
}
