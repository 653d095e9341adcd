//! Numbers of a pinned texel, computed in f64.

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::{Model, Texel};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::model::terms::Terms;
use svbrdf_core::render::{texel_terms, widened};

/// The columns of [`PinnedTexel::cells`]: a name, and what it means.
pub const HEADS: [(&str, &str); 14] = [
    ("normal", "The unit normal: x, y, z"),
    ("diffuse", "Diffuse albedo, linear RGB"),
    ("specular", "Specular reflectance at normal incidence, linear RGB"),
    ("roughness", "Roughness; the GGX width is its square"),
    ("rendering", "Radiance under this light and view, linear RGB"),
    ("D", "The distribution of microfacets"),
    ("G", "The geometry term, with 1 / (NoL NoV) of the microfacet denominator cancelled"),
    ("F", "The Fresnel term, RGB"),
    ("NoL", "Cosine between normal and light"),
    ("NoV", "Cosine between normal and view"),
    ("NoH", "Cosine between normal and half vector"),
    ("VoH", "Cosine between view and half vector"),
    ("normal error", "The angle to the ground truth's normal, in degrees"),
    (
        "loss term",
        "Mean over RGB of the difference that the convention takes, |ln(p + epsilon) - ln(g + epsilon)| or that of its norm: the texel's \
        part of the loss of this scene",
    ),
];

/// A texel of one material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinnedTexel {
    pub texel: Texel<f64>,
    pub terms: Terms<f64>,
    /// The angle to the ground truth's normal in degrees, and the loss term; `None` for the ground truth.
    pub errors: Option<[f64; 2]>,
}

impl PinnedTexel {
    /// The numbers in the order of [`HEADS`].
    pub fn cells(&self) -> [Vec<f64>; 14] {
        let Self { texel, terms, errors } = self;
        let error = |i: usize| errors.map_or_else(Vec::new, |errors| vec![errors[i]]);
        [
            texel.normal.to_array().to_vec(),
            texel.diffuse.to_vec(),
            texel.specular.to_vec(),
            vec![texel.roughness],
            terms.radiance.to_vec(),
            vec![terms.d],
            vec![terms.g],
            terms.f.to_vec(),
            vec![terms.n_dot_l],
            vec![terms.n_dot_v],
            vec![terms.n_dot_h],
            vec![terms.v_dot_h],
            error(0),
            error(1),
        ]
    }
}

/// The texel in column `column` of row `row` of every material, the ground truth first.
pub fn rows<'a>(
    materials: impl IntoIterator<Item = &'a Material<f32>>,
    [column, row]: [usize; 2],
    scene: &Scene,
    convention: &Convention,
) -> Vec<PinnedTexel> {
    let (model, rays) = (Model::<f64>::from(convention), scene.rays::<f64>());
    let mut rows: Vec<PinnedTexel> = Vec::new();
    for material in materials {
        let texel = widened(&material.texel(row * material.width() + column));
        let terms = texel_terms(&texel, material.grid(), &model, &rays, [column, row]);
        let errors = rows.first().map(|ground_truth| {
            let [g, p] = [ground_truth.terms.radiance, terms.radiance];
            let loss = convention.norm().of(&p, &g, convention.epsilon).unwrap_or_default();
            let [g, p] = [ground_truth.texel.normal, texel.normal];
            [g.cross(p).length().atan2(g.dot(p)).to_degrees(), loss]
        });
        rows.push(PinnedTexel { texel, terms, errors });
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_core::model::convention::PRINTED;
    use svbrdf_core::model::scene::Kind;
    use svbrdf_core::progress::Progress;
    use svbrdf_core::render;
    use svbrdf_files::samples;

    #[test]
    fn the_numbers_of_a_pin_are_those_of_the_core_in_f64() {
        let samples = samples::load::<f32>().unwrap();
        let materials = [samples.ground_truth.material, samples.predictions[0].material.clone()];
        let scene = Scene { kind: Kind::Near, view: [0.3, -0.2, 2.0], light: [0.4, 0.5, 1.2] };
        let pictures = [0, 1].map(|i| {
            render::render(&materials[i].cast::<f64>(), &scene, &PRINTED, &Progress::default()).unwrap()
        });
        for texel in [[0, 0], [255, 0], [0, 255], [255, 255], [100, 37]] {
            let index = texel[1] * 256 + texel[0];
            let rows = rows(&materials, texel, &scene, &PRINTED);
            let [g, p] = [0, 1].map(|i| pictures[i].pixels[index]);
            assert_eq!([rows[0].terms.radiance, rows[1].terms.radiance], [g, p], "{texel:?}");
            let ln = |v: f64| (v + PRINTED.epsilon).ln();
            let loss = (0..3).map(|c| (ln(p[c]) - ln(g[c])).abs()).sum::<f64>() / 3.0;
            assert_eq!(rows[1].errors.unwrap()[1], loss);
            assert!(rows[0].errors.is_none());
        }
    }
}
