//! A selection of metrics by their names, or by words of them.

use serde::{Deserialize, Serialize};

use super::{maps, renderings};
use svbrdf_core::error::Error;

/// Metrics by their names or by words of them: `psnr` is all peak signal-to-noise ratios, `rmse_roughness` those names that have these
/// words. Empty: all.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Vec<String>", into = "Vec<String>")]
pub struct MetricSelection(Vec<String>);

impl MetricSelection {
    /// Whether a metric is one of them.
    pub fn has(&self, name: &str) -> bool {
        self.0.is_empty() || self.0.iter().any(|words| has_words(name, words))
    }

    /// Whether a metric of maps is one of them.
    pub fn has_maps(&self) -> bool {
        maps::names().any(|name| self.has(name))
    }

    /// Whether a metric of renderings is one of them.
    pub fn has_renderings(&self) -> bool {
        renderings::NAMES.into_iter().any(|name| self.has(name))
    }

    /// Whether one of the words is of metrics of renderings alone, which need scenes.
    pub fn needs_scenes(&self) -> bool {
        self.0.iter().any(|words| !maps::names().any(|name| has_words(name, words)))
    }

    /// The metrics of these names, and no others that have their words.
    pub(crate) fn of_names(names: Vec<String>) -> Self {
        Self(names.into_iter().map(|name| format!("={name}")).collect())
    }

    /// Whether all metrics are.
    pub fn is_all(&self) -> bool {
        self.0.is_empty()
    }

    /// The names of all metrics.
    pub fn names() -> Vec<&'static str> {
        names().collect()
    }

    /// The first words of all names, then the names.
    pub fn words() -> Vec<&'static str> {
        let mut kinds: Vec<_> = names().filter_map(|name| name.split('_').next()).collect();
        kinds.sort_unstable();
        kinds.dedup();
        kinds.into_iter().chain(names()).collect()
    }
}

impl TryFrom<Vec<String>> for MetricSelection {
    type Error = Error;

    /// # Errors
    /// [`Error::UnknownName`] for words that no metric has.
    fn try_from(words: Vec<String>) -> Result<Self, Error> {
        match words.iter().find(|words| !names().any(|name| has_words(name, words))) {
            None => Ok(Self(words)),
            Some(unknown) => {
                let known = "words of names such as rmse, l1, psnr, ssim11, ssim7, angle, flip, normal, diffuse, roughness, \
                    rendering, or a whole name as in docs/metrics.md";
                Err(Error::unknown_name("metric", unknown, known))
            }
        }
    }
}

impl From<MetricSelection> for Vec<String> {
    fn from(MetricSelection(words): MetricSelection) -> Self {
        words
    }
}

fn names() -> impl Iterator<Item = &'static str> {
    maps::names().chain(renderings::NAMES)
}

/// Whether `words` are a part of `name`, whole words only; after `=`, whether they are the name.
fn has_words(name: &str, words: &str) -> bool {
    words.strip_prefix('=').is_some_and(|whole| whole == name)
        || format!("_{name}_").contains(&format!("_{words}_"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::{RenderedScenes, of_maps, of_renderings};
    use svbrdf_core::material::Material;
    use svbrdf_core::model::brdf::Texel;
    use svbrdf_core::model::convention::PRINTED;
    use svbrdf_core::model::sampler::Sampler;
    use svbrdf_core::progress::Progress;

    fn selection(words: &[&str]) -> Result<MetricSelection, Error> {
        words.iter().map(|&words| words.to_owned()).collect::<Vec<_>>().try_into()
    }

    #[test]
    fn the_names_are_those_of_the_metrics() {
        let texel = Texel { normal: glam::Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness: 0.5 };
        let material = Material::uniform("m", 16, 16, &texel).unwrap();
        let scenes = Sampler::Random.scenes(0, 2, 2, &PRINTED);
        let rendered = RenderedScenes {
            scenes: &scenes,
            sampler: Sampler::Random,
            convention: &PRINTED,
            exposure_ev: 0.0,
        };
        let computed = [
            of_maps(&material, &material).unwrap(),
            of_renderings(&material, &material, &rendered, &Progress::default()).unwrap(),
        ];
        let computed: Vec<_> = computed.iter().flatten().map(|metric| metric.name).collect();
        assert_eq!(names().collect::<Vec<_>>(), computed);
    }

    #[test]
    fn words_select_the_metrics_that_have_them() {
        let psnr = selection(&["psnr", "rmse_roughness"]).unwrap();
        assert!(psnr.has("psnr_roughness") && psnr.has("rmse_roughness_alpha") && !psnr.has("l1_roughness"));
        assert!(psnr.has_maps() && psnr.has_renderings() && !psnr.needs_scenes());
        assert!(selection(&["flip", "psnr"]).unwrap().needs_scenes());
        let rough = selection(&["l1_roughness"]).unwrap();
        assert!(rough.has_maps() && !rough.has_renderings() && !rough.has("l1_diffuse_linear"));
        let flip = selection(&["flip"]).unwrap();
        assert!(!flip.has_maps() && flip.has_renderings());
        assert!(MetricSelection::default().has("anything"));
        for wrong in ["rough", "lpips", "", "rmse_"] {
            assert!(selection(&[wrong]).is_err(), "{wrong}");
        }
    }
}
