//! The adapter: what is said about it, and what happens without one or beyond its limits.

use std::process::Command;

use svbrdf::error::Error;
use svbrdf::gpu::{DisplayMode, DisplayParams, Encoding, Gpu, MaterialTextures, ShadeParams, Shading};
use svbrdf::material::Material;
use svbrdf::math::vec3::Vec3;
use svbrdf::model::brdf::Texel;
use svbrdf::model::convention::PRINTED;
use svbrdf::model::scene::{Kind, Scene};
use svbrdf::picture::camera::Camera;
use svbrdf::picture::quantity::Quantity;

use crate::support::gpu::{bumpy, gpu, picture};

#[test]
fn the_report_is_one_line_that_says_what_is_used_and_why() {
    let Some(gpu) = gpu() else { return };
    let line = gpu.report.to_string();
    assert!(!line.contains('\n'));
    assert!(line.starts_with(&gpu.report.name), "{line}");
    assert!(line.contains(&gpu.report.backend) && line.contains(&gpu.report.reason), "{line}");
    assert!(line.contains(if gpu.report.software { "software" } else { "hardware" }), "{line}");
    assert!(gpu.report.max_texture_side >= 4096);
}

/// This test binary's test of the report, on a machine that seems to have no driver.
fn report_without_driver(ci: bool) -> (bool, String) {
    let mut child = Command::new(std::env::current_exe().expect("this program has a path"));
    child.args(["--exact", "--nocapture", "--test-threads=1"]);
    child.arg("gpu_parity::adapter::the_report_is_one_line_that_says_what_is_used_and_why");
    child.env("VK_ICD_FILENAMES", "none").env("VK_DRIVER_FILES", "none").env("WGPU_BACKEND", "vulkan");
    child.env_remove("CI");
    if ci {
        child.env("CI", "true");
    }
    let output = child.output().expect("it runs");
    let text = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&text).into_owned())
}

#[test]
fn without_an_adapter_gpu_tests_say_that_they_are_ignored() {
    let (success, text) = report_without_driver(false);
    assert!(success, "{text}");
    assert!(text.contains("ignored: no graphics adapter"), "{text}");
    assert!(text.contains("mesa-vulkan-drivers") && text.contains("use the CPU"), "{text}");
}

#[test]
fn without_an_adapter_gpu_tests_fail_in_ci() {
    let (success, text) = report_without_driver(true);
    assert!(!success, "{text}");
    assert!(text.contains("no graphics adapter in CI"), "{text}");
}

#[test]
fn a_material_beyond_the_limits_is_refused_with_both_sizes() {
    let Some(gpu) = gpu() else { return };
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

#[test]
fn an_adapter_with_16_bit_targets_shows_pictures_and_sends_renderings_to_the_cpu() {
    let Some(gpu) = gpu() else { return };
    let mut half = gpu.clone();
    half.report.shading_format = wgpu::TextureFormat::Rgba16Float;
    let scene = Scene { kind: Kind::Distant, view: [0.0, 0.0, 1.0], light: [0.0, 0.0, 1.0] };
    let refused =
        half.render(&bumpy(4, 4), &scene, &PRINTED).expect_err("16 bits are not enough").to_string();
    assert!(refused.contains("32-bit floats") && refused.contains("use the CPU"), "{refused}");

    let shading = Shading::new(&half).expect("compiled");
    let textures = MaterialTextures::upload(&half, &mirror()).expect("uploaded");
    let target = shading.target(&half, [2, 2]).expect("created");
    let params = ShadeParams { scene, convention: PRINTED, quantity: Quantity::Rendering };
    shading.draw(&half, &textures, &params, &target);
    let camera = Camera {
        origin: Vec3::new(0.0, 0.0, 1.0),
        origin_right: Vec3::new(1.0, 0.0, 0.0),
        origin_up: Vec3::new(0.0, 1.0, 0.0),
        direction: Vec3::new(0.0, 0.0, -1.0),
        direction_right: Vec3::zero(),
        direction_up: Vec3::zero(),
    };
    let params = DisplayParams {
        camera,
        // Brings the largest 16-bit number, and nothing larger, just below 1.
        exposure_ev: -16.0,
        mode: DisplayMode::Value,
        difference: None,
        encoding: Encoding::Radiance,
        show_clipping: true,
        epsilon: 0.01,
        background: [0.0; 3],
    };
    let picture = picture(&half, [2, 2], &target, &target, &params);
    assert!(picture.at(0, 0).iter().all(|&level| level >= 254), "{:?}", picture.at(0, 0));
}

/// Straight under the light, its highlight is brighter than any 16-bit number.
fn mirror() -> Material<f32> {
    let texel =
        Texel { normal: Vec3::new(0.0, 0.0, 1.0), diffuse: [0.0; 3], specular: [1.0; 3], roughness: 0.0 };
    Material::uniform("mirror", 2, 2, &texel).expect("valid")
}

#[test]
fn a_failure_that_no_function_can_return_waits_to_be_taken() {
    if gpu().is_none() {
        return;
    }
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
