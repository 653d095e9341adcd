//! npy and npz files as the tables describe them.

use std::fs::File;
use std::io::Write as _;
use std::path::Path;

use exr::prelude::f16;

use super::files::{Content, SIDE};
use super::formula::{Place, values};

impl Content {
    pub(super) fn npz(&self, path: &Path) {
        let mut zip = zip::ZipWriter::new(File::create(path).unwrap());
        for one in self.is.split(';').map(str::trim).filter(|one| !one.is_empty()) {
            let (head, formula) = one.split_once('=').unwrap();
            let (name, shape) = head.trim().split_once(' ').unwrap_or((head.trim(), ""));
            let name = if name.contains('.') { name.to_owned() } else { format!("{name}.npy") };
            zip.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
            zip.write_all(&self.array(&format!("{shape} = {formula}"))).unwrap();
        }
        zip.finish().unwrap();
    }

    /// An array of NumPy, as in `16x16x3 f4 = N`.
    pub(super) fn array(&self, text: &str) -> Vec<u8> {
        let (head, formula) = text.split_once('=').unwrap_or(("", text));
        let (mut shape, mut kind, mut is_planar, mut is_fortran) = (Vec::new(), "f4", false, false);
        for word in head.split_whitespace() {
            match word {
                "-" => {}
                "planes" => is_planar = true,
                "fortran" => is_fortran = true,
                word if word.contains('x') || word.parse::<u64>().is_ok() => {
                    shape = word.split('x').map(|side| side.parse::<usize>().unwrap()).collect();
                }
                other => kind = other,
            }
        }
        if shape.is_empty() && !head.contains('-') {
            shape = vec![SIDE, SIDE, values(formula, Place { x: 0, y: 0, size: [SIDE; 2] }).len()];
        }
        let count: usize = shape.iter().product();
        let (width, channels) =
            match shape.iter().skip_while(|side| shape.len() == 4 && **side == 1).collect::<Vec<_>>()[..] {
                [_, w, c] if !is_planar => (*w, *c),
                [c, _, w] => (*w, *c),
                [_, w] => (*w, 1),
                _ => (1, 1),
            };
        let texels = count / channels.max(1);
        let size = [width, texels / width.max(1)];
        let value = |i: usize| {
            // The channels are apart where they come first, or last and the first axis is the fastest.
            let is_apart = is_planar != is_fortran;
            let (at, channel) =
                if is_apart { (i % texels, i / texels) } else { (i / channels, i % channels) };
            let texel = if is_fortran { at % size[1] * width + at / size[1] } else { at };
            let of = values(formula, Place { x: texel % width, y: texel / width, size });
            of[channel.min(of.len() - 1)]
        };
        let sides: String = shape.iter().map(|side| format!("{side},")).collect();
        let order = if kind.starts_with('>') { ">" } else { "<" };
        let kind = kind.trim_start_matches('>');
        let fortran = if is_fortran { "True" } else { "False" };
        let header =
            format!("{{'descr': '{order}{kind}', 'fortran_order': {fortran}, 'shape': ({sides}), }}");
        let header = format!("{header:117}\n");
        let mut file = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
        file.extend(header.into_bytes());
        for v in (0..count).map(value) {
            let bytes = match kind {
                "f2" => f16::from_f64(v).to_le_bytes().to_vec(),
                "f4" => (v as f32).to_le_bytes().to_vec(),
                "f8" => v.to_le_bytes().to_vec(),
                integer => (v as i64).to_le_bytes()[..integer[1..].parse().unwrap()].to_vec(),
            };
            file.extend(if order == ">" { bytes.into_iter().rev().collect() } else { bytes });
        }
        file
    }
}
