//! Algorithm 3 at 200 single points against numbers that were computed elsewhere with 60 digits.

use glam::DVec3;
use serde::Deserialize;

use svbrdf_core::math::real::{Real, Vec3, Vector};
use svbrdf_core::model::brdf::{Model, Texel};
use svbrdf_core::model::convention::{Convention, GUIDED_2020, MULTI_IMAGE_2019, PRINTED};
use svbrdf_core::model::terms::Terms;

use crate::support::tolerance::{GOLDEN_POINTS, GOLDEN_POINTS_F32_KAPPA};

#[derive(Deserialize)]
struct Points {
    rows: Vec<Row>,
}

#[derive(Deserialize)]
struct Row {
    id: String,
    cat: String,
    n: [f64; 3],
    l: [f64; 3],
    v: [f64; 3],
    r: f64,
    d: [f64; 3],
    s: [f64; 3],
    expected: Option<[f64; 3]>,
    expected_guided_2020: Option<[f64; 3]>,
    terms: Option<ExpectedTerms>,
    kappa: Option<f64>,
}

#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct ExpectedTerms {
    d: f64,
    g: f64,
    f: [f64; 3],
}

fn rows() -> Vec<Row> {
    let points: Points = serde_json::from_str(include_str!("../points.json")).unwrap();
    assert_eq!(points.rows.len(), 200, "no point may get lost");
    points.rows
}

impl Row {
    /// The terms where they reach the result: elsewhere the condition number of the result, which is constant 0,
    /// says nothing about them.
    fn terms_with_weight(&self) -> Option<&ExpectedTerms> {
        self.terms.as_ref().filter(|_| self.expected != Some([0.0; 3]))
    }

    /// The condition number that the bound scales with; `None` where the bound does not apply.
    ///
    /// Where the floor of the roughness acts (no kappa), f64 is held to 1 but for a mirror seen at its peak.
    fn condition<T: Real>(&self) -> Option<f64> {
        let exact = T::NAME == "f64";
        match self.kappa {
            Some(kappa) if exact || kappa <= GOLDEN_POINTS_F32_KAPPA => Some(kappa.max(1.0)),
            None if exact && !self.cat.starts_with("r0_at_mirror") => Some(1.0),
            _ => None,
        }
    }
}

/// What is computed of a texel and its directions to light and view.
type Code<T> = fn(&Model<T>, Texel<T>, [Vec3<T>; 2]) -> [T; 3];

fn radiance<T: Real>(model: &Model<T>, texel: Texel<T>, [l, v]: [Vec3<T>; 2]) -> [T; 3] {
    Terms::of(model, &texel, l, v).radiance
}

/// |got - expected| in units of kappa u |expected|, or why it cannot be measured. NaN is never within a bound.
fn ratio<T: Real>(got: T, expected: f64, condition: f64) -> Result<f64, String> {
    let got = got.f64();
    if !got.is_finite() || got < 0.0 {
        return Err(format!("{got} is not finite and non-negative"));
    }
    if expected == 0.0 && got != 0.0 {
        return Err(format!("{got} is not 0"));
    }
    let excess = ((got - expected).abs() - T::min_positive_value().f64()).max(0.0);
    let u = 0.5 * T::epsilon().f64();
    Ok(if excess == 0.0 { 0.0 } else { excess / (condition * u * expected.abs()) })
}

/// The worst ratio of all rows, or every row that is out of bounds.
fn compare<T: Real>(
    convention: &Convention,
    expected: impl Fn(&Row) -> Option<[f64; 3]>,
    code: Code<T>,
) -> Result<f64, String> {
    let model = Model::from(convention);
    let (mut worst, mut faults) = (0.0, Vec::new());
    for row in rows() {
        let texel = Texel {
            normal: DVec3::from(row.n).normalize().cast(),
            diffuse: row.d.map(T::of),
            specular: row.s.map(T::of),
            roughness: T::of(row.r),
        };
        let got = code(&model, texel, [row.l, row.v].map(|w| DVec3::from(w).cast()));
        if got.iter().any(|x| !x.is_finite() || *x < T::zero()) {
            faults.push(format!("{} {}: {got:?}", row.id, row.cat));
        }
        let (Some(expected), Some(condition)) = (expected(&row), row.condition::<T>()) else { continue };
        for (got, expected) in got.into_iter().zip(expected) {
            match ratio(got, expected, condition) {
                Ok(ratio) if ratio <= GOLDEN_POINTS => worst = ratio.max(worst),
                fault => faults.push(format!(
                    "{} {}: got {got}, expected {expected}, kappa {condition:e}: {fault:?} > {GOLDEN_POINTS}",
                    row.id, row.cat
                )),
            }
        }
    }
    if faults.is_empty() { Ok(worst) } else { Err(faults.join("\n")) }
}

/// Radiances in two conventions, then the three terms as one "color", each by itself.
fn check<T: Real>() {
    let of = |name: &str, found: Result<f64, String>| match found {
        Ok(worst) => println!("{name} {}: worst ratio {worst:.2}", T::NAME),
        Err(faults) => panic!("{name} {}:\n{faults}", T::NAME),
    };
    let term = |of: fn(&ExpectedTerms) -> [f64; 3]| move |row: &Row| row.terms_with_weight().map(of);
    of("printed", compare::<T>(&PRINTED, |row| row.expected, radiance));
    of("guided-2020", compare::<T>(&GUIDED_2020, |row| row.expected_guided_2020, radiance));
    of("D", compare::<T>(&PRINTED, term(|t| [t.d; 3]), |m, t, [l, v]| [Terms::of(m, &t, l, v).d; 3]));
    of("G", compare::<T>(&PRINTED, term(|t| [t.g; 3]), |m, t, [l, v]| [Terms::of(m, &t, l, v).g; 3]));
    of("F", compare::<T>(&PRINTED, term(|t| t.f), |m, t, [l, v]| Terms::of(m, &t, l, v).f));
}

#[test]
fn points_and_their_terms_are_right_in_both_precisions() {
    check::<f64>();
    check::<f32>();
}

#[test]
fn planted_faults_are_seen() {
    let faults: [(&str, Code<f64>); 5] = [
        ("light and view swapped", |model, texel, [l, v]| radiance(model, texel, [v, l])),
        ("one channel 1e-12 too bright", |model, texel, ends| {
            let [r, g, b] = radiance(model, texel, ends);
            [r, g, b * (1.0 + 1e-12)]
        }),
        ("normal mirrored", |model, mut texel, ends| {
            texel.normal.y = -texel.normal.y;
            radiance(model, texel, ends)
        }),
        ("channels swapped", |model, texel, ends| {
            let [r, g, b] = radiance(model, texel, ends);
            [b, g, r]
        }),
        ("NaN", |_, _, _| [f64::NAN; 3]),
    ];
    for (name, fault) in faults {
        compare(&PRINTED, |row| row.expected, fault).expect_err(name);
    }
    compare::<f64>(&MULTI_IMAGE_2019, |row| row.expected, radiance).expect_err("another convention");
}
