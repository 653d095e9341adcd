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
//! `SVBRDF_EXTREMES=10000000 cargo test --test main write_extremes -- --ignored` measures 10^7 random points and writes the table of docs/extremes.md.

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

use std::fmt::Write as _;
use std::path::Path;

use cases::RANDOM_TEXELS;
use rungs::Rung;
use survey::Survey;
use truth::Region;

/// Random points of a test run.
const POINTS: u64 = 100_000;

fn survey_table() -> Survey {
    Survey::of(&cases::table().collect::<Vec<_>>(), 4)
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
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/extremes.md");
    let text = std::fs::read_to_string(&path).unwrap();
    let (before, rest) = text.split_once(TABLE).unwrap();
    let (_, after) = rest.split_once("\n* *values*").unwrap();
    let table = table(&survey, count);
    std::fs::write(path, format!("{before}{TABLE}{table}\n* *values*{after}")).unwrap();
    survey.verdict().unwrap_or_else(|e| panic!("{e}"));
}

/// The heading of the table in the document.
const TABLE: &str = "## Worst relative error\n\n";

/// The table. `random` is the number of random points among the points of the survey.
fn table(survey: &Survey, random: u64) -> String {
    let levels: Vec<_> = rungs::levels().into_iter().map(|(name, _)| name).collect();
    let exact = Region::ALL.iter().map(|region| survey.errors(*region, Rung::F64).0).sum::<u64>() / 3;
    let mut text = format!(
        "At {random} random points and {} of the table, {exact} of them in 256 bits; SIMD by {}; WGSL on {}.\n\n\
         | region | values | one ulp | f64 | f32 | SIMD | WGSL |\n|---|---|---|---|---|---|---|\n",
        survey.points - random,
        levels.join(", "),
        adapter().as_deref().unwrap_or("none"),
    );
    for region in Region::ALL {
        let values = survey.errors(region, Rung::F32).0;
        let one_ulp = number(survey.one_ulp[region as usize]);
        let _ = write!(text, "| {} | {values} | {one_ulp} |", region.name());
        for rung in Rung::ALL {
            let (count, error) = survey.errors(region, rung);
            let _ = write!(text, " {} |", if count == 0 { "-".to_owned() } else { number(error) });
        }
        text.push('\n');
    }
    let shares = survey.shares.map(|share| format!("{share:.2}")).join(" | ");
    text + &format!("| share of the bound of each point | | | {shares} |\n")
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
