//! Short texts on terms, symbols, keys of the case file and warnings: glossary.md, looked up.

use std::sync::OnceLock;

/// The source of all texts: `## group`, `### name`, a line `Also: …; …` with other names, and the text.
const GLOSSARY: &str = include_str!("../glossary.md");

/// One entry of the glossary.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topic {
    /// The term that it explains.
    pub name: &'static str,
    /// Its heading.
    pub group: &'static str,
    /// Other names: symbols, keys of the case file, codes of warnings.
    pub aliases: Vec<&'static str>,
    /// The text as Markdown: paragraphs, and equations indented by four spaces.
    pub text: &'static str,
}

impl Topic {
    /// Other topics that the text mentions by name, in the order of the glossary.
    #[must_use]
    pub fn see_also(&self) -> Vec<&'static str> {
        let text = words(self.text);
        let uses = |name: &str| text.contains(&words(name));
        topics().iter().map(|topic| topic.name).filter(|name| *name != self.name && uses(name)).collect()
    }

    fn names(&self) -> impl Iterator<Item = &'static str> + '_ {
        std::iter::once(self.name).chain(self.aliases.iter().copied())
    }
}

/// No topic has that name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no topic is called \"{}\"{}; `deltav explain` lists all topics",
    case::shown(word),
    suggestions(nearest)
)]
pub struct UnknownTopic {
    /// The word that was looked up.
    pub word: String,
    /// Names that may have been meant, the most likely first.
    pub nearest: Vec<&'static str>,
}

fn suggestions(nearest: &[&str]) -> String {
    let quoted: Vec<String> = nearest.iter().map(|name| format!("\"{name}\"")).collect();
    if quoted.is_empty() { String::new() } else { format!("; did you mean {}?", quoted.join(" or ")) }
}

/// All topics, in the order of the glossary.
pub fn topics() -> &'static [Topic] {
    static TOPICS: OnceLock<Vec<Topic>> = OnceLock::new();
    TOPICS.get_or_init(|| parsed(GLOSSARY))
}

fn parsed(glossary: &'static str) -> Vec<Topic> {
    let mut topics = Vec::new();
    for section in glossary.split("\n## ").skip(1) {
        let mut entries = section.split("\n### ");
        let group = entries.next().and_then(|head| head.lines().next()).unwrap_or_default().trim();
        for entry in entries {
            let (name, rest) = entry.split_once('\n').unwrap_or((entry, ""));
            let rest = rest.trim_matches('\n');
            let (aliases, text) = match rest.strip_prefix("Also: ") {
                Some(rest) => rest.split_once('\n').unwrap_or((rest, "")),
                None => ("", rest),
            };
            let aliases = aliases
                .split("; ")
                .map(|alias| alias.trim().trim_matches('`'))
                .filter(|alias| !alias.is_empty());
            topics.push(Topic {
                name: name.trim(),
                group,
                aliases: aliases.collect(),
                text: text.trim_matches('\n'),
            });
        }
    }
    topics
}

/// The topic of a term, a symbol, a key of the case file or the code of a warning. Capitals count only if
/// names differ in nothing else; a symbol may have the number of a vehicle, `E_1`, and a key its whole path,
/// `vehicle1.crush.depths[2]`.
///
/// ```
/// assert_eq!(report::topic("u")?.name, "relative velocity");
/// assert_eq!(report::topic("vehicle2.crush.width")?.name, "damage width");
/// assert_eq!(report::topic("delta-v-differs")?.group, "Warnings");
/// assert_eq!(report::topic("restituton").unwrap_err().nearest[0], "restitution");
/// # Ok::<(), report::UnknownTopic>(())
/// ```
///
/// # Errors
/// [`UnknownTopic`], with the names that may have been meant.
pub fn topic(word: &str) -> Result<&'static Topic, UnknownTopic> {
    let word = word.trim();
    let mut forms = forms(word);
    forms.extend(with_index(word).iter().flat_map(|symbol| self::forms(symbol)));
    let named = |same: &dyn Fn(&str, &str) -> bool| {
        forms.iter().find_map(|form| topics().iter().find(|topic| topic.names().any(|name| same(name, form))))
    };
    let exact = named(&|name, form| name == form);
    exact
        .or_else(|| named(&|name, form| plain(name) == plain(form)))
        .ok_or_else(|| UnknownTopic { word: word.chars().take(60).collect(), nearest: nearest(word) })
}

/// The forms in which the glossary may have the word: whole, without vehicle and place in a list, and the
/// last part of a key.
fn forms(word: &str) -> Vec<String> {
    let mut forms = vec![word.to_owned()];
    let path = word.split('[').next().unwrap_or_default();
    for vehicle in ["vehicle1.", "vehicle2."] {
        forms.extend(path.strip_prefix(vehicle).map(str::to_owned));
    }
    forms.push(path.to_owned());
    forms.extend(path.rsplit_once('.').map(|(_, key)| key.to_owned()));
    // b_0,1 is b_0.
    forms.extend([",1", ",2"].iter().filter_map(|vehicle| word.strip_suffix(vehicle)).map(str::to_owned));
    // E_1 is E, and v_1x is v_x.
    for number in ["_1", "_2"] {
        if let Some((head, tail)) = word.split_once(number) {
            let tail = tail.trim_start_matches(',');
            forms.push(if tail.is_empty() { head.to_owned() } else { format!("{head}_{tail}") });
            forms.push(head.to_owned());
        }
    }
    forms
}

/// C1 is C_1.
fn with_index(word: &str) -> Option<String> {
    match word.chars().collect::<Vec<char>>()[..] {
        [letter, digit] if letter.is_alphabetic() && digit.is_ascii_digit() => {
            Some(format!("{letter}_{digit}"))
        }
        _ => None,
    }
}

fn plain(text: &str) -> String {
    text.to_lowercase().replace(['-', ' '], "_")
}

/// Names that resemble the word, and names that contain it: one of each topic.
fn nearest(word: &str) -> Vec<&'static str> {
    const MOST: usize = 5;
    let names = || topics().iter().flat_map(Topic::names);
    let wanted = plain(word);
    let containing = names().filter(|name| wanted.chars().count() > 2 && plain(name).contains(&wanted));
    let mut topics_named: Vec<&Topic> = Vec::new();
    let mut nearest = Vec::new();
    for name in case::nearest_names(word, names()).into_iter().chain(containing) {
        let Some(topic) = topics().iter().find(|topic| topic.names().any(|own| own == name)) else {
            continue;
        };
        if !topics_named.contains(&topic) && nearest.len() < MOST {
            topics_named.push(topic);
            nearest.push(name);
        }
    }
    nearest
}

/// The words of a text in lower case, with a space before and after each, so that no name is found within
/// another word.
fn words(text: &str) -> String {
    let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '–' | '\'');
    let words = text.split(|c: char| !is_part(c)).filter(|word| !word.is_empty());
    format!(" {} ", words.collect::<Vec<_>>().join(" ").to_lowercase())
}
