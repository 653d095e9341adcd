//! Mirrors, peaks, grazing light and what f32 can hardly hold.

use super::*;

#[test]
fn peaks_do_not_cancel() {
    let at = |view: [f64; 3], light| Scene { kind: Kind::Distant, view, light };
    let scenes = [at([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]), at([0.6, 0.0, 0.8], [-0.6, 0.0, 0.8])];
    for c in &convention::ALL {
        // Normals within four widths a = r^2 of the half vector.
        let (gt, prediction) = (random(6, [256, 64], 6e-5, 0.0), random(7, [256, 64], 6e-5, 0.0));
        let smooth = |m: Material<f32>| {
            let planes = Planes { roughness: vec![1.0 / 255.0; 256 * 64], ..m.planes().clone() };
            Material::new("smooth", 256, 64, planes).unwrap()
        };
        let bounds = [tolerance::FUSED_PEAK; 2];
        check_all("peak", &smooth(gt), &smooth(prediction), &scenes, c, bounds);
    }
}

#[test]
fn extremes() {
    let distant = |view, light| Scene { kind: Kind::Distant, view, light };
    let near = |view, light| Scene { kind: Kind::Near, view, light };
    let up = [0.0, 0.0, 1.0];
    let scenes = [
        distant(up, up),
        distant([0.6, 0.0, 0.8], [-0.6, 0.0, 0.8]),
        distant([1.0, 0.0, 1e-3], [0.0, 1.0, 1e-6]),
        distant([1.0, 0.0, 1e-3], [0.0, 1.0, 2e-9]),
        near(up, [0.3, 0.2, 1e-6]),
        near([0.0, 0.0, 1e8], [1e8, 0.0, 1e3]),
        near([-0.3, 0.1, 0.01], [0.3, 0.2, 0.01]),
    ];
    let rough = uniform([0.0, 0.0, 1.0], 0.5, 0.5, 0.5, [9, 9]);
    let size = [9, 9];
    let others = [
        ("mirror", uniform([0.0, 0.0, 1.0], 0.0, 0.0, 1.0, size)),
        ("black", uniform([0.0, 0.0, 1.0], 0.0, 0.0, 0.0, size)),
        ("white", uniform([0.0, 0.0, 1.0], 1.0, 1.0, 0.0, size)),
        ("grazing", uniform([1.0, 0.0, 1e-3], 0.0, 1.0, 1.0, size)),
        ("in the plane", uniform([1.0, 0.0, 1e-9], 0.0, 1.0, 1.0, size)),
        ("from behind", uniform([0.0, 0.0, -1.0], 0.3, 1.0, 1.0, size)),
    ];
    for c in &convention::ALL {
        for (what, other) in &others {
            check_all(what, &rough, other, &scenes, c, [tolerance::FUSED_EXTREME; 2]);
        }
    }
}

#[test]
fn opposite_directions_and_tiny_heights_stay_finite() {
    let opposite = |x: f64, z: f64| Scene { kind: Kind::Distant, view: [x, 0.0, z], light: [-x, 0.0, z] };
    let touching = |z: f64| Scene { kind: Kind::Near, view: [0.0, 0.0, z], light: [0.0, 0.0, z] };
    let mut scenes: Vec<_> = [1e-3, 1e-5, 1e-7, 2e-9].map(|z| opposite(1.0, z)).to_vec();
    scenes.extend([1e-3, 1e-7, 1e-9, 1e-18, 1e9].map(touching));
    let (gt, mirror) = (random(8, [9, 9], 0.9, 0.0), uniform([0.0, 0.0, 1.0], 0.0, 1.0, 1.0, [9, 9]));
    for c in &convention::ALL {
        for (name, level) in levels() {
            let (mean, per_scene) = fused(level, &gt, &mirror, &scenes, c);
            let sane = per_scene.iter().all(|x| x.is_finite() && *x >= 0.0);
            assert!(mean.is_finite() && sane, "{name}, {}: {per_scene:?}", c.name);
        }
    }
}
