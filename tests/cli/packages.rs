//! Output for packages and fault reports: version, licences, completions, man pages.

use super::{svbrdf, text};

/// The stdout of a run that must succeed and print nothing else.
fn printed(args: &[&str]) -> String {
    let output = svbrdf().args(args).output().unwrap();
    assert!(output.status.success() && output.stderr.is_empty(), "{args:?}: {output:?}");
    text(&output.stdout).to_owned()
}

#[test]
fn the_verbose_version_has_what_a_report_of_a_fault_needs() {
    let short = printed(&["--version"]);
    assert_eq!(short, format!("svbrdf {}\n", env!("CARGO_PKG_VERSION")));
    assert_eq!(short, printed(&["-V"]));
    let long = printed(&["--version", "--verbose"]);
    assert_eq!(long, printed(&["--verbose", "--version"]));
    let facts: Vec<_> =
        long.lines().skip(1).map(|line| line.split_once(": ").expect("name: value")).collect();
    let names: Vec<_> = facts.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["commit", "build", "features", "platform", "processor", "adapter"]);
    let value = |i: usize| facts[i].1;
    assert_eq!(value(2), if cfg!(feature = "viewer") { "viewer" } else { "none" });
    let widest = svbrdf_core::render::simd::Level::best().name();
    assert!(value(4).starts_with(&format!("{widest}, ")) && value(4).ends_with(" threads"), "{long}");
    assert_eq!(cfg!(not(feature = "viewer")), value(5).ends_with("built without the window"), "{long}");
    let is_without = cfg!(not(feature = "viewer")) || !svbrdf_needs::has!(adapter);
    assert!(is_without || value(5).contains("driver "), "{long}");
}

#[test]
fn the_licences_are_those_of_the_crates_and_of_the_fonts() {
    let licences = printed(&["--licenses"]);
    for content in ["clap ", "SIL OPEN FONT LICENSE", "UBUNTU FONT LICENCE", "Apache License"] {
        assert!(licences.contains(content), "{content}");
    }
}

#[test]
fn completions_of_four_shells_name_every_subcommand_and_option() {
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let script = printed(&["completions", shell]);
        // PowerShell has no values.
        let values: &[_] =
            if shell == "powershell" { &[] } else { &["guided-2020", "materialgan", "albedo=srgb"] };
        for name in ["convert", "rank", "target-error", "max-memory"].iter().chain(values) {
            assert!(script.contains(name), "{shell}: {name}");
        }
    }
}

#[test]
fn every_subcommand_has_a_man_page() {
    let folder = tempfile::tempdir().unwrap();
    let pages = folder.path().join("man");
    printed(&["man", pages.to_str().unwrap()]);
    for (path, _) in super::help::pages() {
        let name = [vec!["svbrdf".to_owned()], path].concat().join("-") + ".1";
        let page = std::fs::read_to_string(pages.join(&name)).unwrap();
        assert!(page.contains(".SH NAME") && page.contains("Example"), "{name}");
    }
    assert!(pages.join("svbrdf-completions.1").exists() && pages.join("svbrdf-man.1").exists());
}
