//! Files that are given to the window as arguments, and refused or accepted before it opens.

use super::*;
use crate::support::surroundings::command;

/// Runs the program on a folder without a display: its exit code, and what it printed as errors.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut command = command(env!("CARGO_BIN_EXE_svbrdf"));
    let output = command.args(arguments).current_dir(folder).output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_scene_file_is_no_material_and_a_broken_one_is_refused_as_by_loss() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("broken.json", r#"{"scenes": [{"kind": "near", "view": [0, 0, 2], "light": [1, 0, -2]}]}"#);
    write("good.json", r#"{"scenes": [{"kind": "near", "view": [0, 0, 2], "light": [1, 0, 2]}]}"#);

    let refused = run(folder.path(), &["loss", "--scenes", "broken.json"]);
    assert_eq!(refused.0, Some(1));
    assert!(refused.1.contains("not a usable scene file: scene 0: "), "{}", refused.1);
    for arguments in [&["broken.json"][..], &["gt.png", "a.png", "broken.json"], &["view", "broken.json"]] {
        assert_eq!(run(folder.path(), arguments), refused, "{arguments:?}");
    }
    let (code, errors) = run(folder.path(), &["good.json", "broken.json"]);
    assert_eq!(code, Some(64));
    assert!(errors.contains("expected one scene file, found good.json and broken.json"), "{errors}");
    // A good one is missing nothing but a display.
    for arguments in [&["good.json"][..], &["gt.png", "good.json", "a.png"]] {
        let (code, errors) = run(folder.path(), arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {errors}");
        assert!(errors.contains("there is no display"), "{errors}");
    }
    // A session is read as a session.
    write("a.svbrdf-session.json", "{}");
    let (code, errors) = run(folder.path(), &["a.svbrdf-session.json", "good.json"]);
    assert_eq!(code, Some(1));
    assert!(errors.contains("no key `svbrdf-session`"), "{errors}");
}
