//! The adapter: what is said about it, and what happens without one or beyond its limits.

use std::process::Command;

use glam::Vec3;

use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_gpu::{DisplayParams, Encoding, Gpu, MaterialTextures, ShadeParams, Shading};
use svbrdf_needs::{has, needs};

use crate::support::gpu::{STALE_BUILD, bumpy, find_gpu, from_above, gpu, picture};

#[needs(adapter)]
fn the_report_is_one_line_that_says_what_is_used_and_why() {
    let gpu = gpu();
    let line = gpu.report.to_string();
    assert!(!line.contains('\n'));
    assert!(line.starts_with(&gpu.report.name), "{line}");
    assert!(line.contains(&gpu.report.backend) && line.contains(&gpu.report.reason), "{line}");
    assert!(line.contains(if gpu.report.software { "software" } else { "hardware" }), "{line}");
    assert!(gpu.report.max_texture_side >= 4096);
}

#[test]
fn the_build_knows_whether_there_is_an_adapter() {
    let required = std::env::var_os("CI").is_some();
    match find_gpu() {
        Ok(gpu) if gpu.report.shading_format == wgpu::TextureFormat::Rgba32Float => {
            assert!(has!(f32_adapter), "{}: {STALE_BUILD}", gpu.report);
        }
        // Used where nothing else is, and tested only on request: `WGPU_BACKEND=gl`.
        Ok(opengl) => {
            assert!(!has!(f32_adapter), "{}: {STALE_BUILD}", opengl.report);
            assert!(!required, "no 32-bit renderings in CI: {}", opengl.report);
        }
        Err(problem) => {
            assert!(!has!(adapter), "{problem}: {STALE_BUILD}");
            assert!(!required, "no graphics adapter in CI: {problem}");
        }
    }
}

/// What `test` of this program prints on a machine that seems to have no driver, and whether it passes.
fn without_driver(test: &str, variables: &[(&str, &str)]) -> (bool, String) {
    let mut child = Command::new(std::env::current_exe().expect("this program has a path"));
    child.args(["--exact", "--include-ignored", "--nocapture", "--test-threads=1"]);
    child.arg(format!("gpu_parity::adapter::{test}"));
    child.env("VK_ICD_FILENAMES", "none").env("VK_DRIVER_FILES", "none").env("WGPU_BACKEND", "vulkan");
    child.env_remove("CI").envs(variables.iter().copied());
    let output = child.output().expect("it runs");
    let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    assert!(text.contains("running 1 test"), "{text}");
    (output.status.success(), text)
}

#[test]
fn a_missing_adapter_fails_the_tests_that_need_one_and_ci() {
    let needs_one = "the_report_is_one_line_that_says_what_is_used_and_why";
    let (passed, text) = without_driver(needs_one, &[]);
    assert!(!passed && text.contains("no usable graphics adapter"), "{text}");
    assert!(text.contains("mesa-vulkan-drivers") && text.contains("use the CPU"), "{text}");

    let knows = "the_build_knows_whether_there_is_an_adapter";
    let (passed, text) = without_driver(knows, &[]);
    assert_eq!(passed, !has!(adapter), "{text}");
    let (passed, text) = without_driver(knows, &[("CI", "true")]);
    assert!(!passed && (text.contains("in CI") || text.contains(STALE_BUILD)), "{text}");
}

#[needs(adapter)]
fn a_material_beyond_the_limits_is_refused_with_both_sizes() {
    let gpu = gpu();
    let mut small = gpu.clone();
    small.report.max_texture_side = 8;
    let refused = |result: Result<(), Error>| {
        let message = result.expect_err("too large").to_string();
        assert!(message.contains("9 x 4") && message.contains("at most 8"), "{message}");
    };
    refused(MaterialTextures::upload(&small, &bumpy(9, 4)).map(drop));
    let shading = Shading::new(gpu).expect("compiled");
    refused(shading.target(&small, [9, 4]).map(drop));
    MaterialTextures::upload(&small, &bumpy(8, 4)).expect("just within the limit");
}

#[needs(adapter)]
fn an_adapter_with_16_bit_targets_shows_pictures_and_sends_renderings_to_the_cpu() {
    let gpu = gpu();
    let mut half = gpu.clone();
    half.report.shading_format = wgpu::TextureFormat::Rgba16Float;
    let scene = Scene { kind: Kind::Distant, view: [0.0, 0.0, 1.0], light: [0.0, 0.0, 1.0] };
    let shading = Shading::new(&half).expect("compiled");
    let textures = MaterialTextures::upload(&half, &mirror()).expect("uploaded");
    let target = shading.target(&half, [2, 2]).expect("created");
    let params = ShadeParams { scene, convention: PRINTED, quantity: Quantity::Rendering };
    shading.draw(&half, &textures, &params, &target);
    let refused = target.read_back(&half).expect_err("16 bits are not enough").to_string();
    assert!(refused.contains("32-bit floats") && refused.contains("use the CPU"), "{refused}");
    // Brings the largest 16-bit number, and nothing larger, just below 1.
    let exposed =
        DisplayParams { exposure_ev: -16.0, show_clipping: true, ..from_above([1.0; 2], Encoding::Radiance) };
    let picture = picture(&half, [2, 2], &target, &target, &exposed);
    assert!(picture.at(0, 0).iter().all(|&level| level >= 254), "{:?}", picture.at(0, 0));
}

/// Straight under the light, its highlight is brighter than any 16-bit number.
fn mirror() -> Material<f32> {
    let texel = Texel { normal: Vec3::Z, diffuse: [0.0; 3], specular: [1.0; 3], roughness: 0.0 };
    Material::uniform("mirror", 2, 2, &texel).expect("valid")
}

#[needs(adapter)]
fn a_failure_that_no_function_can_return_waits_to_be_taken() {
    // A device of its own: other tests take faults too.
    let gpu = Gpu::headless().expect("an adapter");
    assert!(gpu.take_fault().is_none());
    let size = gpu.device.limits().max_buffer_size.saturating_add(4);
    let usage = wgpu::BufferUsages::COPY_DST;
    let _ = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size,
        usage,
        mapped_at_creation: false,
    });
    let fault = gpu.take_fault().expect("a fault").to_string();
    assert!(fault.contains("use the CPU"), "{fault}");
    assert!(gpu.take_fault().is_none());
}
