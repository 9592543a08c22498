//! Damaged files, for the mutation tests of freestand-records and freestand-assess.

/// The same mutations in every run: Knuth's linear congruential generator (TAOCP 2, MMIX), its
/// upper bits.
pub struct Chance(pub u64);

impl Chance {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound.max(1)
    }
}

pub fn split_lines(bytes: &[u8]) -> Vec<&[u8]> {
    bytes.split_inclusive(|&b| b == b'\n').collect()
}

/// One line in place of itself `count` times: 0 loses it, 2 doubles it.
fn repeat_line(bytes: &[u8], at: usize, count: usize) -> Vec<u8> {
    let lines = split_lines(bytes);
    let each = lines.iter().enumerate().map(|(i, line)| {
        if i == at {
            line.repeat(count)
        } else {
            line.to_vec()
        }
    });
    each.collect::<Vec<_>>().concat()
}

/// `bytes` with `with` in place of what stands at `at`.
fn overwrite(bytes: &[u8], at: usize, with: &[u8]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    out.splice(at..(at + with.len()).min(bytes.len()), with.iter().copied());
    out
}

/// What a transfer, an editor or a program makes of a file.
pub fn mutations(bytes: &[u8], chance: &mut Chance) -> Vec<Vec<u8>> {
    let mut out = Vec::new();
    let (length, lines) = (bytes.len(), split_lines(bytes).len());
    // Cut off, at even distances and at the very ends.
    out.extend((0..40).map(|i| bytes[..length * i / 40].to_vec()));
    out.extend((1..12).map(|i| bytes[..length.saturating_sub(i)].to_vec()));
    out.extend((1..8).map(|i| bytes[i.min(length)..].to_vec()));
    // Lines lost or doubled.
    out.extend((0..lines.min(25)).map(|at| repeat_line(bytes, at, 0)));
    out.extend((0..25).map(|_| repeat_line(bytes, chance.below(lines), 0)));
    out.extend((0..15).map(|_| repeat_line(bytes, chance.below(lines), 2)));
    // Single bits.
    for _ in 0..80 {
        let mut flipped = bytes.to_vec();
        flipped[chance.below(length)] ^= 1 << chance.below(8);
        out.push(flipped);
    }
    // Numbers that say something else: each digit of the head, and some others.
    let digits: Vec<usize> = (0..length).filter(|&i| bytes[i].is_ascii_digit()).collect();
    for &at in digits.iter().take(60) {
        out.push(overwrite(bytes, at, b"9"));
        out.push(overwrite(bytes, at, b"-"));
    }
    for with in [
        "99999999999999999999",
        "1E400",
        "-1",
        "NaN",
        "-999",
        "1.7E38",
        "0",
        ".",
        "\u{fffd}",
        "\0",
        "\t",
        "#",
    ] {
        for _ in 0..4 {
            out.push(overwrite(bytes, chance.below(length), with.as_bytes()));
            out.extend(
                digits
                    .get(chance.below(digits.len()))
                    .map(|&at| overwrite(bytes, at, with.as_bytes())),
            );
        }
    }
    // Line ends of other systems, blank lines, all on one line, and what editors put around a text.
    let replaced = |from: &[u8], to: &[u8]| {
        split_lines(bytes)
            .iter()
            .flat_map(|line| {
                [
                    line.strip_suffix(from).unwrap_or(line),
                    if line.ends_with(from) { to } else { b"" },
                ]
                .concat()
            })
            .collect::<Vec<u8>>()
    };
    out.extend(
        [b"\r\n".as_slice(), b"\r\r\n", b"\r", b"\n\n", b" \n", b" "].map(|to| replaced(b"\n", to)),
    );
    let mixed = split_lines(&replaced(b"\n", b"\r\n"))
        .iter()
        .enumerate()
        .fold(Vec::new(), |mut text: Vec<u8>, (i, line)| {
            text.extend_from_slice(line);
            if i % 3 == 0 {
                text.truncate(text.len().saturating_sub(1));
            }
            text
        });
    out.push(mixed);
    out.push([b"\xEF\xBB\xBF", bytes].concat());
    out.push([bytes, b"\n\n \n\x1A"].concat());
    out.push([bytes, bytes].concat());
    // Bytes that are no UTF-8.
    out.extend((0..15).map(|_| {
        overwrite(
            bytes,
            chance.below(length),
            &[0x80 + chance.below(128) as u8],
        )
    }));
    out.push(bytes.to_ascii_lowercase());
    out.push(bytes.to_ascii_uppercase());
    out
}
