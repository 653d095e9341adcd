//! The direction of y in normals, and whether roughness is glossiness: the same for all files of a method.

use svbrdf_core::statistics::median;
use svbrdf_files::read::{NormalY, Roughness};

use super::super::reading::DatasetReading;
use super::group::{Group, Sampled};
use crate::registration;

/// The correlation beyond which the ground truths tell a direction.
const CLEAR: f64 = 0.3;
/// That of glossiness, which is 1 - roughness: no error of a method turns all values over.
const TURNED: f64 = -0.5;
/// The share of the materials that are to agree.
const SHARE: f64 = 0.8;

/// Decides the direction of y of a method, where it is specified nowhere.
pub(super) fn normal_y(decided: &mut DatasetReading, group: &Group<'_>) {
    if decided.of_method(group.method).normal_y.is_some() {
        return;
    }
    // y as it is stored, upwards in the ground truths.
    let of_pair = |[truth, prediction]: &[Sampled; 2]| {
        let y = |one: &Sampled| one.texels.planes().normal[1].clone();
        let sign = if prediction.storage.normal_down { -1.0 } else { 1.0 };
        correlation(&y(truth), &y(prediction)).map(|correlation| sign * correlation)
    };
    let mut found: Vec<f64> = group.pairs.iter().filter_map(of_pair).collect();
    let Some(direction) = agreed(&mut found, group).filter(|direction| direction.abs() >= CLEAR) else {
        return;
    };
    let y = if direction > 0.0 { NormalY::Up } else { NormalY::Down };
    let is_other = |pair: &&[Sampled; 2]| pair[1].storage.normal_down != (y == NormalY::Down);
    let other = group.pairs.iter().filter(is_other).count();
    if other > 0 {
        decided.options_mut(group.method).normal_y = Some(y);
        say(decided, group, &format!("normal-y={}", y.name()), other);
    }
}

/// Decides whether the roughness of a method is glossiness, where it is read as roughness.
pub(super) fn roughness(decided: &mut DatasetReading, group: &Group<'_>) {
    let is_plain = |one: &Sampled| one.storage.roughness == Roughness::R;
    if decided.of_method(group.method).roughness.is_some() || !group.pairs.iter().flatten().all(is_plain) {
        return;
    }
    let values = |one: &Sampled| one.texels.planes().roughness.clone();
    let of_pair = |[truth, prediction]: &[Sampled; 2]| correlation(&values(truth), &values(prediction));
    let mut found: Vec<f64> = group.pairs.iter().filter_map(of_pair).collect();
    let is_turned = agreed(&mut found, group).is_some_and(|correlation| correlation <= TURNED);
    let apart = |turned: bool| -> f32 {
        let of_pair = |[truth, prediction]: &[Sampled; 2]| -> f32 {
            let read = |p: &f32| if turned { 1.0 - p } else { *p };
            values(truth).iter().zip(&values(prediction)).map(|(t, p)| (t - read(p)).abs()).sum()
        };
        group.pairs.iter().map(of_pair).sum()
    };
    if is_turned && apart(true) < 0.5 * apart(false) {
        decided.options_mut(group.method).roughness = Some(Roughness::Gloss);
        say(decided, group, "roughness=gloss", group.pairs.len());
    }
}

fn say(decided: &mut DatasetReading, group: &Group<'_>, option: &str, other: usize) {
    let (method, count) = (group.method, group.pairs.len());
    decided.decisions.push(format!(
        "{method}: {option} for all: ground truths beside {count} materials say so; by themselves {other} of {count} are read otherwise"
    ));
}

/// The median, where most materials have its sign.
fn agreed(found: &mut [f64], group: &Group<'_>) -> Option<f64> {
    let middle = median(found)?;
    let agreeing = found.iter().filter(|one| one.signum() == middle.signum()).count();
    (agreeing as f64 >= SHARE * group.pairs.len() as f64).then_some(middle)
}

fn correlation(a: &[f32], b: &[f32]) -> Option<f64> {
    let [known] =
        registration::correlations(a.iter().zip(b).map(|(a, b)| [[f64::from(*a)], [f64::from(*b)]]));
    known
}
