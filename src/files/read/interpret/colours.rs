//! Encodings of colours: of each map as specified, as its own file tells, or as the evidence of pixels suggests.

use super::evidence::{self, CUSTOM, PRIOR, SURE};
use crate::read::options::{Albedo, ReadOptions, Roughness};
use crate::read::raster::measure;
use crate::read::record::{Assumption, Certainty, Evidence, Ground, Note, Reason, What};
use crate::read::stored::{Inferred, StoredMap, StoredMaterial};

const SEPARATE: Reason =
    Reason::fixed(Ground::Convention, "colours in separate files are sRGB by convention");
const PRIMARIES: Reason = Reason::fixed(
    Ground::Measurement,
    "the file declares primaries that enclose no white, and cannot be converted",
);

/// An encoding with its reason and certainty.
type Choice = (Albedo, Reason, Certainty);

/// How diffuse (or a base colour) and specular are stored, recorded.
pub(super) fn encodings(found: &mut StoredMaterial, options: &ReadOptions) -> [Albedo; 2] {
    let given = [options.albedo, options.specular.or(options.albedo)];
    let known = [found.inferred.albedo.take(), found.inferred.specular.take()];
    let is_open = |which: usize| {
        given[which].is_none() && known[which].as_ref().is_none_or(|(_, why, _)| why.is_custom_of_codes())
    };
    let open = [is_open(0), is_open(1) && found.specular.is_some()];
    let evidence = evidence_of(found, open, options);
    let mut chosen = [Albedo::Srgb; 2];
    for (which, (known, evidence)) in known.into_iter().zip(evidence).enumerate() {
        let Some(map) = [Some(&found.colour), found.specular.as_ref()][which] else { continue };
        let (albedo, mut why, mut certainty) = match (given[which], known) {
            (Some(given), _) => {
                found.notes.extend((which == 1).then(|| contradiction(map, given)).flatten());
                (given, Reason::SPECIFIED, Certainty::Given)
            }
            (None, Some(known)) => judged(known, evidence, &mut found.inferred.roughness),
            (None, None) if which == 0 && open != [true; 2] => alone(evidence),
            (None, None) => verdict(evidence),
        };
        if which == 0 && certainty != Certainty::Given && found.notes.contains(&Note::Primaries) {
            why = why.contradicted(&PRIMARIES);
            certainty = Certainty::Unsure;
        }
        chosen[which] = albedo;
        found.assumptions.push(Assumption::new(
            [What::Albedo, What::Specular][which],
            albedo,
            why,
            certainty,
        ));
    }
    chosen
}

/// The evidence of the pixels about each colour that is `open`: of both together only where both are.
fn evidence_of(found: &StoredMaterial, open: [bool; 2], options: &ReadOptions) -> [Vec<Evidence>; 2] {
    let roughness = options.roughness.or(found.inferred.roughness.as_ref().map(|known| known.0));
    // Glossiness is how artists name it.
    let prior = if roughness == Some(Roughness::Gloss) { Evidence::Prior } else { Evidence::Research };
    let jpeg =
        |maps: &[&StoredMap]| maps.iter().all(|map| evidence::is_jpeg(&map.file)).then_some(Evidence::Jpeg);
    let diffuse = &found.colour;
    match &found.specular {
        Some(specular) if open == [true; 2] => {
            let mut common: Vec<_> = [prior].into_iter().chain(jpeg(&[diffuse, specular])).collect();
            let are_one_size = diffuse.raster.size() == specular.raster.size();
            let diffuse = if are_one_size { evidence::texels(&diffuse.raster) } else { Vec::new() };
            let specular = evidence::texels(&specular.raster);
            common.extend(evidence::measured(&diffuse, &specular));
            // The two differ only where evidence about diffuse alone does.
            let bright = evidence::too_bright(&diffuse, &specular);
            [common.iter().copied().chain(bright).collect(), common]
        }
        Some(specular) if open[1] => {
            let of_specular = evidence::dielectrics(&evidence::texels(&specular.raster));
            let all = [prior].into_iter().chain(jpeg(&[specular])).chain(of_specular);
            [Vec::new(), all.collect()]
        }
        _ if open[0] => {
            [evidence::alone(&evidence::texels(&diffuse.raster)).into_iter().collect(), Vec::new()]
        }
        _ => Default::default(),
    }
}

/// What a file tells, against the evidence of pixels: a custom of codes is doubted, or outweighed, and the curve of roughness with it.
fn judged(known: Choice, evidence: Vec<Evidence>, roughness: &mut Inferred<Roughness>) -> Choice {
    let (albedo, why, certainty) = known;
    let counts = |one: &Evidence| !one.is_custom() && !matches!(one, Evidence::Dark(_));
    let evidence: Vec<_> = evidence.into_iter().filter(counts).collect();
    let log_odds: f64 = evidence.iter().map(|one| one.log_odds()).sum();
    let against = if albedo == Albedo::Linear { -log_odds } else { log_odds };
    if against < SURE {
        return (albedo, why, certainty);
    }
    let other = if albedo == Albedo::Linear { Albedo::Srgb } else { Albedo::Linear };
    let is_outweighed = against > CUSTOM;
    let contradicted = why.contradicted(&Reason::weighed(log_odds, &evidence));
    if let Some((Roughness::Gamma22, of_roughness, _)) = roughness
        && is_outweighed
        && *of_roughness == why
    {
        *roughness = Some((Roughness::R, contradicted.clone(), Certainty::Unsure));
    }
    (if is_outweighed { other } else { albedo }, contradicted, Certainty::Unsure)
}

/// The encoding of a colour without another one to compare it with, by convention.
fn alone(mut dark: Vec<Evidence>) -> Choice {
    if dark.is_empty() {
        return (Albedo::Srgb, SEPARATE, Certainty::Likely);
    }
    dark.insert(0, Evidence::Prior);
    (Albedo::Srgb, Reason::weighed(PRIOR, &dark), Certainty::Unsure)
}

fn verdict(evidence: Vec<Evidence>) -> Choice {
    let log_odds = evidence.iter().map(|one| one.log_odds()).sum::<f64>();
    let albedo = if log_odds > 0.0 { Albedo::Linear } else { Albedo::Srgb };
    let disagrees = |one: &Evidence| {
        let alone = one.log_odds();
        !one.is_custom() && alone.abs() >= SURE && (alone > 0.0) != (log_odds > 0.0)
    };
    let is_sure = log_odds.abs() >= SURE && !evidence.iter().any(disagrees);
    let certainty = if is_sure { Certainty::Likely } else { Certainty::Unsure };
    (albedo, Reason::weighed(log_odds, &evidence), certainty)
}

/// The note that the median of a specular map suggests another encoding than the one that is specified: 0.04 stored linearly, or encoded.
fn contradiction(map: &StoredMap, chosen: Albedo) -> Option<Note> {
    let median = measure::specular_median(&map.raster);
    let suggests = match median {
        0.03..=0.06 => Albedo::Linear,
        0.2..=0.26 => Albedo::Srgb,
        _ => return None,
    };
    let is_other = (suggests == Albedo::Linear) != (chosen == Albedo::Linear) && !map.raster.is_float();
    is_other.then(|| {
        Note::Changed(format!(
            "Specular is read as {chosen}, as specified, but its median is {median:.3}, which suggests {suggests}: check it."
        ))
    })
}
