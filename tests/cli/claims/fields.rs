//! The lengths, sizes and counts in the headers of every format, with the words of their refusals.

/// Words of refusals. A decoder has no use for the field, or reads what is there.
pub const READ: &str = "";
pub const WRONG: &str = "expected a valid ";
pub const END: &str = "expected the whole image, found the end of the file within it";
pub const EMPTY: &str = "expected at least one pixel";
pub const SIDES: &str = "expected at most 65536 x 16384 pixels and 4 GiB";
pub const PIXELS: &str = "expected at most 4 GiB of pixels, found more";
/// The file is shorter than any with such a picture.
pub const SHORT: &str = " bytes for ";
/// The format has pictures of this size in a few bytes.
pub const LIMIT: &str = " of memory, more than the limit of 64 MiB leaves";
pub const GLTF: &str = "expected valid glTF, found: a contradiction in its lengths";

/// A field: the extension of a file, the field's name, the bytes before or at it, how far behind their beginning it lies, its own bytes,
/// and the words of the refusal of its largest values, with sign and without.
pub type Field = (&'static str, &'static str, &'static [u8], isize, usize, [&'static str; 2]);

pub const FIELDS: [Field; 69] = [
    ("png", "length of IHDR", b"IHDR", -4, 4, [WRONG; 2]),
    ("png", "width", b"IHDR", 4, 4, [PIXELS; 2]),
    ("png", "height", b"IHDR", 8, 4, [SIDES; 2]),
    ("png", "length of iCCP", b"iCCP", -4, 4, [END; 2]),
    ("png", "length of tEXt", b"tEXt", -4, 4, [END; 2]),
    ("png", "length of IDAT", b"IDAT", -4, 4, [END; 2]),
    ("jpg", "length of JFIF", b"\xff\xe0", 2, 2, [END; 2]),
    ("jpg", "length of quantization", b"\xff\xdb", 2, 2, [WRONG; 2]),
    ("jpg", "length of codes", b"\xff\xc4", 2, 2, [WRONG; 2]),
    ("jpg", "length of frame", b"\xff\xc0", 2, 2, [END; 2]),
    ("jpg", "height", b"\xff\xc0", 5, 2, [SHORT; 2]),
    ("jpg", "width", b"\xff\xc0", 7, 2, ["expected a packed strip", SHORT]),
    ("jpg", "components", b"\xff\xc0", 9, 1, [WRONG; 2]),
    ("jpg", "length of scan", b"\xff\xda", 2, 2, [END; 2]),
    ("tif", "offset of directory", b"II*\0", 4, 4, [END; 2]),
    ("tif", "count of width", b"\x00\x01\x04\0", 4, 4, [WRONG; 2]),
    ("tif", "width", b"\x00\x01\x04\0", 8, 4, [SIDES; 2]),
    ("tif", "count of height", b"\x01\x01\x04\0", 4, 4, [WRONG; 2]),
    ("tif", "height", b"\x01\x01\x04\0", 8, 4, [WRONG; 2]),
    ("tif", "count of bits", b"\x02\x01\x03\0", 4, 4, [WRONG; 2]),
    ("tif", "count of offsets", b"\x11\x01\x04\0", 4, 4, [WRONG; 2]),
    ("tif", "offset of strip", b"\x11\x01\x04\0", 8, 4, [END; 2]),
    ("tif", "rows of strip", b"\x16\x01\x04\0", 8, 4, [READ; 2]),
    ("tif", "count of lengths", b"\x17\x01\x04\0", 4, 4, [WRONG; 2]),
    ("tif", "length of strip", b"\x17\x01\x04\0", 8, 4, [READ; 2]),
    ("bmp", "length of file", b"BM", 2, 4, [READ; 2]),
    ("bmp", "offset of pixels", b"BM", 10, 4, [END; 2]),
    ("bmp", "length of header", b"BM", 14, 4, [WRONG; 2]),
    ("bmp", "width", b"BM", 18, 4, [WRONG; 2]),
    ("bmp", "height", b"BM", 22, 4, [WRONG, READ]),
    ("bmp", "length of pixels", b"BM", 34, 4, [READ; 2]),
    ("bmp", "colours", b"BM", 46, 4, [READ; 2]),
    ("tga", "length of comment", b"", 0, 1, [END; 2]),
    ("tga", "length of palette", b"", 5, 2, [READ; 2]),
    ("tga", "width", b"", 12, 2, [SHORT; 2]),
    ("tga", "height", b"", 14, 2, [SHORT; 2]),
    ("webp", "length of file", b"RIFF", 4, 4, [READ; 2]),
    ("webp", "length of chunk", b"RIFF", 16, 4, [READ; 2]),
    ("webp", "sides", b"RIFF", 21, 4, [WRONG; 2]),
    ("qoi", "width", b"qoif", 4, 4, [WRONG; 2]),
    ("qoi", "height", b"qoif", 8, 4, [WRONG; 2]),
    ("dds", "length of header", b"DDS ", 4, 4, [WRONG; 2]),
    ("dds", "height", b"DDS ", 12, 4, [SIDES; 2]),
    ("dds", "width", b"DDS ", 16, 4, [SIDES; 2]),
    ("dds", "pitch", b"DDS ", 20, 4, [READ; 2]),
    ("dds", "depth", b"DDS ", 24, 4, [READ; 2]),
    ("dds", "levels", b"DDS ", 28, 4, [READ; 2]),
    ("dds", "length of format", b"DDS ", 76, 4, [WRONG; 2]),
    ("exr", "length of channels", b"chlist\0", 7, 4, [WRONG; 2]),
    ("exr", "left of data", b"dataWindow\0box2i\0", 21, 4, [WRONG; 2]),
    ("exr", "right of data", b"dataWindow\0box2i\0", 29, 4, [WRONG; 2]),
    ("exr", "bottom of data", b"dataWindow\0box2i\0", 33, 4, [WRONG; 2]),
    ("exr", "length of data window", b"dataWindow\0box2i\0", 17, 4, [WRONG; 2]),
    ("exr", "bottom of display", b"displayWindow\0box2i\0", 32, 4, [WRONG, READ]),
    ("npy", "length of header", b"\x93NUMPY", 8, 2, [END; 2]),
    ("npz", "packed length", b"PK\x03\x04", 18, 4, [READ; 2]),
    ("npz", "length", b"PK\x03\x04", 22, 4, [READ; 2]),
    ("npz", "length of name", b"PK\x03\x04", 26, 2, [END; 2]),
    ("npz", "length of more", b"PK\x03\x04", 28, 2, [END; 2]),
    ("npz", "packed length in directory", b"PK\x01\x02", 20, 4, [READ; 2]),
    ("npz", "length in directory", b"PK\x01\x02", 24, 4, [LIMIT, "expected at most 4 GiB in the npz"]),
    ("npz", "length of name in directory", b"PK\x01\x02", 28, 2, [WRONG; 2]),
    ("npz", "length of more in directory", b"PK\x01\x02", 30, 2, [WRONG; 2]),
    ("npz", "offset in directory", b"PK\x01\x02", 42, 4, [WRONG; 2]),
    ("npz", "arrays", b"PK\x05\x06", 10, 2, [WRONG; 2]),
    ("npz", "length of directory", b"PK\x05\x06", 12, 4, [READ; 2]),
    ("npz", "offset of directory", b"PK\x05\x06", 16, 4, [WRONG; 2]),
    ("glb", "length of file", b"glTF", 8, 4, [GLTF; 2]),
    ("glb", "length of JSON", b"glTF", 12, 4, [GLTF; 2]),
];

/// Other bytes: the bytes before or at a field, how far behind their beginning it lies, and its value.
pub type Change = (&'static [u8], isize, &'static [u8]);

/// Pictures of 8192 texels or more a side, and such that no picture has; the words of the refusal.
pub const SIZES: [(&str, &[Change], &str); 24] = [
    ("png", &[(b"IHDR", 6, b"\x20"), (b"IHDR", 10, b"\x20")], SHORT),
    ("png", &[(b"IHDR", 4, b"\0\0\x75\x30\0\0\x75\x30")], SIDES),
    ("png", &[(b"IHDR", 4, b"\x7f\xff\xff\xff\0\0\0\x01")], PIXELS),
    ("png", &[(b"IHDR", 4, b"\x7f\xff\xff\xff\x7f\xff\xff\xff")], PIXELS),
    ("png", &[(b"IHDR", 4, b"\0\0\0\0")], WRONG),
    ("jpg", &[(b"\xff\xc0", 5, b"\x20"), (b"\xff\xc0", 7, b"\x20")], SHORT),
    ("jpg", &[(b"\xff\xc0", 5, b"\xff\xff\xff\xff")], SIDES),
    // Arithmetic coding: a plane of one value has no bits.
    ("jpg", &[(b"\xff\xc0", 5, b"\x20"), (b"\xff\xc0", 7, b"\x20"), (b"\xff\xc0", 1, b"\xc9")], LIMIT),
    ("tif", &[(b"\x00\x01\x04\0", 9, b"\x20"), (b"\x01\x01\x04\0", 9, b"\x20")], SHORT),
    ("tif", &[(b"\x00\x01\x04\0", 8, b"\0\0\0\x80"), (b"\x01\x01\x04\0", 8, b"\x01\0\0\0")], SIDES),
    (
        "tif",
        &[(b"\x00\x01\x04\0", 8, b"\xff\xff\xff\xff"), (b"\x01\x01\x04\0", 8, b"\xff\xff\xff\xff")],
        WRONG,
    ),
    ("tif", &[(b"\x00\x01\x04\0", 8, b"\0\0\0\0")], WRONG),
    ("tga", &[(b"", 13, b"\x20"), (b"", 15, b"\x20")], SHORT),
    ("bmp", &[(b"BM", 19, b"\x20"), (b"BM", 23, b"\x20")], SHORT),
    // Runs: a file may end before its picture.
    (
        "bmp",
        &[(b"BM", 19, b"\x20"), (b"BM", 23, b"\x20"), (b"BM", 28, b"\x08\0\x01"), (b"BM", 46, b"\x02")],
        LIMIT,
    ),
    // Without loss, a plane of one colour has no bits.
    ("webp", &[(b"RIFF", 21, b"\xff\xdf\xff\x07")], LIMIT),
    ("qoi", &[(b"qoif", 6, b"\x20"), (b"qoif", 10, b"\x20")], SHORT),
    ("dds", &[(b"DDS ", 13, b"\x20"), (b"DDS ", 17, b"\x20")], SHORT),
    ("exr", &[(b"dataWindow\0box2i\0", 30, b"\x20"), (b"dataWindow\0box2i\0", 34, b"\x20")], SHORT),
    ("exr", &[(b"dataWindow\0box2i\0", 29, b"\xff\xff\xff\x1f\0\0\0\0")], SIDES),
    ("exr", &[(b"dataWindow\0box2i\0", 29, b"\xff\xff\xff\x7f\0\0\0\0")], WRONG),
    ("exr", &[(b"dataWindow\0box2i\0", 21, b"\x05")], WRONG),
    ("exr", &[(b"dataWindow\0box2i\0", 21, b"\0\0\0\x80\0\0\0\x80\xff\xff\xff\x7f\xff\xff\xff\x7f")], WRONG),
    ("glb", &[(b"glTF", 8, b"\0\0\0\0\0\0\0\0")], GLTF),
];

/// Sizes as text.
pub const TEXTS: [(&str, &str); 6] = [
    ("ppm", "P6\n<w> <h>\n255\n"),
    ("pbm", "P4\n<w> <h>\n"),
    ("pam", "P7\nWIDTH <w>\nHEIGHT <h>\nDEPTH 3\nMAXVAL 255\nTUPLTYPE RGB\nENDHDR\n"),
    ("pfm", "PF\n<w> <h>\n-1.0\n"),
    ("hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y <h> +X <w>\n"),
    ("npy", "{'descr': '<f4', 'fortran_order': False, 'shape': (<h>, <w>, 3), }\n"),
];
pub const TEXT_SIZES: [([u64; 2], &str); 5] = [
    ([8192, 8192], SHORT),
    ([1 << 31, 1], SIDES),
    ([16_384, (1 << 32) - 1], SIDES),
    ([1 << 32, 1 << 32], "expected a"),
    ([5, 0], EMPTY),
];
