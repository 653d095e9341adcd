//! The device that everything of this module runs on.

use wgpu::{Adapter, Backends, Device, DeviceDescriptor, InstanceDescriptor, Queue, Surface};

use svbrdf_core::error::Error;

use super::adapter::{AdapterReport, NO_ADAPTER_REMEDY};
use super::choice::{self, select};
use super::fault::Faults;

/// A graphics device, its queue, and what is known about it. Clones share the device.
#[derive(Clone, Debug)]
pub struct Gpu {
    pub device: Device,
    pub queue: Queue,
    pub report: AdapterReport,
    faults: Faults,
}

impl Gpu {
    /// The best adapter, with no window. `WGPU_BACKEND` (`vulkan`, `metal`, `dx12`, `gl`) narrows the choice, `WGPU_ADAPTER_NAME` and
    /// [`choice::name`](super::choice::name) name one, and `WGPU_POWER_PREF=low` prefers one that saves power.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] where there is none, [`Error::Gpu`] where its driver refuses.
    pub fn headless() -> Result<Self, Error> {
        let (adapter, reason) = select(&Self::all()?, None).map_err(|problem| no_adapter(&problem))?;
        let descriptor = Self::device_descriptor(&adapter);
        let (device, queue) =
            pollster::block_on(adapter.request_device(&descriptor)).map_err(|e| Error::Gpu {
                problem: format!("{} gives no device: {e}", adapter.get_info().name),
                remedy: "update its driver, or use the CPU",
            })?;
        Self::new(&adapter, device, queue, reason)
    }

    /// All adapters, that which is taken without a window first, with the reason.
    ///
    /// # Errors
    /// As [`Gpu::headless`], and where none can render to floats.
    pub fn adapters() -> Result<Vec<AdapterReport>, Error> {
        let all = Self::all()?;
        let (taken, reason) = select(&all, None).map_err(|problem| no_adapter(&problem))?;
        let report = |adapter: &Adapter, reason| {
            AdapterReport::new(adapter, reason, adapter.limits().max_texture_dimension_2d)
        };
        let taken = report(&taken, reason)?;
        let others = all.iter().filter_map(|one| report(one, String::new()).ok());
        let is_taken = |one: &AdapterReport| one.name == taken.name && one.backend == taken.backend;
        let others: Vec<_> = others.filter(|one| !is_taken(one)).collect();
        Ok([vec![taken], others].concat())
    }

    fn all() -> Result<Vec<Adapter>, Error> {
        Self::check_environment()?;
        let instance = wgpu::Instance::new(InstanceDescriptor::new_without_display_handle_from_env());
        Ok(pollster::block_on(instance.enumerate_adapters(Backends::all())))
    }

    /// Checks that `WGPU_BACKEND` names graphics interfaces.
    ///
    /// # Errors
    /// [`Error::NoAdapter`].
    pub fn check_environment() -> Result<(), Error> {
        choice::check()
    }

    /// The device of a window.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] where the adapter cannot render to floats.
    pub fn from_eframe_parts(adapter: &Adapter, device: &Device, queue: &Queue) -> Result<Self, Error> {
        Self::new(adapter, device.clone(), queue.clone(), "chosen for the window".to_owned())
    }

    /// The choice of [`Gpu::headless`] for a window: among those of `adapters` that can present to `surface`.
    ///
    /// # Errors
    /// In words, where there is none: the form that egui-wgpu's `native_adapter_selector` wants.
    pub fn select_adapter(adapters: &[Adapter], surface: Option<&Surface<'_>>) -> Result<Adapter, String> {
        match select(adapters, surface) {
            Ok((adapter, _)) => Ok(adapter),
            Err(problem) => Err(no_adapter(&format!("{problem} that can present to a window")).to_string()),
        }
    }

    /// Asks for all that the adapter can do in size, and for no feature that is not everywhere.
    pub fn device_descriptor(adapter: &Adapter) -> DeviceDescriptor<'static> {
        DeviceDescriptor {
            label: Some("svbrdf"),
            required_limits: adapter.limits(),
            // Textures change their size with the window: large blocks of memory would be kept for small ones.
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..DeviceDescriptor::default()
        }
    }

    /// The first failure since the last call that no function could return: of drawing, or of the driver.
    pub fn take_fault(&self) -> Option<Error> {
        self.faults.take()
    }

    /// Why the device was lost, for example by a reset of its driver. Nothing is drawn from then on.
    pub fn loss(&self) -> Option<&str> {
        self.faults.loss()
    }

    /// The same, once the driver has been asked: it tells of the loss after the work that was sent before it, for which
    /// this waits a second at most.
    pub fn loss_by_now(&self) -> Option<&str> {
        let timeout = Some(std::time::Duration::from_secs(1));
        let _ = self.device.poll(wgpu::PollType::Wait { submission_index: None, timeout });
        self.loss()
    }

    /// Calls `then` once the device is lost, on any thread. Only the first call has an effect.
    pub fn at_loss(&self, then: impl Fn() + Send + Sync + 'static) {
        self.faults.at_loss(then);
    }

    /// Loses the device, as a fault of its driver does, which has not told of it yet. For tests.
    #[doc(hidden)]
    pub fn lose(&self) {
        self.device.destroy();
    }

    fn new(adapter: &Adapter, device: Device, queue: Queue, reason: String) -> Result<Self, Error> {
        let report = AdapterReport::new(adapter, reason, device.limits().max_texture_dimension_2d)?;
        let faults = Faults::watch(&device);
        Ok(Self { device, queue, report, faults })
    }
}

fn no_adapter(problem: &str) -> Error {
    Error::NoAdapter { problem: problem.to_owned(), remedy: NO_ADAPTER_REMEDY }
}
