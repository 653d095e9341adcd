//! Options that no other test sees used: each changes the result. `src/cli/every_option.rs` tries every option in every mode.

use std::fs;
use std::path::Path;

use super::{folder, run_in, text};

/// Commands, and an option of each that changes what it prints or writes.
const USED: [(&str, &str); 5] = [
    ("loss gt.png a.png --near 4", "--texels 3"),
    ("blame gt.png a.png --target-error 30%", "--seed 5"),
    ("scenes gt.png a.png", "--sampler random"),
    ("worst gt.png a.png", "--distance-tail 0.001%"),
    ("convert gt.png x.exr", "--depth float"),
];

/// What a run prints, and the file that it writes.
fn outcome(folder: &Path, args: &str) -> (String, Option<Vec<u8>>) {
    let output = run_in(folder, args);
    assert!(output.status.success(), "{args}: {}", text(&output.stderr));
    let written = ["x.png", "x.html", "x.csv", "x.exr"].map(|name| folder.join(name));
    let file = written.iter().find(|path| path.exists()).map(|path| {
        let bytes = fs::read(path).unwrap();
        fs::remove_file(path).unwrap();
        bytes
    });
    (text(&output.stdout).to_owned(), file)
}

#[test]
fn options_that_are_used_change_the_result() {
    let folder = folder();
    for (command, option) in USED {
        let [without, with] =
            [command.to_owned(), format!("{command} {option}")].map(|args| outcome(folder.path(), &args));
        assert!(without != with, "{command} ignores {option}");
    }
}
