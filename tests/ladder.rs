//! The ladder: each rung of precision is held against the one above it, on the same cases.
//!
//! | rung | against |
//! |---|---|
//! | f64 | 256 bits, points of 60 digits, losses that were computed independently of this project |
//! | f32 as it is written | f64, and the points of 60 digits |
//! | f32 with SIMD, at every instruction set | f64, and the independent losses |
//! | WGSL on an adapter | f64 |
//!
//! Points are those of a table of extremes and random ones, losses and pictures those of random, extreme and golden materials. All bounds
//! are in `support/tolerance.rs`. GLSL is held against the core in `page/pixels.rs`, `svbrdf.torch` in `python/tests/test_torch.py`.
//!
//! `SVBRDF_EXTREMES=10000000 cargo test --test main write_extremes -- --ignored` measures 10^7 random points and writes docs/extremes.md.

mod cases;
mod exact;
mod golden_losses;
mod golden_points;
mod losses;
mod physics;
mod pictures;
mod planted;
mod requests;
mod rungs;
mod survey;
mod truth;

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use svbrdf_core::model::brdf::half_vector;

use cases::RANDOM_TEXELS;
use rungs::Rung;
use survey::Survey;
use truth::Region;

/// Random points of a test run.
const POINTS: u64 = 100_000;

fn survey_table() -> Survey {
    Survey::of(&cases::table().map(|(batch, _)| batch).collect::<Vec<_>>(), 4)
}

/// At least `points` random points; every `exact_every`-th batch is also computed in 256 bits.
fn survey_random(points: u64, exact_every: usize) -> Survey {
    /// Batches in memory at a time.
    const SLAB: u64 = 4096;
    let batches = points.div_ceil(RANDOM_TEXELS as u64);
    let slab = |first: u64| (first..batches.min(first + SLAB)).map(cases::random).collect::<Vec<_>>();
    let surveys = (0..batches).step_by(SLAB as usize).map(|first| Survey::of(&slab(first), exact_every));
    surveys.fold(Survey::new(), Survey::merge)
}

#[test]
fn every_rung_holds_over_the_table_of_extremes() {
    let survey = survey_table();
    survey.verdict().unwrap_or_else(|e| panic!("{e}"));
    println!("shares of the bounds: {:.2?}", survey.shares);
    let gpu = adapter().map(|_| Rung::Wgsl);
    for rung in [Rung::F64, Rung::F32, Rung::Simd].into_iter().chain(gpu) {
        let few = Region::ALL.into_iter().find(|region| survey.errors(*region, rung).0 <= 100);
        assert_eq!(few, None, "{rung:?}");
    }
}

#[test]
fn every_rung_holds_at_random_points() {
    let survey = survey_random(POINTS, 16);
    assert!(survey.points >= POINTS);
    println!("shares of the bounds: {:.2?}", survey.shares);
    survey.verdict().unwrap_or_else(|e| panic!("{e}"));
}

#[test]
#[ignore = "writes docs/extremes.md"]
fn write_extremes() {
    let points = std::env::var("SVBRDF_EXTREMES").ok().and_then(|n| n.parse().ok()).unwrap_or(POINTS);
    let random = survey_random(points, 61);
    let count = random.points;
    let survey = random.merge(survey_table());
    let document = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/extremes.md");
    std::fs::write(document, markdown(&survey, count)).unwrap();
    survey.verdict().unwrap_or_else(|e| panic!("{e}"));
}

/// The document. `random` is the number of random points among the points of the survey.
fn markdown(survey: &Survey, random: u64) -> String {
    let levels: Vec<_> = rungs::levels().into_iter().map(|(name, _)| name).collect();
    let [f64_share, f32_share, simd_share, wgsl_share] = survey.shares.map(|share| format!("{share:.2}"));
    let mut worst = String::new();
    for region in Region::ALL {
        let values = survey.errors(region, Rung::F32).0;
        let _ =
            write!(worst, "| {} | {values} | {} |", region.name(), number(survey.one_ulp[region as usize]));
        for rung in Rung::ALL {
            let (count, error) = survey.errors(region, rung);
            let _ = write!(worst, " {} |", if count == 0 { "-".to_owned() } else { number(error) });
        }
        worst.push('\n');
    }
    format!(
        include_str!("ladder/report.txt"),
        random = random,
        table = survey.points - random,
        exact = Region::ALL.iter().map(|region| survey.errors(*region, Rung::F64).0).sum::<u64>() / 3,
        levels = levels.join(", "),
        adapter = adapter().as_deref().unwrap_or("none"),
        worst = worst,
        f64_share = f64_share,
        f32_share = f32_share,
        simd_share = simd_share,
        wgsl_share = wgsl_share,
    )
}

fn number(x: f64) -> String {
    match x {
        0.0 => "0".to_owned(),
        _ if x.is_infinite() => "inf".to_owned(),
        _ => format!("{x:.1e}"),
    }
}

#[cfg(feature = "viewer")]
fn adapter() -> Option<String> {
    let gpu = crate::support::gpu::find_gpu().ok().filter(|_| svbrdf_needs::has!(f32_adapter));
    gpu.map(|gpu| gpu.report.name.clone())
}

#[cfg(not(feature = "viewer"))]
fn adapter() -> Option<String> {
    None
}

#[test]
fn the_table_holds_every_pair_of_values_of_its_axes() {
    let mut seen = BTreeSet::new();
    for place in cases::table().flat_map(|(_, places)| places).flatten() {
        for (axis, value) in place.iter().enumerate() {
            seen.extend(place[..axis].iter().enumerate().map(|(other, v)| [other, *v, axis, *value]));
        }
    }
    let sizes = cases::SIZES;
    let pairs: usize = (0..10).flat_map(|a| (0..a).map(move |b| sizes[a] * sizes[b])).sum();
    assert_eq!(seen.len(), pairs);
}

#[test]
fn the_table_reaches_its_extremes_in_f32() {
    let (mut at_the_peak, mut opposite, mut behind) = (0, 0, 0);
    for (batch, _) in cases::table() {
        let (l, v) = (batch.w_l.normalize(), batch.w_v.normalize());
        opposite += usize::from((l + v).length() == 0.0);
        for n in batch.texels().map(|t| t.normal) {
            at_the_peak += usize::from(n.dot(half_vector(n, l, v)) == 1.0);
            behind += usize::from(n.dot(l) < 0.0 && l.z > 0.0);
        }
    }
    assert!(at_the_peak > 1000 && opposite > 10 && behind > 1000, "{at_the_peak} {opposite} {behind}");
}
