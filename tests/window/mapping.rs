//! One mapping from the pointer to texels: readout, pins and rectangle name what the screen shows, in every layout, zoom and
//! projection.

use std::collections::BTreeSet;

use rand::SeedableRng as _;
use rand::rngs::ChaCha8Rng;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_viewer::model::inspection::{Inspection, Region};
use svbrdf_viewer::model::view::state::{Layout, Projection};

use super::soak::below;
use super::texels::{numbered, texel_of, zoom};
use super::*;

/// Views that are tried.
const VIEWS: usize = 24;
/// Pairs of points that are tried until both show a texel.
const TRIES: usize = 2000;

/// A picture of the window, with nothing under the pointer.
fn picture(window: &mut Window<'_>) -> image::RgbaImage {
    hover(window, Pos2::ZERO);
    window.render().unwrap()
}

/// The texel at a pixel of a picture, where all around it show the same one.
fn shown(picture: &image::RgbaImage, [x, y]: [u32; 2]) -> Option<[usize; 2]> {
    let colour = picture.get_pixel(x, y);
    let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
    let is_one = around.into_iter().all(|[x, y]| picture.get_pixel(x, y) == colour);
    texel_of([colour.0[0], colour.0[1], colour.0[2]]).filter(|_| is_one)
}

/// Two pixels of the pane that show texels, with these.
fn points(
    picture: &image::RgbaImage,
    pane: egui::Rect,
    random: &mut ChaCha8Rng,
) -> [([u32; 2], [usize; 2]); 2] {
    let mut one = || {
        let share = vec2(0.02 + 0.96 * unit(random), 0.02 + 0.7 * unit(random));
        let at = pane.min + pane.size() * share;
        let pixel = [at.x as u32, at.y as u32];
        // Not on the line of a wipe.
        let is_beside = (at.x - pane.center().x).abs() > 12.0;
        shown(picture, pixel).filter(|_| is_beside).map(|texel| (pixel, texel))
    };
    let pair = (0..TRIES).find_map(|_| Some([one()?, one()?]));
    pair.expect("texels are in sight")
}

fn unit(random: &mut ChaCha8Rng) -> f32 {
    below(random, 10_000) as f32 / 10_000.0
}

fn middle([x, y]: [u32; 2]) -> Pos2 {
    egui::pos2(x as f32 + 0.5, y as f32 + 0.5)
}

/// Draws the rectangle from one pixel to another.
fn rectangle(window: &mut Window<'_>, from: [u32; 2], to: [u32; 2]) -> Region {
    press(window, egui::Key::Q);
    let screen = egui::Rect::from_min_size(Pos2::ZERO, vec2(1.0, 1.0));
    drag_primary(window, screen, middle(from).to_vec2(), middle(to).to_vec2());
    window.state().parts.model.inspection.region.expect("a rectangle was drawn")
}

/// The columns or rows of a region.
fn along(region: Region, axis: usize) -> BTreeSet<usize> {
    (region.first[axis]..=region.last[axis]).collect()
}

/// A view and, for messages, its description.
fn random_view(window: &mut Window<'_>, random: &mut ChaCha8Rng) -> String {
    let display = &mut window.state_mut().parts.model.view.display;
    display.quantity = Quantity::Diffuse;
    display.layout = [Layout::SideBySide, Layout::Wipe, Layout::Single][below(random, 3)];
    display.projection = [Projection::Flat, Projection::Perspective][below(random, 2)];
    display.framing = None;
    let what = format!("{:?}, {:?}", display.layout, display.projection);
    let view = [unit(random) - 0.5, unit(random) - 0.5, 2.0].map(f64::from);
    window.state_mut().parts.model.view.scene.view = view;
    window.state_mut().parts.model.inspection = Inspection::default();
    window.run_steps(3);
    what
}

/// A pane, magnified at random.
fn random_pane(window: &mut Window<'_>, random: &mut ChaCha8Rng) -> egui::Rect {
    let panes: Vec<egui::Rect> =
        window.query_all_by_label_contains("Pane ").map(|node| node.rect()).collect();
    let pane = panes[below(random, panes.len())];
    let at = pane.min + pane.size() * vec2(0.3 + 0.4 * unit(random), 0.45 + 0.1 * unit(random));
    zoom(window, at, below(random, 7) as f32);
    pane
}

/// Whether pixels near this one differ.
fn differs(a: &image::RgbaImage, b: &image::RgbaImage, [x, y]: [u32; 2], reach: u32) -> bool {
    let around = |at: u32, end: u32| at.saturating_sub(reach)..=(at + reach).min(end - 1);
    around(x, a.width()).any(|x| around(y, a.height()).any(|y| a.get_pixel(x, y) != b.get_pixel(x, y)))
}

#[needs(adapter)]
fn readout_pin_and_rectangle_are_of_the_texels_that_the_screen_shows() {
    let folder = tempfile::tempdir().unwrap();
    let numbered = numbered(folder.path());
    let options = ViewerOptions { predictions: numbered.ground_truth.iter().cloned().collect(), ..numbered };
    let mut window = window(options);
    let mut random = ChaCha8Rng::seed_from_u64(46);
    for number in 0..VIEWS {
        let what = format!("view {number}: {}", random_view(&mut window, &mut random));
        let pane = random_pane(&mut window, &mut random);
        let before = picture(&mut window);
        let [(from, a), (to, b)] = points(&before, pane, &mut random);
        for (pixel, texel) in [(from, a), (to, b)] {
            hover(&mut window, middle(pixel));
            assert_eq!(texel_read(&window), Some(texel), "{what}: readout at {pixel:?}");
        }
        press(&mut window, egui::Key::I);
        assert_eq!(window.state().parts.model.inspection.pins, [b], "{what}: pin");
        window.state_mut().parts.model.inspection.pins.clear();
        let region = rectangle(&mut window, from, to);
        let ends = |axis: usize| BTreeSet::from([a[axis], b[axis]]);
        for axis in [0, 1] {
            let found = BTreeSet::from([region.first[axis], region.last[axis]]);
            assert_eq!(found, ends(axis), "{what}: {region:?} from {a:?} to {b:?}");
        }
        if window.state().parts.model.view.display.projection == Projection::Flat {
            let columns: BTreeSet<usize> = (from[0].min(to[0])..=from[0].max(to[0]))
                .filter_map(|x| shown(&before, [x, from[1]]).map(|texel| texel[0]))
                .collect();
            assert_eq!(along(region, 0), columns, "{what}: columns from {a:?} to {b:?}");
        }
        let side = magnification(&window) as f32;
        let after = picture(&mut window);
        for corner in [from, to] {
            // In perspective, texels in front are larger than in the middle.
            let reach = (2.0 * side) as u32 + 4;
            assert!(differs(&before, &after, corner, reach), "{what}: no outline near {corner:?}");
        }
    }
}
