//! The authors' own renderers at probe points.

use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::grammar::{Description, Point};
use svbrdf_core::model::named_conventions as named;
use svbrdf_evaluate::conform::{RenderedPoints, VerdictKind, identify, verdict};
use svbrdf_needs::needs;

use crate::conventions::peers::{PEERS, file, point, triple};

/// The file, its array, and the convention; `None` for a renderer outside of the grammar.
const ALL: [(&str, &str, Option<&str>); 17] = [
    ("chord", "radiance", Some("chord-2025")),
    ("deschaintre_guided_2020", "radiance", Some("guided-2020")),
    ("deschaintre_multi_2019", "radiance", Some("multi-image-2019")),
    ("deschaintre_single_2018", "radiance", Some("single-image-2018")),
    ("diff_renderer", "radiance", Some("materialgan-2020")),
    ("gltf_viewer", "radiance", Some("gltf-viewer")),
    ("learnopengl", "radiance", Some("learnopengl")),
    ("luo", "radiance", Some("luo-2024")),
    ("material_palette", "radiance", Some("material-palette-2024")),
    ("matfuse", "radiance", Some("matfuse-2024")),
    ("mworchel", "radiance", Some("svbrdf-estimation-2022")),
    ("mitsuba_ds", "roughconductor_ggx_none", Some("mitsuba-roughconductor-ggx")),
    ("mitsuba_ds", "roughconductor_beckmann_none", Some("mitsuba-roughconductor-beckmann")),
    ("mitsuba_ds", "principled", None),
    ("mitsuba_ds", "roughplastic_ggx", None),
    ("mitsuba_metal", "principled", None),
    ("mitsuba_metal", "roughplastic_ggx", None),
];

fn points() -> Vec<Point> {
    let of = file("probes");
    let point = |row: usize| Point {
        light: triple(&of["L"], row),
        view: triple(&of["V"], row),
        base_color: triple(&of["base"], row),
        ..point(&of, "", row)
    };
    (0..of["r"].values.len()).map(point).collect()
}

/// RendererTerms that the makers of the numbers set for the probes: intensities and frames.
const OF_THE_PROBES: [&str; 6] = ["intensity", "factor", "normal_y", "ambient", "clip", "clip_terms"];

#[needs(shared)]
fn every_peer_is_found_and_no_other_renderer_has_a_name() {
    let points = points();
    for (name, array, convention) in ALL {
        let radiance = file(&format!("probes/{name}"))[array].values.as_chunks().0.to_vec();
        let found = identify(&RenderedPoints { points: points.clone(), radiance, metallic: None });
        let Some(convention) = convention else {
            let verdict = verdict(&found, &Description::default());
            assert_eq!(verdict.kind, VerdictKind::Unknown, "{name} {array}: {:?}", verdict.differences);
            continue;
        };
        let text = std::fs::read_to_string(format!("{PEERS}/conventions/{convention}.toml")).unwrap();
        let verdict = verdict(&found, &text.parse().unwrap());
        let terms = verdict.differences.iter().map(|difference| &difference.term);
        let wrong: Vec<_> = terms.filter(|term| !OF_THE_PROBES.contains(&term.as_str())).collect();
        assert_ne!(verdict.kind, VerdictKind::Unknown, "{name}: {:?}", verdict.residual);
        assert!(wrong.is_empty(), "{name}: {wrong:?}");
        // Normals as stored are not reproduced.
        let Some(own) = named::all().iter().find(|own| own.name == convention) else { continue };
        let terms: Vec<_> = svbrdf_evaluate::conform::verdict(&found, own)
            .differences
            .into_iter()
            .map(|one| one.term)
            .collect();
        let others = terms.iter().filter(|term| !OF_THE_PROBES.contains(&term.as_str()) && *term != "normal");
        assert_eq!(others.collect::<Vec<_>>(), Vec::<&String>::new(), "{name} and our {convention}");
    }
}

/// Lengths to which a little is added darken the highlights of mirrors: nothing is left of renderers that add it.
#[needs(shared)]
fn renderers_that_add_to_lengths_are_found_whole() {
    let points = super::points();
    let asked = Description::from(&PRINTED).terms;
    for name in ["lookahead-2022", "deepbasis-2023"] {
        let text = std::fs::read_to_string(format!("{PEERS}/conventions/{name}.toml")).unwrap();
        let of: Description = text.parse().unwrap();
        let radiance = points.iter().map(|point| of.terms.radiance(point, true)).collect();
        let found = super::judged(&points, radiance, Some(false), &asked);
        assert!(found.residual < 1e-5, "{name}: {found:?}");
    }
}
