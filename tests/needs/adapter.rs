//! Whether this machine has a graphics driver, judged by files: a build script that started a driver would cost every build.

use std::env;
use std::path::PathBuf;

/// Environment variables that the answer depends on.
const VARIABLES: [&str; 8] = [
    "WGPU_BACKEND",
    "VK_DRIVER_FILES",
    "VK_ICD_FILENAMES",
    "VK_ADD_DRIVER_FILES",
    "XDG_CONFIG_HOME",
    "XDG_CONFIG_DIRS",
    "XDG_DATA_HOME",
    "XDG_DATA_DIRS",
];

/// Tells cargo what the answers depend on.
pub fn watch() {
    for variable in VARIABLES {
        println!("cargo::rerun-if-env-changed={variable}");
    }
    // A missing path would rebuild the tests on every run.
    for folder in folders().iter().filter(|folder| cfg!(target_os = "linux") && folder.is_dir()) {
        println!("cargo::rerun-if-changed={}", folder.display());
    }
}

/// Whether there is an adapter. OpenGL renders to 16 bits, and counts if `WGPU_BACKEND` asks for it.
pub fn is_there() -> bool {
    renders_to_f32() || backends().contains("gl")
}

/// Whether it renders to 32-bit floats: on Linux with a Vulkan driver, on macOS and Windows always.
pub fn renders_to_f32() -> bool {
    let native = !cfg!(target_os = "linux") || (!manifests().is_empty() && has_loader());
    let backends = backends();
    native && (backends.is_empty() || ["vulkan", "vk", "metal", "dx12"].iter().any(|b| backends.contains(b)))
}

fn backends() -> String {
    env::var("WGPU_BACKEND").unwrap_or_default().to_lowercase()
}

/// The driver manifests that Vulkan's loader reads
/// (<https://github.com/KhronosGroup/Vulkan-Loader/blob/main/docs/LoaderDriverInterface.md>).
fn manifests() -> Vec<PathBuf> {
    let listed = |name: &str| env::var_os(name).map(|list| env::split_paths(&list).collect::<Vec<_>>());
    let added = listed("VK_ADD_DRIVER_FILES").unwrap_or_default();
    let named = listed("VK_DRIVER_FILES").or_else(|| listed("VK_ICD_FILENAMES"));
    let places = named.unwrap_or_else(folders).into_iter().chain(added);
    let files = places.flat_map(|place| match place.read_dir() {
        Ok(entries) => entries.filter_map(|entry| Some(entry.ok()?.path())).collect(),
        Err(_) => vec![place],
    });
    files.filter(|file| file.extension().is_some_and(|e| e == "json") && file.is_file()).collect()
}

/// Where the loader looks for manifests if no variable names them.
fn folders() -> Vec<PathBuf> {
    let home = env::var("HOME").unwrap_or_default();
    let variable = |name: &str, default: &str| {
        let value = env::var(name).ok().filter(|value| !value.is_empty());
        value.unwrap_or_else(|| default.to_owned())
    };
    let roots = [
        variable("XDG_CONFIG_HOME", &format!("{home}/.config")),
        variable("XDG_CONFIG_DIRS", "/etc/xdg"),
        "/etc".to_owned(),
        variable("XDG_DATA_HOME", &format!("{home}/.local/share")),
        variable("XDG_DATA_DIRS", "/usr/local/share:/usr/share"),
    ];
    let roots = roots.iter().flat_map(env::split_paths);
    roots.filter(|root| root.is_absolute()).map(|root| root.join("vulkan/icd.d")).collect()
}

/// Whether Vulkan's loader, `libvulkan.so.1`, is where libraries are.
fn has_loader() -> bool {
    let triplet = format!("/usr/lib/{}-linux-gnu", env::var("CARGO_CFG_TARGET_ARCH").unwrap_or_default());
    let system = ["/usr/lib", "/usr/lib64", "/usr/local/lib", "/lib", "/lib64", &triplet].map(PathBuf::from);
    let listed = env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
    env::split_paths(&listed).chain(system).any(|folder| folder.join("libvulkan.so.1").is_file())
}
