//! The order in which the crates can be published: each after its dependencies.

use anyhow::{Context as _, Result, bail};
use serde_json::Value;

/// The names of the crates of this workspace that are published, from `cargo metadata`.
pub(super) fn of(metadata: &Value) -> Result<Vec<String>> {
    let packages = metadata["packages"].as_array().context("cargo metadata has no packages")?;
    let is_published = |package: &&Value| package["source"].is_null() && package["publish"].is_null();
    let mut waiting: Vec<(&str, Vec<&str>)> = Vec::new();
    for package in packages.iter().filter(is_published) {
        let name = package["name"].as_str().context("a package has no name")?;
        waiting.push((name, needed(package)));
    }
    waiting.sort_unstable();
    let mut order: Vec<String> = Vec::new();
    while !waiting.is_empty() {
        let is_ready = |needs: &[&str]| needs.iter().all(|need| order.iter().any(|done| done == need));
        let Some(next) = waiting.iter().position(|(_, needs)| is_ready(needs)) else {
            let names: Vec<_> = waiting.iter().map(|(name, _)| *name).collect();
            bail!("these crates wait for each other, or for one that is not published: {}", names.join(", "));
        };
        order.push(waiting.remove(next).0.to_owned());
    }
    Ok(order)
}

/// The crates of this workspace that have to be in the registry first. Those without a version are for tests,
/// and the package leaves them out.
fn needed(package: &Value) -> Vec<&str> {
    let dependencies = package["dependencies"].as_array().map(Vec::as_slice).unwrap_or_default();
    let ours = dependencies.iter().filter(|one| !one["path"].is_null() && one["req"] != "*");
    ours.filter_map(|one| one["name"].as_str()).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use serde_json::json;

    use super::*;

    fn package(name: &str, needs: &[(&str, &str)]) -> Value {
        let dependencies: Vec<_> =
            needs.iter().map(|(name, req)| json!({ "name": name, "req": req, "path": "/there" })).collect();
        json!({ "name": name, "source": null, "publish": null, "dependencies": dependencies })
    }

    #[test]
    fn each_crate_comes_after_those_that_it_needs() {
        let metadata = json!({ "packages": [
            package("a", &[("c", "^1")]),
            package("b", &[("helpers", "*")]),
            package("c", &[("b", "^1")]),
            json!({ "name": "xtask", "source": null, "publish": [], "dependencies": [] }),
            json!({ "name": "serde", "source": "registry", "publish": null, "dependencies": [] }),
        ] });
        assert_eq!(of(&metadata).unwrap(), ["b", "c", "a"]);
    }

    #[test]
    fn crates_that_wait_for_each_other_are_named() {
        let metadata = json!({ "packages": [package("a", &[("b", "^1")]), package("b", &[("a", "^1")])] });
        let error = of(&metadata).unwrap_err().to_string();
        assert!(error.ends_with("a, b"), "{error}");
    }
}
