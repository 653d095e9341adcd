//! The fused loss against numbers that were computed independently of this project.

use std::path::Path;

use svbrdf_needs::needs;

use super::*;
use crate::golden_loss;

/// A packed 4x1 strip: normal | diffuse | roughness | specular, 8 bits.
fn strip(folder: &Path, case: &serde_json::Value) -> Material<f32> {
    let file = folder.join(case["file"].as_str().unwrap());
    let image = image::open(file).unwrap().to_rgb8();
    let (width, height) = (image.width() / 4, image.height());
    let gamma = if case["albedo"] == "linear" { 1.0 } else { 2.2 };
    let plane = |part: u32, channel: usize, decode: &dyn Fn(f64) -> f64| {
        let texel = |row, column| f64::from(image.get_pixel(part * width + column, row)[channel]) / 255.0;
        let rows = (0..height).flat_map(|row| (0..width).map(move |column| (row, column)));
        rows.map(|(row, column)| decode(texel(row, column)) as f32).collect::<Vec<_>>()
    };
    let planes = Planes {
        normal: [0, 1, 2].map(|c| plane(0, c, &|x| 2.0 * x - 1.0)),
        diffuse: [0, 1, 2].map(|c| plane(1, c, &|x| x.powf(gamma))),
        roughness: plane(2, 0, &|x| x),
        specular: [0, 1, 2].map(|c| plane(3, c, &|x| x.powf(gamma))),
    };
    Material::new("golden", width as usize, height as usize, planes).unwrap()
}

#[needs(shared)]
#[test]
fn losses_are_the_golden_ones() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/golden");
    for case in golden_loss::cases() {
        let scenes: Vec<Scene> = serde_json::from_value(case["scenes"].clone()).unwrap();
        let (gt, prediction) = (strip(&folder, &case["ground_truth"]), strip(&folder, &case["prediction"]));
        for c in &convention::ALL {
            let golden = golden_loss::expected(&case, c).unwrap_or_else(|e| panic!("{e}"));
            let want = (golden.loss, golden.per_scene);
            for (name, level) in levels() {
                let got = fused(level, &gt, &prediction, &scenes, c);
                let [mean, scene] = compare(&got, &want, BOUNDS).unwrap();
                println!("{}, {}, {name}: loss {mean:.1e}, scene {scene:.1e}", case["id"], c.name);
            }
        }
    }
}
