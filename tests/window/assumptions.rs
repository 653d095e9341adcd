//! The drop-downs of assumptions: what they switch is switched in the material, the panes and the loss.

use super::*;

/// The built-in ground truth as two files, `truth` and `guess`.
fn two_strips() -> (tempfile::TempDir, [PathBuf; 2]) {
    let folder = tempfile::tempdir().unwrap();
    let paths = strips(folder.path(), ["truth.png", "guess.png"]);
    (folder, paths)
}

/// A window on files with its tab open, high enough for all panels.
fn opened<'a>(paths: impl IntoIterator<Item = PathBuf>) -> Window<'a> {
    let mut window = on_files(paths);
    tab(&mut window, "Files");
    window.set_size(vec2(1200.0, 2000.0));
    window.run_steps(3);
    window
}

/// Unfolds the drop-downs of every material.
fn change(window: &mut Window<'_>) {
    let count = window.query_all_by_label("Change...").count();
    for index in 0..count {
        window.query_all_by_label("Change...").nth(index).unwrap().click();
        window.run_steps(12);
    }
}

/// A window on both, once their loss is there.
fn on_two_strips<'a>(paths: [PathBuf; 2]) -> Window<'a> {
    let mut window = opened(paths);
    loss(&mut window);
    change(&mut window);
    window
}

/// Clicks the drop-down `name`, then `choice` in it; not before the loss is there, whose panel moves those below.
fn choose(window: &mut Window<'_>, name: &str, choice: &str) {
    loss(window);
    super::choose(window, name, choice);
}

fn material(window: &Window<'_>, index: usize) -> Material<f32> {
    window.materials().nth(index).unwrap().clone()
}

fn loss(window: &mut Window<'_>) -> f64 {
    wait(window, "the loss", |app| app.losses().is_some());
    window.losses().unwrap()[0].estimate.mean
}

#[needs(adapter)]
fn every_assumption_of_the_ground_truth_can_be_switched_by_a_click() {
    let (_folder, paths) = two_strips();
    let mut window = on_two_strips(paths);
    for (what, choice) in [
        ("preset", "materialgan"),
        ("order", "dsrn"),
        ("albedo", "log0.01"),
        ("specular", "gamma2.2"),
        ("normal y", "down"),
        ("normal encoding", "xy"),
        ("roughness", "gloss"),
        ("energy", "unscaled"),
    ] {
        let before = material(&window, 0);
        choose(&mut window, &format!("{what} of truth"), &format!("{what} {choice}"));
        wait(&mut window, choice, |app| *app.materials().next().unwrap() != before);
        assert!(window.messages().is_empty(), "{choice}: {:?}", window.messages());
        assert!(loss(&mut window) > 0.0, "{choice}");
        let changed = material(&window, 0);
        choose(&mut window, &format!("{what} of truth"), &format!("auto: infer {what}"));
        wait(&mut window, "auto", |app| *app.materials().next().unwrap() != changed);
        assert!(material(&window, 0) == before, "{choice}, and back");
    }
    assert_eq!(loss(&mut window), 0.0);
}

#[needs(adapter)]
fn tiles_that_are_not_square_open_with_their_grid_and_f0_with_its_number() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wide.png");
    let tile =
        |x: u32, _| image::Rgb(if (32..64).contains(&x) { [128, 128, 255] } else { [(x % 32) as u8; 3] });
    image::RgbImage::from_fn(3 * 32, 16, tile).save(&path).unwrap();
    let mut window = opened([path]);
    change(&mut window);
    assert_eq!(material(&window, 0).size(), [16, 16]);
    super::choose(&mut window, "order of wide", "order dnr");
    wait(&mut window, "the order", |app| !app.is_reading());
    enter(&mut window, "columns of tiles of wide", "3");
    wait(&mut window, "the wide tiles", |app| app.materials().next().unwrap().size() == [32, 16]);
    let specular = |app: &App| app.materials().next().unwrap().planes().specular[0][0];
    assert_eq!(specular(window.state()), 0.04);
    enter(&mut window, "F0 of wide", "0.08");
    wait(&mut window, "another F0", |app| specular(app) == 0.08);
    enter(&mut window, "columns of tiles of wide", "0");
    wait(&mut window, "square tiles again", |app| app.materials().next().unwrap().size() == [16, 16]);
}

#[needs(adapter)]
fn a_file_of_several_materials_has_a_chooser() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.mtl");
    for (name, rgb) in [("red", [180, 0, 0]), ("green", [0, 180, 0])] {
        let picture = image::RgbImage::from_pixel(8, 8, rgb.into());
        picture.save(folder.path().join(format!("{name}.png"))).unwrap();
    }
    let text = "newmtl red\nmap_Kd red.png\nPr 0.2\nnewmtl green\nmap_Kd green.png\nPr 0.7\n";
    std::fs::write(&path, text).unwrap();
    let mut window = on_files([path]);
    tab(&mut window, "Files");
    let diffuse = |app: &App| app.materials().next().unwrap().texel(0).diffuse;
    assert_eq!((diffuse(window.state())[0] > 0.0, diffuse(window.state())[1] > 0.0), (true, false));
    let name = window.names()[0].clone();
    super::choose(&mut window, &format!("material of {name}"), "1: green");
    wait(&mut window, "the other material", |app| !app.is_reading() && diffuse(app)[1] > 0.0);
    assert_eq!(diffuse(window.state())[0], 0.0);
    assert!(window.messages().is_empty(), "{:?}", window.messages());
}
