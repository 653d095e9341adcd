//! The validators of Khronos and of MaterialX on what is written for other programs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use svbrdf_files::write::{self, Depth, FileKind, WriteOptions};
use svbrdf_needs::needs;

use crate::support::surfaces::cases;

/// Prints what `gltf-validator` finds in each file.
const KHRONOS: &str = "const validator = require('gltf-validator'), fs = require('fs');
    const report = path => validator.validateBytes(new Uint8Array(fs.readFileSync(path)));
    Promise.all(process.argv.slice(1).map(report)).then(found => console.log(JSON.stringify(found.map(one => one.issues))));";

/// Prints what MaterialX finds in each document against its own library, whether its pictures are there, and whether it can make a
/// shader of it.
const MATERIALX: &str = r#"
import json, os, sys
import MaterialX as mx
import MaterialX.PyMaterialXGenShader as gen
import MaterialX.PyMaterialXGenGlsl as glsl
library = mx.createDocument()
search = mx.getDefaultDataSearchPath()
mx.loadLibraries(mx.getDefaultDataLibraryFolders(), search, library)

def shader(document):
    generator = glsl.GlslShaderGenerator.create()
    context = gen.GenContext(generator)
    context.registerSourceCodeSearchPath(search)
    colours = gen.DefaultColorManagementSystem.create(generator.getTarget())
    colours.loadLibrary(library)
    generator.setColorManagementSystem(colours)
    units = gen.UnitSystem.create(generator.getTarget())
    units.loadLibrary(library)
    units.setUnitConverterRegistry(mx.UnitConverterRegistry.create())
    generator.setUnitSystem(units)
    element = gen.findRenderableElements(document)[0]
    return generator.generate(element.getName(), element, context).getSourceCode("pixel")

found = []
for path in sys.argv[1:]:
    document = mx.createDocument()
    mx.readFromXmlFile(document, path)
    images = [image for graph in document.getNodeGraphs() for image in graph.getNodes("image")]
    names = [image.getInputValue("file") for image in images]
    missing = [name for name in names if not os.path.isfile(os.path.join(os.path.dirname(path), name))]
    document.importLibrary(library)
    is_valid, problems = document.validate()
    length = len(shader(document)) if is_valid else 0
    found.append({"valid": is_valid, "problems": problems, "pictures": names, "missing": missing, "shader": length})
print(json.dumps(found))
"#;

/// The output of a script for these files.
fn found(program: &str, option: &str, script: &str, files: &[PathBuf]) -> Vec<Value> {
    let output = Command::new(program).args([option, script]).args(files).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found.len(), files.len());
    found
}

/// Every case, written in every depth of `extension`.
fn written(extension: &str, depths: &[Depth]) -> (TempDir, Vec<PathBuf>) {
    let folder = tempdir().unwrap();
    let mut files = Vec::new();
    for (number, (_, material, _)) in cases().into_iter().enumerate() {
        for depth in depths {
            let path = folder.path().join(format!("{number}_{}.{extension}", depth.name()));
            let options = WriteOptions { depth: Some(*depth), ..WriteOptions::default() };
            write::write(&material, &path, FileKind::new(&path, &options).unwrap()).unwrap();
            files.push(path);
        }
    }
    (folder, files)
}

fn changed(path: &Path, from: &str, to: &str) {
    let bytes = fs::read(path).unwrap();
    assert_eq!(from.len(), to.len());
    let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
    fs::write(path, [&bytes[..at], to.as_bytes(), &bytes[at + from.len()..]].concat()).unwrap();
}

#[needs(gltf_validator)]
#[test]
fn the_validator_of_khronos_finds_nothing_in_a_glb_and_sees_planted_faults() {
    let (_folder, files) = written("glb", &[Depth::Eight, Depth::Sixteen]);
    for (path, issues) in files.iter().zip(found("node", "-e", KHRONOS, &files)) {
        // It remarks on sizes that are no powers of two.
        let of_size = |issue: &&Value| issue["code"] == "IMAGE_NPOT_DIMENSIONS";
        let all = issues["messages"].as_array().unwrap();
        assert_eq!(all.iter().filter(of_size).count(), all.len(), "{}: {issues:#}", path.display());
    }
    for (path, (from, to)) in files.iter().zip([
        ("\"SCALAR\"", "\"VEC999\""),
        ("\"type\":\"VEC4\"", "\"type\":\"VEC2\""),
        ("image/png", "image/jpg"),
        ("\"POSITION\"", "\"POSITIOM\""),
    ]) {
        changed(path, from, to);
        let issues = &found("node", "-e", KHRONOS, std::slice::from_ref(path))[0];
        let count = |kind: &str| issues[kind].as_u64().unwrap();
        assert!(count("numErrors") + count("numWarnings") > 0, "{from} as {to}: {issues:#}");
    }
}

#[needs(materialx)]
#[test]
fn materialx_finds_its_documents_valid_and_sees_planted_faults() {
    let depths = [Depth::Eight, Depth::Sixteen, Depth::Half, Depth::Float];
    let (_folder, files) = written("mtlx", &depths);
    for (path, report) in files.iter().zip(found("python3", "-c", MATERIALX, &files)) {
        let pictures = report["pictures"].as_array().unwrap().len();
        let is_right = report["valid"] == true && report["missing"] == serde_json::json!([]) && pictures >= 4;
        assert!(is_right && report["shader"].as_u64() > Some(1000), "{}: {report:#}", path.display());
    }
    for (path, (from, to)) in files.iter().zip([
        ("type=\"color3\" nodegraph", "type=\"float\"  nodegraph"),
        ("output=\"base_color\"", "output=\"base_tint_\""),
    ]) {
        changed(path, from, to);
        let report = &found("python3", "-c", MATERIALX, std::slice::from_ref(path))[0];
        assert_eq!(report["valid"], false, "{from} as {to}: {report:#}");
    }
    let textures = files[2].with_extension("").display().to_string() + "_textures";
    fs::remove_file(Path::new(&textures).join("normal.exr")).unwrap();
    let report = &found("python3", "-c", MATERIALX, &files[2..3])[0];
    assert_eq!(report["missing"].as_array().unwrap().len(), 1, "{report:#}");
}
