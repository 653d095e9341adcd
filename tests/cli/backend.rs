//! `svbrdf loss --backend`.

use std::process::{Command, Output};

use super::{folder, svbrdf, text, without_adapter};
use serde_json::Value;

/// Takes a while on the CPU: 1500 scenes of the built-in materials.
const LONG_JOB: &str = "--near 1000 --distant 500";

fn loss(args: &str) -> Command {
    let mut command = svbrdf();
    command.args(["loss", "--format", "json"]).args(args.split_whitespace());
    command
}

/// The report of a run that must succeed, and its stderr.
fn report(output: &Output) -> (Value, String) {
    let stderr = text(&output.stderr).to_owned();
    assert!(output.status.success(), "{stderr}");
    (serde_json::from_slice(&output.stdout).unwrap(), stderr)
}

#[test]
fn the_cpu_computes_unless_something_else_is_asked_for() {
    let default = loss("").output().unwrap();
    assert_eq!(report(&default).0["backend"], "cpu");
    assert_eq!(default, loss("--backend cpu").output().unwrap());
    assert_eq!(report(&loss("--precision f64 --backend auto").output().unwrap()).0["backend"], "cpu");
}

#[test]
fn notes_say_why_no_adapter_computes() {
    let of_all = "note: the loss over all scenes is computed on the CPU";
    // Whether that is short, or there is no adapter, is a question of time.
    let of_few = "note: computed on the CPU: ";
    let folder = folder();
    for (arguments, note, expected) in [
        ("--backend auto", of_all, true),
        ("", of_all, false),
        ("--backend auto --near 1", of_all, false),
        ("--backend auto --near 1", of_few, true),
    ] {
        let auto = without_adapter(folder.path(), &format!("loss --format json {arguments}"));
        let (auto, stderr) = report(&auto);
        assert_eq!(stderr.contains(note), expected, "{arguments}: {stderr}");
        let plain = arguments.replace("--backend auto", "");
        assert_eq!(auto, report(&loss(&plain).output().unwrap()).0);
    }
}

#[test]
fn without_an_adapter_the_gpu_is_refused_and_auto_takes_the_cpu() {
    let folder = folder();
    for args in ["loss --backend gpu", "render gt.png --gpu -o x.png"] {
        let refused = without_adapter(folder.path(), args);
        let stderr = text(&refused.stderr);
        assert_eq!((refused.status.code(), text(&refused.stdout)), (Some(2), ""), "{stderr}");
        assert!(stderr.contains("no usable graphics adapter") && !folder.path().join("x.png").exists());
    }
    let auto = without_adapter(folder.path(), &format!("loss --format json --backend auto {LONG_JOB}"));
    let (auto, stderr) = report(&auto);
    assert_eq!(auto["backend"], "cpu");
    let short = stderr.contains("less than starting an adapter");
    assert!(short || stderr.contains("CPU: no usable graphics adapter"), "{stderr}");
}

#[cfg(feature = "gpu")]
#[svbrdf_needs::needs(adapter)]
#[test]
fn the_gpu_computes_what_the_cpu_computes() {
    let (on_gpu, _) = report(&loss("--near 6 --backend gpu").output().unwrap());
    let (on_cpu, _) = report(&loss("--near 6").output().unwrap());
    assert_eq!(on_gpu["backend"], "gpu");
    for prediction in 0..2 {
        let loss = |report: &Value| report["results"][prediction]["loss"].as_f64().unwrap();
        let (got, want) = (loss(&on_gpu), loss(&on_cpu));
        assert!((got / want - 1.0).abs() < crate::support::tolerance::GPU_LOSS, "{got}, not {want}");
    }
}

#[cfg(feature = "gpu")]
#[svbrdf_needs::needs(adapter)]
#[test]
fn auto_measures_a_long_job_and_prints_the_number_of_what_it_takes() {
    let gpu = crate::support::gpu::gpu();
    let (auto, stderr) = report(&loss(&format!("--backend auto {LONG_JOB}")).output().unwrap());
    let taken = auto["backend"].as_str().unwrap();
    let note = format!("note: computed on the {}: ", taken.to_uppercase());
    assert!(stderr.contains(&note), "{stderr}");
    let measured = stderr.contains("measured, about ") && stderr.contains(&gpu.report.name);
    assert!(measured || stderr.contains("less than starting an adapter"), "{stderr}");
    assert_eq!(auto, report(&loss(&format!("--backend {taken} {LONG_JOB}")).output().unwrap()).0);
}
