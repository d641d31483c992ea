//! The software bill of materials: what the program is built from, in CycloneDX 1.5.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context as _, Result};
use serde_json::{Value, json};

/// The bill of a package: itself, and all packages that it is built from, for any machine, with the checksums
/// of the lock file.
pub(super) fn of(metadata: &Value, lock: &str, program: &str) -> Result<Value> {
    let packages = metadata["packages"].as_array().context("cargo metadata has no packages")?;
    let by_id: BTreeMap<&str, &Value> =
        packages.iter().filter_map(|package| Some((package["id"].as_str()?, package))).collect();
    let start = packages.iter().find(|package| package["name"] == program);
    let start = start.and_then(|package| package["id"].as_str());
    let start = start.with_context(|| format!("cargo metadata has no {program}"))?;
    let needs = needs(metadata)?;
    let (mut seen, mut open) = (BTreeSet::from([start]), vec![start]);
    while let Some(id) = open.pop() {
        let next = needs.get(id).into_iter().flatten();
        open.extend(next.filter(|id| seen.insert(**id)).copied().collect::<Vec<_>>());
    }
    let sums = checksums(lock);
    let part = |id: &str| by_id.get(id).map(|package| component(package, &sums));
    let others: Vec<Value> = seen.iter().filter(|id| **id != start).filter_map(|id| part(id)).collect();
    let reference = |id: &str| by_id.get(id).map(|package| address(package));
    let dependencies: Vec<Value> = seen
        .iter()
        .map(|id| {
            let on: Vec<_> = needs.get(id).into_iter().flatten().filter_map(|id| reference(id)).collect();
            json!({ "ref": reference(id), "dependsOn": on })
        })
        .collect();
    let mut itself = part(start).context("the program is no package")?;
    itself["type"] = json!("application");
    Ok(json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": { "component": itself },
        "components": others,
        "dependencies": dependencies,
    }))
}

/// The packages that each package needs to be built; those only for its tests are left out.
fn needs(metadata: &Value) -> Result<BTreeMap<&str, BTreeSet<&str>>> {
    let nodes = metadata["resolve"]["nodes"].as_array().context("cargo metadata has no dependencies")?;
    let is_built_from = |one: &&Value| {
        let kinds = one["dep_kinds"].as_array().map(Vec::as_slice).unwrap_or_default();
        kinds.iter().any(|kind| kind["kind"] != "dev")
    };
    let mut needs = BTreeMap::new();
    for node in nodes {
        let id = node["id"].as_str().context("a package has no id")?;
        let all = node["deps"].as_array().map(Vec::as_slice).unwrap_or_default();
        needs.insert(id, all.iter().filter(is_built_from).filter_map(|one| one["pkg"].as_str()).collect());
    }
    Ok(needs)
}

fn address(package: &Value) -> String {
    let text = |key: &str| package[key].as_str().unwrap_or_default();
    format!("pkg:cargo/{}@{}", text("name"), text("version").replace('+', "%2B"))
}

fn component(package: &Value, sums: &BTreeMap<(&str, &str), &str>) -> Value {
    let text = |key: &str| package[key].as_str().unwrap_or_default();
    let mut one = json!({
        "type": "library",
        "bom-ref": address(package),
        "name": text("name"),
        "version": text("version"),
        "purl": address(package),
    });
    if let Some(licence) = package["license"].as_str() {
        // Older packages write a slash where SPDX has OR.
        one["licenses"] = json!([{ "expression": licence.replace('/', " OR ") }]);
    }
    if let Some(sum) = sums.get(&(text("name"), text("version"))) {
        one["hashes"] = json!([{ "alg": "SHA-256", "content": sum }]);
    }
    one
}

/// The checksums of a lock file, by name and version.
fn checksums(lock: &str) -> BTreeMap<(&str, &str), &str> {
    let of_block =
        |block| Some(((value(block, "name")?, value(block, "version")?), value(block, "checksum")?));
    lock.split("[[package]]").filter_map(of_block).collect()
}

/// The text of a key in a block of a lock file.
fn value<'a>(block: &'a str, key: &str) -> Option<&'a str> {
    let mut lines = block.lines().filter_map(|line| line.strip_prefix(key));
    lines.find_map(|rest| rest.strip_prefix(" = \"")?.strip_suffix('"'))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn the_bill_has_what_the_program_is_built_from_and_no_more() {
        let package =
            |name: &str| json!({ "id": name, "name": name, "version": "1.0.0+x", "license": "MIT/ISC" });
        let dep = |name: &str, kind: Value| json!({ "pkg": name, "dep_kinds": [{ "kind": kind }] });
        let metadata = json!({
            "packages": [package("deltav-cli"), package("used"), package("below"), package("tested"), package("other")],
            "resolve": { "nodes": [
                { "id": "deltav-cli", "deps": [dep("used", Value::Null), dep("tested", json!("dev"))] },
                { "id": "used", "deps": [dep("below", json!("build"))] },
                { "id": "below", "deps": [] },
                { "id": "tested", "deps": [dep("other", Value::Null)] },
                { "id": "other", "deps": [] },
            ] },
        });
        let lock = "[[package]]\nname = \"used\"\nversion = \"1.0.0+x\"\nchecksum = \"abc\"\n";
        let bill = of(&metadata, lock, "deltav-cli").unwrap();
        let names: Vec<_> = bill["components"].as_array().unwrap().iter().map(|one| &one["name"]).collect();
        assert_eq!(names, ["below", "used"]);
        let used = &bill["components"][1];
        assert_eq!(used["hashes"][0]["content"], "abc");
        assert_eq!(used["licenses"][0]["expression"], "MIT OR ISC");
        assert_eq!(used["purl"], "pkg:cargo/used@1.0.0%2Bx");
        assert_eq!(bill["metadata"]["component"]["name"], "deltav-cli");
    }
}
