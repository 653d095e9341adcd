//! Sessions that the window saves and the command line reads.

use svbrdf_needs::needs;

use super::*;

/// The kinds of the save dialog, as steps back from the path field.
const SESSION: usize = 2;
const RENDERINGS: usize = 4;

/// Saves with the proposed name, by the keyboard.
fn save(desktop: &Desktop, kind: usize, name: &str) {
    desktop.dialog("ctrl+s");
    (0..kind).for_each(|_| desktop.keys(&["shift+Tab"]));
    desktop.keys(&["space"]);
    desktop.keys(&["Return"]);
    desktop.wait(name, |_| desktop.folder.path().join(name).exists());
    desktop.wait_until_still();
}

/// Runs the program on the folder of the desktop; its output.
fn run(desktop: &Desktop, arguments: &str) -> String {
    let output =
        desktop.svbrdf().args(arguments.split(' ')).current_dir(desktop.folder.path()).output().unwrap();
    assert!(output.status.success(), "{arguments}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn pixels(desktop: &Desktop, name: &str) -> RgbImage {
    image::open(desktop.folder.path().join(name)).unwrap().to_rgb8()
}

#[needs(f32_adapter, desktop)]
fn a_session_gives_the_pixels_and_the_numbers_of_its_window() {
    let desktop = Desktop::start();
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/samples");
    for name in ["worn_tiles.png", "wrong_roughness.png"] {
        std::fs::copy(assets.join(name), desktop.folder.path().join(name)).unwrap();
    }
    let program = desktop.open(&["worn_tiles.png", "wrong_roughness.png"]);
    // Another light, another exposure; then the difference, with the range that the window finds.
    let before = desktop.wait_until_still();
    for step in ["mousemove 260 260", "mousedown 1", "mousemove 230 340", "mousemove 200 420", "mouseup 1"] {
        desktop.xdotool(step);
    }
    desktop.wait("the light to follow the drag", |picture| changed(picture, &before) > 20_000);
    let session = "comparison.svbrdf-session.json";
    for keys in [&["e", "e"][..], &["d"]] {
        desktop.keys(keys);
        desktop.wait_until_still();
        save(&desktop, RENDERINGS, "svbrdf-renderings.png");
        save(&desktop, SESSION, session);
        run(&desktop, &format!("render {session} -o values.png"));
        assert!(pixels(&desktop, "values.png") == pixels(&desktop, "svbrdf-renderings.png"), "{keys:?}");
        // Planted: without the session, light and exposure are others.
        run(&desktop, "render worn_tiles.png wrong_roughness.png -o usual.png");
        assert!(pixels(&desktop, "usual.png") != pixels(&desktop, "values.png"));
        // The next ones are waited for.
        std::fs::remove_file(desktop.folder.path().join("svbrdf-renderings.png")).unwrap();
        std::fs::rename(desktop.folder.path().join(session), desktop.folder.path().join("last.json"))
            .unwrap();
    }
    let session = "last.svbrdf-session.json";
    std::fs::rename(desktop.folder.path().join("last.json"), desktop.folder.path().join(session)).unwrap();
    drop(program);

    // The window asks for 1%.
    let of_session = run(&desktop, &format!("loss {session} --format json"));
    let of_files = "loss worn_tiles.png wrong_roughness.png --target-error 1% --format json";
    let loss =
        |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap()["results"][0]["loss"].clone();
    assert!(loss(&of_session).is_f64(), "{of_session}");
    assert_eq!(loss(&of_session), loss(&run(&desktop, of_files)));
    assert_ne!(loss(&of_session), loss(&run(&desktop, &format!("{of_files} --seed 1"))));
}
