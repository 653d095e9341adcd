//! The data of the figure, as JSON for its script.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;

use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::colour_map::{diverging, heat};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::Error;
use svbrdf_shaders::PAGE_GLSL;

use super::content::{PageReport, View};
use super::encode::EncodedMaterial;

/// Colours of a legend.
const COLOURS: usize = 64;

/// A scene of the findings, with its exposure in stops.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct LinkedScene {
    pub scene: Scene,
    pub exposure: f32,
}

#[derive(Serialize)]
struct Data<'a> {
    materials: &'a [EncodedMaterial],
    convention: &'static str,
    /// The convention that is drawn.
    drawn: &'static str,
    model: BTreeMap<&'static str, f32>,
    epsilon: f64,
    shaders: Value,
    /// The difference of each quantity.
    kinds: BTreeMap<&'static str, Kind>,
    colours: BTreeMap<&'a str, Vec<String>>,
    start: Start<'a>,
    scenes: &'a [LinkedScene],
}

#[derive(Serialize)]
struct Kind {
    key: &'static str,
    name: &'static str,
    unit: &'static str,
    signed: bool,
    range: f64,
}

#[derive(Serialize)]
struct Start<'a> {
    scene: Scene,
    exposure: f32,
    quantity: &'a str,
    difference: bool,
    layout: &'a str,
    prediction: usize,
    wipe: f32,
}

/// The JSON of the figure.
///
/// # Errors
/// [`Error::Internal`], which these values never give.
pub(super) fn json(
    materials: &[EncodedMaterial],
    report: &PageReport<'_>,
    scenes: &[LinkedScene],
) -> Result<String, Error> {
    let drawn = report.convention.drawn();
    let failed = |problem: serde_json::Error| Error::Internal(format!("a page cannot be made: {problem}"));
    let data = Data {
        materials,
        convention: report.convention.name,
        drawn: drawn.name,
        model: model(&drawn),
        epsilon: report.convention.epsilon,
        shaders: serde_json::from_str(PAGE_GLSL).map_err(failed)?,
        kinds: Quantity::ALL.map(|quantity| (quantity.name(), kind(&report.view, quantity))).into(),
        colours: [("heat", colours(heat, 0.0)), ("diverging", colours(diverging, -1.0))].into(),
        start: start(report),
        scenes,
    };
    serde_json::to_string(&data).map_err(failed)
}

/// The members of `Model` of brdf.wgsl.
fn model(convention: &Convention) -> BTreeMap<&'static str, f32> {
    let model = Model::<f32>::from(convention);
    [
        ("intensity", model.intensity),
        ("roughness_floor", model.roughness_floor),
        ("light_z_floor", model.light_z_floor),
        ("clamp_n_dot_h", f32::from(model.clamp_n_dot_h)),
        ("d_floor", model.d_floor),
        ("g_floor", model.g_floor),
    ]
    .into()
}

fn kind(view: &View, quantity: Quantity) -> Kind {
    let (kind, range) = view.display.differences.pointwise(quantity);
    Kind {
        key: kind.key(),
        name: kind.name(),
        unit: kind.unit(),
        signed: kind.is_signed(),
        range: range.unwrap_or_else(|| kind.default_range()),
    }
}

/// The colours of amounts from `low` to 1.
fn colours(map: fn(f32) -> [f32; 3], low: f32) -> Vec<String> {
    let colour = |i: usize| {
        let amount = low + (1.0 - low) * i as f32 / (COLOURS - 1) as f32;
        let [r, g, b] = map(amount).map(|c| (c * 255.0).round() as u8);
        format!("#{r:02x}{g:02x}{b:02x}")
    };
    (0..COLOURS).map(colour).collect()
}

fn start<'a>(report: &'a PageReport<'_>) -> Start<'a> {
    let View { scene, exposure_ev, ref display } = report.view;
    Start {
        scene,
        exposure: exposure_ev,
        quantity: display.quantity.name(),
        difference: display.difference,
        layout: display.layout.key(),
        prediction: display.prediction.min(report.materials.len().saturating_sub(2)),
        wipe: display.wipe,
    }
}
