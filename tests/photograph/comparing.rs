//! Known corners, factor, light and material.

use glam::{DMat3, DVec3};

use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::{Model, Texel, render};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_evaluate::photograph::{PhotographComparison, flash};
use svbrdf_files::Error;
use svbrdf_files::photograph::Corners;

use super::{SCENE, compared, glossy, photograph, rectified, small};
use crate::support::tolerance::{PHOTOGRAPH_FACTOR, PHOTOGRAPH_LOG};

const CORNERS: Corners = Corners([[60.5, 40.25], [610.0, 75.5], [660.0, 470.0], [30.0, 430.0]]);

fn mean(compared: &PhotographComparison) -> f64 {
    compared.statistics(Difference::Log).unwrap().mean
}

/// The matrix that maps three basis vectors and (1, 1, 1) to four points, each up to a factor.
fn basis(points: [[f64; 2]; 4]) -> DMat3 {
    let [a, b, c, d] = points.map(|[x, y]| DVec3::new(x, y, 1.0));
    let three = DMat3::from_cols(a, b, c);
    three * DMat3::from_diagonal(three.inverse() * d)
}

/// The photograph of a plane of one texel within `corners`, 1 / `factor` as bright as its rendering. The plane goes on beyond
/// the corners.
fn pictured(material: &Material<f32>, corners: &Corners, factor: f64) -> svbrdf_files::read::Photograph {
    let unit = basis([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let from_pixel = unit * basis(corners.0).inverse();
    let [half_width, half_height] = material.grid().half_extent().map(f64::from);
    let texel = material.cast::<f64>().texel(0);
    photograph(700, 500, |x, y| {
        let p = from_pixel * DVec3::new(x as f64 + 0.5, y as f64 + 0.5, 1.0);
        let [s, t] = [p.x / p.z, p.y / p.z];
        let place = DVec3::new((2.0 * s - 1.0) * half_width, (1.0 - 2.0 * t) * half_height, 0.0);
        let (w_l, w_v) = SCENE.rays::<f64>().from_texel(place);
        render(&Model::from(&PRINTED), &texel, w_l, w_v).map(|value| (value / factor) as f32)
    })
}

#[test]
fn a_photograph_of_known_corners_light_and_exposure_gives_them_back() {
    let material = glossy(0.35);
    let photograph = pictured(&material, &CORNERS, 0.37);
    let right = compared(&rectified(&photograph, &CORNERS, &material), &material);
    assert!((right.factor / 0.37 - 1.0).abs() < PHOTOGRAPH_FACTOR, "{}", right.factor);
    assert!((right.exposure_ev() - 0.37_f64.log2()).abs() < 1e-3);
    assert!(mean(&right) < PHOTOGRAPH_LOG, "{}", mean(&right));
    for kind in [Difference::Absolute, Difference::Relative] {
        let statistics = right.statistics(kind).unwrap();
        assert!(statistics.p95 < 10.0 * PHOTOGRAPH_LOG, "{kind:?}: {statistics:?}");
    }

    // Planted faults: another roughness, a corner that is 12 pixels off, corners turned by a quarter, another light.
    let wrong = compared(&rectified(&photograph, &CORNERS, &material), &glossy(0.45));
    let mut corners = CORNERS;
    corners.0[1][0] -= 12.0;
    let shifted = compared(&rectified(&photograph, &corners, &material), &material);
    let [a, b, c, d] = CORNERS.0;
    let turned = compared(&rectified(&photograph, &Corners([b, c, d, a]), &material), &material);
    let dim = rectified(&photograph, &CORNERS, &material);
    let light = Scene { light: [-0.5, 0.3, 1.6], ..SCENE };
    let lit = dim.compare(&material, &light, &PRINTED, &Progress::default()).unwrap();
    for fault in [wrong, shifted, turned, lit] {
        assert!(mean(&fault) > 10.0 * mean(&right), "{} against {}", mean(&fault), mean(&right));
    }
}

/// Of 3 x 3 pixels a texel, with a pattern that averages out, in a bright frame.
#[test]
fn a_larger_photograph_is_averaged_over_each_texel_and_ranks_the_right_material_first() {
    let [truth, blurred, rough] = small();
    let rendering = render_f32(&truth, &SCENE, &PRINTED, &Progress::default()).unwrap();
    let photograph = photograph(64 * 3 + 20, 64 * 3 + 9, |x, y| {
        let (Some(x), Some(y)) = (x.checked_sub(7), y.checked_sub(5)) else { return [99.0; 3] };
        let (column, row) = (x / 3, y / 3);
        if column > 63 || row > 63 {
            return [99.0; 3];
        }
        let sign = if (column + row).is_multiple_of(2) { 1.0 } else { -1.0 };
        let pattern = 1.0 + sign * if (x % 3, y % 3) == (1, 1) { 0.8 } else { -0.1 };
        rendering.pixels[row * 64 + column].map(|value| 4.0 * pattern * value)
    });
    let corners = Corners([[7.0, 5.0], [199.0, 5.0], [199.0, 197.0], [7.0, 197.0]]);
    let rectified = rectified(&photograph, &corners, &truth);
    let right = compared(&rectified, &truth);
    assert!((right.factor / 0.25 - 1.0).abs() < 1e-5, "{}", right.factor);
    assert!(right.statistics(Difference::Log).unwrap().maximum < 1e-5);
    for wrong in [&blurred, &rough] {
        let wrong = compared(&rectified, wrong);
        assert!(mean(&wrong) > 0.02 && mean(&wrong) > 1e3 * mean(&right), "{}", mean(&wrong));
    }
}

#[test]
fn a_photograph_of_the_size_of_the_material_is_taken_as_it_is() {
    let [truth, ..] = small();
    let rendering = render_f32(&truth, &SCENE, &PRINTED, &Progress::default()).unwrap();
    let photograph = photograph(64, 64, |x, y| rendering.pixels[y * 64 + x]);
    let rectified = rectified(&photograph, &Corners::whole([64, 64]), &truth);
    assert_eq!(rectified.image, rendering);
    let compared = compared(&rectified, &truth);
    assert_eq!(compared.factor, 1.0);
    assert!(compared.differences(Difference::Log).iter().all(|difference| *difference == 0.0));
}

#[test]
fn clipped_texels_are_counted_and_left_out_of_the_fit_and_of_every_difference() {
    let [truth, ..] = small();
    let rendering = render_f32(&truth, &SCENE, &PRINTED, &Progress::default()).unwrap();
    let limit = 0.3;
    let mut picture = photograph(64, 64, |x, y| rendering.pixels[y * 64 + x].map(|value| value.min(limit)));
    let clips: Vec<bool> = rendering.pixels.iter().map(|rgb| rgb.iter().any(|v| *v >= limit)).collect();
    let count = clips.iter().filter(|clips| **clips).count();
    assert!((40..2000).contains(&count), "{count}");
    let whole = Corners::whole([64, 64]);
    // A planted fault: clipped pixels that nobody marks.
    let unmarked = compared(&rectified(&picture, &whole, &truth), &truth);
    picture.clipped = clips;
    let marked = rectified(&picture, &whole, &truth);
    assert_eq!(marked.clipped(), count);
    assert!((marked.clipped_share() - count as f64 / 4096.0).abs() < 1e-12);
    let compared = compared(&marked, &truth);
    let statistics = compared.statistics(Difference::Log).unwrap();
    assert_eq!((compared.factor, statistics.not_finite, statistics.maximum), (1.0, count, 0.0));
    assert!(mean(&unmarked) > 1e-3);
}

#[test]
fn the_falloff_of_a_point_light_is_divided_out() {
    let normal = [0.0, 0.0, 1.0].into();
    let texel = Texel { normal, diffuse: [0.5; 3], specular: [0.0; 3], roughness: 1.0 };
    let material = Material::uniform("matte", 32, 32, &texel).unwrap();
    // Of a physical light: the cosine of incidence over the square of the distance.
    let light = DVec3::from(SCENE.light);
    let photograph = photograph(32, 32, |x, y| {
        let to_light = light - material.grid().position::<DVec3>(x, y);
        [(to_light.normalize().z / to_light.length_squared()) as f32; 3]
    });
    let rectified = rectified(&photograph, &Corners::whole([32, 32]), &material);
    let with = compared(&rectified, &material);
    let without = compared(&rectified.without_falloff(&SCENE), &material);
    // The Fresnel term of a black specular map remains.
    let off = without.statistics(Difference::Relative).unwrap().maximum;
    assert!(off < 2e-3 && mean(&with) > 0.05, "{off}, {}", mean(&with));
}

#[test]
fn a_flash_is_at_the_camera_at_the_distance_of_its_field_of_view() {
    let scene = flash(90.0).unwrap();
    assert_eq!((scene.kind, scene.view), (Kind::Near, scene.light));
    assert!((scene.view[2] - 1.0).abs() < 1e-12 && scene.view[..2] == [0.0, 0.0]);
    assert!((flash(53.130_102_354).unwrap().light[2] - 2.0).abs() < 1e-9);
    for wrong in [0.0, -45.0, 180.0, f64::NAN] {
        assert!(flash(wrong).unwrap_err().to_string().contains("field of view of 0.1 to 179 degrees"));
    }
}

#[test]
fn what_cannot_be_compared_is_refused_with_its_reason() {
    let material = glossy(0.35);
    let refusal = |of: &dyn Fn(&mut Image<f32>)| {
        let photograph = photograph(64, 48, |_, _| [0.5; 3]);
        let mut rectified = rectified(&photograph, &Corners::whole([64, 48]), &material);
        of(&mut rectified.image);
        rectified.compare(&material, &SCENE, &PRINTED, &Progress::default()).unwrap_err().to_string()
    };
    let one = || Image { width: 1, height: 1, pixels: vec![[1.0; 3]] };
    for (refusal, words) in [
        (refusal(&|image| image.pixels.fill([f32::NAN; 3])), "to glossy: every texel is clipped"),
        (refusal(&|image| image.pixels.fill([0.0; 3])), "is lit both in a photograph and in its rendering"),
        (refusal(&|image| *image = one()), "the rectified photograph is 1 x 1, glossy is 64 x 48"),
    ] {
        assert!(refusal.contains(words), "{words}: {refusal}");
    }
    let photograph = photograph(64, 48, |_, _| [0.5; 3]);
    let corners = Corners::whole([65, 48]);
    let outside = super::Rectified::new(&photograph, &corners, [8, 8], &Progress::default());
    assert!(matches!(outside, Err(Error::UnusableCorners { .. })));
}
