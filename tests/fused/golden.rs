//! The fused loss against numbers that were computed independently of this project.

use svbrdf_needs::needs;

use super::*;
use crate::golden_loss;

#[needs(shared)]
#[test]
fn losses_are_the_golden_ones() {
    for case in golden_loss::cases() {
        let scenes: Vec<Scene> = serde_json::from_value(case["scenes"].clone()).unwrap();
        let [gt, prediction] = ["ground_truth", "prediction"].map(|key| golden_loss::material(&case[key]));
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
