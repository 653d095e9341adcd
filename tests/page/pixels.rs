//! Pixels of the figure against those of `svbrdf render`, flat and in perspective; the time of a frame.

use std::collections::BTreeMap;

use serde_json::json;

use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::{self, PRINTED};
use svbrdf_core::model::scene::{Scene, sample};
use svbrdf_core::picture::camera::Camera;
use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_needs::needs;

use super::browser::Page;
use super::numbers::{decoded, pictured, rendered, show};
use super::{built_in, figure, noise};
use crate::support::tolerance::PAGE_PIXELS;

/// Near-field scenes of each convention, and as many distant ones; `SVBRDF_PAGE_SCENES` gives another number.
const SCENES: usize = 4;
/// Of the window, in pixels: after each scene the page draws its panes, which are not looked at.
const SMALL: [u32; 2] = [360, 300];
/// Width and height of the pane in perspective, in pixels.
const PANE: usize = 160;
/// Texels across it, where they face the view.
const ACROSS: f32 = 8.0;

/// How far values of 8 bits are apart: their number, how many differ, and by how much at most.
#[derive(Clone, Copy, Debug, Default)]
struct Agreement {
    values: usize,
    other: usize,
    largest: u8,
}

impl Agreement {
    fn of(page: &[u8], core: &[u8]) -> Self {
        assert_eq!(page.len(), core.len());
        let off: Vec<u8> = page.iter().zip(core).map(|(a, b)| a.abs_diff(*b)).collect();
        let other = off.iter().filter(|off| **off > 0).count();
        Self { values: off.len(), other, largest: off.into_iter().max().unwrap_or_default() }
    }

    fn and(self, other: Self) -> Self {
        Self {
            values: self.values + other.values,
            other: self.other + other.other,
            largest: self.largest.max(other.largest),
        }
    }
}

/// The pane of a material in perspective with `core`, its rendering, wherever a pixel lies within a texel.
fn perspective(
    page: &mut Page,
    index: usize,
    material: &Material<f32>,
    scene: &Scene,
    core: &[[u8; 3]],
) -> Agreement {
    let grid = material.grid();
    let zoom = grid.width as f32 / ACROSS;
    let pixels = decoded(&page.evaluate(&format!(
        "(() => {{ const f = window.svbrdf.figure, box = {{ x: 0, y: 0, width: {PANE}, height: {PANE} }}; \
         f.canvas.width = f.canvas.height = {PANE}; Object.assign(f.state, {{ projection: 'perspective', zoom: {zoom} }}); \
         const pane = {{ material: {index}, difference: null, wipe: null }}; \
         f.shading.pane(pane, f.how(), f.camera(1, 1), box, f.shown(pane)); \
         let text = ''; for (const byte of f.shading.pixels(box)) text += String.fromCharCode(byte); \
         Object.assign(f.state, {{ projection: 'flat', zoom: 1 }}); return btoa(text); }})()"
    )));
    let camera = Camera::of_scene(scene, grid, 1.0).zoomed(zoom, [0.0; 2]);
    let texel = |column: f32, row: f32| {
        let [x, y] = [column, row].map(|pixel| 2.0 * (pixel + 0.5) / PANE as f32 - 1.0);
        let [x, y] = camera.plane_from_ndc(x, y)?;
        let spacings = (grid.width - 1) as f32;
        Some([0.5 * (x * spacings + grid.width as f32), 0.5 * (grid.height as f32 - y * spacings)])
    };
    let mut agreement = Agreement::default();
    for (i, pixel) in pixels.chunks_exact(4).enumerate() {
        let (column, row) = ((i % PANE) as f32, (i / PANE) as f32);
        let [Some(here), Some(right), Some(above)] =
            [texel(column, row), texel(column + 1.0, row), texel(column, row + 1.0)]
        else {
            continue;
        };
        // Pixels that cover more than a texel show the mean of several; neighbours cover a little more or less.
        let covered = |axis: usize| (right[axis] - here[axis]).abs() + (above[axis] - here[axis]).abs();
        let is_within =
            |axis: usize| (0.02..0.98).contains(&here[axis].rem_euclid(1.0)) && covered(axis) < 0.8;
        let inside =
            (0.0..grid.width as f32).contains(&here[0]) && (0.0..grid.height as f32).contains(&here[1]);
        if inside && is_within(0) && is_within(1) {
            let texel = here[1] as usize * grid.width + here[0] as usize;
            agreement = agreement.and(Agreement::of(&pixel[..3], &core[texel]));
        }
    }
    agreement
}

/// Every n-th texel of every n-th row: values as they are stored, and a sixteenth of the time of a page.
pub fn sparse(material: &Material<f32>, every: usize) -> Material<f32> {
    let (width, planes) = (material.width(), material.planes());
    let of = |plane: &Vec<f32>| -> Vec<f32> {
        let rows = plane.chunks(width).step_by(every);
        rows.flat_map(|row| row.iter().step_by(every)).copied().collect()
    };
    let three = |planes: &[Vec<f32>; 3]| planes.each_ref().map(of);
    let planes = Planes {
        normal: three(&planes.normal),
        diffuse: three(&planes.diffuse),
        specular: three(&planes.specular),
        roughness: of(&planes.roughness),
    };
    let [width, height] = material.size().map(|side| side.div_ceil(every));
    Material::new(material.name(), width, height, planes).unwrap()
}

#[needs(browser)]
#[test]
fn pixels_are_those_of_render_in_every_convention() {
    let scenes = std::env::var("SVBRDF_PAGE_SCENES").ok().and_then(|n| n.parse().ok()).unwrap_or(SCENES);
    let (built_in, noises) =
        (built_in().iter().map(|one| sparse(one, 4)).collect::<Vec<_>>(), [noise(1), noise(2)]);
    let mut table = BTreeMap::new();
    for materials in [built_in.as_slice(), &noises] {
        let refs: Vec<&Material<f32>> = materials.iter().collect();
        // A member of the grammar is drawn as the nearest one.
        for convention in convention::ALL.into_iter().chain(["gltf-viewer".parse().unwrap()]) {
            let mut page = Page::open(&figure(materials, convention), SMALL);
            for (i, scene) in sample(7, scenes, scenes, &convention).iter().enumerate() {
                let exposure = [0.0, 2.0, -1.5][i % 3];
                show(&mut page, scene, Quantity::Rendering, exposure);
                let index = i % materials.len();
                let core = rendered(
                    &refs[index..=index],
                    PictureContent::default(),
                    scene,
                    &convention.drawn(),
                    exposure,
                );
                let perspective = perspective(&mut page, index, &materials[index], scene, &core[0]);
                assert!(perspective.values > 1500, "{scene:?}: {perspective:?}");
                let flat = decoded(&page.evaluate(&pictured(index, None)));
                let flat = Agreement::of(&flat, core[0].as_flattened());
                for (projection, agreement) in [("flat", flat), ("perspective", perspective)] {
                    let named = format!("{}, {:?}, {projection}", convention.name, scene.kind);
                    assert!(agreement.largest <= PAGE_PIXELS, "{named}: {scene:?}: {agreement:?}");
                    let merged = table.get(&named).map_or(agreement, |one: &Agreement| one.and(agreement));
                    table.insert(named, merged);
                }
            }
        }
    }
    for (named, Agreement { values, other, largest }) in table {
        println!("{named}: {largest} of 255 at most, {other} of {values} values");
    }
}

/// Draws until the pixels are there, and prints the time in milliseconds.
#[test]
#[ignore = "a measurement: cargo test --test main time_of_a_frame -- --ignored --nocapture"]
fn time_of_a_frame() {
    let mut page = Page::open(&figure(&built_in(), PRINTED), [1366, 768]);
    let times = page.evaluate(
        "(() => { const f = window.svbrdf.figure, times = []; \
         for (let i = 0; i < 40; i++) { f.state.scene.light[0] = 0.01 * i; const start = performance.now(); \
         f.draw(); f.shading.pixels({ x: 0, y: 0, width: 1, height: 1 }); times.push(performance.now() - start); } \
         times.sort((a, b) => a - b); return [f.panes().length, times[2], times[20], times[37]]; })()",
    );
    assert_eq!(times[0], json!(3));
    println!("median {}, from {} to {} ms", times[2], times[1], times[3]);
}
