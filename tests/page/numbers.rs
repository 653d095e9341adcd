//! Pixels, differences and cameras of the page against those of the core.

use base64::Engine as _;
use serde_json::{Value, json};

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::{Convention, PRINTED};
use svbrdf_core::model::scene::{Scene, sample};
use svbrdf_core::picture::camera::Camera;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent};
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::progress::Progress;
use svbrdf_needs::needs;

use super::browser::Page;
use super::{built_in, figure, noise};
use crate::support::tolerance::{PAGE_CAMERA, PAGE_NUMBERS, PAGE_PIXELS};

/// Shows a scene in the flat view of the page, at an exposure.
pub fn show(page: &mut Page, scene: &Scene, quantity: Quantity, exposure: f32) {
    let state = json!({ "scene": scene, "quantity": quantity.name(), "exposure": exposure });
    page.evaluate(&format!("window.svbrdf.figure.set({state})"));
}

/// The 8-bit picture of a material in the page.
fn picture(page: &mut Page, material: usize, difference: Option<Difference>) -> Vec<u8> {
    decoded(&page.evaluate(&pictured(material, difference)))
}

/// The expression for [`picture`], whose value [`decoded`] reads.
pub fn pictured(material: usize, difference: Option<Difference>) -> String {
    let difference = json!(difference.map(Difference::key));
    format!(
        "(() => {{ let text = ''; for (const byte of window.svbrdf.figure.picture({material}, {difference})) \
         text += String.fromCharCode(byte); return btoa(text); }})()"
    )
}

/// The bytes of a text in base64.
pub fn decoded(text: &Value) -> Vec<u8> {
    base64::prelude::BASE64_STANDARD.decode(text.as_str().unwrap()).unwrap()
}

/// The largest difference of two pictures, in steps of 8 bits.
fn largest(page: &[u8], core: &[[u8; 3]]) -> u8 {
    assert_eq!(page.len(), 3 * core.len());
    page.iter().zip(core.as_flattened()).map(|(a, b)| a.abs_diff(*b)).max().unwrap()
}

/// What `svbrdf render` writes.
pub fn rendered(
    materials: &[&Material<f32>],
    content: PictureContent,
    scene: &Scene,
    convention: &Convention,
    exposure: f32,
) -> Vec<Vec<[u8; 3]>> {
    let pictures = content.pictures(materials, scene, convention, exposure, &Progress::default()).unwrap();
    let colours = |image: &svbrdf_core::image::Image<f32>| {
        image.pixels.iter().map(|rgb| pictures.content.colour(*rgb, exposure)).collect()
    };
    pictures.images.iter().map(colours).collect()
}

#[needs(browser)]
#[test]
fn maps_and_coloured_differences_are_those_of_render() {
    let materials = built_in();
    let refs: Vec<&Material<f32>> = materials.iter().collect();
    let scene = sample(3, 1, 0, &PRINTED)[0];
    let mut page = Page::open(&figure(&materials, PRINTED), [800, 600]);
    for quantity in Quantity::ALL {
        show(&mut page, &scene, quantity, 0.0);
        let content = PictureContent { quantity, difference: None };
        let core = rendered(&refs, content, &scene, &PRINTED, 0.0);
        for (index, core) in core.iter().enumerate() {
            let off = largest(&picture(&mut page, index, None), core);
            assert!(off <= PAGE_PIXELS, "{quantity:?} of {index}: off by {off}");
        }
        for kind in Difference::pointwise(quantity) {
            let state = json!({ quantity.name(): kind.key() });
            page.evaluate(&format!("Object.assign(window.svbrdf.figure.state.kinds, {state})"));
            let coloured = ColouredDifference { kind: *kind, range: Some(kind.default_range()) };
            let content = PictureContent { quantity, difference: Some(coloured) };
            let core = rendered(&refs, content, &scene, &PRINTED, 0.0);
            for (index, core) in core.iter().enumerate() {
                let off = largest(&picture(&mut page, index + 1, Some(*kind)), core);
                assert!(off <= PAGE_PIXELS, "{kind:?} of {quantity:?} of {index}: off by {off}");
            }
        }
    }
}

#[needs(browser)]
#[test]
fn readouts_are_those_of_the_core() {
    let materials = [noise(1), noise(2)];
    let mut page = Page::open(&figure(&materials, PRINTED), [800, 600]);
    let mut worst = 0.0f64;
    for scene in sample(5, 4, 4, &PRINTED) {
        for quantity in Quantity::ALL {
            show(&mut page, &scene, quantity, 0.0);
            for kind in Difference::pointwise(quantity) {
                let state = json!({ quantity.name(): kind.key() });
                page.evaluate(&format!("Object.assign(window.svbrdf.figure.state.kinds, {state})"));
                for texel in [[0, 0], [47, 0], [5, 31], [20, 20]] {
                    let [g, p] = [0, 1].map(|i| quantity.at(&materials[i], &scene, &PRINTED, texel));
                    let place = json!({ "texel": texel, "cell": texel });
                    let found = page.evaluate(&format!(
                        "[...window.svbrdf.figure.value(1, {place}), window.svbrdf.figure.difference(1, {place})]"
                    ));
                    let found: Vec<f64> =
                        found.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
                    let difference = kind.of_texel(g, p, PRINTED.epsilon);
                    let expected = p.map(f64::from).into_iter().chain([difference]);
                    for (found, expected) in found.iter().zip(expected) {
                        let off = (found - expected).abs() / expected.abs().max(1.0);
                        assert!(
                            off < PAGE_NUMBERS,
                            "{scene:?} {kind:?} {texel:?}: {found}, expected {expected}"
                        );
                        worst = worst.max(off);
                    }
                }
            }
        }
    }
    println!("largest deviation of a readout: {worst:e}");
}

/// Repeated, a rendering under near-field light is of the plane that the copies make; everything else is of texels.
#[needs(browser)]
#[test]
fn readouts_of_a_repeated_material_are_of_what_is_seen() {
    let materials = [noise(1), noise(2)];
    let mut page = Page::open(&figure(&materials, PRINTED), [800, 600]);
    let [near, distant] = [sample(5, 1, 0, &PRINTED)[0], sample(5, 0, 1, &PRINTED)[0]];
    page.evaluate("window.svbrdf.figure.set({ tiled: true })");
    for (scene, quantity) in
        [(near, Quantity::Rendering), (distant, Quantity::Rendering), (near, Quantity::Normal)]
    {
        show(&mut page, &scene, quantity, 0.0);
        for (cell, texel) in [([0, 0], [24, 24]), ([23, 24], [47, 0]), ([90, 40], [18, 16])] {
            // The point of the cell's middle, in a plane of 2 x 48 cells between -48 / 47 and 48 / 47.
            let [x, y] = cell.map(|number: i32| (f64::from(number) - 47.5) / 47.0);
            let seen = page.evaluate(&format!("window.svbrdf.figure.seen([{x}, {}])", -y));
            assert_eq!(seen, json!({ "texel": texel, "cell": cell }));
            // The texel in its own place is lit so where light and view are moved by the distance of both places.
            let own = texel.map(|number: usize| (2.0 * number as f64 - 47.0) / 47.0);
            let moved = |[a, b, c]: [f64; 3]| [a + own[0] - x, b - own[1] + y, c];
            let mut lit = scene;
            if quantity == Quantity::Rendering && scene == near {
                (lit.view, lit.light) = (moved(scene.view), moved(scene.light));
            }
            let expected = quantity.at(&materials[1], &lit, &PRINTED, texel);
            let found = page.evaluate(&format!("window.svbrdf.figure.value(1, {seen})"));
            for (found, expected) in found.as_array().unwrap().iter().zip(expected.map(f64::from)) {
                let off = (found.as_f64().unwrap() - expected).abs() / expected.abs().max(1.0);
                assert!(off < PAGE_NUMBERS, "{scene:?} {quantity:?} {cell:?}: {found}, expected {expected}");
            }
        }
    }
}

#[needs(browser)]
#[test]
fn cameras_are_those_of_the_core() {
    let materials = [noise(1)];
    let mut page = Page::open(&figure(&materials, PRINTED), [800, 600]);
    let mut worst = 0.0f64;
    let numbers = |camera: Camera| {
        let Camera { origin, origin_right, origin_up, direction, direction_right, direction_up } = camera;
        [origin, origin_right, origin_up, direction, direction_right, direction_up].map(|v| v.to_array())
    };
    for scene in sample(9, 6, 6, &PRINTED) {
        for projection in ["flat", "perspective"] {
            let state = json!({ "scene": scene, "projection": projection, "zoom": 1.7, "pan": [0.2, -0.3] });
            let found = page.evaluate(&format!(
                "(() => {{ window.svbrdf.figure.set({state}); const c = window.svbrdf.figure.camera(300, 200); \
                 return [c.origin, c.originRight, c.originUp, c.direction, c.directionRight, c.directionUp]; }})()"
            ));
            let grid = materials[0].grid();
            let camera = match projection {
                "flat" => Camera::flat(grid, 1.5),
                _ => Camera::of_scene(&scene, grid, 1.5),
            };
            let expected = numbers(camera.zoomed(1.7, [0.2, -0.3]));
            for (i, expected) in expected.as_flattened().iter().enumerate() {
                let found = found[i / 3][i % 3].as_f64().unwrap();
                let off = (found - f64::from(*expected)).abs() / f64::from(expected.abs()).max(1.0);
                worst = worst.max(off);
                assert!(
                    off < PAGE_CAMERA,
                    "{scene:?} {projection}, number {i}: {found}, expected {expected}"
                );
            }
        }
    }
    println!("largest deviation of a camera: {worst:e}");
}

#[needs(browser)]
#[test]
fn a_fault_planted_in_the_shader_is_seen() {
    let materials = [noise(1)];
    let html = figure(&materials, PRINTED);
    let (right, wrong) = ("* 0.25)", "* 0.26)");
    assert!(html.contains(right), "the factor 1/4 of the lobe");
    let scene = sample(7, 1, 0, &PRINTED)[0];
    let core = rendered(&[&materials[0]], PictureContent::default(), &scene, &PRINTED, 0.0);
    let off = |html: &str| {
        let mut page = Page::open(html, [800, 600]);
        show(&mut page, &scene, Quantity::Rendering, 0.0);
        largest(&picture(&mut page, 0, None), &core[0])
    };
    assert!(off(&html) <= PAGE_PIXELS);
    assert!(off(&html.replace(right, wrong)) > PAGE_PIXELS);
}

#[needs(browser)]
#[test]
fn without_webgl_the_still_picture_stays_with_the_reason() {
    let html = figure(&[noise(1)], PRINTED).replace("#version 300 es", "#version 999");
    let mut page = Page::open(&html, [800, 600]);
    let state = page.evaluate(
        "[document.getElementById('canvas').hidden, document.getElementById('still').complete, \
          document.getElementById('still').naturalWidth, document.getElementById('problem').textContent]",
    );
    assert_eq!([&state[0], &state[1], &state[2]], [&json!(true), &json!(true), &json!(48)]);
    assert!(state[3].as_str().unwrap().contains("a shader cannot be compiled"), "{state}");
}
