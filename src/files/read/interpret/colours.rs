//! Encodings of colours: as specified, as the files tell, or as the gathered evidence suggests.

use super::values::decide;
use crate::read::gather::{ColourEvidence, PRIOR, SURE};
use crate::read::measure;
use crate::read::options::{Albedo, ReadOptions};
use crate::read::record::{
    Assumption, Certainty, Evidence, Note, Reason, SpecifiedBy, StorageConvention, What,
};
use crate::read::stored::{Inferred, StoredMaterial};

/// How diffuse (or a base colour) and specular are stored, recorded.
pub(super) fn encodings(
    found: &mut StoredMaterial,
    evidence: ColourEvidence,
    options: &ReadOptions,
) -> [Albedo; 2] {
    let [diffuse, specular] = detected(evidence);
    let inferred = found.inferred.albedo.take();
    // Without evidence the encoding is specified or inferred: then this is never asked.
    let detected = || diffuse.unwrap_or_else(|| alone(None));
    let albedo = decide(&mut found.assumptions, What::Albedo, options.albedo, inferred, detected);
    let is_other = options.albedo.is_none() && found.notes.contains(&Note::Primaries);
    if let Some(assumption) = found.assumptions.last_mut().filter(|_| is_other) {
        let why = std::mem::replace(&mut assumption.why, Reason::OtherPrimaries);
        assumption.why = Reason::ContradictedBy(Box::new(why), Box::new(Reason::OtherPrimaries));
        assumption.certainty = Certainty::Unsure;
    }
    [albedo, specular_encoding(found, options, specular)]
}

/// The encodings that the evidence supports, of diffuse (or a base colour) and of specular.
fn detected(evidence: ColourEvidence) -> [Inferred<Albedo>; 2] {
    match evidence {
        ColourEvidence::Specified => [None, None],
        ColourEvidence::Alone(dark) => [Some(alone(dark)), None],
        ColourEvidence::Pair { diffuse, specular, .. } => [diffuse, specular].map(verdict).map(Some),
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_verdict_rests_on_the_evidence_that_was_gathered() {
        let albedo = |evidence: &[Evidence]| {
            let (diffuse, specular) = (evidence.to_vec(), evidence.to_vec());
            let [diffuse, specular] = detected(ColourEvidence::Pair { diffuse, specular, neighbours: None });
            assert_eq!(diffuse, specular);
            diffuse.map(|(albedo, _, certainty)| (albedo, certainty)).unwrap()
        };
        assert_eq!(albedo(&[Evidence::Prior]), (Albedo::Srgb, Certainty::Likely));
        assert_eq!(albedo(&[Evidence::Research]), (Albedo::Srgb, Certainty::Unsure));
        let linear = Evidence::LinearDielectrics(1.0);
        assert_eq!(albedo(&[Evidence::Research, linear]), (Albedo::Linear, Certainty::Likely));
        let neighbours = |log_odds| Evidence::Neighbours { count: 4, log_odds };
        assert_eq!(albedo(&[Evidence::Research, neighbours(3.0)]), (Albedo::Linear, Certainty::Unsure));
        assert_eq!(albedo(&[Evidence::Research, neighbours(-3.0)]), (Albedo::Srgb, Certainty::Likely));
    }

    #[test]
    fn a_colour_by_itself_is_encoded_and_unsure_where_it_is_dark() {
        let of = |dark| detected(ColourEvidence::Alone(dark)).map(|one| one.map(|(a, _, c)| (a, c)));
        assert_eq!(of(None), [Some((Albedo::Srgb, Certainty::Likely)), None]);
        assert_eq!(of(Some(Evidence::Dark(0.03))), [Some((Albedo::Srgb, Certainty::Unsure)), None]);
        assert_eq!(detected(ColourEvidence::Specified), [None, None]);
    }
}
