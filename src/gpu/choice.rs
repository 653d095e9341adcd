//! Which of several adapters is taken: the one that is named, else hardware, by the interface of the platform, among those that
//! `WGPU_BACKEND` allows.

use std::cmp::Reverse;
use std::ffi::OsStr;
use std::sync::{Mutex, OnceLock, PoisonError};

use wgpu::{Adapter, AdapterInfo, Backend, DeviceType, PowerPreference, Surface};

use svbrdf_core::error::Error;

use super::adapter::backend_name;

/// The name in the environment; `--adapter` counts before it.
const NAME: &str = "WGPU_ADAPTER_NAME";
/// The interfaces whose start has failed, in the environment of a program that starts itself anew.
pub const FAILED: &str = "SVBRDF_FAILED_BACKENDS";

static NAMED: OnceLock<String> = OnceLock::new();
static PREFERRED: OnceLock<String> = OnceLock::new();
static TAKEN: Mutex<Option<Backend>> = Mutex::new(None);

/// Names the adapter that this process takes: any part of its name, in any case.
pub fn name(part: String) {
    let _ = NAMED.set(part);
}

/// Names the adapter that this process takes where it is there and no other one is named.
pub fn prefer(name: String) {
    let _ = PREFERRED.set(name);
}

/// The list for [`FAILED`] with the interface that was taken last; `None` where it has failed before, or none was taken.
pub fn failed_with_taken() -> Option<String> {
    let taken = backend_name((*TAKEN.lock().unwrap_or_else(PoisonError::into_inner))?);
    let before = std::env::var(FAILED).unwrap_or_default();
    let is_new = before.split(',').all(|one| one != taken);
    is_new.then(|| if before.is_empty() { taken.to_owned() } else { format!("{before},{taken}") })
}

/// The best of `adapters` that can present to `surface`, and why it is the best.
///
/// # Errors
/// In words, where there is none, or none of the name that is asked for.
pub(super) fn select(
    adapters: &[Adapter],
    surface: Option<&Surface<'_>>,
) -> Result<(Adapter, String), String> {
    let usable = |a: &&Adapter| surface.is_none_or(|s| a.is_surface_supported(s));
    let usable: Vec<(&Adapter, AdapterInfo)> =
        adapters.iter().filter(usable).map(|adapter| (adapter, adapter.get_info())).collect();
    let infos: Vec<&AdapterInfo> = usable.iter().map(|(_, info)| info).collect();
    let (best, reason) = Preference::of_environment().best(&infos)?;
    let (adapter, info) = &usable[best];
    *TAKEN.lock().unwrap_or_else(PoisonError::into_inner) = Some(info.backend);
    Ok(((*adapter).clone(), reason))
}

/// What decides.
#[derive(Clone, Debug, Default)]
struct Preference {
    name: Option<String>,
    /// One that may be missing.
    preferred: Option<String>,
    low_power: bool,
    failed: Vec<String>,
    /// Whether `WGPU_BACKEND` leaves some out.
    narrowed: bool,
}

impl Preference {
    fn of_environment() -> Self {
        Self {
            name: NAMED.get().cloned().or_else(|| std::env::var(NAME).ok()).filter(|name| !name.is_empty()),
            preferred: PREFERRED.get().cloned(),
            low_power: PowerPreference::from_env() == Some(PowerPreference::LowPower),
            failed: std::env::var(FAILED).unwrap_or_default().split(',').map(str::to_owned).collect(),
            narrowed: std::env::var_os("WGPU_BACKEND").is_some(),
        }
    }

    /// The index of the best, and why it is the best.
    fn best(&self, adapters: &[&AdapterInfo]) -> Result<(usize, String), String> {
        let is_there = |part: &&String| adapters.iter().any(|one| has_name(one, part));
        let name = self.name.as_ref().or(self.preferred.as_ref().filter(is_there));
        let of_name = |info: &AdapterInfo| name.is_none_or(|part| has_name(info, part));
        let among = if self.narrowed { " that WGPU_BACKEND allows" } else { "" };
        let named: Vec<usize> = (0..adapters.len()).filter(|&one| of_name(adapters[one])).collect();
        let best = named.iter().copied().min_by_key(|&one| self.rank(adapters[one]));
        match (best, name) {
            (Some(best), Some(name)) => Ok((best, format!("the best whose name has \"{name}\""))),
            (Some(best), None) if adapters.len() == 1 => Ok((best, format!("the only adapter{among}"))),
            (Some(best), None) => {
                let rule = format!("hardware first, then {}, GL last", backend_name(USUAL));
                Ok((best, format!("the best of {} adapters{among} ({rule})", adapters.len())))
            }
            (None, Some(name)) if !adapters.is_empty() => {
                let names: Vec<_> = adapters.iter().map(|one| one.name.as_str()).collect();
                Err(format!("no adapter is called \"{name}\", found {}", names.join("; ")))
            }
            (None, _) => Err("no adapter was found".to_owned()),
        }
    }

    /// Sorts adapters, the best first. On Windows DX12 comes before Vulkan, whose windows fail on machines with two adapters.
    fn rank(&self, info: &AdapterInfo) -> (bool, bool, u8, Reverse<u8>) {
        let power = match info.device_type {
            DeviceType::DiscreteGpu if self.low_power => 1,
            DeviceType::DiscreteGpu => 3,
            DeviceType::IntegratedGpu => 2,
            DeviceType::VirtualGpu | DeviceType::Other | DeviceType::Cpu => 0,
        };
        let interface = match info.backend {
            backend if backend == USUAL => 0,
            Backend::Gl => 2,
            _ => 1,
        };
        let has_failed = self.failed.iter().any(|one| one == backend_name(info.backend));
        (info.device_type == DeviceType::Cpu, has_failed, interface, Reverse(power))
    }
}

/// Whether the name of an adapter has this part, in any case.
fn has_name(info: &AdapterInfo, part: &str) -> bool {
    info.name.to_lowercase().contains(&part.to_lowercase())
}

/// The interface of the platform.
const USUAL: Backend = if cfg!(windows) {
    Backend::Dx12
} else if cfg!(target_vendor = "apple") {
    Backend::Metal
} else {
    Backend::Vulkan
};

/// The variable of wgpu, in which several are separated by commas.
const VARIABLE: &str = "WGPU_BACKEND";
/// The names that wgpu knows.
const KNOWN: [&str; 11] =
    ["vulkan", "vk", "metal", "mtl", "dx12", "d3d12", "opengl", "gles", "gl", "webgpu", "noop"];

/// Checks that `WGPU_BACKEND`, where it is set, names graphics interfaces: wgpu passes over what it does not know.
///
/// # Errors
/// [`Error::NoAdapter`], which says what the variable holds.
pub(super) fn check() -> Result<(), Error> {
    match std::env::var_os(VARIABLE) {
        Some(value) if !is_known(&value) => Err(Error::NoAdapter {
            problem: format!(
                "expected names of graphics interfaces in {VARIABLE}, found \"{}\"",
                value.display()
            ),
            remedy: "set it to vulkan, metal, dx12 or gl, several separated by commas, or unset it",
        }),
        _ => Ok(()),
    }
}

fn is_known(value: &OsStr) -> bool {
    let value = value.to_string_lossy().to_lowercase();
    value.split(',').all(|name| KNOWN.contains(&name.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_named_adapter_is_taken_else_hardware_by_the_interface_of_the_platform() {
        use DeviceType::{Cpu, DiscreteGpu, IntegratedGpu};
        let of =
            |name: &str, kind, backend| AdapterInfo { name: name.into(), ..AdapterInfo::new(kind, backend) };
        let all = [
            of("llvmpipe", Cpu, USUAL),
            of("GeForce", DiscreteGpu, Backend::Gl),
            of("Iris", IntegratedGpu, USUAL),
            of("GeForce", DiscreteGpu, USUAL),
        ];
        let infos: Vec<&AdapterInfo> = all.iter().collect();
        let usual = Preference::default();
        let name = |name: &str| Preference { name: Some(name.into()), ..usual.clone() };
        let failed = Preference { failed: vec![backend_name(USUAL).to_owned()], ..usual.clone() };
        let low_power = Preference { low_power: true, ..usual.clone() };
        let prefer = |name: &str| Preference { preferred: Some(name.into()), ..usual.clone() };
        let table =
            [(usual.clone(), 3), (low_power, 2), (failed, 1), (name("LLVM"), 0), (name("geforce"), 3)];
        let kept = [(prefer("iris"), 2), (prefer("Radeon"), 3)];
        for (preference, expected) in table.into_iter().chain(kept) {
            assert_eq!(preference.best(&infos).unwrap().0, expected, "{preference:?}");
        }
        let error = name("Radeon").best(&infos).unwrap_err();
        assert!(error.contains("\"Radeon\", found llvmpipe; GeForce; Iris"), "{error}");
        assert!(Preference::default().best(&[]).is_err());
        assert!(name("GeForce").best(&infos).unwrap().1.contains("GeForce"));
        assert_eq!(Preference::default().best(&infos[..1]).unwrap().1, "the only adapter");
    }

    #[test]
    fn names_are_known_in_lists_and_in_any_case_and_what_wgpu_passes_over_is_not() {
        for known in ["vulkan", "Vulkan", "gl, vulkan", "vk,dx12,metal"] {
            assert!(is_known(OsStr::new(known)), "{known}");
            assert!(!wgpu::Backends::from_comma_list(known).is_empty(), "{known}");
        }
        for name in KNOWN {
            assert!(!wgpu::Backends::from_comma_list(name).is_empty(), "{name}");
        }
        for unknown in ["", " ", "vulcan", "vulkan,", "vulkan;gl", "gpu"] {
            assert!(!is_known(OsStr::new(unknown)), "{unknown}");
        }
    }
}
