//! Limits of trust in files: what they may name, and how much memory they may take.

use svbrdf_files::disk::{memory, open};

/// Fewest bytes of a limit: a smaller one would refuse every file.
const LEAST: u64 = 16 << 20;

#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "Files")]
pub struct TrustArgs {
    /// Lets files name others by absolute paths: in glTF, MTL, MaterialX, sidecar and session files
    #[arg(long, global = true)]
    allow_outside: bool,

    /// Most memory that reading takes, as 4GiB or 500MiB [default: half of what is left]
    #[arg(long, value_name = "SIZE", value_parser = bytes, global = true)]
    max_memory: Option<u64>,
}

impl TrustArgs {
    /// Applies them to all of this process.
    pub fn apply(self) {
        if self.allow_outside {
            open::allow_outside();
        }
        if let Some(bytes) = self.max_memory {
            memory::set_limit(bytes);
        }
    }
}

/// A number of bytes with a unit.
fn bytes(text: &str) -> Result<u64, String> {
    let digits = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    let factor = match unit.trim().to_ascii_lowercase().as_str() {
        "k" | "kib" => 1u64 << 10,
        "m" | "mib" => 1 << 20,
        "g" | "gib" => 1 << 30,
        "t" | "tib" => 1 << 40,
        _ => 0,
    };
    let bytes = number.parse::<f64>().ok().map(|number| (number * factor as f64) as u64);
    bytes
        .filter(|bytes| *bytes >= LEAST)
        .ok_or_else(|| format!("expected a number with MiB or GiB, at least {}MiB, as in 4GiB", LEAST >> 20))
}
