//! The encoding of colours: linear or sRGB, the same for all files of a method.
//!
//! A method that is dark, flat or of high contrast stores other values, too. But a wrong encoding is a power: colours are bright and flat, or
//! dark and of high contrast, at once, and black stays black. Only where both halves of that are mended by the other reading, and a factor
//! then explains the prediction better than a factor and an offset do in the present one, the ground truths decide. The power 1 / 2.2 is too
//! near to sRGB to be told from it.

use svbrdf_core::material::Material;
use svbrdf_core::statistics::median;
use svbrdf_files::changes::Reading;
use svbrdf_files::read::{Albedo, Storage};

use super::super::reading::DatasetReading;
use super::group::{Group, Own, Sampled};

/// A colour of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Colour {
    Diffuse,
    Specular,
}

impl Colour {
    /// The option that specifies its encoding.
    fn key(self) -> &'static str {
        match self {
            Self::Diffuse => "albedo",
            Self::Specular => "specular-albedo",
        }
    }
}

pub(super) const ROLES: [Colour; 2] = [Colour::Diffuse, Colour::Specular];

const ENCODINGS: [Albedo; 2] = [Albedo::Linear, Albedo::Srgb];

/// Standard deviations of what methods do to the level of a colour and to its contrast, as logarithms.
const LEVEL: f64 = 0.5;
const CONTRAST: f64 = 0.25;
/// By how much the other reading is to be better, as log odds.
const MARGIN: f64 = 2.5;
/// Log odds that leave an encoding open.
const SURE: f64 = 2.0;
/// The share of the materials that are to agree.
const SHARE: f64 = 0.8;
/// Added to colours before their logarithm.
const DARK: f64 = 0.004;
/// Spread of the logarithms below which the ground truths have no contrast to tell by.
const NO_CONTRAST: f64 = 0.15;

/// The encodings of a ground truth and a prediction.
type Both = [Albedo; 2];

/// Decides how a colour of the ground truths and of each method is read.
pub(super) fn decide(decided: &mut DatasetReading, groups: &[Group<'_>], colour: Colour) {
    let of_groups: Vec<(&Group<'_>, Verdict)> =
        groups.iter().filter_map(|group| Some((group, verdict(group, colour)?))).collect();
    // The ground truths are read in one way for all methods: in another one than by themselves only where all agree.
    let truths: Vec<Albedo> = of_groups.iter().map(|(_, verdict)| verdict.encodings[0]).collect();
    let Some(first) = truths.first().copied() else { return };
    let do_agree = truths.iter().all(|truth| *truth == first);
    for (group, verdict) in &of_groups {
        let of_truths = if do_agree { verdict.encodings } else { verdict.default };
        specify(decided, group, colour, Side::Method, of_truths[1], verdict);
        decided.decisions.extend(verdict.unsure.map(|other| doubt(group, colour, verdict.default, other)));
    }
    if let Some((group, verdict)) = of_groups.first().filter(|_| do_agree) {
        specify(decided, group, colour, Side::GroundTruths, first, verdict);
    }
}

/// What a person should look at, and what to type where it is so.
fn doubt(group: &Group<'_>, colour: Colour, default: Both, other: Both) -> String {
    let place = usize::from(default[0] == other[0]);
    let (key, whose) = (colour.key(), if place == 0 { "gt" } else { group.method });
    format!(
        "{}: unsure whether {key} of {whose} is {}: level and contrast suggest it, and single texels do not; look at one, and where it is so \
         type --read {whose}:{key}={}",
        group.method, other[place], other[place]
    )
}

#[derive(Clone, Copy, PartialEq)]
enum Side {
    GroundTruths,
    Method,
}

/// Specifies an encoding, and says so, where files by themselves are read otherwise.
fn specify(
    decided: &mut DatasetReading,
    group: &Group<'_>,
    colour: Colour,
    side: Side,
    encoding: Albedo,
    verdict: &Verdict,
) {
    let place = usize::from(side == Side::Method);
    let own = group.pairs.iter().map(|pair| pair[place].own[colour as usize]);
    let other = own.clone().filter(|own| own.encoding != Some(encoding)).count();
    if other == 0 || own.clone().any(|own| own.is_stated) {
        return;
    }
    let (options, name) = match side {
        Side::GroundTruths => (&mut decided.ground_truths, "ground truths"),
        Side::Method => (decided.options_mut(group.method), group.method),
    };
    let key = colour.key();
    match colour {
        // What is said of diffuse alone holds for specular, too, unless that is specified.
        Colour::Diffuse => options.albedo = Some(encoding),
        Colour::Specular => options.specular = Some(encoding),
    }
    let why = match verdict.is_witnessed {
        true => format!("ground truths beside {} materials say so", group.pairs.len()),
        false => format!("most of {} materials say so", group.pairs.len()),
    };
    decided.decisions.push(format!(
        "{name}: {key}={} for all: {why}; by themselves {other} of {} are read otherwise",
        encoding,
        group.pairs.len()
    ));
}

/// The encodings of the ground truths and of a method.
struct Verdict {
    encodings: Both,
    /// Those without a witness.
    default: Both,
    is_witnessed: bool,
    /// Those that levels and contrasts suggest, and single texels do not.
    unsure: Option<Both>,
}

/// `None` where both are stated.
fn verdict(group: &Group<'_>, colour: Colour) -> Option<Verdict> {
    let sides = [0, 1].map(|side| {
        let own: Vec<[Own; 2]> = group.pairs.iter().map(|pair| pair[side].own).collect();
        let stated = own.iter().map(|own| own[colour as usize]).find(|own| own.is_stated);
        let stated = stated.and_then(|own| own.encoding);
        let of = |colour: Colour| {
            let custom = own.first().map_or(0.0, |own| own[colour as usize].custom);
            custom + own.iter().map(|own| own[colour as usize].pixels).sum::<f64>()
        };
        // Where diffuse alone leaves it open, it is stored as specular is.
        let is_open = colour == Colour::Diffuse && of(colour).abs() < SURE;
        let log_odds = of(colour) + if is_open { of(Colour::Specular) } else { 0.0 };
        let most = if log_odds > 0.0 { Albedo::Linear } else { Albedo::Srgb };
        (stated, most)
    });
    let has_base = group.pairs.iter().flatten().any(|one| one.storage.base_colour);
    if sides.iter().all(|(stated, _)| stated.is_some()) || (has_base && colour == Colour::Specular) {
        return None;
    }
    let [truth, method] = sides.map(|(stated, most)| stated.unwrap_or(most));
    // Files of one kind are stored in one way, unless the ground truths say otherwise.
    let is_one_kind = sides.iter().all(|(stated, _)| stated.is_none());
    let default = if is_one_kind { [truth; 2] } else { [truth, method] };
    let is_possible = |both: &Both| {
        both.iter().zip(&sides).all(|(one, (stated, _))| stated.is_none_or(|stated| stated == *one))
    };
    let all = ENCODINGS.into_iter().flat_map(|truth| ENCODINGS.map(|method| [truth, method]));
    // Both in the other encoding are as near to each other as before.
    let others = all.filter(|both| is_possible(both) && (both[0] == both[1]) != (default[0] == default[1]));
    let distance = |both: &Both| distance(group.pairs, *both, colour);
    let present = distance(&default);
    let nearer = others.filter_map(|both| {
        let found = distance(&both)?;
        (found + MARGIN <= present?).then_some((both, found))
    });
    let nearest = nearer.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(both, _)| both);
    let best = nearest.filter(|both| agreeing(group.pairs, default, *both, colour) >= SHARE);
    let encodings = best.unwrap_or(default);
    let unsure = nearest.filter(|_| best.is_none());
    Some(Verdict { encodings, default, is_witnessed: best.is_some(), unsure })
}

/// The mean over the channels of a colour, read in another encoding.
fn values(one: &Sampled, encoding: Albedo, colour: Colour) -> Vec<f64> {
    let reading = match colour {
        Colour::Diffuse if one.storage.base_colour => Reading::Colours(encoding),
        Colour::Diffuse => Reading::Diffuse(encoding),
        Colour::Specular => Reading::Specular(encoding),
    };
    let material = reading.applied(&one.texels, &one.storage).unwrap_or_else(|_| one.texels.clone());
    let planes = of(&material, colour);
    (0..planes[0].len()).map(|i| planes.iter().map(|plane| f64::from(plane[i])).sum::<f64>() / 3.0).collect()
}

fn of(material: &Material<f32>, colour: Colour) -> &[Vec<f32>; 3] {
    match colour {
        Colour::Diffuse => &material.planes().diffuse,
        Colour::Specular => &material.planes().specular,
    }
}

/// How far level and contrast of all predictions are from those of their ground truths, as a logarithm of a probability; `None` where the
/// ground truths have no contrast.
fn distance(pairs: &[[Sampled; 2]], both: Both, colour: Colour) -> Option<f64> {
    let logarithms = |side: usize| -> Vec<f64> {
        let all = pairs.iter().flat_map(|pair| values(&pair[side], both[side], colour));
        all.map(|value| (value + DARK).ln()).collect()
    };
    let [mut truth, mut prediction] = [0, 1].map(logarithms);
    let contrast = [&truth, &prediction].map(|values| spread(values).max(1e-9));
    let level = median(&mut prediction)? - median(&mut truth)?;
    let apart = [level / LEVEL, (contrast[1] / contrast[0]).ln() / CONTRAST];
    (contrast[0] > NO_CONTRAST).then(|| apart.iter().map(|one| one * one / 2.0).sum())
}

fn spread(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
}

/// The share of the materials that a factor in the encodings `other` explains better than a factor and an offset in those of `present`, by
/// the mean difference of the stored values.
fn agreeing(pairs: &[[Sampled; 2]], present: Both, other: Both, colour: Colour) -> f64 {
    let is_for = |pair: &&[Sampled; 2]| {
        let [truth, prediction] = read(pair, present, colour);
        let line = fitted(&truth, &prediction);
        by_factor(pair, other, colour)
            < difference(&truth, &prediction, present[1], |t| line[0] + line[1] * t)
    };
    pairs.iter().filter(is_for).count() as f64 / pairs.len().max(1) as f64
}

fn read(pair: &[Sampled; 2], both: Both, colour: Colour) -> [Vec<f64>; 2] {
    [0, 1].map(|side| values(&pair[side], both[side], colour))
}

/// What a factor leaves of the difference of a prediction from its ground truth.
fn by_factor(pair: &[Sampled; 2], both: Both, colour: Colour) -> f64 {
    let [truth, prediction] = read(pair, both, colour);
    let ratio = |(t, p): (&f64, &f64)| ((p + 1e-4) / (t + 1e-4)).ln();
    let mut ratios: Vec<f64> = truth.iter().zip(&prediction).map(ratio).collect();
    let factor = median(&mut ratios).unwrap_or(0.0).exp();
    difference(&truth, &prediction, both[1], |t| factor * t)
}

fn difference(truth: &[f64], prediction: &[f64], encoding: Albedo, explained: impl Fn(f64) -> f64) -> f64 {
    let stored = |value: f64| f64::from(Storage::encode(Some(encoding), value.clamp(0.0, 1.0) as f32));
    truth.iter().zip(prediction).map(|(t, p)| (stored(explained(*t)) - stored(*p)).abs()).sum()
}

/// Offset and factor by least squares.
fn fitted(x: &[f64], y: &[f64]) -> [f64; 2] {
    let count = x.len() as f64;
    let [mean_x, mean_y] = [x, y].map(|values| values.iter().sum::<f64>() / count);
    let squares: f64 = x.iter().map(|x| (x - mean_x).powi(2)).sum();
    let products: f64 = x.iter().zip(y).map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let factor = if squares > 0.0 { products / squares } else { 0.0 };
    [mean_y - factor * mean_x, factor]
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt as _, SeedableRng as _};
    use svbrdf_core::material::Planes;

    /// What a method makes of the colour of a texel, and of the mean of its material.
    type Method = fn(f64, f64) -> f64;

    const HONEST: Method = |value, _| value;
    const BAD: [Method; 10] = [
        |value, _| 0.1 * value,
        |value, _| 0.22 * value,
        |value, _| 0.5 * value,
        |value, _| 1.8 * value,
        |_, mean| mean,
        |value, mean| mean + 0.2 * (value - mean),
        |value, mean| mean + 0.5 * (value - mean),
        |value, mean| 1.6 * (mean + 0.3 * (value - mean)),
        |value, mean| 0.4 * (mean + 0.4 * (value - mean)),
        |value, mean| mean + 1.6 * (value - mean),
    ];

    /// A colour of 8 bits that is stored so and read by itself in another way.
    fn sampled(values: &[f64], stored: Albedo, read: Albedo) -> Sampled {
        let encoded = |value: &f64| Storage::encode(Some(stored), value.clamp(0.0, 1.0) as f32);
        let code = |value| (255.0 * encoded(value)).round() / 255.0;
        let read = Some(read);
        let plane: Vec<f32> = values.iter().map(|value| Storage::decode(read, code(value))).collect();
        let [zeros, ones] = [0.0, 1.0].map(|value| vec![value; plane.len()]);
        let planes = Planes {
            normal: [zeros.clone(), zeros.clone(), ones],
            diffuse: [plane.clone(), plane.clone(), plane],
            specular: [zeros.clone(), zeros.clone(), zeros.clone()],
            roughness: zeros,
        };
        let own = Own { encoding: read, custom: -1.1, pixels: 0.0, is_stated: false };
        let storage = Storage { colours: read, specular: read, ..Storage::default() };
        let texels = Material::new("m", values.len(), 1, planes).unwrap();
        Sampled { texels, storage, own: [own; 2] }
    }

    /// Eight materials of smooth colours whose level differs, and what a method with errors of its own makes of them.
    fn pairs(
        method: Method,
        [truth, stored]: Both,
        noise: f64,
        generator: &mut ChaCha8Rng,
    ) -> Vec<[Sampled; 2]> {
        let material = |_| {
            let mut random = || generator.random_range(0.0..1.0);
            let (level, waves) = (0.05 + 0.4 * random(), [random(), random(), random(), random()]);
            let wave = |i: f64, of: f64, phase: f64| (0.02 * (1.0 + 3.0 * of) * i + 6.0 * phase).sin();
            let colours: Vec<f64> = (0..256_u16)
                .map(|i| {
                    level
                        * (1.0
                            + 0.3 * wave(i.into(), waves[0], waves[1])
                            + 0.2 * wave(i.into(), waves[2], waves[3]))
                })
                .collect();
            let mean = colours.iter().sum::<f64>() / colours.len() as f64;
            let errors = [random(), random()];
            let error = |i: usize| (noise * wave(i as f64, errors[0], errors[1])).exp();
            let of = |(i, value): (usize, &f64)| method(*value, mean) * error(i);
            let predicted: Vec<f64> = colours.iter().enumerate().map(of).collect();
            [sampled(&colours, truth, Albedo::Srgb), sampled(&predicted, stored, Albedo::Srgb)]
        };
        (0..8).map(material).collect()
    }

    fn encodings(pairs: &[[Sampled; 2]]) -> Both {
        verdict(&Group { method: "ours", pairs }, Colour::Diffuse).unwrap().encodings
    }

    #[test]
    fn ground_truths_tell_how_a_method_is_stored() {
        use Albedo::{Linear, Srgb};
        let mut generator = ChaCha8Rng::seed_from_u64(1);
        for noise in [0.0, 0.05, 0.1, 0.2] {
            for stored in [[Srgb, Linear], [Linear, Srgb], [Srgb, Srgb]] {
                let pairs = pairs(HONEST, stored, noise, &mut generator);
                let verdict = verdict(&Group { method: "ours", pairs: &pairs }, Colour::Diffuse).unwrap();
                // Errors of a method as large as the contrast of a material leave it open, and that is said.
                let is_open = noise >= 0.1 && verdict.unsure == Some(stored);
                assert!(
                    verdict.encodings == stored || is_open,
                    "{stored:?}, {noise}: {:?}",
                    verdict.encodings
                );
            }
        }
    }

    #[test]
    fn no_reading_flatters_a_bad_method() {
        let mut generator = ChaCha8Rng::seed_from_u64(2);
        let wrong = (0..200).filter(|trial: &usize| {
            let noise = [0.02, 0.1, 0.2, 0.3][trial / 10 % 4];
            let stored = [Albedo::Srgb; 2];
            encodings(&pairs(BAD[trial % 10], stored, noise, &mut generator)) != stored
        });
        assert_eq!(wrong.collect::<Vec<_>>(), [0_usize; 0], "of 200");
    }
}
