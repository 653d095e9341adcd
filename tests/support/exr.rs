//! EXR files byte by byte: what no library writes.

/// The beginning of a file of one part and one channel `Y` of 32-bit floats, up to its table of blocks.
///
/// `deep` makes it one of samples in depth; the window is (x least, y least, x most, y most).
pub fn header(window: [i32; 4], deep: bool) -> Vec<u8> {
    let mut file = vec![0x76, 0x2f, 0x31, 0x01];
    file.extend((if deep { 0x802_u32 } else { 2 }).to_le_bytes());
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        for text in [name, kind] {
            file.extend(text.as_bytes());
            file.push(0);
        }
        file.extend((value.len() as u32).to_le_bytes());
        file.extend(value);
    };
    let int = |n: i32| n.to_le_bytes().to_vec();
    // Name, type float, linear, three bytes of nothing, sampling of 1 x 1, and the end of the list.
    let channel = [b"Y\0".to_vec(), int(2), vec![0; 4], int(1), int(1), vec![0]].concat();
    attribute("channels", "chlist", &channel);
    attribute("compression", "compression", &[0]);
    let window: Vec<u8> = window.into_iter().flat_map(i32::to_le_bytes).collect();
    attribute("dataWindow", "box2i", &window);
    attribute("displayWindow", "box2i", &window);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1_f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1_f32.to_le_bytes());
    if deep {
        attribute("name", "string", b"part");
        attribute("type", "string", b"deepscanline");
        attribute("version", "int", &int(1));
        attribute("chunkCount", "int", &int(1));
        attribute("maxSamplesPerPixel", "int", &int(1));
    }
    file.push(0);
    file
}

/// A deep EXR of one texel with one sample of 0.5.
pub fn deep() -> Vec<u8> {
    let mut file = header([0; 4], true);
    let block = file.len() as u64 + 8;
    file.extend(block.to_le_bytes());
    file.extend(0_i32.to_le_bytes());
    // Bytes of the table of counts, of the samples packed, and of the samples.
    [4_u64, 4, 4].into_iter().for_each(|size| file.extend(size.to_le_bytes()));
    file.extend(1_i32.to_le_bytes());
    file.extend(0.5_f32.to_le_bytes());
    file
}
