//! Pass 2: what a window would show.

mod differences;

use glam::Vec3;

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::camera::Camera;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_gpu::{DisplayMode, DisplayParams, Encoding, Gpu, ShadeParams, Shaded};
use svbrdf_needs::needs;

use crate::support::gpu::{BACKGROUND, Picture, bumpy, from_above, gpu, gpu_f32, picture, shaded_by};
use crate::support::tolerance::SCREEN_LEVELS;

/// Light and view straight above.
const ABOVE: Scene = Scene { kind: Kind::Distant, view: [0.0, 0.0, 1.0], light: [0.0, 0.0, 1.0] };

fn shaded(gpu: &Gpu, material: &Material<f32>, quantity: Quantity) -> Shaded {
    shaded_by(gpu, material, &ShadeParams { scene: ABOVE, convention: PRINTED, quantity })
}

/// The whole map of a quantity, to the outer edges of its texels.
fn whole(size: [usize; 2], quantity: Quantity) -> DisplayParams {
    let half = |side: usize| side as f32 / size[0].saturating_sub(1).max(1) as f32;
    from_above(size.map(half), Encoding::from(quantity))
}

fn srgb(linear: f64) -> f64 {
    let x = linear.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

fn levels(encoded: [f64; 3]) -> [u8; 3] {
    encoded.map(|x| (255.0 * x).round() as u8)
}

fn close(got: [u8; 3], expected: [u8; 3]) -> bool {
    got.iter().zip(expected).all(|(got, expected)| got.abs_diff(expected) <= SCREEN_LEVELS)
}

/// What of `picture` is not `expected(column, row)`, where that says anything.
fn faults(picture: &Picture, expected: impl Fn(usize, usize) -> Option<[u8; 3]>) -> Vec<String> {
    let place = |i: usize| (i % picture.width, i / picture.width);
    let fault = |(column, row): (usize, usize)| {
        let (got, expected) = (picture.at(column, row), expected(column, row)?);
        (!close(got, expected)).then(|| format!("({column}, {row}): {got:?}, expected {expected:?}"))
    };
    (0..picture.pixels.len()).map(place).filter_map(fault).collect()
}

fn diffuse(material: &Material<f32>, column: usize, row: usize) -> [f64; 3] {
    material.texel(row * material.width() + column).diffuse.map(f64::from)
}

fn gray(value: f32) -> Material<f32> {
    let texel = Texel { normal: Vec3::Z, diffuse: [value; 3], specular: [0.0; 3], roughness: value };
    Material::uniform("gray", 4, 4, &texel).expect("valid")
}

#[needs(adapter)]
fn known_values_are_encoded_as_the_standard_says() {
    let gpu = gpu();
    let known = [(0.0, 0, 0), (0.002, 7, 1), (0.2, 124, 51), (0.5, 188, 128), (1.0, 255, 255)];
    for (value, as_albedo, as_data) in known {
        for (shown, level) in [(Quantity::Diffuse, as_albedo), (Quantity::Roughness, as_data)] {
            let shaded = shaded(gpu, &gray(value), shown);
            let picture = picture(gpu, [4, 4], &shaded, &shaded, &whole([4, 4], shown));
            assert!(picture.at(1, 1)[0].abs_diff(level) <= SCREEN_LEVELS, "{value}: {:?}", picture.at(1, 1));
        }
    }
}

#[needs(f32_adapter)]
fn radiance_is_exposed_before_it_is_encoded() {
    let gpu = gpu_f32();
    let material = gray(0.3);
    let shaded = shaded(gpu, &material, Quantity::Rendering);
    let on_gpu = shaded.read_back(gpu).expect("read back").pixels[0];
    for exposure_ev in [-3.0_f32, 0.0, 1.0, 2.0] {
        let params = DisplayParams { exposure_ev, ..whole([4, 4], Quantity::Rendering) };
        let picture = picture(gpu, [4, 4], &shaded, &shaded, &params);
        let expected = on_gpu.map(|x| srgb(f64::from(x * exposure_ev.exp2())));
        assert!(close(picture.at(2, 1), levels(expected)), "{exposure_ev}: {:?}", picture.at(2, 1));
    }
}

#[needs(adapter)]
fn every_texel_is_crisp_and_in_its_place_when_magnified() {
    let gpu = gpu();
    for size in [[5, 3], [4, 4], [1, 1], [1, 3], [3, 1], [16, 9]] {
        let material = bumpy(size[0], size[1]);
        let shaded = shaded(gpu, &material, Quantity::Diffuse);
        for zoom in [1, 2, 3, 7] {
            let pane = size.map(|side| (side * zoom) as u32);
            let picture = picture(gpu, pane, &shaded, &shaded, &whole(size, Quantity::Diffuse));
            let expected = |column: usize, row: usize| {
                Some(levels(diffuse(&material, column / zoom, row / zoom).map(srgb)))
            };
            let faults = faults(&picture, expected);
            assert!(faults.is_empty(), "{size:?} at zoom {zoom}: {faults:#?}");
        }
    }
}

#[needs(adapter)]
fn the_comparison_of_pictures_goes_red_on_planted_faults() {
    let gpu = gpu();
    let material = bumpy(6, 6);
    let shaded = shaded(gpu, &material, Quantity::Diffuse);
    let picture = picture(gpu, [6, 6], &shaded, &shaded, &whole([6, 6], Quantity::Diffuse));
    let planted = |from: fn(usize, usize) -> (usize, usize)| {
        let texel = |(column, row): (usize, usize)| levels(diffuse(&material, column, row).map(srgb));
        faults(&picture, |column, row| Some(texel(from(column, row))))
    };
    assert_eq!(planted(|column, row| (column, row)), Vec::<String>::new());
    assert!(!planted(|column, row| (5 - column, row)).is_empty());
    assert!(!planted(|column, row| (column, 5 - row)).is_empty());
    assert!(!planted(|column, row| (row, column)).is_empty());
    assert_eq!(planted(|column, row| if (column, row) == (2, 3) { (0, 0) } else { (column, row) }).len(), 1);
}

#[needs(adapter)]
fn a_perspective_view_shows_what_the_camera_says() {
    let gpu = gpu();
    let camera = Camera {
        origin: Vec3::new(0.3, -2.0, 1.5),
        origin_right: Vec3::ZERO,
        origin_up: Vec3::ZERO,
        direction: Vec3::new(-0.1, 1.0, -0.75),
        direction_right: Vec3::new(0.9, 0.1, 0.0),
        direction_up: Vec3::new(0.0, 0.6, 0.8),
    };
    let (size, pane) = ([6, 4], [200, 160]);
    let material = bumpy(size[0], size[1]);
    let shaded = shaded(gpu, &material, Quantity::Diffuse);
    let picture =
        picture(gpu, pane, &shaded, &shaded, &DisplayParams { camera, ..whole(size, Quantity::Diffuse) });
    let background = levels(BACKGROUND.map(f64::from));
    let expected = |column: usize, row: usize| {
        let x = (2 * column + 1) as f32 / pane[0] as f32 - 1.0;
        let y = 1.0 - (2 * row + 1) as f32 / pane[1] as f32;
        let Some([x, y]) = camera.plane_from_ndc(x, y) else { return Some(background) };
        let place = [0.5 * (5.0 * x + 6.0), 0.5 * (4.0 - 5.0 * y)];
        // At the edge of a texel rounding decides.
        if place.iter().any(|p| (p - p.round()).abs() < 1e-3) {
            return None;
        }
        if place[0] < 0.0 || place[1] < 0.0 || place[0] >= 6.0 || place[1] >= 4.0 {
            return Some(background);
        }
        Some(levels(diffuse(&material, place[0] as usize, place[1] as usize).map(srgb)))
    };
    let faults = faults(&picture, expected);
    assert!(faults.is_empty(), "{} faults: {:#?}", faults.len(), &faults[..faults.len().min(9)]);
    let shows_background = |row: usize| (0..200).any(|column| close(picture.at(column, row), background));
    assert!(shows_background(0) && (0..160).any(|row| !close(picture.at(100, row), background)));
}

/// The mean of what pixel (column, row) of `pane` covers of the whole map, by overlap.
fn box_average(material: &Material<f32>, pane: [usize; 2], column: usize, row: usize) -> [f64; 3] {
    let overlap = |texel: usize, pixel: usize, texels: usize, pixels: usize| {
        let step = texels as f64 / pixels as f64;
        let (low, high) = (pixel as f64 * step, (pixel + 1) as f64 * step);
        (high.min(texel as f64 + 1.0) - low.max(texel as f64)).max(0.0) / step
    };
    let [width, height] = material.size();
    let mut mean = [0.0; 3];
    for index in 0..width * height {
        let weight =
            overlap(index % width, column, width, pane[0]) * overlap(index / width, row, height, pane[1]);
        let texel = diffuse(material, index % width, index / width);
        mean = [0, 1, 2].map(|c| mean[c] + weight * texel[c]);
    }
    mean
}

#[needs(adapter)]
fn what_a_pixel_covers_is_averaged_before_it_is_encoded_when_minified() {
    let gpu = gpu();
    for (size, pane) in
        [([8, 8], [2, 2]), ([6, 9], [4, 6]), ([7, 7], [3, 3]), ([32, 32], [2, 2]), ([90, 60], [9, 6])]
    {
        let material = bumpy(size[0], size[1]);
        let shaded = shaded(gpu, &material, Quantity::Diffuse);
        // Positions that are rounded as other adapters do: footprints reach a little beyond their texels, or end before.
        for rounding in [0.0, 1e-6, -1e-6, 4e-6] {
            let half = |side: usize| (1.0 + rounding) * side as f32 / (size[0] - 1) as f32;
            let params = from_above(size.map(half), Encoding::from(Quantity::Diffuse));
            let picture = picture(gpu, pane.map(|side| side as u32), &shaded, &shaded, &params);
            let faults = faults(&picture, |c, r| Some(levels(box_average(&material, pane, c, r).map(srgb))));
            assert!(faults.is_empty(), "{size:?} in {pane:?}, {rounding}: {faults:#?}");
        }
    }
}

#[needs(adapter)]
fn a_very_large_map_is_averaged_with_a_stride() {
    let gpu = gpu();
    let material = bumpy(400, 400);
    let shaded = shaded(gpu, &material, Quantity::Diffuse);
    let picture = picture(gpu, [4, 4], &shaded, &shaded, &whole([400, 400], Quantity::Diffuse));
    for (column, row) in [(0, 0), (3, 0), (0, 3), (3, 3)] {
        let expected = levels(box_average(&material, [4, 4], column, row).map(srgb));
        let got = picture.at(column, row);
        // 15 of 100 texels along either axis: a few levels.
        assert!(got.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 6), "{got:?}, expected {expected:?}");
    }
}

#[needs(adapter)]
fn a_wipe_shows_the_reference_on_the_left() {
    let gpu = gpu();
    let white = shaded(gpu, &gray(1.0), Quantity::Diffuse);
    let black = shaded(gpu, &gray(0.0), Quantity::Diffuse);
    for (x, reference_columns) in [(-1.0, 0), (-0.5, 2), (0.0, 4), (0.5, 6), (1.0, 8)] {
        let params = DisplayParams { mode: DisplayMode::Wipe(x), ..whole([4, 4], Quantity::Diffuse) };
        let picture = picture(gpu, [8, 8], &white, &black, &params);
        let expected = |column: usize, _| Some([if column < reference_columns { 0 } else { 255 }; 3]);
        assert_eq!(faults(&picture, expected), Vec::<String>::new(), "wipe at {x}");
    }
}

#[needs(adapter)]
fn clipped_pixels_are_striped_on_demand() {
    let gpu = gpu();
    let striped = |value: f32, exposure_ev: f32, show_clipping: bool| {
        let shaded = shaded(gpu, &gray(value), Quantity::Rendering);
        let params = DisplayParams { exposure_ev, show_clipping, ..whole([4, 4], Quantity::Rendering) };
        let picture = picture(gpu, [16, 16], &shaded, &shaded, &params);
        picture.pixels.iter().filter(|p| p[0] != p[1] || p[1] != p[2]).count()
    };
    assert_eq!(striped(0.9, 0.0, true), 0);
    assert_eq!(striped(0.9, 9.0, false), 0);
    assert_eq!(striped(0.9, 9.0, true), 128);
}

#[needs(adapter)]
fn a_draft_shows_the_nearest_texel_where_a_pixel_covers_several() {
    let gpu = gpu();
    let size = [15, 9];
    let material = bumpy(size[0], size[1]);
    let shaded = shaded(gpu, &material, Quantity::Diffuse);
    let faults = |nearest| {
        let params = DisplayParams { nearest, ..whole(size, Quantity::Diffuse) };
        let picture = picture(gpu, [5, 3], &shaded, &shaded, &params);
        faults(&picture, |column, row| {
            Some(levels(diffuse(&material, 3 * column + 1, 3 * row + 1).map(srgb)))
        })
    };
    assert_eq!(faults(true), Vec::<String>::new());
    assert!(faults(false).len() > 7, "means are shown otherwise");
}
