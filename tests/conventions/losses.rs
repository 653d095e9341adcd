//! Losses under conventions of the grammar: by the core against the grammar itself, and by the program.

use glam::DVec3;
use svbrdf::{Comparison, Convention, Progress, Request, built_in};
use svbrdf_core::error::Error;
use svbrdf_core::material::{Material, base_and_metallic};
use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::grammar::words::{Maps, Norm};
use svbrdf_core::model::grammar::{Description, Point, RendererTerms};
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::model::terms::Terms;
use svbrdf_core::render::texel_terms;

fn scenes() -> Vec<Scene> {
    vec![
        Scene { kind: Kind::Near, view: [0.2, -0.1, 2.5], light: [0.4, 0.5, 1.2] },
        Scene { kind: Kind::Distant, view: [0.0, 0.6, 0.8], light: [-0.6, 0.0, 0.8] },
    ]
}

/// The radiance of a texel, written out.
fn radiance(terms: &RendererTerms, material: &Material<f64>, scene: &Scene, index: usize) -> [f64; 3] {
    let (width, height) = (material.width(), material.height());
    let is_near = scene.kind == Kind::Near;
    let at = terms.grid.position(index % width, index / width, width, height);
    let (light, view) = terms.grid.vectors(at, DVec3::from(scene.light), DVec3::from(scene.view), is_near);
    let texel = material.texel(index);
    let (base_color, metallic) = match terms.material.material {
        Maps::Metallic => base_and_metallic(texel.diffuse, texel.specular),
        _ => (texel.diffuse, 0.0),
    };
    let point = Point {
        normal: texel.normal.to_array(),
        diffuse: texel.diffuse,
        specular: texel.specular,
        roughness: texel.roughness,
        base_color,
        metallic,
        light: light.to_array(),
        view: view.to_array(),
    };
    terms.radiance(&point, is_near)
}

/// The loss of a scene, written out.
fn expected(described: &Description, [a, b]: [&Material<f64>; 2], scene: &Scene) -> f64 {
    let of = |material| {
        let texels = 0..a.width() * a.height();
        texels.flat_map(|i| radiance(&described.terms, material, scene, i)).collect::<Vec<_>>()
    };
    let norm = if described.loss.norm == Norm::None { Norm::LogL1 } else { described.loss.norm };
    norm.of(&of(a), &of(b), described.loss.epsilon.unwrap_or(0.01)).unwrap()
}

#[test]
fn losses_are_those_of_the_grammar_in_both_precisions() {
    let materials = built_in::<f64>().unwrap();
    let (a, b) = (&materials.ground_truth.material, &materials.predictions[0].material);
    let singles = built_in::<f32>().unwrap();
    let (a32, b32) = (&singles.ground_truth.material, &singles.predictions[0].material);
    let request = Request::Listed(scenes());
    for described in &named::all()[4..] {
        let convention = Convention::try_from(described).unwrap();
        let outcome =
            Comparison::new(a, &[b], convention).unwrap().run(&request, &Progress::default()).unwrap();
        let single =
            Comparison::new(a32, &[b32], convention).unwrap().run(&request, &Progress::default()).unwrap();
        for (i, scene) in scenes().iter().enumerate() {
            let expected = expected(described, [a, b], scene);
            let [got, single] = [&outcome, &single].map(|outcome| outcome.losses[0].per_scene[i]);
            assert!((got / expected - 1.0).abs() < 1e-12, "{}: {got}, expected {expected}", described.name);
            assert!(
                (single / expected - 1.0).abs() < 1e-5,
                "{}: {single}, expected {expected}",
                described.name
            );
        }
    }
}

/// The conventions that are both in the grammar and in the kernel: Algorithm 3 by either.
#[test]
fn the_grammar_renders_the_four_as_algorithm_3_does() {
    let materials = built_in::<f64>().unwrap();
    let (a, b) = (&materials.ground_truth.material, &materials.predictions[0].material);
    for described in &named::all()[..4] {
        let own = Convention::try_from(described).unwrap();
        assert!(own.member.is_none(), "{}", described.name);
        // Another name: not the kernel's any more.
        let renamed = Description { name: "renamed".to_owned(), ..described.clone() };
        let member = Convention::try_from(&renamed).unwrap();
        assert!(member.member.is_some());
        let run = |convention| {
            let comparison = Comparison::new(a, &[b], convention).unwrap();
            comparison.run(&Request::default(), &Progress::default()).unwrap()
        };
        let (own, member) = (run(own), run(member));
        assert_eq!(own.scenes, member.scenes, "{}", described.name);
        let [own, member] = [own, member].map(|outcome| outcome.losses[0].estimate.mean);
        assert!((own / member - 1.0).abs() < 1e-9, "{}: {own} and {member}", described.name);
    }
}

/// The terms that the window shows of a pinned texel: by the grammar those of Algorithm 3, where the renderer is that.
#[test]
fn the_terms_of_a_texel_are_those_of_its_renderer() {
    let materials = built_in::<f64>().unwrap();
    let material = &materials.ground_truth.material;
    let of = |convention: &Convention, place: [usize; 2], scene: &Scene| {
        let texel = material.texel(place[1] * material.width() + place[0]);
        texel_terms(&texel, material.grid(), &Model::from(convention), &scene.rays(), place)
    };
    let numbers = |terms: &Terms<f64>| {
        let Terms { n_dot_l, n_dot_v, n_dot_h, v_dot_h, d, g, f, radiance } = *terms;
        [[n_dot_l, n_dot_v, n_dot_h], [v_dot_h, d, g], f, radiance].concat()
    };
    let off = |a: &Terms<f64>, b: &Terms<f64>| {
        let pairs = numbers(a).into_iter().zip(numbers(b));
        pairs.map(|(a, b)| (a - b).abs() / b.abs().max(1e-3)).fold(0.0, f64::max)
    };
    for described in &named::all()[..4] {
        let renamed = Description { name: "renamed".to_owned(), ..described.clone() };
        let [own, member] = [described, &renamed].map(|one| Convention::try_from(one).unwrap());
        let smith: Convention = "svbrdf-estimation-2022".parse().unwrap();
        for (scene, place) in scenes().iter().zip([[30, 50], [200, 111]]) {
            let expected = of(&own, place, scene);
            assert!(off(&of(&member, place, scene), &expected) < 1e-9, "{}", described.name);
            assert!(off(&of(&smith, place, scene), &expected) > 1e-3, "another renderer is not seen");
        }
    }
}

#[test]
fn what_has_no_near_field_scenes_samples_distant_ones_alone() {
    let matfuse = named::all().iter().find(|c| c.name == "matfuse-2024").unwrap();
    let convention = Convention::try_from(matfuse).unwrap();
    let scenes = svbrdf_core::model::scene::sample(0, 4, 2, &convention);
    assert!(scenes.iter().all(|scene| scene.kind == Kind::Distant));
    let flash = "[[scenes]]\nkind = \"flash\"\nz = 4.0\n".parse::<Description>().unwrap();
    assert!(matches!(Convention::try_from(&flash), Err(Error::BadConvention { .. })));
}
