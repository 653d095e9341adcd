//! Options of reading that a diagnosis suggests.

use svbrdf_core::diagnose::Remedy;
use svbrdf_core::error::Error;

use super::ReadOptions;

impl ReadOptions {
    /// These options with the one that corrects the reading.
    ///
    /// # Errors
    /// [`Error::UnknownName`] for a value that the option does not have.
    pub fn with_remedy(self, remedy: Remedy) -> Result<Self, Error> {
        let name = remedy.value();
        Ok(match remedy {
            Remedy::NormalY(_) => Self { normal_y: Some(name.parse()?), ..self },
            Remedy::Albedo(_) => Self { albedo: Some(name.parse()?), ..self },
            Remedy::SpecularAlbedo(_) => Self { specular: Some(name.parse()?), ..self },
            Remedy::Roughness(_) => Self { roughness: Some(name.parse()?), ..self },
            Remedy::Energy(_) => Self { energy: Some(name.parse()?), ..self },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Albedo, NormalY, Roughness};
    use super::*;

    #[test]
    fn the_values_of_remedies_are_those_of_the_options() {
        let remedies = [
            (Remedy::NormalY("down"), ReadOptions { normal_y: Some(NormalY::Down), ..ReadOptions::AUTO }),
            (Remedy::Albedo("linear"), ReadOptions { albedo: Some(Albedo::Linear), ..ReadOptions::AUTO }),
            (
                Remedy::SpecularAlbedo("srgb"),
                ReadOptions { specular: Some(Albedo::Srgb), ..ReadOptions::AUTO },
            ),
            (
                Remedy::Roughness("alpha"),
                ReadOptions { roughness: Some(Roughness::Alpha), ..ReadOptions::AUTO },
            ),
        ];
        for (remedy, expected) in remedies {
            assert_eq!(ReadOptions::AUTO.with_remedy(remedy).unwrap(), expected, "{remedy}");
        }
        let others = [Remedy::NormalY("up"), Remedy::Roughness("gloss"), Remedy::Roughness("r")];
        for remedy in others.into_iter().chain(["scaled", "unscaled"].map(Remedy::Energy)) {
            ReadOptions::AUTO.with_remedy(remedy).unwrap();
        }
        assert!(ReadOptions::AUTO.with_remedy(Remedy::Energy("none")).is_err());
    }
}
