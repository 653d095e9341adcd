//! Numerical stability at the extremes: every rung of precision over a table of extreme cases and over random ones.
//!
//! `SVBRDF_EXTREMES=10000000 cargo test write_extremes -- --ignored --nocapture` measures 10^7 random points and writes
//! docs/extremes.md, docs/extremes.csv and docs/extremes.svg.

mod cases;
mod exact;
mod picture;
mod planted;
mod regions;
mod report;
mod rungs;
mod survey;

use std::collections::BTreeSet;
use std::path::Path;

use svbrdf_core::model::brdf::half_vector;
use svbrdf_core::model::convention::{Convention, GUIDED_2020, MULTI_IMAGE_2019, SINGLE_IMAGE_2018};

use cases::RANDOM_TEXELS;
use regions::Region;
use rungs::Rung;
use survey::Survey;

/// Random points of a test run.
const POINTS: u64 = 100_000;

/// The table of extremes.
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
    for region in Region::ALL {
        let gpu = adapter().is_some().then_some(Rung::Gpu);
        for rung in [Rung::F64, Rung::F32, Rung::Fused].into_iter().chain(gpu) {
            assert!(survey.errors(region, rung).count > 100, "{rung:?} has nothing of {region:?}");
        }
    }
}

#[test]
fn every_rung_holds_at_random_points() {
    let survey = survey_random(POINTS, 16);
    assert!(survey.points >= POINTS);
    survey.verdict().unwrap_or_else(|e| panic!("{e}"));
    // The printed form of D cancels.
    let worst = |rung| survey.errors(Region::Satin, rung).worst;
    assert!(worst(Rung::Cancelling) > 30.0 * worst(Rung::F32));
    assert!(survey.errors(Region::GlossyHighlight, Rung::Cancelling).worst.is_infinite());
}

#[test]
#[ignore = "writes docs/extremes.md, extremes.csv and extremes.svg"]
fn write_extremes() {
    let points = std::env::var("SVBRDF_EXTREMES").ok().and_then(|n| n.parse().ok()).unwrap_or(POINTS);
    let random = survey_random(points, 61);
    let count = random.points;
    let survey = random.merge(survey_table());
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    std::fs::write(docs.join("extremes.md"), report::markdown(&survey, count, adapter().as_deref())).unwrap();
    std::fs::write(docs.join("extremes.csv"), report::csv(&survey)).unwrap();
    std::fs::write(docs.join("extremes.svg"), picture::svg()).unwrap();
    survey.verdict().unwrap_or_else(|e| panic!("{e}"));
}

#[cfg(feature = "viewer")]
fn adapter() -> Option<String> {
    crate::support::gpu::find_gpu().ok().map(|gpu| gpu.report.name.clone())
}

#[cfg(not(feature = "viewer"))]
fn adapter() -> Option<String> {
    None
}

#[test]
fn the_table_holds_every_pair_of_values_of_its_axes() {
    let mut seen = BTreeSet::new();
    for (_, places) in cases::table() {
        for place in places.iter().flatten() {
            for (axis, value) in place.iter().enumerate() {
                seen.extend(place[..axis].iter().enumerate().map(|(other, v)| [other, *v, axis, *value]));
            }
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
    println!("{at_the_peak} at NoH = 1, {opposite} batches with l = -v, {behind} behind the texel");
    assert!(at_the_peak > 1000 && opposite > 10 && behind > 1000);
}

#[test]
fn the_released_codes_share_their_clamps() {
    for c in [SINGLE_IMAGE_2018, MULTI_IMAGE_2019] {
        let clamps = Convention {
            clamp_n_dot_h: c.clamp_n_dot_h,
            d_floor: c.d_floor,
            g_floor: c.g_floor,
            ..GUIDED_2020
        };
        let floors =
            Convention { roughness_floor: c.roughness_floor, light_z_floor: c.light_z_floor, ..clamps };
        assert_eq!(floors, GUIDED_2020);
    }
}
