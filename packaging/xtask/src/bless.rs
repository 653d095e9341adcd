//! Renews the files that are generated.

use crate::{command, finish};

/// Generated files: a name, the files, and the lines of a shell that write them.
struct Generated {
    name: &'static str,
    files: &'static str,
    script: &'static str,
}

/// What others are made of comes first.
const GENERATED: [Generated; 10] = [
    Generated {
        name: "locks",
        files: "Cargo.lock, tests/fuzz/Cargo.lock",
        script: "for folder in . tests/fuzz; do
            cargo metadata --format-version 1 --manifest-path $folder/Cargo.toml >/dev/null
        done",
    },
    Generated {
        name: "licences",
        files: "packaging/THIRD-PARTY",
        script: "made=$(packaging/third_party.py) && printf '%s\\n' \"$made\" >packaging/THIRD-PARTY",
    },
    Generated { name: "assets", files: "assets/icons/*.png", script: "cargo run --example make_assets" },
    Generated {
        name: "shaders",
        files: "shaders/page.json",
        script: "cargo test --test main write_shaders -- --ignored",
    },
    Generated {
        name: "pages",
        files: "assets/pictures/{report,ranking}.jpg",
        script: "cargo test --test main write_the_pictures_of_pages -- --ignored",
    },
    Generated {
        name: "pictures",
        files: "assets/pictures/{window,why,diagnosis,dataset}.jpg",
        script: "cargo test --package window-tests screenshots -- --ignored",
    },
    Generated {
        name: "transcripts",
        files: "tests/transcripts/*.md, and what documents show of commands",
        script: "SVBRDF_BLESS=1 cargo test --test main commands_of_documents || git diff --stat tests/transcripts README.md docs",
    },
    Generated {
        name: "snapshots",
        files: "tests/window/snapshots/*.txt",
        script: "SVBRDF_BLESS=1 cargo test --package window-tests snapshots",
    },
    Generated {
        name: "extremes",
        files: "docs/extremes.md",
        script: "SVBRDF_EXTREMES=10000000 cargo test --test main write_extremes -- --ignored",
    },
    Generated {
        name: "study",
        files: "docs/study.csv (times of this machine)",
        script: "cargo run --release -- study -o docs/study.csv",
    },
];

/// Renews the files of these names; of all but `study` where there are none.
pub fn run(names: &[String]) -> Result<(), String> {
    let find = |name: &String| GENERATED.iter().find(|one| one.name == *name);
    if let Some(unknown) = names.iter().find(|name| find(name).is_none()) {
        return Err(format!("nothing generated is called {unknown}\n{}", help()));
    }
    let chosen = |one: &&Generated| match names {
        [] => one.name != "study",
        names => names.iter().any(|name| name == one.name),
    };
    for one in GENERATED.iter().filter(chosen) {
        eprintln!("== {}: {}", one.name, one.files);
        finish(command("bash").args(["-euo", "pipefail", "-c", one.script]))?;
    }
    Ok(())
}

pub fn help() -> String {
    let line = |one: &Generated| format!("  {:<15} {}\n", one.name, one.files);
    format!("bless renews, by default all but study:\n{}", GENERATED.iter().map(line).collect::<String>())
}
