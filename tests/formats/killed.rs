//! The real program, killed at moments over a whole run while it writes over a file.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::*;
use crate::support::surroundings::command;

/// Width and height of the material: compressing it takes far longer than reading it.
const LARGE: usize = 640;
/// Kills of a round, evenly over a little more than a whole run.
const KILLS: usize = 12;

fn convert(folder: &Path, from: &str) -> Command {
    let mut command = command(env!("CARGO_BIN_EXE_svbrdf"));
    command.args(["convert", from, "out.exr", "--depth", "float"]).current_dir(folder);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

#[test]
fn a_kill_at_any_moment_leaves_the_whole_old_file_or_the_whole_new_one() {
    let folder = tempdir().unwrap();
    let large = |brightness: f64| {
        picture(4 * LARGE, LARGE, |x, y| {
            let (map, x, y) = (x / LARGE, x % LARGE % SIDE, y % SIDE);
            stored(map, x, y, |v| brightness * v)
        })
    };
    let out = folder.path().join("out.exr");
    let [old, new] = [("old.png", 0.5), ("new.png", 1.0)].map(|(name, brightness)| {
        save(folder.path(), name, &large(brightness), ImageFormat::Png);
        assert!(convert(folder.path(), name).status().unwrap().success());
        std::fs::read(&out).unwrap()
    });
    assert!(old != new);
    // Whether it is the new file; `None` for neither.
    let which = |found: &[u8]| if found == old { Some(false) } else { (found == new).then_some(true) };
    assert_eq!(
        [&old[..], &new, &new[..new.len() / 2], &[]].map(which),
        [Some(false), Some(true), None, None]
    );
    let started = Instant::now();
    assert!(convert(folder.path(), "new.png").status().unwrap().success());
    let whole = started.elapsed();

    let (mut kept, mut replaced, mut unfinished) = (0, 0, 0);
    // More rounds only where a busy machine has not shown all three outcomes yet.
    for kill in 0..10 * KILLS {
        if kill >= KILLS && kept > 0 && replaced > 0 && unfinished > 0 {
            break;
        }
        std::fs::write(&out, &old).unwrap();
        let mut child = convert(folder.path(), "new.png").spawn().unwrap();
        let share = (kill % KILLS) as f64 / (KILLS - 1) as f64;
        std::thread::sleep(Duration::from_secs_f64(1.3 * share * whole.as_secs_f64()));
        child.kill().unwrap();
        child.wait().unwrap();
        let found = std::fs::read(&out).unwrap();
        match which(&found) {
            Some(false) => kept += 1,
            Some(true) => replaced += 1,
            None => panic!("{} bytes that are neither file", found.len()),
        }
        for entry in std::fs::read_dir(folder.path()).unwrap() {
            let entry = entry.unwrap();
            let name = entry.file_name().to_string_lossy().into_owned();
            if !["old.png", "new.png", "out.exr"].contains(&name.as_str()) {
                assert!(name.starts_with(".svbrdf-"), "{name} is left behind");
                std::fs::remove_file(entry.path()).unwrap();
                unfinished += 1;
            }
        }
    }
    println!("old {kept}, new {replaced}, temporary files left {unfinished}; a whole run takes {whole:?}");
    assert!(kept > 0 && replaced > 0 && unfinished > 0, "old {kept}, new {replaced}, left {unfinished}");
}
