//! The map over the directions of light and view.

use svbrdf_core::loss::Comparison;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Endpoint, Kind};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::why::{Hemisphere, hemisphere};

use super::*;

/// The map of these predictions.
fn expected(predictions: &[usize], moved: Endpoint, fixed: [f64; 3]) -> Hemisphere {
    let materials = materials();
    let predictions: Vec<_> = predictions.iter().map(|index| &materials[*index]).collect();
    let comparison = Comparison::new(&materials[0], &predictions, PRINTED).unwrap();
    hemisphere(&comparison, moved, fixed, 64, &Progress::default(), |_| ()).unwrap()
}

/// Whether they are the same; NaN is NaN.
fn is_same(a: &Hemisphere, b: &Hemisphere) -> bool {
    let bits = |map: &Hemisphere| -> Vec<u64> {
        map.losses.iter().chain(&map.standard_errors).flatten().map(|v| v.to_bits()).collect()
    };
    a.directions == b.directions && bits(a) == bits(b)
}

fn wait_for_map(window: &mut Window<'_>) -> Hemisphere {
    wait(window, "the finest map", |app| app.direction_map().is_some_and(|map| map.side == 64));
    window.state().direction_map().unwrap().clone()
}

fn unit(p: [f64; 3]) -> [f64; 3] {
    let length = p.iter().map(|c| c * c).sum::<f64>().sqrt();
    p.map(|c| c / length)
}

#[needs(adapter)]
#[test]
fn the_map_is_that_of_the_core_over_lights_and_over_views() {
    let mut window = opened();
    let over_lights = wait_for_map(&mut window);
    assert!(is_same(&over_lights, &expected(&[1, 2], Endpoint::Light, [0.0, 0.0, 1.0])));
    // Each prediction has the map that it has alone.
    for (index, losses) in over_lights.losses.iter().enumerate() {
        let alone = expected(&[index + 1], Endpoint::Light, [0.0, 0.0, 1.0]);
        assert!(losses.iter().zip(&alone.losses[0]).all(|(a, b)| a.to_bits() == b.to_bits()), "{index}");
    }
    click(&mut window, "Over views");
    let over_views = wait_for_map(&mut window);
    let fixed = unit(window.state().parts.model.view.scene.light);
    assert!(is_same(&over_views, &expected(&[1, 2], Endpoint::View, fixed)));
    assert!(!is_same(&over_views, &over_lights), "a planted fault");
}

#[needs(adapter)]
#[test]
fn a_click_puts_the_light_where_the_map_is_clicked_and_the_loss_there_is_that_of_the_map() {
    let mut window = opened();
    let map = wait_for_map(&mut window);
    let before = window.state().parts.model.view.scene;
    let rect = window.get_by_label("Loss over light directions").rect();
    // To the right of the middle and above it.
    for (x, y) in [(0.5, 0.3), (-0.6, -0.2)] {
        let at = rect.center() + vec2(x, -y) * rect.width() / 2.0;
        for event in [egui::Event::PointerMoved(at), primary(at, true), primary(at, false)] {
            window.event(event);
            window.run_steps(2);
        }
        let scene = window.state().parts.model.view.scene;
        let [light_x, light_y, light_z] = unit(scene.light);
        assert_eq!((scene.kind, scene.view), (Kind::Distant, before.view));
        let off = (light_x - f64::from(x)).abs().max((light_y - f64::from(y)).abs());
        assert!(off < 0.02 && light_z > 0.0, "{scene:?}");
        let [column, row] = map.cell([light_x, light_y, light_z]).unwrap();
        let cell = row * map.side + column;
        let (read, error) = (map.losses[0][cell], map.standard_errors[0][cell]);
        window.get_by_label_contains(&format!(": {read:.4} ± {error:.4}"));
        let here = wait_for_scene_losses(&mut window)[0];
        // The middle of the cell is up to 0.02 away; 4 standard errors.
        assert!((here - read).abs() < 4.0 * error + 0.05 * read, "{here}, on the map {read} ± {error}");
    }
    // The map of the lights does not depend on the light.
    assert!(is_same(&wait_for_map(&mut window), &map));

    // Predictions are side by side with their difference, whose sign turns with the chosen one.
    let rects = |window: &Window<'_>| {
        let of = |text: &str| window.get_by_label(&format!("Loss over light directions{text}")).rect();
        [of(""), of(" of 2"), of(" of the difference to 2")]
    };
    let [first, second, difference] = rects(&window);
    assert!(
        (first.top() - second.top()).abs() < 1.0 && first.right() < second.left(),
        "{first:?} {second:?}"
    );
    assert_eq!([first.size(), first.size()], [second.size(), difference.size()]);
    let (column, row) = (40, 20);
    let cell = row * map.side + column;
    let apart = map.losses[0][cell] - map.losses[1][cell];
    assert!(apart.abs() > 1e-3, "they differ there");
    let at = |rect: egui::Rect| {
        let share = vec2(column as f32 + 0.5, row as f32 + 0.5) / map.side as f32;
        rect.min + share * rect.size()
    };
    let sign = |value: f64| if value < 0.0 { "\u{2212}" } else { "+" };
    for (rect, text) in [
        (first, format!(": {:.4} ± ", map.losses[0][cell])),
        (second, format!(": {:.4} ± ", map.losses[1][cell])),
        (difference, format!(": {}{:.4}", sign(apart), apart.abs())),
    ] {
        hover(&mut window, at(rect));
        window.get_by_label_contains(&text);
    }
    press(&mut window, egui::Key::Num2);
    let difference = window.get_by_label("Loss over light directions of the difference to 1").rect();
    hover(&mut window, at(difference));
    window.get_by_label_contains(&format!(": {}{:.4}", sign(-apart), apart.abs()));
}
