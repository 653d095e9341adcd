//! Seams: whether a map that is repeated shows its border.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

use svbrdf_core::material::{Map, Material};

/// The border of a map that is repeated.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Seam {
    pub map: Map,
    /// "columns": the last column beside the first one; "rows": the last row above the first one.
    pub across: &'static str,
    /// The share of the neighbouring columns (or rows) that differ as much as those across the border do, the border included: small
    /// means a visible seam.
    pub rank: f64,
}

/// The seams of all maps that are not constant.
pub fn seams(material: &Material<f32>) -> Vec<Seam> {
    let of_map = |map: Map| {
        let of_planes: Vec<_> = planes_of(material, map)
            .into_par_iter()
            .map(|plane| differences(plane, material.width()))
            .collect();
        let seam = |(axis, across): (usize, &'static str)| {
            let count = of_planes.first()?[axis].len();
            let difference = |first: usize| of_planes.iter().map(|plane| plane[axis][first]).sum::<f64>();
            let differences: Vec<f64> = (0..count).map(difference).collect();
            let border = *differences.last()?;
            let as_large = differences.iter().filter(|difference| **difference >= border).count();
            let varies = differences.iter().any(|difference| *difference > 0.0);
            varies.then(|| Seam { map, across, rank: as_large as f64 / count as f64 })
        };
        ["columns", "rows"].into_iter().enumerate().map(seam).collect::<Vec<_>>()
    };
    Map::ALL.into_iter().flat_map(of_map).flatten().collect()
}

/// How much each column of a plane of this `width` differs from the next one, and each row; after the last one comes the first.
fn differences(plane: &[f32], width: usize) -> [Vec<f64>; 2] {
    let of = |a: f32, b: f32| f64::from((a - b).abs());
    let mut columns = vec![0.0; width];
    let next_rows = plane.chunks(width).cycle().skip(1);
    let of_row = |(row, next): (&[f32], &[f32])| {
        let following = row.iter().skip(1).chain(row.first());
        columns.iter_mut().zip(row.iter().zip(following)).for_each(|(sum, (a, b))| *sum += of(*a, *b));
        row.iter().zip(next).map(|(a, b)| of(*a, *b)).sum()
    };
    let rows = plane.chunks(width).zip(next_rows).map(of_row).collect();
    [columns, rows]
}

fn planes_of(material: &Material<f32>, map: Map) -> Vec<&[f32]> {
    let planes = material.planes();
    match map {
        Map::Normal => planes.normal.iter().map(Vec::as_slice).collect(),
        Map::Diffuse => planes.diffuse.iter().map(Vec::as_slice).collect(),
        Map::Specular => planes.specular.iter().map(Vec::as_slice).collect(),
        Map::Roughness => vec![&planes.roughness],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_core::material::Planes;

    #[test]
    fn a_ramp_has_a_seam_and_a_wave_has_none() {
        let rank = |value: &dyn Fn(f64) -> f64| {
            let plane = |constant: f32| vec![constant; 64 * 4];
            let planes = Planes {
                normal: [plane(0.0), plane(0.0), plane(1.0)],
                diffuse: [plane(0.5), plane(0.5), plane(0.5)],
                specular: [plane(0.04), plane(0.04), plane(0.04)],
                roughness: (0..256).map(|i| value(f64::from(i % 64) / 64.0) as f32).collect(),
            };
            let found = seams(&Material::new("m", 64, 4, planes).unwrap());
            assert!(found.len() == 1 && found[0].across == "columns" && found[0].map == Map::Roughness);
            found[0].rank
        };
        assert_eq!(rank(&|x| x), 1.0 / 64.0);
        assert!(rank(&|x| 0.5 + 0.4 * (std::f64::consts::TAU * x).cos()) > 0.9);
    }
}
