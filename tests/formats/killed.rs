//! The real program, killed at random moments while it writes over a file.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};

use super::*;
use crate::support::surroundings::command;

/// Width and height of the material: compressing it takes far longer than reading it.
const LARGE: usize = 640;

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

    let mut random = ChaCha8Rng::seed_from_u64(11);
    let (mut kept, mut replaced, mut unfinished) = (0, 0, 0);
    // More rounds only where a busy machine has not shown all three outcomes yet.
    for round in 0..300 {
        if round >= 60 && kept > 0 && replaced > 0 && unfinished > 0 {
            break;
        }
        std::fs::write(&out, &old).unwrap();
        let mut child = convert(folder.path(), "new.png").spawn().unwrap();
        let share = f64::from(random.next_u32()) / f64::from(u32::MAX);
        std::thread::sleep(Duration::from_secs_f64(1.2 * share * whole.as_secs_f64()));
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
