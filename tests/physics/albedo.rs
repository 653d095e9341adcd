//! The directional albedo of a white material: which share of the light is reflected towards all directions.
//!
//! `cargo test --no-default-features write_albedo -- --ignored --nocapture` writes docs/albedo.svg and prints a table.

use std::fmt::Write as _;
use std::path::Path;

use glam::DVec3;
use rayon::prelude::*;

use svbrdf_core::model::brdf::{self, Model, Texel};
use svbrdf_core::model::convention::{Convention, GUIDED_2020, PRINTED};

use super::plot;

/// Half vectors along a meridian and around the normal, per quarter of the sphere.
const STEPS: [usize; 2] = [400, 128];
/// Roughnesses of the figure.
pub const ROUGHNESS: [f64; 6] = [0.02, 0.1, 0.25, 0.5, 0.75, 1.0];
/// Angles between view and normal, in degrees.
pub const ANGLES: [f64; 10] = [0.0, 15.0, 30.0, 45.0, 55.0, 65.0, 72.0, 78.0, 83.0, 87.0];

/// (name, diffuse albedo, specular reflectance).
pub const WHITE: [(&str, f64, f64); 2] =
    [("metal (s = 1)", 0.0, 1.0), ("dielectric (d = 1, s = 0.04)", 1.0, 0.04)];

/// The share of the light from direction `v` that is reflected; by reciprocity, the radiance towards `v` under light
/// of radiance 1 from everywhere. Without the factor that a convention puts on R.
///
/// The integral over the light l of f(l, v) n.l, taken over half vectors h: dl = 4 (v.h) dh. The step along the
/// meridian is in ln tan(theta), where a lobe of any width is smooth.
pub fn albedo(convention: &Convention, texel: &Texel<f64>, view_degrees: f64) -> f64 {
    let model = Model::from(&Convention { intensity: 1.0, ..*convention });
    let angle = view_degrees.to_radians();
    let v = DVec3::new(angle.sin(), 0.0, angle.cos());
    let width = texel.roughness.max(convention.roughness_floor).powi(2);
    let [low, high] = [1e-4 * width, 1e4];
    let step = (high / low).ln() / STEPS[0] as f64;
    let ring = |i: usize| {
        let t = low * (step * (i as f64 + 0.5)).exp();
        let cosine = 1.0 / t.hypot(1.0);
        let sine = t * cosine;
        let spoke = |j: usize| {
            let phi = std::f64::consts::PI * (j as f64 + 0.5) / STEPS[1] as f64;
            let h = DVec3::new(sine * phi.cos(), sine * phi.sin(), cosine);
            let v_dot_h = v.dot(h);
            let l = h * (2.0 * v_dot_h) - v;
            let lit = l.z > 0.0 && v_dot_h > 0.0;
            if lit { brdf::reflectance(&model, texel, l, v)[0] * l.z * 4.0 * v_dot_h } else { 0.0 }
        };
        // Both sides of the plane of incidence.
        let around = std::f64::consts::TAU / STEPS[1] as f64;
        sine * sine * cosine * step * around * (0..STEPS[1]).map(spoke).sum::<f64>()
    };
    (0..STEPS[0]).map(ring).sum()
}

pub fn white(diffuse: f64, specular: f64, roughness: f64) -> Texel<f64> {
    Texel { normal: DVec3::Z, diffuse: [diffuse; 3], specular: [specular; 3], roughness }
}

#[test]
fn the_albedo_of_a_lambertian_surface_is_its_diffuse_albedo() {
    // The specular lobe of s = 0 is only the Fresnel term of F, which vanishes at l = v.
    for roughness in [0.3, 1.0] {
        let both = albedo(&PRINTED, &white(0.8, 0.0, roughness), 0.0);
        let lobe = albedo(&PRINTED, &white(0.0, 0.0, roughness), 0.0);
        assert!((both - lobe - 0.8).abs() < 1e-3, "{both} - {lobe}");
    }
}

#[test]
fn a_smooth_metal_reflects_all_light_where_nothing_is_clamped() {
    // G is 1 / (n.l n.v) and D a unit impulse: the albedo is 1.
    for angle in [0.0, 30.0, 60.0] {
        let got = albedo(&PRINTED, &white(0.0, 1.0, 0.02), angle);
        assert!((got - 1.0).abs() < 5e-3, "{angle} degrees: {got}");
    }
    // The clamp of the denominator of D at 0.001 caps this lobe.
    assert!(albedo(&GUIDED_2020, &white(0.0, 1.0, 0.02), 0.0) < 0.1);
}

/// Every curve of the figure: for each convention that differs, each white material and each roughness.
fn curves() -> Vec<plot::Panel> {
    let conventions = [("printed", PRINTED), ("released codes", GUIDED_2020)];
    let panels = conventions.into_iter().flat_map(|c| WHITE.into_iter().map(move |w| (c, w)));
    let panel =
        |((name, convention), (material, d, s)): ((&str, Convention), (&str, f64, f64))| plot::Panel {
            title: format!("{name}: {material}"),
            curves: ROUGHNESS
                .into_par_iter()
                .map(|r| ANGLES.into_par_iter().map(|a| albedo(&convention, &white(d, s, r), a)).collect())
                .collect(),
        };
    panels.map(panel).collect()
}

#[test]
#[ignore = "writes docs/albedo.svg"]
fn write_albedo() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let panels = curves();
    std::fs::write(docs.join("albedo.svg"), plot::svg(&panels)).unwrap();
    println!("{}", table(&panels));
}

fn table(panels: &[plot::Panel]) -> String {
    let mut text = "| convention: material | r |".to_owned();
    ANGLES.iter().for_each(|angle| text.push_str(&format!(" {angle} deg |")));
    text.push_str(&format!("\n|---|---|{}\n", "---|".repeat(ANGLES.len())));
    for panel in panels {
        for (roughness, curve) in ROUGHNESS.iter().zip(&panel.curves) {
            let _ = write!(text, "| {} | {roughness} |", panel.title);
            curve.iter().for_each(|albedo| text.push_str(&format!(" {albedo:.3} |")));
            text.push('\n');
        }
    }
    text
}
