//! Tables beside that of sizes and instruction sets.

use svbrdf_core::image::Image;
use svbrdf_core::loss::{Comparison, Request, Sampling, Texels};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::{render, render_f32};

use crate::bound::flops_per_texel_scene;
use crate::job::{FUSED, Job, TOLERANCE, fastest, loss, material, on};

/// The time per texel and scene of several predictions at once, on one thread, and what each further one costs. `bound`
/// is that of one prediction.
#[expect(clippy::expect_used, reason = "a benchmark may panic")]
pub fn predictions_rows(bound: f64) {
    const COUNTS: [usize; 4] = [1, 2, 4, 8];
    let size = 256;
    let materials: Vec<_> = (1..=9).map(|seed| material(seed, size)).collect();
    let predictions: Vec<&Material<f32>> = materials[1..].iter().collect();
    let bound = |count| bound * flops_per_texel_scene(count) / flops_per_texel_scene(1);
    println!("| predictions | ns per texel-scene | of the bound | each further one, ns | of its bound |");
    println!("|---|---|---|---|---|");
    let mut before: Option<(usize, f64)> = None;
    for count in COUNTS {
        let comparison = Comparison::new(&materials[0], &predictions[..count], PRINTED).expect("of one size");
        let comparison = comparison.on(&FUSED).without_pilot();
        let run = || comparison.run(&Request::default(), &Progress::default()).expect("a loss").losses;
        assert_eq!(run().len(), count);
        let time = 1e9 * fastest(|| drop(run())) / (size * size * 9) as f64;
        let further = before.map_or("| |".to_owned(), |(fewer, less)| {
            let (more, least) = ((count - fewer) as f64, bound(count) - bound(fewer));
            format!("{:.2} | {:.0}% |", (time - less) / more, 100.0 * least / (time - less))
        });
        println!("| {count} | {time:.2} | {:.0}% | {further}", 100.0 * bound(count) / time);
        before = Some((count, time));
    }
}

/// Rendering of whole images. Per texel it may take no longer than the loss in the same scene.
#[expect(clippy::expect_used, reason = "a benchmark may panic")]
pub fn rendering_rows() {
    let job = Job::new(1024, 6, 3);
    let texels = (job.size * job.size) as f64;
    for (what, scene) in [("near-field", job.scenes[0]), ("distant", job.scenes[6])] {
        let image = |plain: bool| {
            let render = if plain { render::<f32> } else { render_f32 };
            render(&job.materials[0], &scene, &PRINTED, &Progress::default()).expect("a picture")
        };
        let sum = |image: Image<f32>| image.pixels.iter().flatten().map(|x| f64::from(*x)).sum::<f64>();
        let (got, want) = (sum(image(false)), sum(image(true)));
        assert!((got - want).abs() <= TOLERANCE * want, "{got}, not {want}");
        let [gt, prediction] = &job.materials;
        let loss = || loss(&FUSED, [gt, prediction], &Request::Listed(vec![scene]));
        let first = loss();
        let loss = fastest(|| assert_eq!(loss(), first));
        println!(
            "rendering {}^2, {what}, {} threads: {:.2} ns/texel (plain {:.1}; the loss in this scene {:.2})",
            job.size,
            rayon::current_num_threads(),
            1e9 * fastest(|| drop(image(false))) / texels,
            1e9 * fastest(|| drop(image(true))) / texels,
            1e9 * loss / texels,
        );
    }
}

/// Losses of many scenes, each on an independent random subset of 128 texels. The time should depend little on the size.
pub fn sampled_rows() {
    let request = Request::Scenes(Sampling {
        near: 512,
        distant: 256,
        seed: 0,
        sampler: Sampler::Sobol,
        texels: Texels::Sampled(128),
    });
    for size in [256, 1024, 4096] {
        let [gt, prediction] = [1, 2].map(|seed| material(seed, size));
        let loss = || loss(&FUSED, [&gt, &prediction], &request);
        let first = loss();
        println!(
            "512 + 256 scenes, each on a random subset of 128 texels of {size}^2, {} threads: {:.2} ms",
            rayon::current_num_threads(),
            1e3 * fastest(|| assert_eq!(loss(), first)),
        );
    }
}

/// Whether time is linear in texels, and whether the peak memory of the process is that of the planes.
pub fn sizes(threads: usize) {
    println!("\n| texels | ns/pp, {threads} threads | planes, MiB | peak memory, MiB |\n|---|---|---|---|");
    for size in [256, 512, 1024, 2048, 4096, 8192] {
        let materials = [1, 2].map(|seed| material(seed, size));
        let [gt, prediction] = &materials;
        let loss = || loss(&FUSED, [gt, prediction], &Request::default());
        let first = loss();
        let best = on(threads, || fastest(|| assert_eq!(loss(), first)));
        let per_pp = 1e9 * best / (size * size * 9) as f64;
        let planes = (2 * 10 * 4 * size * size) >> 20;
        println!(
            "| {size}^2 | {per_pp:.2} | {planes} | {} |",
            peak_memory().map_or("?".to_owned(), |m| m.to_string())
        );
    }
}

/// Peak memory of this process in MiB, where the system reports it.
fn peak_memory() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse::<usize>().ok().map(|kib| kib >> 10)
}
