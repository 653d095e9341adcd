//! Stillness: what is seen changes only by what the hand does.

use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};
use svbrdf_files::session::window::Framing;

use super::*;

/// Changes of the layout, the panels, the legend and the drawer, each its own inverse.
const INVOLUTIONS: [egui::Key; 7] = [
    egui::Key::D, // differences, and the legend with them
    egui::Key::J, // histograms
    egui::Key::B, // side panel
    egui::Key::X, // ground truth and prediction change places
    egui::Key::T, // repeated
    egui::Key::V, // false colours
    egui::Key::L, // clipping
];

fn texel_at_the_centre(window: &mut Window<'_>, title: &str) -> Option<[usize; 2]> {
    // The side panel slides.
    window.run_steps(12);
    let rect = pane(window, title);
    hover(window, rect.center() + vec2(0.3, 0.3));
    texel_read(window)
}

fn magnify(window: &mut Window<'_>) {
    let framing = Framing { pixels_per_texel: 12.0, centre: [62.5, 53.5] };
    window.state_mut().parts.model.view.display.framing = Some(framing);
    window.run_steps(3);
}

#[needs(adapter)]
#[test]
fn the_magnified_texel_stays_at_the_centre_of_its_pane_whatever_opens_and_closes() {
    let mut window = built_in();
    magnify(&mut window);
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for step in 0..24 {
        let key = INVOLUTIONS[random.next_u32() as usize % 3];
        press(&mut window, key);
        assert_eq!(texel_at_the_centre(&mut window, GROUND_TRUTH), Some([62, 53]), "step {step}: {key:?}");
    }
    for size in [vec2(900.0, 700.0), vec2(1400.0, 620.0), vec2(1200.0, 800.0)] {
        window.set_size(size);
        window.run_steps(4);
        for layout in ["wipe", "single", "side by side"] {
            press(&mut window, egui::Key::C);
            let framing = window.state().parts.model.view.display.framing.unwrap();
            assert_eq!((framing.pixels_per_texel, framing.centre), (12.0, [62.5, 53.5]), "{size:?} {layout}");
        }
        assert_eq!(texel_at_the_centre(&mut window, GROUND_TRUTH), Some([62, 53]), "{size:?}");
    }
}

#[needs(adapter)]
#[test]
fn what_is_its_own_inverse_ends_at_the_same_texel_under_the_pointer() {
    let mut window = built_in();
    magnify(&mut window);
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for round in 0..8 {
        let at = pane(&window, GROUND_TRUTH).center() + vec2(37.0, -21.0);
        hover(&mut window, at);
        let before = (texel_read(&window), window.state().parts.model.view.clone());
        let keys: Vec<_> =
            (0..4).map(|_| INVOLUTIONS[random.next_u32() as usize % INVOLUTIONS.len()]).collect();
        keys.iter().chain(keys.iter().rev()).for_each(|key| press(&mut window, *key));
        window.run_steps(12);
        hover(&mut window, at);
        let after = (texel_read(&window), window.state().parts.model.view.clone());
        assert_eq!(before, after, "round {round}: {keys:?}");
    }
}

#[needs(adapter)]
#[test]
fn the_key_of_a_pin_pressed_twice_leaves_no_pin() {
    let mut window = built_in();
    magnify(&mut window);
    let at = pane(&window, GROUND_TRUTH).center() + vec2(-40.0, 60.0);
    hover(&mut window, at);
    let texel = texel_read(&window);
    press(&mut window, egui::Key::I);
    assert_eq!(texel_read(&window), texel, "the drawer that opens moves nothing");
    assert_eq!(window.state().parts.model.inspection.pins.len(), 1);
    press(&mut window, egui::Key::I);
    assert_eq!(window.state().parts.model.inspection.pins.len(), 0);
}

#[needs(adapter)]
#[test]
fn in_perspective_the_hand_turns_the_material_and_a_fit_brings_it_back() {
    let mut window = built_in();
    press(&mut window, egui::Key::P);
    let rect = pane(&window, GROUND_TRUTH);
    let view = |window: &Window<'_>| window.state().parts.model.view.scene.view;
    drag(&mut window, egui::PointerButton::Secondary, rect, vec2(0.5, 0.5), vec2(0.6, 0.4));
    let [x, y, z] = view(&window);
    assert!(x < -0.1 && y < -0.1, "the view goes against the hand: {x}, {y}, {z}");
    for _ in 0..4 {
        drag(&mut window, egui::PointerButton::Secondary, rect, vec2(0.1, 0.9), vec2(0.9, 0.1));
    }
    let share = |[x, y, z]: [f64; 3]| z / (x * x + y * y + z * z).sqrt();
    let degrees = share(view(&window)).acos().to_degrees();
    assert!((degrees - 85.0).abs() < 1e-6, "it stops at {degrees} degrees");
    press(&mut window, egui::Key::F);
    assert!((share(view(&window)) - 0.2).abs() < 1e-9, "a fifth of its area: {:?}", view(&window));
}

/// The accessible rectangles of all controls of the bar, by name.
fn bar(window: &Window<'_>) -> Vec<(String, egui::Rect)> {
    let rect = |name: &str| {
        let nodes = window.query_all_by_label(name).map(|node| node.rect());
        nodes.min_by(|a, b| a.top().total_cmp(&b.top())).unwrap_or_else(|| panic!("no {name}"))
    };
    super::bar::CONTROLS.iter().map(|name| ((*name).to_owned(), rect(name))).collect()
}

#[needs(adapter)]
#[test]
fn the_controls_of_the_bar_stay_where_they_are_in_every_mode() {
    let mut window = built_in();
    window.set_size(vec2(1500.0, 860.0));
    window.run_steps(12);
    let before = bar(&window);
    let panes = pane(&window, GROUND_TRUTH);
    for key in
        [egui::Key::D, egui::Key::M, egui::Key::D, egui::Key::M, egui::Key::M, egui::Key::M, egui::Key::D]
    {
        press(&mut window, key);
        assert_eq!(bar(&window), before, "{:?}", window.state().parts.model.view.display);
        assert_eq!(pane(&window, GROUND_TRUTH), panes);
    }
    for key in [egui::Key::V, egui::Key::P, egui::Key::T, egui::Key::X, egui::Key::C] {
        press(&mut window, key);
        assert_eq!(bar(&window), before, "{key:?}");
    }
}

#[needs(adapter)]
#[test]
fn the_side_panel_has_one_width_and_a_click_beside_a_dialog_moves_nothing() {
    let mut window = built_in();
    let scene = window.state().parts.model.view.scene;
    let rect = pane(&window, GROUND_TRUTH);
    press(&mut window, egui::Key::F1);
    drag(&mut window, egui::PointerButton::Primary, rect, vec2(0.05, 0.9), vec2(0.1, 0.95));
    assert_eq!(window.state().parts.model.view.scene, scene, "behind the help");
    press(&mut window, egui::Key::Escape);
    drag(&mut window, egui::PointerButton::Primary, rect, vec2(0.05, 0.9), vec2(0.1, 0.95));
    assert_ne!(window.state().parts.model.view.scene, scene);
    for name in ["Why", "Files", "Loss"] {
        tab(&mut window, name);
        window.run_steps(30);
        assert_eq!(pane(&window, GROUND_TRUTH), rect, "{name}");
    }
}

#[needs(adapter)]
#[test]
fn the_automatic_range_is_that_of_the_predictions_also_of_a_mixture() {
    use svbrdf_core::material::Map as MaterialMap;
    use svbrdf_viewer::model::command::DisplayCommand;
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    wait(&mut window, "the statistics", |app| app.difference_statistics().is_some());
    let range = |window: &Window<'_>| window.state().parts.displayed().range();
    let before = range(&window);
    let mut mixed = Vec::new();
    for only_right in [false, true] {
        window.state_mut().parts.model.apply(DisplayCommand::Isolate(Some(MaterialMap::Normal)).into());
        window.state_mut().parts.model.apply(DisplayCommand::SetOnlyRight(only_right).into());
        wait(&mut window, "the mixture", |app| {
            let displayed = app.parts.displayed();
            let chosen = displayed.model.view.display.prediction + 1;
            displayed.materials()[chosen].id() != displayed.model.materials.all[chosen].id()
        });
        wait(&mut window, "the statistics", |app| app.difference_distributions().is_some());
        mixed.extend(window.state().difference_distributions().map(|one| one.auto_range));
        assert_eq!(range(&window), before, "only right: {only_right}");
    }
    assert!(
        mixed.iter().any(|range| *range != before),
        "a planted fault: a mixture's own range is another one"
    );
}

/// Writes a packed material of `side` x `side` texels: normal, diffuse, roughness, specular.
fn write_packed(path: &std::path::Path, side: u32, value: impl Fn(usize, u32, u32) -> [u8; 3]) {
    let pixel = |x, y| image::Rgb(value((x / side) as usize, x % side, y));
    image::RgbImage::from_fn(4 * side, side, pixel).save(path).unwrap();
}

/// The ground truth of a pair of this kind, and its prediction: equal, one texel a step apart, black and white, mirror and
/// matte, noise, normals to either side.
fn write_pair(folder: &std::path::Path, kind: usize, side: u32) -> Vec<std::path::PathBuf> {
    let noise = |tile: usize, x: u32, y: u32| {
        (x.wrapping_mul(73) ^ y.wrapping_mul(151) ^ (tile as u32 * 97)).wrapping_mul(2_654_435_761) >> 24
    };
    let plain = |tile: usize| [[128, 128, 255], [120, 90, 60], [140; 3], [20; 3]][tile];
    let value = |is_prediction: bool| {
        move |tile: usize, x: u32, y: u32| match (kind, tile, is_prediction) {
            (1, 1, true) if (x, y) == (0, 0) => [121, 90, 60],
            (2, 1, _) => [if is_prediction { 255 } else { 0 }; 3],
            (3, 2, _) => [if is_prediction { 255 } else { 0 }; 3],
            (4, 1.., _) => [noise(tile + usize::from(is_prediction), x, y) as u8; 3],
            (5, 0, _) => {
                if is_prediction {
                    [250, 128, 160]
                } else {
                    [6, 128, 160]
                }
            }
            _ => plain(tile),
        }
    };
    let names =
        ["ground truth.png", "a prediction whose name is too long for every place it is shown in.png"];
    [false, true]
        .into_iter()
        .zip(names)
        .map(|(is_prediction, name)| {
            let path = folder.join(format!("{kind} {side} {name}"));
            write_packed(&path, side, value(is_prediction));
            path
        })
        .collect()
}

#[needs(adapter)]
#[test]
fn the_layout_is_the_same_over_100_frames_of_30_kinds_of_pairs() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = built_in();
    window.set_size(vec2(1000.0, 640.0));
    window.run_steps(4);
    let controls = |window: &Window<'_>| {
        let names = ["Tab Why", " loss", "Seed", "Copy losses", "Near-field", "Convention", "?", "Range"];
        // The button is "Compute loss" or "Cancel loss".
        let rect = |name: &str| match name {
            " loss" => {
                let either = ["Compute loss", "Cancel loss"];
                either.into_iter().find_map(|name| Some(window.query_by_label(name)?.rect()))
            }
            _ => window.query_all_by_label(name).map(|node| node.rect()).next(),
        };
        let rects = names.map(|name| rect(name).unwrap_or_else(|| panic!("no {name}")));
        let panes: Vec<egui::Rect> = window.query_all_by_label_contains("Pane ").map(|n| n.rect()).collect();
        (rects, panes)
    };
    let mut layouts = Vec::new();
    for side in [1, 2, 16, 24, 40] {
        for kind in 0..6 {
            let paths = write_pair(folder.path(), kind, side);
            let ctx = window.ctx.clone();
            let open = svbrdf_viewer::model::command::MaterialsCommand::Open {
                paths,
                replace: true,
                read: svbrdf_files::read::ReadOptions::AUTO,
            };
            window.state_mut().apply(&ctx, open.into());
            wait(&mut window, "the pair", |app| {
                !app.is_reading() && app.names()[0].starts_with(&format!("{kind} {side} "))
            });
            let before = controls(&window);
            for frame in 0..100 {
                window.step();
                assert_eq!(controls(&window), before, "kind {kind}, {side} texels, frame {frame}");
            }
            layouts.push(before);
        }
    }
    assert_eq!(layouts.len(), 30);
    for (kind, layout) in layouts.iter().enumerate() {
        assert_eq!(*layout, layouts[0], "all pairs have one layout: {kind}");
    }
}

#[needs(adapter)]
#[test]
fn titles_of_many_predictions_keep_what_tells_them_apart() {
    let folder = tempfile::tempdir().unwrap();
    let names = ["alpha", "bravo", "charlie", "delta", "echo", "foxtrot", "golf", "hotel", "india"];
    let path = |name: &str| folder.path().join(format!("{name}.png"));
    write_packed(&path("gt"), 8, |tile, _, _| if tile == 0 { [128, 128, 255] } else { [90; 3] });
    for (index, name) in names.iter().enumerate() {
        let diffuse = 20 * index as u8;
        write_packed(&path(&format!("model_of_a_run_{name}")), 8, |tile, _, _| {
            if tile == 0 { [128, 128, 255] } else { [diffuse; 3] }
        });
    }
    let predictions = names.iter().map(|name| path(&format!("model_of_a_run_{name}")).into()).collect();
    let options =
        ViewerOptions { ground_truth: Some(path("gt").into()), predictions, ..ViewerOptions::default() };
    let window = super::window(options);
    assert_eq!(window.state().names().len(), 10, "{:?}", window.state().messages());
    let scenery = |window: &Window<'_>| {
        let parts = &window.state().parts;
        let displayed = svbrdf_viewer::jobs::displayed::Displayed::of(&parts.model, &parts.jobs);
        let scenery = svbrdf_viewer::ui::content::scenery(&window.ctx, displayed, &parts.model.view);
        scenery.contents().into_iter().map(|content| scenery.name_of(content, 9)).collect::<Vec<_>>()
    };
    let found = scenery(&window);
    assert_eq!(found[0], "GROUND TRUTH  gt");
    for (index, name) in names.iter().enumerate() {
        assert_eq!(found[index + 1], format!("{}  \u{2026}{name}", index + 1));
    }
}
