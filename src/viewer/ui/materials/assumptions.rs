//! Assumptions about each map of a material, one line a map.

use svbrdf_core::material::Map;
use svbrdf_files::read::{Assumption, Certainty, What};

/// The parts of a material that assumptions are about, in the order of the lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Material,
    Normal,
    Diffuse,
    Specular,
    Roughness,
}

impl Part {
    const ALL: [Self; 5] = [Self::Material, Self::Normal, Self::Diffuse, Self::Specular, Self::Roughness];

    fn name(self) -> &'static str {
        match self {
            Self::Material => "Material",
            Self::Normal => "Normal",
            Self::Diffuse => "Diffuse",
            Self::Specular => "Specular",
            Self::Roughness => "Roughness",
        }
    }

    fn of(assumption: &Assumption) -> Self {
        match assumption.map() {
            None => Self::Material,
            Some(Map::Normal) => Self::Normal,
            Some(Map::Diffuse) => Self::Diffuse,
            Some(Map::Specular) => Self::Specular,
            Some(Map::Roughness) => Self::Roughness,
        }
    }
}

/// What was assumed about a map or about the material as a whole.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AssumedLine {
    /// The map, or "Material".
    pub name: &'static str,
    pub chosen: String,
    pub why: String,
    /// Whether another reading is as plausible.
    pub unsure: bool,
}

/// The lines of the parts about which something was assumed.
pub fn lines(assumptions: &[Assumption]) -> Vec<AssumedLine> {
    let line = |part: Part| {
        let about: Vec<&Assumption> = assumptions.iter().filter(|a| Part::of(a) == part).collect();
        let mut chosen: Vec<String> = Vec::new();
        let mut why: Vec<String> = Vec::new();
        for assumption in &about {
            chosen.push(words(part, assumption));
        }
        // What is unsure comes first: the line may be cut.
        let (unsure, sure): (Vec<&Assumption>, Vec<&Assumption>) =
            about.iter().partition(|assumption| assumption.certainty == Certainty::Unsure);
        for assumption in unsure.iter().chain(&sure) {
            let reason = assumption.why.to_string();
            if !why.contains(&reason) {
                why.push(reason);
            }
        }
        (!about.is_empty()).then(|| AssumedLine {
            name: part.name(),
            chosen: chosen.join(", "),
            why: why.join("; "),
            unsure: !unsure.is_empty(),
        })
    };
    Part::ALL.into_iter().filter_map(line).collect()
}

/// The choice in words that need no heading.
fn words(part: Part, assumption: &Assumption) -> String {
    let chosen = &assumption.chosen;
    match assumption.what {
        What::NormalY => format!("y {chosen}"),
        What::Workflow => format!("{chosen} workflow"),
        What::Energy => format!("{chosen} by (1 - specular)"),
        What::Size => format!("resampled to {chosen}"),
        What::Roughness if chosen == "r" => "r as stored".to_owned(),
        What::Missing => {
            let value = chosen.strip_prefix(&part.name().to_lowercase()).unwrap_or(chosen);
            format!("no map, {} everywhere", value.trim())
        }
        _ => chosen.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_files::read::{Reason, Role, SpecifiedBy, StorageConvention};

    fn assumption(what: What, chosen: &str, why: impl Into<Reason>, certainty: Certainty) -> Assumption {
        Assumption::new(what, chosen, why, certainty)
    }

    #[test]
    fn each_map_has_one_line_with_each_reason_once_and_what_is_unsure_first() {
        let order = StorageConvention::DeschaintreOrder;
        let all = [
            assumption(What::Layout, "ndrs", Reason::UsualOrder, Certainty::Likely),
            assumption(What::Workflow, "specular", Reason::SpecularMap, Certainty::Sure),
            assumption(What::Albedo, "linear", order, Certainty::Likely),
            assumption(What::Roughness, "r", order, Certainty::Likely),
            assumption(What::NormalEncoding, "xy", Reason::TwoChannels, Certainty::Sure),
            assumption(What::NormalY, "up", Reason::MostMapsUp(0.1), Certainty::Unsure),
            assumption(What::Energy, "scaled", order, Certainty::Likely),
        ];
        let lines = lines(&all);
        let names: Vec<_> = lines.iter().map(|line| line.name).collect();
        assert_eq!(names, ["Material", "Normal", "Diffuse", "Roughness"]);
        assert_eq!(lines[0].chosen, "ndrs, specular workflow");
        assert_eq!(lines[1].chosen, "xy, y up");
        let first = Reason::MostMapsUp(0.1).to_string();
        assert!(lines[1].why.starts_with(&first), "{}", lines[1].why);
        assert!(lines[1].why.ends_with(&Reason::TwoChannels.to_string()), "{}", lines[1].why);
        assert_eq!(lines.iter().map(|line| line.unsure).collect::<Vec<_>>(), [false, true, false, false]);
        assert_eq!(lines[2].chosen, "linear, scaled by (1 - specular)");
        assert_eq!(lines[2].why, order.to_string());
        assert_eq!(lines[3].chosen, "r as stored");
    }

    #[test]
    fn values_and_absent_maps_stand_in_the_line_of_their_map() {
        let out_of_range = Reason::OutsideUnit { map: Role::Base, count: 3, low: -1.0, high: 2.0 };
        let cases = [
            (
                What::Missing,
                "normal (0, 0, 1)",
                Reason::NoNormalMap,
                "Normal",
                "no map, (0, 0, 1) everywhere",
            ),
            (What::Missing, "specular 0.04", Reason::NoSpecularMap, "Specular", "no map, 0.04 everywhere"),
            (
                What::Missing,
                "specular 0.08",
                Reason::Specified(SpecifiedBy::Caller),
                "Specular",
                "no map, 0.08 everywhere",
            ),
            (What::Missing, "roughness 0.5", Reason::DiffuseAlone, "Roughness", "no map, 0.5 everywhere"),
            (What::Values, "clamped to [0, 1]", out_of_range, "Diffuse", "clamped to [0, 1]"),
            (What::Size, "64 x 64", Reason::SmallerMaps(Vec::new()), "Material", "resampled to 64 x 64"),
        ];
        for (what, chosen, why, name, expected) in cases {
            let lines = lines(&[assumption(what, chosen, why, Certainty::Likely)]);
            assert_eq!(lines.len(), 1, "{chosen}");
            assert_eq!((lines[0].name, lines[0].chosen.as_str()), (name, expected));
        }
    }
}
