//! Encodings of colours: as specified, as the files tell, or as the evidence of pixels suggests.

use super::evidence::{self, PRIOR, SURE};
use super::neighbours::Neighbours;
use super::values::decide;
use crate::read::options::{Albedo, ReadOptions, Roughness};
use crate::read::raster::measure;
use crate::read::record::{
    Assumption, Certainty, Evidence, Note, Reason, SpecifiedBy, StorageConvention, What,
};
use crate::read::stored::{Inferences, Inferred, StoredMap, StoredMaterial};

/// How diffuse (or a base colour) and specular are stored, recorded; with the neighbours that were looked at.
pub(super) fn encodings(
    found: &mut StoredMaterial,
    options: &ReadOptions,
) -> ([Albedo; 2], Option<Neighbours>) {
    let ([diffuse, specular], neighbours) = detected(found, options);
    let inferred = found.inferred.albedo.take();
    // Nothing is detected where the encoding is specified or inferred: then this is never asked.
    let detected = || diffuse.unwrap_or_else(|| alone(None));
    let albedo = decide(&mut found.assumptions, What::Albedo, options.albedo, inferred, detected);
    let is_other = options.albedo.is_none() && found.notes.contains(&Note::Primaries);
    if let Some(assumption) = found.assumptions.last_mut().filter(|_| is_other) {
        let why = std::mem::replace(&mut assumption.why, Reason::OtherPrimaries);
        assumption.why = Reason::ContradictedBy(Box::new(why), Box::new(Reason::OtherPrimaries));
        assumption.certainty = Certainty::Unsure;
    }
    ([albedo, specular_encoding(found, options, specular)], neighbours)
}

/// The encodings that the pixels of diffuse (or a base colour) and of specular suggest, where options and files leave them open.
fn detected(found: &StoredMaterial, options: &ReadOptions) -> ([Inferred<Albedo>; 2], Option<Neighbours>) {
    let Inferences { albedo, specular: known, roughness, .. } = &found.inferred;
    match &found.specular {
        _ if options.albedo.is_some() || (albedo.is_some() && known.is_some()) => ([None, None], None),
        Some(specular) => {
            let roughness = options.roughness.or(roughness.as_ref().map(|known| known.0));
            pair(&found.colour, specular, roughness)
        }
        None if albedo.is_some() => ([None, None], None),
        None => ([Some(alone(evidence::alone(&found.colour.raster))), None], None),
    }
}

/// The encodings of diffuse and specular, with the evidence of neighbours where their own leaves them open.
///
/// The two differ only where evidence about diffuse alone does. `roughness` is what the names declare it: glossiness is
/// how artists name it.
fn pair(
    diffuse: &StoredMap,
    specular: &StoredMap,
    roughness: Option<Roughness>,
) -> ([Inferred<Albedo>; 2], Option<Neighbours>) {
    let prior = if roughness == Some(Roughness::Gloss) { Evidence::Prior } else { Evidence::Research };
    let mut common = vec![prior];
    if evidence::is_jpeg(&diffuse.file) && evidence::is_jpeg(&specular.file) {
        common.push(Evidence::Jpeg);
    }
    common.extend(evidence::measured(&diffuse.raster, &specular.raster));
    let total: f64 = common.iter().map(|one| one.log_odds()).sum();
    let pictures = || [diffuse.file.clone(), specular.file.clone()];
    let neighbours = (total.abs() < SURE).then(|| Neighbours::of(pictures()));
    common.extend(neighbours.as_ref().and_then(Neighbours::evidence));
    let bright = evidence::too_bright(&diffuse.raster, &specular.raster);
    let diffuse = common.iter().copied().chain(bright).collect();
    ([diffuse, common].map(verdict).map(Some), neighbours)
}

/// The encoding of a colour without specular, by convention.
fn alone(dark: Option<Evidence>) -> (Albedo, Reason, Certainty) {
    match dark {
        Some(dark) => {
            let evidence = vec![Evidence::Prior, dark];
            (Albedo::Srgb, Reason::Weighed { log_odds: PRIOR, evidence }, Certainty::Unsure)
        }
        None => (Albedo::Srgb, StorageConvention::SeparateColours.into(), Certainty::Likely),
    }
}

fn verdict(evidence: Vec<Evidence>) -> (Albedo, Reason, Certainty) {
    let log_odds = evidence.iter().map(|one| one.log_odds()).sum::<f64>();
    let albedo = if log_odds > 0.0 { Albedo::Linear } else { Albedo::Srgb };
    let disagrees = |one: &Evidence| {
        let alone = one.log_odds();
        !one.is_custom() && alone.abs() >= SURE && (alone > 0.0) != (log_odds > 0.0)
    };
    let is_sure = log_odds.abs() >= SURE && !evidence.iter().any(disagrees);
    let certainty = if is_sure { Certainty::Likely } else { Certainty::Unsure };
    (albedo, Reason::Weighed { log_odds, evidence }, certainty)
}

/// The encoding that the median of specular suggests: 0.04 stored linearly, or encoded.
fn by_median(median: f64) -> (Albedo, Reason, Certainty) {
    let (albedo, suggests, certainty) = match median {
        0.03..=0.06 => (Albedo::Linear, Some(Albedo::Linear), Certainty::Likely),
        0.2..=0.26 => (Albedo::Srgb, Some(Albedo::Srgb), Certainty::Likely),
        _ => (Albedo::Srgb, None, Certainty::Unsure),
    };
    (albedo, Reason::SpecularMedian { median, suggests }, certainty)
}

fn specular_encoding(
    found: &mut StoredMaterial,
    options: &ReadOptions,
    detected: Inferred<Albedo>,
) -> Albedo {
    let Some(source) = &found.specular else { return Albedo::Srgb };
    let median = measure::specular_median(&source.raster);
    let hint = found.inferred.specular.take();
    let is_known = hint.is_some();
    let hint = hint.or(detected);
    let chosen = options.specular.or(options.albedo).or(hint.as_ref().map(|h| h.0)).unwrap_or(Albedo::Srgb);
    let (says, why, certainty) = by_median(median);
    let contradicts =
        (says == Albedo::Linear) != (chosen == Albedo::Linear) && certainty == Certainty::Likely;
    let assumption = if options.specular.or(options.albedo).is_some() {
        if contradicts && !source.raster.is_float() {
            found.notes.push(Note::SpecularMedian {
                chosen,
                by: SpecifiedBy::Caller,
                median,
                suggests: says,
            });
        }
        Assumption::given(What::Specular, chosen)
    } else if contradicts
        && is_known
        && !source.raster.is_float()
        && hint.as_ref().is_none_or(|(.., certainty)| *certainty != Certainty::Sure)
    {
        let convention = hint.map_or(StorageConvention::SeparateColours.into(), |(_, why, _)| why);
        let why = Reason::ContradictedBy(Box::new(convention), Box::new(why));
        Assumption::new(What::Specular, chosen, why, Certainty::Unsure)
    } else if let Some((_, why, certainty)) = hint {
        Assumption::new(What::Specular, chosen, why, certainty)
    } else {
        Assumption::new(What::Specular, chosen, why, certainty)
    };
    found.assumptions.push(assumption);
    chosen
}
