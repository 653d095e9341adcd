//! Manifests: licences in `packaging/THIRD-PARTY`, the reason of each direct dependency, one version everywhere. Workflows: pinned actions,
//! least permissions.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use toml::{Table, Value};

/// A file of the checkout.
fn read(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The manifests of the crates that are published.
const MANIFESTS: [&str; 9] = [
    "Cargo.toml",
    "assets/Cargo.toml",
    "shaders/Cargo.toml",
    "src/core/Cargo.toml",
    "src/evaluate/Cargo.toml",
    "src/files/Cargo.toml",
    "src/gpu/Cargo.toml",
    "src/page/Cargo.toml",
    "src/viewer/Cargo.toml",
];

/// The names of the dependencies of this kind, such as `dependencies`, on all platforms.
fn names(manifest: &str, kind: &str) -> BTreeSet<String> {
    let manifest: Table = manifest.parse().unwrap();
    let of_targets = manifest.get("target").and_then(Value::as_table).into_iter().flat_map(Table::values);
    let all = [&manifest].into_iter().chain(of_targets.filter_map(Value::as_table));
    all.filter_map(|table| table.get(kind)?.as_table()).flat_map(|table| table.keys().cloned()).collect()
}

/// The crates of others, as `NAME VERSION`, that the crates of `roots` are built from, on any platform.
fn built_from(lock: &str, roots: BTreeSet<String>) -> BTreeSet<String> {
    let lock: Table = lock.parse().unwrap();
    let packages: Vec<&Table> =
        lock["package"].as_array().unwrap().iter().filter_map(Value::as_table).collect();
    let mut open: Vec<String> = roots.into_iter().collect();
    let mut of_others = BTreeSet::new();
    // `NAME`, with the version where there are several.
    while let Some(dependency) = open.pop() {
        for package in &packages {
            let [name, version] = ["name", "version"].map(|key| package[key].as_str().unwrap());
            let named = format!("{name} {version}");
            let is_meant = (dependency == name || dependency == named) && package.contains_key("source");
            if is_meant && of_others.insert(named) {
                let dependencies =
                    package.get("dependencies").and_then(Value::as_array).into_iter().flatten();
                open.extend(dependencies.filter_map(|one| one.as_str().map(str::to_owned)));
            }
        }
    }
    of_others
}

/// The crates that `packaging/THIRD-PARTY` lists.
fn listed(third_party: &str) -> BTreeSet<String> {
    let table = third_party.lines().skip_while(|line| !line.is_empty()).skip(1);
    let lines = table.take_while(|line| !line.is_empty());
    lines.filter_map(|line| line.split_once(": ").map(|(name, _)| name.to_owned())).collect()
}

#[test]
fn the_licences_of_all_crates_are_listed() {
    let manifests = MANIFESTS.iter().chain(&["python/Cargo.toml"]);
    let direct = manifests.flat_map(|file| names(&read(file), "dependencies")).collect();
    let needed = built_from(&read("Cargo.lock"), direct);
    let listed = listed(&read("packaging/THIRD-PARTY"));
    let [missing, too_many] =
        [[&needed, &listed], [&listed, &needed]].map(|[a, b]| a.difference(b).collect::<Vec<_>>());
    assert!(
        missing.is_empty() && too_many.is_empty(),
        "run packaging/third_party.py > packaging/THIRD-PARTY: it lacks {missing:?} and has {too_many:?} too many"
    );
}

#[test]
fn every_direct_dependency_has_its_reason() {
    let manifests =
        MANIFESTS.iter().chain(&["tests/window/Cargo.toml", "python/Cargo.toml"]).map(|file| read(file));
    let both = |manifest: String| ["dependencies", "dev-dependencies"].map(|kind| names(&manifest, kind));
    let mut needed: BTreeSet<String> = manifests.flat_map(both).flatten().collect();
    needed.retain(|name| name != "svbrdf" && !name.starts_with("svbrdf-"));
    let page = read("docs/dependencies.md");
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `")?.split_once('`'));
    assert_eq!(needed, rows.map(|(name, _)| name.to_owned()).collect());
}

#[test]
fn all_crates_and_packages_have_one_version() {
    let version = env!("CARGO_PKG_VERSION");
    let root: Table = read("Cargo.toml").parse().unwrap();
    for own in MANIFESTS.iter().filter_map(|file| file.strip_suffix("/Cargo.toml")) {
        let own = format!("svbrdf-{}", own.trim_start_matches("src/"));
        assert_eq!(root["workspace"]["dependencies"][&own]["version"].as_str(), Some(version), "{own}");
    }
    for (file, before) in [
        ("CHANGELOG.md", "\n## "),
        ("packaging/io.github.OWNER.svbrdf.metainfo.xml", "<release version=\""),
        ("docs/CITATION.cff", "\nversion: "),
    ] {
        let text = read(file).replace("\n## Unreleased", "");
        let newest = text.split_once(before).and_then(|(_, rest)| rest.split([' ', '"', '\n']).next());
        assert_eq!(newest, Some(version), "{file}");
    }
}

#[test]
fn the_top_level_has_at_most_20_entries() {
    let mut git = std::process::Command::new("git");
    let listed = git.arg("ls-files").current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
    let listed = String::from_utf8(listed.stdout).unwrap();
    let entries: BTreeSet<_> = listed.lines().filter_map(|path| path.split('/').next()).collect();
    assert!(entries.contains("Cargo.toml") && entries.len() <= 20, "{} entries: {entries:?}", entries.len());
}

/// The actions of a workflow, as `OWNER/NAME@COMMIT # VERSION`.
fn actions(workflow: &str) -> impl Iterator<Item = &str> {
    let lines = workflow.lines().map(|line| line.trim_start().trim_start_matches("- "));
    lines.filter_map(|line| line.strip_prefix("uses:")).map(str::trim)
}

/// Whether an action is of the checkout, or pinned by its whole commit with its version in a comment.
fn is_pinned(action: &str) -> bool {
    let commit_and_version = action.split_once('@').and_then(|(_, pinned)| pinned.split_once(" # v"));
    action.starts_with("./")
        || commit_and_version.is_some_and(|(commit, version)| {
            let is_hash = commit.len() == 40 && commit.bytes().all(|b| b.is_ascii_hexdigit());
            is_hash && version.starts_with(|c: char| c.is_ascii_digit())
        })
}

/// What all jobs of a workflow may do.
fn common_permissions(workflow: &str) -> &str {
    let head = workflow.split("\njobs:").next().unwrap_or_default();
    head.split_once("\npermissions:\n").map_or("", |(_, listed)| listed.trim())
}

#[test]
fn workflows_run_pinned_code_and_no_workflow_gives_write_access_to_all_its_jobs() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(".github/workflows");
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    // dist writes release.yml with the commits of its own file.
    let dist = read("Cargo.toml");
    let mut count = 0;
    for name in names {
        let workflow = read(&format!(".github/workflows/{name}"));
        let permissions = common_permissions(&workflow);
        assert_eq!(permissions.split("\n\n").next(), Some("contents: read"), "{name}");
        // Nor a script of dist, which is one of these.
        for piped in ["| sh", "| bash", "install_dist.run"] {
            assert!(!workflow.contains(piped), "{name}: download a version, and check its checksum: {piped}");
        }
        for action in actions(&workflow) {
            assert!(
                is_pinned(action),
                "{name}: give the commit and the version, as in `OWNER/NAME@COMMIT # v1.2.3`: {action}"
            );
            let (name_of, commit) = action.split_once('@').unwrap_or((action, ""));
            assert!(
                name != "release.yml" || dist.contains(&format!("\"{name_of}\" = \"{commit}\"")),
                "dist: {action}"
            );
            count += 1;
        }
    }
    assert!(count > 30, "{count} actions");
}
