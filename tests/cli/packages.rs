//! Output for packages and fault reports: version, licences, completions, man pages.

use super::{succeed, svbrdf, text};

#[test]
fn the_verbose_version_has_what_a_report_of_a_fault_needs() {
    let at = std::path::Path::new(".");
    let short = succeed(at, "--version");
    assert_eq!(
        (short.as_str(), &short),
        (concat!("svbrdf ", env!("CARGO_PKG_VERSION"), "\n"), &succeed(at, "-V"))
    );
    let long = succeed(at, "--version --verbose");
    assert_eq!(long, succeed(at, "--verbose --version"));
    let (names, values): (Vec<_>, Vec<_>) =
        long.lines().skip(1).filter_map(|line| line.split_once(": ")).unzip();
    assert_eq!(names, ["commit", "build", "features", "platform", "processor", "adapter"]);
    assert_eq!(values[2], if cfg!(feature = "viewer") { "viewer" } else { "none" });
    let widest = svbrdf_core::render::simd::Level::best().name();
    assert!(values[4].starts_with(&format!("{widest}, ")) && values[4].ends_with(" threads"), "{long}");
    assert_eq!(cfg!(not(feature = "viewer")), values[5].ends_with("built without the window"), "{long}");
    let is_without = cfg!(not(feature = "viewer")) || !svbrdf_needs::has!(adapter);
    assert!(is_without || values[5].contains("driver "), "{long}");
}

#[test]
fn what_packages_install_has_every_subcommand_option_and_licence() {
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let script = succeed(std::path::Path::new("."), &format!("completions {shell}"));
        // PowerShell has no values.
        let values: &[_] =
            if shell == "powershell" { &[] } else { &["guided-2020", "materialgan", "albedo=srgb"] };
        for name in ["convert", "rank", "target-error", "max-memory"].iter().chain(values) {
            assert!(script.contains(name), "{shell}: {name}");
        }
    }
    let folder = tempfile::tempdir().unwrap();
    succeed(folder.path(), "man pages");
    for name in ["", "-loss", "-rank", "-convert", "-man"] {
        let page = std::fs::read_to_string(folder.path().join(format!("pages/svbrdf{name}.1"))).unwrap();
        assert!(page.contains(".SH NAME") && page.contains("Example"), "{name}");
    }
    let licences = svbrdf().arg("--licenses").output().unwrap();
    for content in ["clap ", "SIL OPEN FONT LICENSE", "UBUNTU FONT LICENCE", "Apache License"] {
        assert!(text(&licences.stdout).contains(content), "{content}");
    }
}
