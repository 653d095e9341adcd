//! PNG files byte by byte: any depth, colour type, interlacing and chunk.

/// Colour types of PNG.
pub const GRAY: u8 = 0;
pub const RGB: u8 = 2;
pub const PALETTE: u8 = 3;
pub const GRAY_ALPHA: u8 = 4;
pub const RGBA: u8 = 6;

/// What a PNG is made of.
#[derive(Clone, Copy, Debug)]
pub struct Png<'a> {
    pub size: [usize; 2],
    pub depth: u8,
    pub colour: u8,
    pub interlaced: bool,
    /// Between the header and the pixels: name and content.
    pub chunks: &'a [([u8; 4], Vec<u8>)],
}

impl Png<'_> {
    fn samples(&self) -> usize {
        match self.colour {
            GRAY | PALETTE => 1,
            GRAY_ALPHA => 2,
            RGB => 3,
            _ => 4,
        }
    }

    /// The file whose sample number `channel` of the pixel in column x of row y is `at(x, y, channel)`.
    pub fn bytes(&self, at: impl Fn(usize, usize, usize) -> u16) -> Vec<u8> {
        // Adam7: first column, first row, step of columns, step of rows.
        let passes: &[[usize; 4]] = if self.interlaced {
            &[
                [0, 0, 8, 8],
                [4, 0, 8, 8],
                [0, 4, 4, 8],
                [2, 0, 4, 4],
                [0, 2, 2, 4],
                [1, 0, 2, 2],
                [0, 1, 1, 2],
            ]
        } else {
            &[[0, 0, 1, 1]]
        };
        let [width, height] = self.size;
        let mut raw = Vec::new();
        for &[left, top, across, down] in passes.iter().filter(|pass| pass[0] < width) {
            for y in (top..height).step_by(down) {
                raw.push(0);
                let row = (left..width).step_by(across);
                let samples = row.flat_map(|x| (0..self.samples()).map(move |c| (x, c)));
                raw.extend(packed(samples.map(|(x, c)| at(x, y, c)), self.depth));
            }
        }
        let [w, h] = self.size.map(|side| (side as u32).to_be_bytes());
        let header = [w.as_slice(), &h, &[self.depth, self.colour, 0, 0, u8::from(self.interlaced)]].concat();
        let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
        file.extend(chunk(*b"IHDR", &header));
        self.chunks.iter().for_each(|(name, content)| file.extend(chunk(*name, content)));
        file.extend(chunk(*b"IDAT", &zlib(&raw)));
        file.extend(chunk(*b"IEND", &[]));
        file
    }
}

/// Samples of `depth` bits, the first one in the highest bits; the last byte is filled up.
fn packed(samples: impl Iterator<Item = u16>, depth: u8) -> Vec<u8> {
    let (mut bytes, mut bits, mut count) = (Vec::new(), 0_u32, 0);
    for sample in samples {
        bits = bits << depth | u32::from(sample);
        count += depth;
        while count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    if count > 0 {
        bytes.push((bits << (8 - count)) as u8);
    }
    bytes
}

pub fn chunk(name: [u8; 4], content: &[u8]) -> Vec<u8> {
    let named = [name.as_slice(), content].concat();
    let length = (content.len() as u32).to_be_bytes();
    [length.as_slice(), &named, &crc32(&named).to_be_bytes()].concat()
}

/// As zlib stores what it does not compress.
pub fn zlib(raw: &[u8]) -> Vec<u8> {
    let mut stream = vec![0x78, 0x01];
    let blocks = raw.chunks(65_535);
    let last = blocks.len() - 1;
    for (number, block) in blocks.enumerate() {
        let length = block.len() as u16;
        stream.push(u8::from(number == last));
        stream.extend(length.to_le_bytes());
        stream.extend((!length).to_le_bytes());
        stream.extend(block);
    }
    let (mut a, mut b) = (1_u32, 0_u32);
    for &byte in raw {
        a = (a + u32::from(byte)) % 65_521;
        b = (b + a) % 65_521;
    }
    stream.extend((b << 16 | a).to_be_bytes());
    stream
}

pub fn crc32(bytes: &[u8]) -> u32 {
    let shift = |crc: u32, _| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), shift))
}
