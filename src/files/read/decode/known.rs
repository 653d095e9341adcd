//! Formats that are recognized and not read, and what to do with their files.

/// What to do with a file that is not read.
const PICTURE: &str = "convert it to PNG";
const ARRAYS: &str = "save each map as an array of rows, columns and channels: one .npz of all, or .npy";
const MATERIAL: &str = "export the material as glTF or MaterialX, or open the folder of its pictures";

/// How files begin, from which byte on, what they are called, and what to do with them.
#[rustfmt::skip]
const BEGINNINGS: [(usize, &[u8], &str, &str); 26] = [
    (0, b"8BPS", "a Photoshop document (PSD)", PICTURE),
    (0, b"\xff\x0a", "JPEG XL", PICTURE),
    (4, b"JXL ", "JPEG XL", PICTURE),
    (4, b"jP  ", "JPEG 2000", PICTURE),
    (0, b"\xff\x4f\xff\x51", "JPEG 2000", PICTURE),
    (4, b"ftypavif", "AVIF", PICTURE),
    (4, b"ftypavis", "AVIF", PICTURE),
    (4, b"ftyphei", "HEIC", PICTURE),
    (4, b"ftypmif1", "HEIC", PICTURE),
    (0, b"\xabKTX", "KTX", PICTURE),
    (0, b"GIF8", "GIF", PICTURE),
    (0, b"\x13\xab\xa1\x5c", "ASTC", PICTURE),
    (0, b"gimp xcf", "a GIMP image (XCF)", PICTURE),
    (0, b"%PDF", "PDF", PICTURE),
    (0, b"SDPX", "DPX", PICTURE),
    (0, b"XPDS", "DPX", PICTURE),
    (0, b"\xff\xd8\xff\xf7", "JPEG-LS", PICTURE),
    (0, b"7z\xbc\xaf\x27\x1c", "an archive (7z, or Substance)", "unpack it, or render its maps as pictures"),
    (8, b"{\"", "safetensors", ARRAYS),
    (0, b"\x80\x02", "a pickle of Python", ARRAYS),
    (0, b"#usda", "USD", MATERIAL),
    (0, b"PXR-USDC", "USD", MATERIAL),
    (0, b"\x89HDF\r\n", "HDF5", ARRAYS),
    (0, b"MATLAB", "a file of MATLAB", ARRAYS),
    (0, b"PAR1", "Parquet", ARRAYS),
    (0, b"ARROW1", "Arrow", ARRAYS),
];

/// The name of the format of a file that begins with `head` and is not read, and what to do with it.
pub(crate) fn name(head: &[u8]) -> Option<(&'static str, &'static str)> {
    let is = |(at, magic, ..): &&(usize, &[u8], &str, &str)| {
        head.get(*at..).is_some_and(|head| head.starts_with(magic))
    };
    BEGINNINGS.iter().find(is).map(|(.., name, remedy)| (*name, *remedy))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_format_that_is_not_read_has_a_name() {
        assert_eq!(name(b"8BPS\0\x01"), Some(("a Photoshop document (PSD)", PICTURE)));
        assert_eq!(name(b"\0\0\0\x0cJXL \r\n"), Some(("JPEG XL", PICTURE)));
        assert_eq!(name(b"\0\0\0\x20ftypavif"), Some(("AVIF", PICTURE)));
        assert_eq!(name(b"MATLAB 5.0 MAT-file"), Some(("a file of MATLAB", ARRAYS)));
        assert_eq!(name(b"\x89PNG"), None);
        assert_eq!(name(b""), None);
    }
}
