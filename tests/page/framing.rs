//! The magnified part of a session, with which the figure begins.

use glam::Vec3;
use serde_json::json;

use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::picture::camera::Camera;
use svbrdf_files::session::window::{Framing, Layout, Projection, SessionDisplay};
use svbrdf_needs::needs;
use svbrdf_page::{MOST_BYTES, Report};

use super::browser::Page;
use super::{html, noise, report};

const FRAMING: Framing = Framing { pixels_per_texel: 30.0, centre: [31.5, 12.25] };

/// A page whose maps are halved by a small `max_bytes`.
fn open(framing: Framing, projection: Projection, max_bytes: usize) -> Page {
    let material = noise(1);
    let materials = [&material];
    let mut report = Report { max_bytes, ..report(&materials, PRINTED) };
    report.view.scene.view = [0.5, -0.3, 2.0];
    report.view.display = SessionDisplay {
        layout: Layout::Single,
        projection,
        framing: Some(framing),
        ..SessionDisplay::default()
    };
    Page::open(&html(&report), [800, 600])
}

/// The camera of the first pane, and the height of the pane in pixels.
fn camera(page: &mut Page) -> (Camera, f32) {
    let found = page.after_frame(
        "(() => { const b = window.svbrdf.figure.boxes()[0], c = window.svbrdf.figure.camera(b.width, b.height); \
         return [[c.origin, c.originRight, c.originUp, c.direction, c.directionRight, c.directionUp], b.height]; })()",
    );
    let vector =
        |i: usize| Vec3::from_array([0, 1, 2].map(|axis| found[0][i][axis].as_f64().unwrap() as f32));
    let [origin, origin_right, origin_up, direction, direction_right, direction_up] =
        [0, 1, 2, 3, 4, 5].map(vector);
    let camera = Camera { origin, origin_right, origin_up, direction, direction_right, direction_up };
    (camera, found[1].as_f64().unwrap() as f32)
}

/// The texel in the middle of the pane, of a material of 48 x 48 texels.
fn centre(camera: &Camera) -> [f32; 2] {
    let [x, y] = camera.plane_from_ndc(0.0, 0.0).unwrap();
    let [half_width, half_height] = noise(1).grid().half_extent();
    [24.0 * (x / half_width + 1.0), 24.0 * (1.0 - y / half_height)]
}

fn near(found: [f32; 2], expected: [f32; 2]) -> bool {
    found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-3)
}

#[needs(browser)]
#[test]
fn the_figure_begins_with_the_texels_of_the_session_and_resets_to_them() {
    for projection in [Projection::Flat, Projection::Perspective] {
        let mut page = open(FRAMING, projection, MOST_BYTES);
        let (begins, height) = camera(&mut page);
        assert!(near(centre(&begins), FRAMING.centre), "{projection:?}: {:?}", centre(&begins));
        let texel = 2.0 / 47.0;
        let zoom = page.evaluate("window.svbrdf.figure.state.zoom").as_f64().unwrap() as f32;
        page.evaluate("document.getElementById('canvas').focus()");
        page.press("f", 0);
        let fitted = camera(&mut page).0;
        let pixels = zoom * 0.5 * height / fitted.half_height() * texel;
        assert!((pixels / FRAMING.pixels_per_texel - 1.0).abs() < 1e-4, "{projection:?}: {pixels}");
        page.press("r", 0);
        assert_eq!(camera(&mut page).0, begins);
        page.press("0", 0);
        let (single, height) = camera(&mut page);
        assert!(near(centre(&single), [24.0; 2]));
        if projection == Projection::Flat {
            assert!((0.5 * height / single.half_height() * texel - 1.0).abs() < 1e-4);
        }
    }
}

#[needs(browser)]
#[test]
fn halved_maps_begin_with_the_same_part_of_the_material() {
    let mut page = open(FRAMING, Projection::Flat, 1);
    assert_eq!(page.evaluate("window.svbrdf.figure.grid.width"), json!(24));
    let [x, y] =
        [0, 1].map(|i| page.evaluate(&format!("window.svbrdf.figure.data.start.framing.centre[{i}]")));
    assert_eq!([x, y], [json!(15.75), json!(6.125)]);
    let (begins, height) = camera(&mut page);
    let pixels = 0.5 * height / begins.half_height() * 2.0 / 23.0;
    assert!((pixels / (2.0 * FRAMING.pixels_per_texel) - 1.0).abs() < 1e-4, "{pixels}");
}

#[needs(browser)]
#[test]
fn a_framing_out_of_range_leaves_some_of_the_material_visible() {
    for (pixels_per_texel, centre) in [(0.0, [1e30, -1e30]), (-1.0, [0.0; 2]), (3e38, [f32::MAX; 2])] {
        let mut page = open(Framing { pixels_per_texel, centre }, Projection::Flat, MOST_BYTES);
        let found = self::centre(&camera(&mut page).0);
        assert!(found.iter().all(|c| (-0.01..=48.01).contains(c)), "{pixels_per_texel}: {found:?}");
    }
}
