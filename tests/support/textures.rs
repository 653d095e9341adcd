//! DDS byte by byte.

/// A DDS of `width` x `height` texels: the pixel format as 8 words, then the pixels.
pub fn dds(width: u32, height: u32, pixel_format: [u32; 8], pixels: &[u8]) -> Vec<u8> {
    let mut file = b"DDS ".to_vec();
    let mut words = vec![124, 0x1007, height, width, 0, 0, 0];
    words.extend([0; 11]);
    words.extend(pixel_format);
    words.extend([0x1000, 0, 0, 0, 0]);
    words.iter().for_each(|word: &u32| file.extend(word.to_le_bytes()));
    file.extend(pixels);
    file
}
