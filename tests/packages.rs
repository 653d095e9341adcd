//! Manifests: licences in `packaging/THIRD-PARTY`, the reason of each direct dependency, one version everywhere. Workflows: pinned actions,
//! least permissions.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

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

/// The names in the tables of a manifest whose headers end with `kind`, such as `dependencies`.
fn names(manifest: &str, kind: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let mut is_inside = false;
    for line in manifest.lines() {
        if let Some(header) = line.strip_prefix('[') {
            let header = header.trim_end_matches(']');
            is_inside = header.rsplit('.').next() == Some(kind) && header != "workspace.dependencies";
        } else if is_inside && line.starts_with(|c: char| c.is_ascii_alphabetic()) {
            names.insert(line.split(['.', ' ', '=']).next().unwrap_or_default().to_owned());
        }
    }
    names
}

/// A package of Cargo.lock.
#[derive(Debug, Default)]
struct Locked {
    version: String,
    is_from_elsewhere: bool,
    /// Names, with versions where there are several.
    dependencies: Vec<String>,
}

/// The packages of Cargo.lock, by name.
fn locked(lock: &str) -> BTreeMap<String, Vec<Locked>> {
    let mut packages = BTreeMap::<String, Vec<Locked>>::new();
    for block in lock.split("[[package]]").skip(1) {
        let value = |key: &str| {
            let line = block.lines().find_map(|line| line.strip_prefix(&format!("{key} = \"")));
            line.map(|rest| rest.trim_end_matches('"').to_owned())
        };
        let listed = block.lines().filter_map(|line| line.strip_prefix(" \""));
        packages.entry(value("name").unwrap()).or_default().push(Locked {
            version: value("version").unwrap(),
            is_from_elsewhere: value("source").is_some(),
            dependencies: listed.map(|line| line.trim_end_matches("\",").to_owned()).collect(),
        });
    }
    packages
}

/// The crates of others, as `NAME VERSION`, that the crates of `roots` are built from, on any platform.
fn built_from(lock: &str, roots: BTreeSet<String>) -> BTreeSet<String> {
    let packages = locked(lock);
    let mut open: Vec<String> = roots.into_iter().collect();
    let mut done = BTreeSet::new();
    let mut of_others = BTreeSet::new();
    while let Some(dependency) = open.pop() {
        let mut words = dependency.split(' ');
        let (name, version) = (words.next().unwrap_or_default(), words.next());
        for package in &packages[name] {
            let is_meant = version.is_none_or(|version| version == package.version);
            if is_meant && done.insert(format!("{name} {}", package.version)) && package.is_from_elsewhere {
                of_others.insert(format!("{name} {}", package.version));
                open.extend(package.dependencies.iter().cloned());
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
    let missing: Vec<_> = needed.difference(&listed).collect();
    let too_many: Vec<_> = listed.difference(&needed).collect();
    assert!(
        missing.is_empty() && too_many.is_empty(),
        "run packaging/third_party.py > packaging/THIRD-PARTY: it lacks {missing:?} and has {too_many:?} too many"
    );
}

#[test]
fn every_direct_dependency_has_its_reason() {
    let mut needed = BTreeSet::new();
    for file in MANIFESTS.iter().chain(&["tests/window/Cargo.toml", "python/Cargo.toml"]) {
        let manifest = read(file);
        needed.extend(["dependencies", "dev-dependencies"].iter().flat_map(|kind| names(&manifest, kind)));
    }
    let is_own = |name: &String| name == "svbrdf" || name.starts_with("svbrdf-");
    needed.retain(|name| !is_own(name));
    let page = read("docs/dependencies.md");
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `"));
    let explained: BTreeSet<_> =
        rows.filter_map(|row| row.split_once('`').map(|(name, _)| name.to_owned())).collect();
    assert_eq!(needed, explained);
}

#[test]
fn all_crates_and_packages_have_one_version() {
    let version = env!("CARGO_PKG_VERSION");
    let root = read("Cargo.toml");
    for own in MANIFESTS.iter().filter_map(|file| file.strip_suffix("/Cargo.toml")) {
        let own = format!("svbrdf-{}", own.trim_start_matches("src/"));
        let line = root.lines().find(|line| line.starts_with(&format!("{own} = {{"))).unwrap();
        assert!(line.contains(&format!("version = \"{version}\"")), "{line}");
    }
    let newest = |text: &str, before: &str| {
        let after = text.split_once(before).unwrap_or_else(|| panic!("no {before:?}")).1;
        after.split([' ', '"', '\n']).next().unwrap_or_default().to_owned()
    };
    let changes = read("CHANGELOG.md").replace("\n## Unreleased", "");
    assert_eq!(newest(&changes, "\n## "), version);
    assert_eq!(
        newest(&read("packaging/io.github.OWNER.svbrdf.metainfo.xml"), "<release version=\""),
        version
    );
    assert_eq!(newest(&read("docs/CITATION.cff"), "\nversion: "), version);
}

/// The programs that a build script starts.
fn started(script: &str) -> Vec<&str> {
    let starts = script.split("Command::new(").skip(1);
    starts.map(|rest| rest.split(')').next().unwrap_or_default()).collect()
}

#[test]
fn the_build_of_users_starts_git_alone() {
    assert_eq!(started(&read("packaging/build.rs")), ["\"git\""]);
    assert_eq!(started("Command::new(program).args([option, script])"), ["program"]);
}

#[test]
fn the_top_level_has_at_most_20_entries() {
    let mut git = std::process::Command::new("git");
    let listed = git.arg("ls-files").current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
    let listed = String::from_utf8(listed.stdout).unwrap();
    let entries: BTreeSet<_> = listed.lines().filter_map(|path| path.split('/').next()).collect();
    assert!(entries.contains("Cargo.toml") && entries.len() <= 20, "{} entries: {entries:?}", entries.len());
}

/// The workflows: file name and text.
fn workflows() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(".github/workflows");
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let names = entries.map(|name| name.into_string().unwrap());
    names.map(|name| (name.clone(), read(&format!(".github/workflows/{name}")))).collect()
}

/// The actions of a workflow, as `OWNER/NAME@COMMIT # VERSION`.
fn actions(workflow: &str) -> Vec<&str> {
    let lines = workflow.lines().map(|line| line.trim_start().trim_start_matches("- "));
    lines.filter_map(|line| line.strip_prefix("uses:")).map(str::trim).collect()
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

/// What all jobs of a workflow may do, one permission a line.
fn common_permissions(workflow: &str) -> Option<Vec<&str>> {
    let head = workflow.split_once("\njobs:")?.0;
    let listed = head.split_once("\npermissions:\n")?.1;
    Some(listed.lines().take_while(|line| line.starts_with("  ")).map(str::trim).collect())
}

#[test]
fn every_action_is_pinned_by_its_commit() {
    let workflows = workflows();
    let all: Vec<_> =
        workflows.iter().flat_map(|(name, text)| actions(text).into_iter().map(move |a| (name, a))).collect();
    assert!(all.len() > 30, "{all:?}");
    let loose: Vec<_> = all.iter().filter(|(_, action)| !is_pinned(action)).collect();
    assert!(
        loose.is_empty(),
        "give the commit and the version, as in `OWNER/NAME@COMMIT # v1.2.3`: {loose:?}"
    );
    assert!(is_pinned("./.github/actions/a"));
    let commit = "0123456789abcdef0123456789abcdef01234567";
    assert!(is_pinned(&format!("a/b@{commit} # v1.2.3")));
    for loose in
        ["a/b@v6 # v6", "a/b@release/v1", &format!("a/b@{commit}"), &format!("a/b@{} # v1", &commit[1..])]
    {
        assert!(!is_pinned(loose), "{loose}");
    }
    // dist writes release.yml with the commits of its own file.
    let dist = read("Cargo.toml");
    for (_, action) in all.iter().filter(|(name, _)| *name == "release.yml") {
        let (name, commit) = action.split_once('@').unwrap();
        assert!(dist.contains(&format!("\"{name}\" = \"{commit}\"")), "workspace.metadata.dist: {action}");
    }
}

#[test]
fn no_workflow_gives_write_access_to_all_its_jobs() {
    for (name, text) in workflows() {
        assert_eq!(common_permissions(&text), Some(vec!["contents: read"]), "{name}");
    }
    assert_eq!(common_permissions("name: a\n\njobs:\n  permissions:\n"), None);
}

#[test]
fn planted_dependencies_are_found() {
    let manifest = "[dependencies]\na.workspace = true\nb = { version = \"1\" }\n\n[target.'cfg(unix)'.dependencies]\nc = \"1\"\n\
                    [dev-dependencies]\nd = \"1\"\n[workspace.dependencies]\ne = \"1\"\n";
    let of = |kind| names(manifest, kind).into_iter().collect::<Vec<_>>();
    assert_eq!([of("dependencies"), of("dev-dependencies")], [vec!["a", "b", "c"], vec!["d"]]);
    let lock = "[[package]]\nname = \"a\"\nversion = \"1.0.0\"\nsource = \"x\"\ndependencies = [\n \"b 2.0.0\",\n]\n\n\
                [[package]]\nname = \"b\"\nversion = \"1.0.0\"\nsource = \"x\"\n\n\
                [[package]]\nname = \"b\"\nversion = \"2.0.0\"\nsource = \"x\"\n";
    let found = built_from(lock, BTreeSet::from(["a".to_owned()]));
    assert_eq!(found.into_iter().collect::<Vec<_>>(), ["a 1.0.0", "b 2.0.0"]);
    assert_eq!(listed("head\n\na 1.0.0: MIT\n\nb 2.0.0: MIT\n"), BTreeSet::from(["a 1.0.0".to_owned()]));
}
