//! The dialogs that open and save.

use std::os::unix::fs::PermissionsExt as _;

use svbrdf_needs::needs;

use crate::support::temporary::is_writing;

use super::*;

/// How many pixels have the colour of errors.
fn problem_pixels(picture: &RgbImage) -> usize {
    let far =
        |p: &image::Rgb<u8>| [0xef, 0x7f, 0x71].iter().zip(p.0).any(|(a, b): (&u8, u8)| a.abs_diff(b) > 40);
    picture.pixels().filter(|pixel| !far(pixel)).count()
}

/// The window after *Browse* in its dialog *Open*, and the screen before.
fn browsed(desktop: &Desktop) -> (Running, RgbImage) {
    let built_in = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/samples/worn_tiles.png");
    std::fs::copy(built_in, desktop.folder.path().join("tiles.png")).unwrap();
    let program = desktop.open(&[]);
    desktop.dialog("ctrl+o");
    let before = desktop.wait_until_still();
    // The next control after the path field.
    desktop.keys(&["Tab", "space"]);
    (program, before)
}

fn wait_for_tiles(desktop: &Desktop) {
    let stored = desktop.folder.path().join(".local/share/svbrdf/settings.json");
    desktop.wait("the material to be opened", |_| {
        std::fs::read_to_string(&stored).is_ok_and(|text| text.contains("tiles.png"))
    });
}

#[needs(f32_adapter, desktop)]
fn without_a_file_dialog_browse_says_so_and_the_cursor_is_in_the_path_field() {
    let desktop = Desktop::start();
    let (program, before) = browsed(&desktop);
    let unfocused = problem_pixels(&before);
    desktop.wait("the error", |picture| problem_pixels(picture) > unfocused + 200);
    desktop.xdotool("type tiles.png");
    desktop.keys(&["ctrl+Return"]);
    wait_for_tiles(&desktop);
    drop(program);
}

#[needs(f32_adapter, desktop)]
fn with_zenity_browse_takes_the_path_that_it_prints() {
    let desktop = Desktop::start();
    let zenity = desktop.bin().join("zenity");
    std::fs::create_dir(desktop.bin()).unwrap();
    let path = desktop.folder.path().join("tiles.png");
    let script = format!("#!/bin/sh\necho '{0}'\n: > '{0}.chosen'\n", path.display());
    std::fs::write(&zenity, script).unwrap();
    std::fs::set_permissions(&zenity, std::fs::Permissions::from_mode(0o755)).unwrap();
    let (program, _) = browsed(&desktop);
    desktop.wait("zenity to end", |_| path.with_extension("png.chosen").exists());
    desktop.wait_until_still();
    // Back to the path field.
    desktop.keys(&["shift+Tab", "ctrl+Return"]);
    wait_for_tiles(&desktop);
    drop(program);
}

#[needs(f32_adapter, desktop)]
fn a_signal_while_a_picture_is_saved_leaves_no_temporary_file() {
    const SIDE: u32 = 1024;
    let desktop = Desktop::start();
    let folder = desktop.folder.path();
    let tile = |x: u32, y: u32| match x / SIDE {
        0 => [128, 140, 250],
        // Noise, which takes its time to be compressed.
        1 => [x, y, x ^ y].map(|v| (v.wrapping_mul(2_654_435_761) >> 13) as u8),
        2 => [90; 3],
        _ => [12; 3],
    };
    RgbImage::from_fn(4 * SIDE, SIDE, |x, y| image::Rgb(tile(x, y))).save(folder.join("large.png")).unwrap();
    let mut program = desktop.open(&["large.png"]);
    // Back from the path field: scenes, session, strip. The choice puts the cursor into the field again.
    desktop.dialog("ctrl+s");
    desktop.keys(&["shift+Tab", "shift+Tab", "shift+Tab", "space"]);
    desktop.xdotool("key Return");
    let start = Instant::now();
    while !is_writing(folder, program.0.id()) {
        assert!(!folder.join("svbrdf-strip.png").exists(), "it was written unseen");
        assert!(start.elapsed() < Duration::from_secs(120), "nothing is written");
        std::thread::sleep(Duration::from_millis(1));
    }
    let kill = format!("kill -TERM {}", program.0.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
    let status = program.0.wait().unwrap();
    assert_eq!(status.code(), Some(130), "{status}");
    let names = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let left: Vec<_> = names.filter(|name| name.to_string_lossy().contains("svbrdf-")).collect();
    assert!(left.is_empty(), "it was cancelled: {left:?}");
}
