//! Pixels, differences and cameras of the page against those of the core.

use std::collections::BTreeMap;

use base64::Engine as _;
use serde_json::json;

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::{self, Convention, PRINTED};
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
fn show(page: &mut Page, scene: &Scene, quantity: Quantity, exposure: f32) {
    let state = json!({ "scene": scene, "quantity": quantity.name(), "exposure": exposure });
    page.evaluate(&format!("window.svbrdf.figure.set({state})"));
}

/// The 8-bit picture of a material in the page, a pixel for each texel.
fn picture(page: &mut Page, material: usize, difference: Option<Difference>) -> Vec<u8> {
    let difference = json!(difference.map(Difference::key));
    let text = page.evaluate(&format!(
        "(() => {{ const figure = window.svbrdf.figure, {{ canvas, shading, grid: {{ width, height }} }} = figure; \
         [canvas.width, canvas.height] = [width, height]; \
         const box = {{ x: 0, y: 0, width, height }}, s = Math.max(width, 2) - 1; \
         const camera = {{ origin: [0, 0], half: [width / s, height / s] }}; \
         shading.pane({{ material: {material}, difference: {difference}, wipe: null }}, figure.how(), camera, box, figure.shown()); \
         const pixels = new Uint8Array(4 * width * height); \
         shading.gl.readPixels(0, 0, width, height, shading.gl.RGBA, shading.gl.UNSIGNED_BYTE, pixels); figure.changed(); \
         let text = ''; for (const byte of pixels) text += String.fromCharCode(byte); return btoa(text); }})()"
    ));
    let pixels = base64::prelude::BASE64_STANDARD.decode(text.as_str().unwrap()).unwrap();
    let width = page.evaluate("window.svbrdf.figure.grid.width").as_u64().unwrap() as usize;
    let rows = pixels.chunks(4 * width).rev();
    rows.flat_map(|row| row.chunks(4).flat_map(|rgba| rgba[..3].to_vec())).collect()
}

/// Makes this the difference of a quantity.
fn choose(page: &mut Page, quantity: Quantity, kind: Difference) {
    let chosen = json!({ "key": kind.key(), "name": kind.name(), "unit": kind.unit(), "signed": kind.is_signed(), "range": kind.default_range() });
    page.evaluate(&format!("window.svbrdf.figure.data.kinds[{:?}] = {chosen}", quantity.name()));
}

/// The largest difference of two pictures, in steps of 8 bits.
fn largest(page: &[u8], core: &[[u8; 3]]) -> u8 {
    assert_eq!(page.len(), 3 * core.len());
    page.iter().zip(core.as_flattened()).map(|(a, b)| a.abs_diff(*b)).max().unwrap()
}

/// What `svbrdf render` writes.
fn rendered(
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

/// Near-field scenes of each convention, and as many distant ones; `SVBRDF_PAGE_SCENES` gives another number.
const SCENES: usize = 4;

/// Every fourth texel of every fourth row: values as they are stored, and a sixteenth of the time of a page.
fn sparse(material: &Material<f32>) -> Material<f32> {
    let [width, height] = material.size().map(|side| side / 4);
    let texels: Vec<usize> =
        (0..width * height).map(|i| 4 * (i / width) * material.width() + 4 * (i % width)).collect();
    material.gathered(&texels, [width, height])
}

#[needs(browser)]
fn pixels_are_those_of_render_in_every_convention() {
    let scenes = std::env::var("SVBRDF_PAGE_SCENES").ok().and_then(|n| n.parse().ok()).unwrap_or(SCENES);
    let built_in: Vec<_> = built_in().iter().map(sparse).collect();
    let noises = [noise(1), noise(2)];
    let mut table = BTreeMap::new();
    for materials in [built_in.as_slice(), &noises] {
        // A member of the grammar is drawn as the nearest one.
        for convention in convention::ALL.into_iter().chain(["gltf-viewer".parse().unwrap()]) {
            let mut page = Page::open(&figure(materials, convention), [360, 300]);
            for (i, scene) in sample(7, scenes, scenes, &convention).iter().enumerate() {
                let exposure = [0.0, 2.0, -1.5][i % 3];
                show(&mut page, scene, Quantity::Rendering, exposure);
                let index = i % materials.len();
                let content = PictureContent::default();
                let core = rendered(&[&materials[index]], content, scene, &convention.drawn(), exposure);
                let page = picture(&mut page, index, None);
                let named = format!("{}, {:?}", convention.name, scene.kind);
                let off = largest(&page, &core[0]);
                assert!(off <= PAGE_PIXELS, "{named}: {scene:?}: off by {off}");
                let differing = page.iter().zip(core[0].as_flattened()).filter(|(a, b)| a != b).count();
                let sum: &mut [usize; 3] = table.entry(named).or_default();
                *sum = [sum[0].max(off.into()), sum[1] + differing, sum[2] + page.len()];
            }
        }
    }
    for (named, [largest, differing, values]) in table {
        println!("{named}: {largest} of 255 at most, {differing} of {values} values");
    }
}

#[needs(browser)]
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
            choose(&mut page, quantity, *kind);
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
fn readouts_are_those_of_the_core() {
    let materials = [noise(1), noise(2)];
    let mut page = Page::open(&figure(&materials, PRINTED), [800, 600]);
    let mut worst = 0.0f64;
    for scene in sample(5, 4, 4, &PRINTED) {
        for quantity in Quantity::ALL {
            show(&mut page, &scene, quantity, 0.0);
            for kind in Difference::pointwise(quantity) {
                choose(&mut page, quantity, *kind);
                for texel in [[0, 0], [47, 0], [5, 31], [20, 20]] {
                    let [g, p] = [0, 1].map(|i| quantity.at(&materials[i], &scene, &PRINTED, texel));
                    let at = json!(texel);
                    let found = page.evaluate(&format!(
                        "[...window.svbrdf.figure.value(1, {at}), window.svbrdf.figure.difference(1, {at})]"
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

#[needs(browser)]
fn the_camera_and_the_texels_below_it_are_those_of_the_core() {
    let material = noise(1);
    let mut page = Page::open(&figure(&[noise(1)], PRINTED), [800, 600]);
    let found = page.evaluate(
        "(() => { window.svbrdf.figure.set({ zoom: 1.7, pan: [0.2, -0.3] }); \
         const { origin, half } = window.svbrdf.figure.camera(300, 200); return [...origin, ...half]; })()",
    );
    let Camera { origin, origin_right, origin_up, .. } =
        Camera::flat(material.grid(), 1.5).zoomed(1.7, [0.2, -0.3]);
    for (i, expected) in [origin.x, origin.y, origin_right.x, origin_up.y].into_iter().enumerate() {
        let off = (found[i].as_f64().unwrap() - f64::from(expected)).abs();
        assert!(off < PAGE_CAMERA, "number {i}: {found}, expected {expected}");
    }
    let [half_width, half_height] = material.grid().half_extent().map(f64::from);
    for (point, texel) in [
        ([0.01 - half_width, half_height - 0.01], json!([0, 0])),
        ([half_width - 0.01, -0.01], json!([47, 24])),
        ([half_width + 0.01, 0.0], json!(null)),
        ([0.0, half_height + 0.01], json!(null)),
    ] {
        let point = json!(point);
        let expression = format!("window.svbrdf.figure.texel({point})");
        assert_eq!(page.evaluate(&expression), texel, "{point}");
    }
}

#[needs(browser)]
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
