//! Pixels, differences and cameras of the page against those of the core.

use base64::Engine as _;
use serde_json::{Value, json};

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::{ALL, Convention, PRINTED};
use svbrdf_core::model::scene::{Scene, sample};
use svbrdf_core::picture::camera::Camera;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent};
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::progress::Progress;

use super::browser::Page;
use super::{built_in, figure, noise};
use crate::support::tolerance::{PAGE_CAMERA, PAGE_NUMBERS, PAGE_PIXELS};

/// Scenes of each convention.
const SCENES: [usize; 2] = [10, 10];

/// Shows a scene in the flat view of the page, at an exposure.
fn show(page: &mut Page, scene: &Scene, quantity: Quantity, exposure: f32) {
    page.evaluate(&showing(scene, quantity, exposure));
}

/// The expression for [`show`].
pub fn showing(scene: &Scene, quantity: Quantity, exposure: f32) -> String {
    let state = json!({ "scene": scene, "quantity": quantity.name(), "exposure": exposure });
    format!("window.svbrdf.figure.set({state})")
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
pub fn largest(page: &[u8], core: &[[u8; 3]]) -> u8 {
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

/// Width and height of the pane in perspective, in pixels.
const PANE: usize = 160;
/// Texels across it, where they face the view.
const ACROSS: f32 = 8.0;

/// Compares the pane of a material in perspective with `core`, its rendering, wherever a pixel lies within a texel: the largest
/// difference and the number of pixels.
fn in_perspective(
    page: &mut Page,
    index: usize,
    material: &Material<f32>,
    scene: &Scene,
    core: &[[u8; 3]],
) -> (u8, usize) {
    let zoom = material.grid().width as f32 / ACROSS;
    let pixels = decoded(&page.evaluate(&format!(
        "(() => {{ const f = window.svbrdf.figure, box = {{ x: 0, y: 0, width: {PANE}, height: {PANE} }}; \
         f.canvas.width = f.canvas.height = {PANE}; Object.assign(f.state, {{ projection: 'perspective', zoom: {zoom} }}); \
         f.shading.pane({{ material: {index}, difference: null, wipe: null }}, f.how(), f.camera(1, 1), box, f.shown()); \
         let text = ''; for (const byte of f.shading.pixels(box)) text += String.fromCharCode(byte); \
         Object.assign(f.state, {{ projection: 'flat', zoom: 1 }}); return btoa(text); }})()"
    )));
    let grid = material.grid();
    let camera = Camera::of_scene(scene, grid, 1.0).zoomed(zoom, [0.0; 2]);
    let texel = |column: f32, row: f32| {
        let [x, y] = [column, row].map(|pixel| 2.0 * (pixel + 0.5) / PANE as f32 - 1.0);
        let [x, y] = camera.plane_from_ndc(x, y)?;
        let spacings = (grid.width - 1) as f32;
        Some([0.5 * (x * spacings + grid.width as f32), 0.5 * (grid.height as f32 - y * spacings)])
    };
    let (mut off, mut compared) = (0, 0);
    for (i, pixel) in pixels.chunks_exact(4).enumerate() {
        let (column, row) = ((i % PANE) as f32, (i / PANE) as f32);
        let [Some(here), Some(right), Some(above)] =
            [texel(column, row), texel(column + 1.0, row), texel(column, row + 1.0)]
        else {
            continue;
        };
        let covered = |axis: usize| (right[axis] - here[axis]).abs() + (above[axis] - here[axis]).abs();
        let is_within =
            |axis: usize| (0.02..0.98).contains(&here[axis].rem_euclid(1.0)) && covered(axis) < 0.8;
        let inside =
            (0.0..grid.width as f32).contains(&here[0]) && (0.0..grid.height as f32).contains(&here[1]);
        if inside && is_within(0) && is_within(1) {
            let expected = core[here[1] as usize * grid.width + here[0] as usize];
            off = off.max((0..3).map(|c| pixel[c].abs_diff(expected[c])).max().unwrap());
            compared += 1;
        }
    }
    (off, compared)
}

#[test]
#[cfg_attr(not(has_browser), ignore = "needs chromium, which is not installed")]
fn pixels_are_those_of_render_in_every_convention() {
    let (built_in, noises) = (built_in(), [noise(1), noise(2)]);
    let (mut other, mut all, mut perspective) = (0, 0, 0);
    for materials in [built_in.as_slice(), &noises] {
        let refs: Vec<&Material<f32>> = materials.iter().collect();
        for convention in ALL {
            let mut page = Page::open(&figure(materials, convention), [800, 600]);
            for (i, scene) in sample(7, SCENES[0], SCENES[1], &convention).iter().enumerate() {
                let exposure = [0.0, 2.0, -1.5][i % 3];
                show(&mut page, scene, Quantity::Rendering, exposure);
                let index = i % materials.len();
                let core =
                    rendered(&refs[index..=index], PictureContent::default(), scene, &convention, exposure);
                let pixels = picture(&mut page, index, None);
                let off = largest(&pixels, &core[0]);
                other += pixels.iter().zip(core[0].as_flattened()).filter(|(a, b)| a != b).count();
                all += pixels.len();
                assert!(off <= PAGE_PIXELS, "{}: {scene:?}: off by {off}", convention.name);
                let (off, compared) = in_perspective(&mut page, index, &materials[index], scene, &core[0]);
                assert!(off <= PAGE_PIXELS, "{}: {scene:?} in perspective: off by {off}", convention.name);
                assert!(compared > 500, "{scene:?}: {compared} pixels in perspective lie within a texel");
                perspective += compared;
            }
        }
    }
    println!("{other} of {all} values differ by a step; {perspective} pixels in perspective");
}

#[test]
#[cfg_attr(not(has_browser), ignore = "needs chromium, which is not installed")]
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

#[test]
#[cfg_attr(not(has_browser), ignore = "needs chromium, which is not installed")]
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
                    let place = json!(texel);
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

#[test]
#[cfg_attr(not(has_browser), ignore = "needs chromium, which is not installed")]
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

#[test]
#[cfg_attr(not(has_browser), ignore = "needs chromium, which is not installed")]
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

#[test]
#[cfg_attr(not(has_browser), ignore = "needs chromium, which is not installed")]
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
