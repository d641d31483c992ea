//! `[impact]`: the crush plane, and the impact law with its keys.

use super::range::is_range;
use super::tree::{Reader, Table};
use super::values::named;
use crate::case_problem::{CaseProblem, RESTITUTION_FORMS};
use crate::schema::{KeysOfLaw, laws_of_key};
use inputs::{BrachTangential, GivenImpact, ImpactLaw, LawName, Quantity, Restitution};

impl<'t> Reader<'t> {
    pub(super) fn impact(&mut self, table: &Table<'t>) -> Option<GivenImpact> {
        self.require(table, &["crush_plane"]);
        let crush_plane = self.quantity(table, "crush_plane");
        let law = self.law(table);
        Some(GivenImpact { crush_plane: crush_plane?, law: law? })
    }

    fn law(&mut self, table: &Table<'t>) -> Option<ImpactLaw> {
        // A misspelt `law` is not the default either.
        let is_default = !table.has("law") && !table.means("law");
        let law =
            if is_default { Some(LawName::default()) } else { self.choice(table, "law", &LawName::WORDS) };
        if let Some(law) = law {
            self.keys_of_law(table, law, is_default);
        }
        // If the law is unknown, all keys are read.
        let reads = |key: &str| law.is_none_or(|law| law.uses(key));
        let restitution = if reads("restitution") { self.restitution(table) } else { None };
        let tangential = if reads("tangential") { self.tangential(table) } else { None };
        let mut coefficient = |key| {
            if reads(key) { self.number(table, key) } else { None }
        };
        let moment_restitution = coefficient("moment_restitution");
        let tangential_restitution = coefficient("tangential_restitution");
        let tangential_velocity_change = if reads("tangential_velocity_change") {
            self.quantity(table, "tangential_velocity_change")
        } else {
            None
        };
        let friction = if reads("friction") { self.number(table, "friction") } else { None };
        Some(match law? {
            LawName::Brach => {
                ImpactLaw::Brach { restitution: restitution?, tangential: tangential?, moment_restitution }
            }
            LawName::Woolley => ImpactLaw::Woolley { tangential_velocity_change },
            LawName::Ishikawa => ImpactLaw::Ishikawa {
                restitution: restitution?,
                tangential_restitution: tangential_restitution?,
            },
            LawName::KudlichSlibar => {
                ImpactLaw::KudlichSlibar { restitution: restitution?, friction: friction? }
            }
        })
    }

    /// Checks that the law has the keys that it needs, and no others.
    fn keys_of_law(&mut self, table: &Table<'t>, law: LawName, is_default: bool) {
        for key in table.schema.names().filter(|key| table.has(key) && !law.uses(key)) {
            let problem = CaseProblem::KeyOfOtherLaw {
                table: table.label(),
                key,
                law: law.name(),
                is_default,
                keys: law.keys(),
                owners: laws_of_key(key),
            };
            self.report(table.key_span(key), problem);
        }
        for key in law.needed().iter().filter(|key| !table.has(key) && !table.means(key)) {
            let problem = CaseProblem::MissingKeyOfLaw {
                table: table.label(),
                key,
                law: law.name(),
                is_default,
                keys: law.keys(),
                example: table.schema.example(key),
            };
            self.report_path(&table.path_of(key), problem);
        }
    }

    fn restitution(&mut self, impact: &Table<'t>) -> Option<Restitution> {
        if !impact.is_table_or_list("restitution") || is_range(impact, "restitution") {
            return self.number(impact, "restitution").map(Restitution::Constant);
        }
        let wanted = "a plain number, or a table of speeds and values";
        let table = self.inline_or(impact, "restitution", wanted, RESTITUTION_FORMS)?;
        let speeds = self.quantities(&table, "speeds");
        let values = self.numbers(&table, "values");
        if table.given(&["speeds", "values"]).len() < 2 {
            return self.no_form(&table, RESTITUTION_FORMS);
        }
        self.ascending(&table, speeds.as_deref());
        let (speeds, values) = (speeds?, values?);
        let path = table.path_of("values");
        if !speeds.is_empty() && speeds.len() != values.len() {
            let problem =
                CaseProblem::ValueCount { path: path.clone(), values: values.len(), speeds: speeds.len() };
            self.report_path(&path, problem);
        }
        Some(Restitution::OfClosingSpeed { speeds, values })
    }

    /// Checks that there are closing speeds, and that each is greater than the one before.
    fn ascending(&mut self, table: &Table<'t>, speeds: Option<&[Quantity]>) {
        let path = table.path_of("speeds");
        if let Some([]) = speeds {
            self.report_path(&path.clone(), CaseProblem::NoPoints { path });
            return;
        }
        for (index, pair) in speeds.unwrap_or_default().windows(2).enumerate() {
            if let [before, value] = *pair
                && value.si() <= before.si()
            {
                let path = format!("value {} of {}", index + 2, named(&path));
                let span = self.span_of_element(table, "speeds", index + 1);
                self.report(span, CaseProblem::NotAscending { path, value, before });
                // The speeds after it may be out of order only because of this one.
                return;
            }
        }
    }

    fn tangential(&mut self, impact: &Table<'t>) -> Option<BrachTangential> {
        const FORMS: &str =
            "tangential = \"critical\", { ratio = 0.37 }, { fraction = 0.9 } or { friction = 0.5 }";
        if impact.is_string("tangential") {
            return self.choice_among(impact, "tangential", &BrachTangential::WORDS, FORMS);
        }
        let table = self.inline_or(impact, "tangential", "\"critical\" or a table in braces", FORMS)?;
        match table.given(&["ratio", "fraction", "friction"])[..] {
            ["ratio"] => self.number(&table, "ratio").map(BrachTangential::Ratio),
            ["fraction"] => self.number(&table, "fraction").map(BrachTangential::FractionOfCritical),
            ["friction"] => self.number(&table, "friction").map(BrachTangential::Friction),
            _ => self.no_form(&table, FORMS),
        }
    }
}
