//! The conventions of others in the fused kernel and in shaders, against the numbers of their authors' code.

use svbrdf_core::loss::{Fused, Plain};
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::model::scene::{Kind, Scene, sample};
use svbrdf_core::render::simd::kernel::Kernel;
use svbrdf_core::render::simd::{Level, render_at};
use svbrdf_files::samples;
use svbrdf_needs::needs;

use super::peers::{StoredPoint, convention_and_peer, subset};
use crate::support::losses::losses;
use crate::support::spread::Expected;
use crate::support::tolerance::{FUSED_LOSS, FUSED_SCENE, FUSED_SQUARE};

/// Those that the kernel and `svbrdf.torch` have.
const IN_THE_KERNEL: [&str; 3] = ["svbrdf-estimation-2022", "material-palette-2024", "matfuse-2024"];

fn of(name: &str) -> Convention {
    name.parse().unwrap()
}

fn levels() -> Vec<(&'static str, Level)> {
    Level::all().into_iter().filter_map(|(name, level)| Some((name, level?))).collect()
}

#[test]
fn the_kernel_has_the_named_conventions_that_need_it_and_no_other_renderer() {
    let has = |name: &str| Kernel::of(&of(name)).is_some_and(|kernel| kernel.has_norm());
    assert!(IN_THE_KERNEL.iter().all(|name| has(name)));
    assert!(!has("materialgan-2020") && !has("gltf-viewer"));
    // A term that the kernel does not know.
    for name in IN_THE_KERNEL {
        let mut described = named::all().iter().find(|one| one.name == name).unwrap().clone();
        described.name = "another".to_owned();
        assert!(Kernel::of(&Convention::try_from(&described).unwrap()).is_some(), "{name}");
        described.terms.specular.v_den_min = 1e-3;
        assert!(Kernel::of(&Convention::try_from(&described).unwrap()).is_none(), "{name}");
    }
}

/// A stored point as a material of one texel and its scene; `None` where light or view is below the plane.
fn one_texel(point: &StoredPoint) -> Option<(Material<f64>, Scene)> {
    let texel = Texel {
        normal: point.normal.into(),
        diffuse: point.diffuse,
        specular: point.specular,
        roughness: point.roughness,
    };
    let scene = Scene { kind: Kind::Near, view: point.view, light: point.light };
    scene.check().ok()?;
    Some((Material::uniform("one", 1, 1, &texel).ok()?, scene))
}

type Rung = (String, Box<dyn Fn(&Material<f32>, &Scene, &Convention) -> [f32; 3]>);

/// Every instruction set, and the adapter where there is one.
fn rungs() -> Vec<Rung> {
    let kernel = |(name, level): (&'static str, Level)| -> Rung {
        let render = move |material: &Material<f32>, scene: &Scene, c: &Convention| {
            render_at(level, material, scene, c, &Default::default()).unwrap().pixels[0]
        };
        (format!("kernel, {name}"), Box::new(render))
    };
    #[cfg_attr(not(feature = "gpu"), expect(unused_mut, reason = "the adapter is added"))]
    let mut rungs: Vec<Rung> = levels().into_iter().map(kernel).collect();
    #[cfg(feature = "gpu")]
    if svbrdf_needs::has!(f32_adapter) {
        let gpu = crate::support::gpu::gpu_f32();
        let render = |material: &Material<f32>, scene: &Scene, c: &Convention| {
            gpu.render(material, scene, c).unwrap().pixels[0]
        };
        rungs.push(("shader".to_owned(), Box::new(render)));
    }
    rungs
}

/// The largest share of the bound of the radiances of the authors' code, and how many were compared.
fn check(rung: &Rung, name: &str, factor: f32) -> Result<(f64, usize), String> {
    let (subset, convention) = (subset(), of(name));
    let (mut worst, mut count) = (0.0_f64, 0);
    for (point, authors) in subset.points.iter().zip(&subset.peers[name]) {
        let (Some(authors), Some((material, scene))) = (authors, one_texel(point)) else { continue };
        let expected = Expected::of(&material, &scene, &convention).with_values(vec![*authors]);
        let got = (rung.1)(&material.cast(), &scene, &convention).map(|x| x * factor);
        worst = worst
            .max(expected.compare(&[got]).map_err(|e| format!("{}, {name}: {point:?}: {e}", rung.0))?.share);
        count += 1;
    }
    Ok((worst, count))
}

#[test]
fn radiances_are_the_authors_on_every_rung() {
    for rung in rungs() {
        for name in IN_THE_KERNEL {
            let (worst, count) = check(&rung, name, 1.0).unwrap_or_else(|problem| panic!("{problem}"));
            println!("{}, {name}: {worst:.2} of the bound at {count} points", rung.0);
            assert!(count >= 10, "{count}");
            assert!(check(&rung, name, 1.0002).is_err(), "a planted fault: {}, {name}", rung.0);
        }
    }
}

/// Of normalized normals: the authors' loss where the code normalizes.
#[needs(shared)]
#[test]
fn the_loss_over_listed_scenes_is_the_authors_in_f32() {
    let name = "matfuse-2024";
    let (materials, scenes, authors) = convention_and_peer(name);
    let [a, b] = materials.each_ref().map(|material| material.cast::<f32>());
    for (level, on) in levels() {
        let got = losses(&Fused { level: Some(on) }, &a, &[&b], &scenes, &of(name))
            .unwrap()
            .remove(0)
            .estimate
            .mean;
        println!(
            "{name}, {level}: {got} against {authors}, relative error {:.1e}",
            (got / authors - 1.0).abs()
        );
        assert!((got / authors - 1.0).abs() < FUSED_SQUARE, "{level}: {got}, expected {authors}");
    }
}

/// `material` in f32, with a changed roughness.
fn rougher(material: &Material<f32>) -> Material<f32> {
    let planes = material.planes();
    let roughness = planes.roughness.iter().map(|r| (r + 0.05).min(1.0)).collect();
    let planes = Planes { roughness, ..planes.clone() };
    Material::new("rougher", material.width(), material.height(), planes).unwrap()
}

#[test]
fn losses_of_the_kernel_are_those_of_f64() {
    let materials = samples::load::<f32>().unwrap();
    let truth = &materials.ground_truth.material;
    for name in IN_THE_KERNEL {
        let convention = of(name);
        let bounds = if name == "matfuse-2024" { [FUSED_SQUARE; 2] } else { [FUSED_LOSS, FUSED_SCENE] };
        let scenes = sample(7, 3, 2, &convention);
        for prediction in [&materials.predictions[0].material, &rougher(truth)] {
            let want = losses(&Plain, &truth.cast::<f64>(), &[&prediction.cast()], &scenes, &convention);
            let want = want.unwrap().remove(0);
            for (level, on) in levels() {
                let compute = |convention: &Convention| {
                    losses(&Fused { level: Some(on) }, truth, &[prediction], &scenes, convention)
                        .unwrap()
                        .remove(0)
                };
                let got = compute(&convention);
                let off = |got: f64, want: f64| (got / want - 1.0).abs();
                let mean = off(got.estimate.mean, want.estimate.mean);
                let scene =
                    got.per_scene.iter().zip(&want.per_scene).map(|(g, w)| off(*g, *w)).fold(0.0, f64::max);
                println!("{name}, {}, {level}: loss {mean:.1e}, scene {scene:.1e}", prediction.name());
                assert!(mean < bounds[0] && scene < bounds[1], "{name}, {level}: {mean:e}, {scene:e}");
                for other in IN_THE_KERNEL.iter().filter(|other| **other != name) {
                    let other = compute(&of(other)).estimate.mean;
                    assert!(off(other, want.estimate.mean) > 1e-3, "a planted fault: {other}");
                }
            }
        }
    }
}
