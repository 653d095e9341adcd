//! Stillness: what is seen changes only by what the hand does.

use svbrdf_core::material::Map as MaterialMap;

use super::*;

/// Changes of the layout, the panels, the legend and the drawer, each its own inverse.
const INVOLUTIONS: [egui::Key; 5] = [
    egui::Key::D, // differences, and the legend with them
    egui::Key::B, // side panel
    egui::Key::X, // ground truth and prediction change places
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

#[needs(adapter)]
fn the_magnified_texel_stays_at_the_centre_of_its_pane_whatever_opens_and_closes() {
    let mut window = built_in();
    let framing = Framing { pixels_per_texel: 12.0, centre: [62.5, 53.5] };
    window.state_mut().parts.model.view.display.framing = Some(framing);
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for step in 0..16 {
        let key = INVOLUTIONS[random.next_u32() as usize % INVOLUTIONS.len()];
        press(&mut window, key);
        assert_eq!(texel_at_the_centre(&mut window, GROUND_TRUTH), Some([62, 53]), "step {step}: {key:?}");
    }
    for size in [vec2(900.0, 700.0), vec2(1400.0, 620.0)] {
        window.set_size(size);
        window.run_steps(4);
        for layout in ["wipe", "single", "side by side"] {
            press(&mut window, egui::Key::C);
            let framing = window.view().display.framing.unwrap();
            assert_eq!((framing.pixels_per_texel, framing.centre), (12.0, [62.5, 53.5]), "{size:?} {layout}");
        }
        assert_eq!(texel_at_the_centre(&mut window, GROUND_TRUTH), Some([62, 53]), "{size:?}");
    }
}

/// The legend, the drawer and the rectangle leave the panes where they are, also those that fit their pictures: a second press of I
/// removes the pin.
#[needs(adapter)]
fn the_legend_and_the_drawer_move_no_pane() {
    let mut window = built_in();
    let panes = |window: &Window<'_>| {
        [GROUND_TRUTH, PREDICTIONS[0], PREDICTIONS[1]].map(|title| {
            let label = format!("Pane {title}");
            window.query_all_by_label_contains(&label).map(|pane| pane.rect()).next().unwrap()
        })
    };
    let (first, at) = (panes(&window), pane(&window, GROUND_TRUTH).center());
    hover(&mut window, at);
    let (texel, magnified) = (texel_read(&window), magnification(&window));
    for key in [egui::Key::D, egui::Key::I, egui::Key::Q, egui::Key::D, egui::Key::I] {
        press(&mut window, key);
        window.run_steps(12);
        assert_eq!((panes(&window), texel_read(&window)), (first, texel), "{key:?}");
        assert_eq!(magnification(&window), magnified, "{key:?}");
    }
    assert!(window.model().inspection.pins.is_empty(), "the second press removes the pin of the first");
}

/// Drags an edge of a panel sideways.
pub fn drag_edge(window: &mut Window<'_>, x: f32, by: f32) {
    let edge = egui::pos2(x, 400.0);
    window.event(egui::Event::PointerMoved(edge));
    window.run_steps(2);
    window.event(primary(edge, true));
    window.run_steps(2);
    for share in [0.2, 0.6, 1.0] {
        window.event(egui::Event::PointerMoved(edge + vec2(share * by, 0.0)));
        window.run_steps(2);
    }
    window.event(primary(edge + vec2(by, 0.0), false));
    window.run_steps(12);
}

/// The side panel has the width that the hand gives it, also at the next start.
#[needs(adapter)]
fn the_side_panel_keeps_the_width_that_it_is_given() {
    let mut window = built_in();
    let before = window.model().settings.side_width;
    drag_edge(&mut window, 1200.0 - before, -100.0);
    let after = window.model().settings.side_width;
    assert!((after - before - 100.0).abs() < 20.0, "{before} to {after}");
}

#[needs(adapter)]
fn in_perspective_the_hand_turns_the_material_and_a_fit_brings_it_back() {
    let mut window = built_in();
    press(&mut window, egui::Key::P);
    let rect = pane(&window, GROUND_TRUTH);
    let view = |window: &Window<'_>| window.scene().view;
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

#[needs(adapter)]
fn the_side_panel_has_one_width_and_a_click_beside_a_dialog_moves_nothing() {
    let mut window = built_in();
    let scene = window.scene();
    let rect = pane(&window, GROUND_TRUTH);
    press(&mut window, egui::Key::F1);
    drag_primary(&mut window, rect, vec2(0.05, 0.9), vec2(0.1, 0.95));
    assert_eq!(window.scene(), scene, "behind the help");
    press(&mut window, egui::Key::Escape);
    drag_primary(&mut window, rect, vec2(0.05, 0.9), vec2(0.1, 0.95));
    assert_ne!(window.scene(), scene);
    for name in ["Why", "Files", "Loss"] {
        tab(&mut window, name);
        window.run_steps(30);
        assert_eq!(pane(&window, GROUND_TRUTH), rect, "{name}");
    }
}

#[needs(adapter)]
fn the_automatic_range_is_that_of_the_predictions_also_of_a_mixture() {
    let mut window = with_differences();
    let before = window.difference_range();
    let mut mixed = Vec::new();
    for only_right in [false, true] {
        edit(&mut window, |model| model.view.isolate(Some(MaterialMap::Normal)));
        edit(&mut window, |model| model.view.display.only_right = only_right);
        wait(&mut window, "the mixture", |app| {
            app.displayed_materials()[1].0.contains(if only_right { "right" } else { "wrong" })
        });
        wait(&mut window, "the statistics", |app| app.difference_distributions().is_some());
        mixed.extend(window.difference_distributions().map(|one| one.auto_range));
        assert_eq!(window.difference_range(), before, "only right: {only_right}");
    }
    assert!(mixed.iter().any(|range| *range != before), "a planted fault: the own range of a mixture");
}

/// The ground truth of a pair of this kind, and its prediction: equal, black and white, mirror and matte, noise, normals to
/// either side.
fn write_pair(folder: &Path, kind: u32, side: u32) -> [PathBuf; 2] {
    let noise = |seed: u32, x: u32, y: u32| {
        (x.wrapping_mul(73) ^ y.wrapping_mul(151) ^ (seed * 97)).wrapping_mul(2_654_435_761) >> 24
    };
    let long = "a prediction whose name is too long for every place it is shown in.png";
    [(0, "ground truth.png"), (1, long)].map(|(number, name)| {
        let path = folder.join(format!("{kind} {side} {name}"));
        let extreme = 255 * number as u8;
        write_packed(&path, side, |tile, x, y| match (kind, tile) {
            (1, 1) | (2, 2) => [extreme; 3],
            (3, 1..) => [noise(tile + number, x, y) as u8; 3],
            (4, 0) => [extreme, 128, 160],
            _ => [[128, 128, 255], [120, 90, 60], [140; 3], [20; 3]][tile as usize],
        });
        path
    })
}

#[needs(adapter)]
fn the_layout_is_the_same_in_every_frame_of_every_kind_of_pair() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = built_in();
    window.set_size(vec2(1000.0, 640.0));
    window.run_steps(4);
    let controls = |window: &Window<'_>| {
        let names = ["Tab Why", "Seed", "Copy losses", "Near-field", "Convention", "Help", "Pane "];
        // One of them is there at a time.
        let either = ["Compute loss", "Cancel loss"].map(|name| window.query_by_label(name));
        let rects = names.map(|name| {
            let rects: Vec<_> = window.query_all_by_label_contains(name).map(|node| node.rect()).collect();
            assert!(!rects.is_empty(), "no {name}");
            rects
        });
        (rects, either.into_iter().flatten().map(|node| node.rect()).next().unwrap())
    };
    // The texel under the pointer is none of the first pair, which is smaller.
    let at = pane(&window, GROUND_TRUTH).center();
    hover(&mut window, at);
    let mut first = None;
    for (side, kind) in [1, 40].into_iter().flat_map(|side| (0..5).map(move |kind| (side, kind))) {
        open(&mut window, write_pair(folder.path(), kind, side));
        wait(&mut window, "the pair", |app| {
            !app.is_reading() && app.names()[0].starts_with(&format!("{kind} {side} "))
        });
        let first = first.get_or_insert_with(|| controls(&window));
        for frame in 0..60 {
            window.step();
            assert_eq!(controls(&window), *first, "kind {kind}, {side} texels, frame {frame}");
        }
    }
}
