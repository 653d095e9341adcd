//! Renderers outside of the grammar: none of them has a name.

use std::f64::consts::PI;

use glam::DVec3;

use svbrdf_core::model::grammar::words::{Fresnel, Shadowing, Weight};
use svbrdf_core::model::grammar::{Point, RendererTerms};
use svbrdf_evaluate::conform::{RenderedPoints, VerdictKind, lobe_factors};

use super::{judged, points, single};

type Renderer = fn(&Point, &Angles) -> [f64; 3];

/// GGX, separable Smith, Schlick's fifth power, 1 - F.
fn base() -> RendererTerms {
    let mut t = RendererTerms::BASE;
    t.specular.g = Shadowing::Smith;
    t.specular.f = Fresnel::Fifth;
    t.diffuse.diffuse = Weight::Fresnel;
    t
}
struct Angles {
    nl: f64,
    nv: f64,
    nh: f64,
    vh: f64,
    d: f64,
    r: f64,
    a: f64,
}
fn angles(p: &Point) -> Angles {
    let n = DVec3::from(p.normal).normalize();
    let (l, v) = (DVec3::from(p.light).normalize(), DVec3::from(p.view).normalize());
    let h = (l + v).normalize();
    Angles {
        nl: n.dot(l).max(0.0),
        nv: n.dot(v).max(0.0),
        nh: n.dot(h).max(0.0),
        vh: v.dot(h).max(0.0),
        d: DVec3::from(p.light).length(),
        r: p.roughness,
        a: p.roughness * p.roughness,
    }
}
fn diffuse(p: &Point) -> [f64; 3] {
    let mut t = base();
    t.specular.front_min = Some(f64::INFINITY);
    t.radiance(p, true)
}
fn lambert(p: &Point) -> [f64; 3] {
    let mut t = base();
    t.diffuse.diffuse = Weight::One;
    t.specular.front_min = Some(f64::INFINITY);
    t.radiance(p, true)
}
fn specular(p: &Point) -> [f64; 3] {
    let mut t = base();
    t.diffuse.diffuse = Weight::Zero;
    t.radiance(p, true)
}
fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|c| a[c] + b[c])
}
fn times(a: [f64; 3], x: f64) -> [f64; 3] {
    a.map(|a| a * x)
}
fn fresnel(p: &Point, w: f64) -> [f64; 3] {
    p.specular.map(|s| s + (1.0 - s) * w)
}
fn smith(x: f64, a: f64) -> f64 {
    if x <= 0.0 { 0.0 } else { 2.0 / (1.0 + (1.0 + a * a * (1.0 - x * x) / (x * x)).sqrt()) }
}
fn vis(q: &Angles) -> f64 {
    if q.nl * q.nv <= 0.0 { 0.0 } else { smith(q.nl, q.a) * smith(q.nv, q.a) / (4.0 * q.nl * q.nv) }
}
fn ggx(q: &Angles) -> f64 {
    let a2 = (q.a * q.a).max(1e-9);
    let t = q.nh * q.nh * a2 + 1.0 - q.nh * q.nh;
    a2 / (PI * t * t)
}
fn lobe(p: &Point, q: &Angles, d: f64, v: f64) -> [f64; 3] {
    times(fresnel(p, (1.0 - q.vh).powi(5)), d * v * q.nl)
}
const ALL: [(&str, Renderer); 24] = [
    ("Disney diffuse", |p, q| {
        let f = 0.5 + 2.0 * q.r * q.vh * q.vh - 1.0;
        sum(
            times(lambert(p), (1.0 + f * (1.0 - q.nl).powi(5)) * (1.0 + f * (1.0 - q.nv).powi(5))),
            specular(p),
        )
    }),
    ("Oren-Nayar", |p, q| {
        let s2 = q.a;
        let (a, b) = (1.0 - 0.5 * s2 / (s2 + 0.33), 0.45 * s2 / (s2 + 0.09));
        let (l, v) = (DVec3::from(p.light).normalize(), DVec3::from(p.view).normalize());
        let c = (l.dot(v) - q.nl * q.nv).max(0.0) / q.nl.max(q.nv).max(1e-3);
        sum(times(diffuse(p), a + b * c), specular(p))
    }),
    ("clearcoat", |p, q| {
        let a: f64 = 0.01;
        let d = (a * a - 1.0) / (PI * (a * a).ln() * (1.0 + (a * a - 1.0) * q.nh * q.nh));
        let f = 0.04 + 0.96 * (1.0 - q.vh).powi(5);
        sum(
            sum(diffuse(p), specular(p)),
            [0.25 * d * f * q.nl * smith(q.nl, 0.25) * smith(q.nv, 0.25) / (4.0 * q.nl * q.nv).max(1e-3); 3],
        )
    }),
    ("GTR 1", |p, q| {
        let a2 = (q.a * q.a).clamp(1e-9, 0.999);
        let d = (a2 - 1.0) / (PI * a2.ln() * (1.0 + (a2 - 1.0) * q.nh * q.nh));
        sum(diffuse(p), lobe(p, q, d, vis(q)))
    }),
    ("GTR 3", |p, q| {
        let a2 = (q.a * q.a).max(1e-9);
        let t = 1.0 + (a2 - 1.0) * q.nh * q.nh;
        let d = 2.0 * a2 * a2 / (PI * (1.0 + a2) * t.powi(3));
        sum(diffuse(p), lobe(p, q, d, vis(q)))
    }),
    ("Blinn-Phong", |p, q| {
        let e = 2.0 / (q.a * q.a).max(1e-6) - 2.0;
        sum(diffuse(p), lobe(p, q, (e + 2.0) / (2.0 * PI) * q.nh.powf(e), vis(q)))
    }),
    ("Blinn-Phong, no shadowing", |p, q| {
        let e = 2.0 / (q.a * q.a).max(1e-6) - 2.0;
        sum(diffuse(p), lobe(p, q, (e + 8.0) / (8.0 * PI) * q.nh.powf(e), 1.0))
    }),
    ("Ward", |p, q| {
        let a2 = (q.a * q.a).max(1e-9);
        let d = (-(1.0 - q.nh * q.nh) / (q.nh * q.nh).max(1e-9) / a2).exp()
            / (4.0 * PI * a2 * (q.nl * q.nv).max(1e-6).sqrt());
        sum(diffuse(p), times(p.specular, d * q.nl))
    }),
    ("sheen", |p, q| sum(sum(diffuse(p), specular(p)), [0.3 * (1.0 - q.vh).powi(5) * q.nl; 3])),
    ("multiple scattering", |p, q| {
        let e = 1.0 - 0.45 * q.r.powi(2) * (0.4 + 0.6 * q.nv);
        let s = specular(p);
        sum(diffuse(p), [0, 1, 2].map(|c| s[c] * (1.0 + p.specular[c] * (1.0 / e - 1.0))))
    }),
    ("exact Fresnel", |p, q| {
        let f = p.specular.map(|s| {
            let r = s.clamp(0.0, 0.98).sqrt();
            let n = (1.0 + r) / (1.0 - r);
            let g = (n * n - 1.0 + q.vh * q.vh).sqrt();
            let (a, b) = ((g - q.vh) / (g + q.vh), (q.vh * (g + q.vh) - 1.0) / (q.vh * (g - q.vh) + 1.0));
            0.5 * a * a * (1.0 + b * b)
        });
        let w = lobe(p, q, 1.0, 1.0);
        let s = specular(p);
        let d = lambert(p);
        [0, 1, 2].map(|c| d[c] * (1.0 - f[c]) + if w[c] > 0.0 { s[c] * f[c] * q.nl / w[c] } else { 0.0 })
    }),
    ("Fresnel to the fourth power", |p, q| {
        let (o, n) = (fresnel(p, (1.0 - q.vh).powi(5)), fresnel(p, (1.0 - q.vh).powi(4)));
        let s = specular(p);
        sum(diffuse(p), [0, 1, 2].map(|c| if o[c] != 0.0 { s[c] * n[c] / o[c] } else { 0.0 }))
    }),
    ("falloff 1/d", |p, q| times(sum(diffuse(p), specular(p)), 1.0 / q.d)),
    ("wrapped diffuse", |p, _| {
        let n = DVec3::from(p.normal).normalize().dot(DVec3::from(p.light).normalize());
        sum(p.diffuse.map(|d| d / PI * ((n + 0.5) / 1.5).max(0.0)), specular(p))
    }),
    ("Reinhard", |p, _| sum(diffuse(p), specular(p)).map(|x| x / (1.0 + x))),
    ("filmic", |p, _| {
        sum(diffuse(p), specular(p))
            .map(|x| (x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)).clamp(0.0, 1.0))
    }),
    ("alpha = r^1.5", |p, _| {
        let mut o = *p;
        o.roughness = p.roughness.max(0.0).powf(0.75);
        sum(diffuse(p), specular(&o))
    }),
    ("bumps twice as strong", |p, _| {
        let mut o = *p;
        o.normal[0] *= 2.0;
        o.normal[1] *= 2.0;
        sum(diffuse(&o), specular(&o))
    }),
    ("Kelemen", |p, q| sum(diffuse(p), lobe(p, q, ggx(q), 0.25 / (q.vh * q.vh).max(1e-3)))),
    ("V cavities", |p, q| {
        let g = (2.0 * q.nh * q.nv / q.vh).min(2.0 * q.nh * q.nl / q.vh).min(1.0);
        let v = if q.nl * q.nv > 0.0 { g / (4.0 * q.nl * q.nv) } else { 0.0 };
        sum(diffuse(p), lobe(p, q, ggx(q), v))
    }),
    ("diffuse without 1/pi", |p, _| sum(times(diffuse(p), PI), specular(p))),
    ("energy-conserving scale of specular", |p, _| {
        let s = specular(p);
        let m = p.diffuse.iter().copied().fold(0.0, f64::max);
        sum(diffuse(p), times(s, 1.0 - 0.3 * m))
    }),
    ("light of finite size", |p, q| {
        let mut o = *p;
        o.roughness = (p.roughness * p.roughness + 0.05 / q.d).clamp(0.0, 1.0).sqrt();
        sum(diffuse(p), specular(&o))
    }),
    ("spherical-Gaussian distribution", |p, q| {
        let a2 = (q.a * q.a).max(1e-6);
        sum(diffuse(p), lobe(p, q, (2.0 / a2 * (q.nh - 1.0)).exp() / (PI * a2), vis(q)))
    }),
];

#[test]
fn no_renderer_outside_of_the_grammar_has_a_name_and_what_they_are_made_from_has_one() {
    // A third of the probes tells.
    let points: Vec<_> = points().into_iter().step_by(3).collect();
    let kind = |of: Renderer| {
        let radiance: Vec<_> = points.iter().map(|point| single(of(point, &angles(point)))).collect();
        judged(&points, radiance, Some(false), &base()).kind
    };
    for (name, of) in ALL {
        assert_eq!(kind(of), VerdictKind::Unknown, "{name}");
    }
    assert_eq!(kind(|point, _| base().radiance(point, true)), VerdictKind::Conforms);
}

/// The commonest deviations: no 1/pi in one lobe, no 1/4 in the other. What differs otherwise has no factors.
#[test]
fn factors_on_the_lobes_are_found() {
    let points = points();
    let found = |of: Renderer| {
        let radiance = points.iter().map(|point| single(of(point, &angles(point)))).collect();
        lobe_factors(&RenderedPoints { points: points.clone(), radiance, metallic: Some(false) }, &base())
    };
    let planted: [(Renderer, [f64; 2]); 4] = [
        (|p, _| sum(times(diffuse(p), PI), specular(p)), [PI, 1.0]),
        (|p, _| sum(diffuse(p), times(specular(p), 4.0)), [1.0, 4.0]),
        (|p, _| sum(diffuse(p), times(specular(p), PI)), [1.0, PI]),
        (|p, _| sum(times(diffuse(p), 2.0 * PI), times(specular(p), 2.0)), [2.0 * PI, 2.0]),
    ];
    for (of, expected) in planted {
        let factors = found(of).unwrap();
        let off = factors.iter().zip(expected).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        assert!(off < 1e-5, "{factors:?} {expected:?}");
    }
    for (name, of) in ALL.iter().filter(|(name, _)| *name != "diffuse without 1/pi") {
        assert_eq!(found(*of), None, "{name}");
    }
}
