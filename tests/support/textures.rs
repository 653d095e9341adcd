//! Texture files of games byte by byte: DDS and KTX2.

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

/// A DDS of plain pixels (red, green, blue, alpha).
pub fn dds_plain(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    dds(width, height, [32, 0x41, 0, 32, 0xff, 0xff00, 0xff_0000, 0xff00_0000], pixels)
}

/// A DDS of 4 x 4 blocks of the code `name`.
pub fn dds_blocks(width: u32, height: u32, name: &[u8; 4], blocks: &[u8]) -> Vec<u8> {
    dds(width, height, [32, 4, u32::from_le_bytes(*name), 0, 0, 0, 0, 0], blocks)
}

/// A DDS of 4 x 4 blocks of the DXGI format of this number.
pub fn dds_dx10(width: u32, height: u32, format: u32, blocks: &[u8]) -> Vec<u8> {
    // Format, a picture of two dimensions, no cube, one picture, alpha not said.
    let head: Vec<u8> = [format, 3, 0, 1, 0].into_iter().flat_map(u32::to_le_bytes).collect();
    dds_blocks(width, height, b"DX10", &[head.as_slice(), blocks].concat())
}

/// A block of BC1 of one colour, in 5, 6 and 5 bits.
pub fn bc1_block([r, g, b]: [u16; 3]) -> [u8; 8] {
    let [low, high] = (r << 11 | g << 5 | b).to_le_bytes();
    [low, high, low, high, 0, 0, 0, 0]
}

/// A block of BC5 of one x and one y.
pub fn bc5_block([x, y]: [u8; 2]) -> [u8; 16] {
    [x, x, 0, 0, 0, 0, 0, 0, y, y, 0, 0, 0, 0, 0, 0]
}

/// A block of UASTC of one colour: its mode 8.
fn uastc_block(rgba: [u8; 4]) -> [u8; 16] {
    let colour = rgba.iter().rev().fold(0_u128, |all, &byte| all << 8 | u128::from(byte));
    (23 | colour << 5).to_le_bytes()
}

/// A KTX2 of UASTC whose every block of 4 x 4 texels, row by row, has one colour.
pub fn ktx2_uastc(width: u32, height: u32, colours: &[[u8; 4]]) -> Vec<u8> {
    const DESCRIPTOR: u32 = 44;
    const LEVEL: u32 = 160;
    let mut file = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    let word = |file: &mut Vec<u8>, word: u32| file.extend(word.to_le_bytes());
    let long = |file: &mut Vec<u8>, long: u64| file.extend(long.to_le_bytes());
    // Vulkan format, type size, size, layers, faces, levels, no supercompression.
    [0, 1, width, height, 0, 0, 1, 1, 0].into_iter().for_each(|n| word(&mut file, n));
    // The data format descriptor, no key and value pairs, no global data.
    [104, DESCRIPTOR, 0, 0].into_iter().for_each(|n| word(&mut file, n));
    [0, 0].into_iter().for_each(|n| long(&mut file, n));
    let bytes = 16 * colours.len() as u64;
    [u64::from(LEVEL), bytes, bytes].into_iter().for_each(|n| long(&mut file, n));
    word(&mut file, DESCRIPTOR);
    word(&mut file, 0);
    word(&mut file, 2 | 40 << 16);
    // UASTC, Rec. 709, linear, straight alpha; blocks of 4 x 4 in 16 bytes; one sample of four channels.
    file.extend([166, 1, 1, 0, 3, 3, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0]);
    file.extend([0, 0, 127, 3, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255]);
    file.resize(LEVEL as usize, 0);
    colours.iter().for_each(|&colour| file.extend(uastc_block(colour)));
    file
}
