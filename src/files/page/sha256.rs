//! SHA-256 (FIPS 180-4), for the hashes of the script and the style in the content security policy.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

/// The source expression of a content security policy that admits an inline script or style of this text.
pub(super) fn source(text: &str) -> String {
    format!("sha256-{}", BASE64_STANDARD.encode(digest(text.as_bytes())))
}

/// The first 32 bits of the fractional parts of the `power`-th roots of the first primes.
fn roots<const N: usize>(root: impl Fn(f64) -> f64) -> [u32; N] {
    let mut primes = (2u32..).filter(|n| (2..*n).take_while(|d| d * d <= *n).all(|d| n % d != 0));
    std::array::from_fn(|_| {
        let root = primes.next().map_or(0.0, |prime| root(f64::from(prime)));
        (root.fract() * 2f64.powi(32)) as u32
    })
}

fn digest(message: &[u8]) -> [u8; 32] {
    let constants: [u32; 64] = roots(f64::cbrt);
    let mut state: [u32; 8] = roots(f64::sqrt);
    let mut padded = message.to_vec();
    padded.push(0x80);
    padded.resize((message.len() + 9).next_multiple_of(64) - 8, 0);
    padded.extend((8 * message.len() as u64).to_be_bytes());
    for block in padded.chunks_exact(64) {
        let mut words = [0u32; 64];
        for (word, bytes) in words.iter_mut().zip(block.chunks_exact(4)) {
            *word = bytes.iter().fold(0, |word, byte| word << 8 | u32::from(*byte));
        }
        for t in 16..64 {
            let (x, y) = (words[t - 15], words[t - 2]);
            let first = x.rotate_right(7) ^ x.rotate_right(18) ^ x >> 3;
            let second = y.rotate_right(17) ^ y.rotate_right(19) ^ y >> 10;
            words[t] = words[t - 16].wrapping_add(first).wrapping_add(words[t - 7]).wrapping_add(second);
        }
        let rounds = words.iter().zip(&constants);
        let last = rounds.fold(state, |state, (word, constant)| round(state, word.wrapping_add(*constant)));
        state = std::array::from_fn(|i| state[i].wrapping_add(last[i]));
    }
    let mut digest = [0; 32];
    digest
        .iter_mut()
        .zip(state.iter().flat_map(|word| word.to_be_bytes()))
        .for_each(|(out, byte)| *out = byte);
    digest
}

fn round([a, b, c, d, e, f, g, h]: [u32; 8], word: u32) -> [u32; 8] {
    let sums = |x: u32, [i, j, k]: [u32; 3]| x.rotate_right(i) ^ x.rotate_right(j) ^ x.rotate_right(k);
    let choice = e & f ^ !e & g;
    let majority = a & b ^ a & c ^ b & c;
    let first = h.wrapping_add(sums(e, [6, 11, 25])).wrapping_add(choice).wrapping_add(word);
    let second = sums(a, [2, 13, 22]).wrapping_add(majority);
    [first.wrapping_add(second), a, b, c, d.wrapping_add(first), e, f, g]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_digests() {
        let hex = |text: &[u8]| digest(text).map(|byte| format!("{byte:02x}")).concat();
        let known: [(&[u8], &str); 3] = [
            (b"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"),
            (b"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"),
            (
                b"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
                "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1",
            ),
        ];
        for (text, expected) in known {
            assert_eq!(hex(text), expected);
        }
    }
}
