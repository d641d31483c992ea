//! `[uncertainty]`: estimates without a spread, and errors that several numbers share.

use std::ops::Range as Span;

use super::tree::{Reader, Table};
use crate::case_problem::CaseProblem;
use crate::nearest::{join, nearest};
use crate::schema::MOST_ZONES;
use inputs::{Case, Dimension, GivenUncertainty, Input, SharedError, Spread, Unit, list_of};

const SIZES: &str = "`sd = \"1 cm\"`, or `within = \"5 %\"` and `confidence = 0.95`";
const ERRORS: &str = "shared = [{ name = \"tape\", of = [\"vehicle1.crush.depths\", \"vehicle1.crush.width\"], sd = \"1 cm\" }]";

/// A key of a list, and its place.
struct Named {
    key: String,
    span: Span<usize>,
}

impl<'t> Reader<'t> {
    /// Reads the table, after the rest of the case.
    pub(super) fn uncertainty(&mut self, table: &Table<'t>, case: &Case) -> Option<GivenUncertainty> {
        let exact = if table.has("exact") { self.exact(table, case) } else { Some(Vec::new()) };
        let shared = if table.has("shared") { self.shared(table, case) } else { Some(Vec::new()) };
        Some(GivenUncertainty { exact: exact?, shared: shared? })
    }

    fn exact(&mut self, table: &Table<'t>, case: &Case) -> Option<Vec<String>> {
        let names = self.names(table, "exact")?;
        let mut known: Vec<String> = case.estimates().into_iter().map(|estimate| estimate.key()).collect();
        // A contact point is estimated in two directions.
        known.dedup();
        let mut is_sound = true;
        for Named { key, span } in &names {
            if known.contains(key) {
                continue;
            }
            let help = if known.is_empty() {
                "this case estimates nothing, and numbers without a range are already exact: remove \
                 this entry"
                    .to_owned()
            } else {
                let quoted: Vec<String> = known.iter().map(|key| format!("\"{key}\"")).collect();
                format!(
                    "in this case, {} can be listed; any other number is exact unless it is a range",
                    join(&quoted, "and")
                )
            };
            self.refuse_at(span, format!("\"{key}\" has no spread that could be switched off"), help);
            is_sound = false;
        }
        is_sound.then(|| names.into_iter().map(|name| name.key).collect())
    }

    fn shared(&mut self, table: &Table<'t>, case: &Case) -> Option<Vec<SharedError>> {
        let tables = self.tables(table, "shared", ERRORS, MOST_ZONES)?;
        let inputs = case.inputs();
        let errors: Vec<Option<SharedError>> =
            tables.iter().map(|table| self.shared_error(table, &inputs)).collect();
        let errors: Vec<SharedError> = errors.into_iter().collect::<Option<_>>()?;
        for (index, error) in errors.iter().enumerate() {
            if errors[..index].iter().any(|other| other.name == error.name) {
                let message = format!("two shared errors have the name \"{}\"", error.name);
                return self.refuse(
                    &tables[index].path_of("name"),
                    message,
                    "give each error a name of its own",
                );
            }
        }
        Some(errors)
    }

    fn shared_error(&mut self, table: &Table<'t>, inputs: &[Input]) -> Option<SharedError> {
        self.require(table, &["name", "of"]);
        let name = self.text(table, "name").and_then(|name| {
            let name = name.as_given();
            if name.chars().all(|letter| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_')) {
                return Some(name.to_owned());
            }
            let message =
                "the name of a shared error has a character that is neither a letter nor a digit".to_owned();
            let help = "write a name of letters, digits, spaces, hyphens and underscores";
            self.refuse(&table.path_of("name"), message, help)
        });
        let of = if table.has("of") { self.names(table, "of") } else { None };
        let of = of?;
        let dimension = self.dimension_shared(table, &of, inputs)?;
        let size = self.size_of_error(table, dimension);
        let size = match table.given(&["sd", "within", "confidence"])[..] {
            ["sd"] | ["within", "confidence"] => size?,
            _ => return self.no_form(table, SIZES),
        };
        if matches!(size, Spread::Normal { .. }) && !self.is_one_dimension(&of, inputs) {
            return None;
        }
        Some(SharedError { name: name?, of: of.into_iter().map(|name| name.key).collect(), size })
    }

    /// The dimension of the first number; none for a plain number.
    fn dimension_shared(
        &mut self,
        table: &Table<'t>,
        of: &[Named],
        inputs: &[Input],
    ) -> Option<Option<Dimension>> {
        if of.is_empty() {
            let help = "list the keys of the numbers that share the error, such as \"vehicle1.crush.depths\"";
            let path = table.path_of("of");
            self.refuse::<()>(&path, format!("\"{path}\" is an empty list"), help);
        }
        let mut is_sound = true;
        for Named { key, span } in of {
            if unit_of(key, inputs).is_some() {
                continue;
            }
            let candidates = inputs.iter().map(|input| list_of(&input.path).unwrap_or(&input.path));
            let help = nearest(key, candidates).map_or_else(
                || "give the key of a number of this file, such as \"vehicle1.crush.depths\"".to_owned(),
                |near| format!("did you mean \"{near}\"?"),
            );
            self.refuse_at(span, format!("this file gives no number \"{key}\""), help);
            is_sound = false;
        }
        let first = of.first().filter(|_| is_sound)?;
        Some(unit_of(&first.key, inputs)?.map(Unit::dimension))
    }

    fn is_one_dimension(&mut self, of: &[Named], inputs: &[Input]) -> bool {
        let dimension = |name: &Named| unit_of(&name.key, inputs).flatten().map(Unit::dimension);
        let Some(first) = of.first() else { return true };
        let Some(other) = of.iter().find(|name| dimension(name) != dimension(first)) else { return true };
        let what = |name: &Named| dimension(name).map_or("a plain number", Dimension::name);
        let message = format!(
            "\"{}\" is {} and \"{}\" is {}, so one error cannot be added to both",
            first.key,
            what(first),
            other.key,
            what(other)
        );
        let help =
            "give the error as a percentage, `within = \"5 %\"` and `confidence = 0.95`, or an error to each";
        self.refuse_at(&other.span, message, help.to_owned());
        false
    }

    /// A list of keys, each once.
    fn names(&mut self, table: &Table<'t>, key: &'static str) -> Option<Vec<Named>> {
        let value = table.get(key)?;
        let (path, example) = (table.path_of(key), table.schema.example(key));
        let wanted = "a list of keys, each in quotes";
        let Some(list) = value.get_ref().as_array() else {
            return self.wrong_type(value, path, wanted, example);
        };
        let mut names: Vec<Named> = Vec::new();
        let mut is_sound = true;
        for (index, element) in list.iter().enumerate() {
            let Some(text) = element.get_ref().as_str() else {
                self.wrong_type::<()>(element, format!("{path}[{}]", index + 1), wanted, example);
                is_sound = false;
                continue;
            };
            if names.iter().any(|name| name.key == text) {
                let message = format!("\"{path}\" lists \"{text}\" twice");
                self.refuse_at(&element.span(), message, "remove one of the two".to_owned());
                is_sound = false;
            }
            names.push(Named { key: text.to_owned(), span: element.span() });
        }
        is_sound.then_some(names)
    }

    fn refuse_at(&mut self, span: &Span<usize>, message: String, help: String) {
        self.report(span.clone(), CaseProblem::Fault { message, help: Some(help) });
    }
}

/// The unit of the number of a key, or of the first of a list; `None` if there is no such number.
fn unit_of(key: &str, inputs: &[Input]) -> Option<Option<&'static Unit>> {
    inputs.iter().find(|input| input.path == key || list_of(&input.path) == Some(key)).map(|input| input.unit)
}
