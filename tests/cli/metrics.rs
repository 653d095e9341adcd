//! Metrics of maps, over data sets, and of published evaluations.

use std::fs;

use super::*;

#[test]
fn metrics_of_renderings_have_intervals_and_an_exposure() {
    let folder = folder();
    let args = "metrics gt.png a.png b.png --near 8 --distant 4";
    let found = json_of(folder.path(), &format!("{args} --exposure 1"));
    assert_eq!(found["exposure_ev"], 1.0);
    let entry = &found["results"][1];
    let flip = entry["metrics"]["flip_rendering_clipped"].as_f64().unwrap();
    let ends = entry["intervals95"]["flip_rendering_clipped"].as_array().unwrap();
    let [low, high] = [0, 1].map(|end| ends[end].as_f64().unwrap());
    assert!(0.0 <= low && low < flip && flip < high, "{low}, {flip}, {high}");
    assert!(entry["intervals95"].get("rmse_roughness").is_none());
    let text = succeed(folder.path(), &format!("{args} --exposure 1"));
    assert!(text.contains("renderings at 1 EV, clipped to [0, 1]\n"), "{text}");
    let line = text.lines().find(|line| line.starts_with("flip_rendering_clipped")).unwrap();
    assert_has(line, &[&format!("{flip:.6}"), &format!("{low:.6} to {high:.6}")]);
    let rows = rows_of(folder.path(), &format!("{args} --exposure 1"));
    let row = rows.iter().find(|row| row["metric"] == "flip_rendering_clipped").unwrap();
    assert_eq!(
        ["b", "b interval95_low", "b interval95_high"].map(|t| row[t].parse()),
        [flip, low, high].map(Ok)
    );
    let dark = json_of(folder.path(), args);
    assert_eq!(dark["results"][1]["metrics"]["rmse_roughness"], entry["metrics"]["rmse_roughness"]);
    assert_ne!(dark["results"][1]["metrics"]["flip_rendering_clipped"].as_f64().unwrap(), flip);
}

#[test]
fn a_ranking_of_a_data_set_has_metrics_of_the_maps() {
    let folder = data_set(&[("ours", 8), ("theirs", 40)], 6);
    fs::write(folder.path().join("theirs/m5.png"), "not an image").unwrap();
    let rank = "rank --dataset gt ours theirs --target-error 5% --metrics --read roughness=r";
    let found = json_of(folder.path(), rank);
    for (method, expected) in [(0, 8.0), (1, 40.0)] {
        let metrics = &found["methods"][method]["metrics"];
        for statistic in ["mean", "median"] {
            let got = metrics["rmse_roughness"][statistic].as_f64().unwrap();
            assert!((got - expected / 255.0).abs() < 1e-7, "{statistic}: {got}");
        }
        assert_eq!(metrics["angle_normal_mean_degrees"]["mean"], 0.0);
    }
    let table = succeed(folder.path(), rank);
    assert!(table.contains("metric, mean over materials") && table.contains("rmse_roughness"), "{table}");
    let latex = succeed(folder.path(), &format!("{rank} --format latex"));
    // The PSNR of equal maps is infinite. Theirs lacks a material, and is compared with nothing.
    assert_has(
        &latex,
        &["PSNR of normal, as stored (dB) $\\uparrow$ & \\textbf{$\\infty$} & $\\infty$ \\\\"],
    );
    assert!(
        latex.contains("PSNR of roughness (dB) $\\uparrow$ & \\textbf{30.0690} & 16.0896 \\\\"),
        "{latex}"
    );
    assert_eq!(latex.matches("\\begin{tabular}").count(), 2, "{latex}");
    // The roughness of theirs is worse in every material, the normals are the same.
    assert!(latex.contains("RMSE of roughness $\\downarrow$ & \\textbf{0.0314} & 0.1569 \\\\"), "{latex}");
    assert!(latex.contains("(degrees) $\\downarrow$ & \\textbf{0.0000} & 0.0000 \\\\"), "{latex}");
    // Theirs is marked, and with --common compared over the materials of both.
    assert_has(
        &latex,
        &[
            "\\caption{Rendering loss over 6 materials: convention printed, epsilon 0.01",
            "theirs (5 of 6 materials)",
        ],
    );
    assert!(table.contains("theirs (5 of 6 materials)"), "{table}");
    let common = json_of(folder.path(), &format!("{rank} --common"));
    assert_eq!(common["compared_materials"].as_array().unwrap().len(), 5);
    assert!(common["methods"].as_array().unwrap().iter().all(|method| method["compared"] == true));
    assert!(common["repetition"]["command"].as_str().unwrap().contains("--common"));
    let few = rank.replace("--metrics", "--metrics=rmse_roughness,psnr_roughness");
    let few = json_of(folder.path(), &few);
    let names: Vec<&String> = few["methods"][0]["metrics"].as_object().unwrap().keys().collect();
    assert_eq!(names.iter().filter(|name| !name.contains("roughness")).count(), 0, "{names:?}");
    assert!(
        few["repetition"]["command"].as_str().unwrap().contains("--metrics=rmse_roughness,psnr_roughness")
    );
    let rows = rows_of(folder.path(), rank);
    assert_eq!((rows.len(), rows.iter().filter(|row| row["l1_roughness"].is_empty()).count()), (12, 1));
    // Metrics are kept with results, an infinite one, too.
    for _ in 0..2 {
        assert_eq!(json_of(folder.path(), &format!("{rank} --results kept"))["methods"], found["methods"]);
    }
    let without = rank.replace(" --metrics", "");
    assert!(!succeed(folder.path(), &without).contains("rmse"));
}
