//! Formats of pictures that are recognized and not read.

/// How files begin, from which byte on, and what they are called.
const BEGINNINGS: [(usize, &[u8], &str); 18] = [
    (0, b"8BPS", "a Photoshop document (PSD)"),
    (0, b"\xff\x0a", "JPEG XL"),
    (4, b"JXL ", "JPEG XL"),
    (4, b"jP  ", "JPEG 2000"),
    (0, b"\xff\x4f\xff\x51", "JPEG 2000"),
    (4, b"ftypavif", "AVIF"),
    (4, b"ftypavis", "AVIF"),
    (4, b"ftyphei", "HEIC"),
    (4, b"ftypmif1", "HEIC"),
    (0, b"\xabKTX 11", "KTX of version 1"),
    (0, b"sB", "a Basis Universal file of its own (.basis)"),
    (0, b"GIF8", "GIF"),
    (0, b"\x13\xab\xa1\x5c", "ASTC"),
    (0, b"gimp xcf", "a GIMP image (XCF)"),
    (0, b"%PDF", "PDF"),
    (0, b"[gd_resource", "a resource of Godot"),
    (0, b"[remap]", "an import file of Godot"),
    (0, b"#usda", "USD"),
];

/// The name of the format of a file that begins with `head` and is not read.
pub(crate) fn name(head: &[u8]) -> Option<&'static str> {
    let is = |(at, magic, _): &&(usize, &[u8], &str)| head.get(*at..).is_some_and(|h| h.starts_with(magic));
    BEGINNINGS.iter().find(is).map(|(.., name)| *name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_format_that_is_not_read_has_a_name() {
        assert_eq!(name(b"8BPS\0\x01"), Some("a Photoshop document (PSD)"));
        assert_eq!(name(b"\0\0\0\x0cJXL \r\n"), Some("JPEG XL"));
        assert_eq!(name(b"\0\0\0\x20ftypavif"), Some("AVIF"));
        assert_eq!(name(b"\x89PNG"), None);
        assert_eq!(name(b""), None);
    }
}
