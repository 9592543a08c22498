use super::record::crc32c;
use super::steim::{Packing, decode};
use crate::formats::binary::Order;
use crate::formats::{Direction, MotionFile, ReadOptions, parse_motions};
use proptest::prelude::*;

/// 29 samples whose differences fill every kind of word: 7 of 4 bits, 6 of 5, 5 of 6, 4 of 8, 3 of
/// 10, 2 of 15, 1 of 30.
const SAMPLES: [i32; 29] = [
    1000,
    1007,
    999,
    1002,
    1003,
    1002,
    1002,
    1007,
    1022,
    1006,
    1015,
    1006,
    1008,
    1020,
    1051,
    1019,
    1039,
    1019,
    1020,
    1147,
    1019,
    1119,
    1019,
    1530,
    1018,
    1318,
    17701,
    1317,
    536_872_228,
];
/// The same as libmseed 3 packs them.
const STEIM1: [u32; 16] = [
    0x0155_AAC0,
    0x0000_03E8,
    0x2000_0524,
    0x0007_F803,
    0x01FF_0005,
    0x0FF0_09F7,
    0x020C_1FE0,
    0x14EC_017F,
    0xFF80_0064,
    0xFF9C_01FF,
    0xFE00_012C,
    0x3FFF_C000,
    0x1FFF_FFFF,
    0,
    0,
    0,
];
const STEIM2: [u32; 16] = [
    0x03F6_A800,
    0x0000_03E8,
    0x2000_0524,
    0x8078_31F0,
    0x4AF8_26E2,
    0x0C7E_052C,
    0x017F_8064,
    0xF9C7_FE00,
    0x8096_3FFF,
    0x7FFF_C000,
    0x5FFF_FFFF,
    0,
    0,
    0,
    0,
    0,
];

fn big(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_be_bytes()).collect()
}

fn as_f64(samples: &[i32]) -> Vec<f64> {
    samples.iter().map(|&sample| f64::from(sample)).collect()
}

#[test]
fn frames_of_another_packer_are_read() {
    for (words, packing) in [(STEIM1, Packing::Steim1), (STEIM2, Packing::Steim2)] {
        let mut found = Vec::new();
        decode(&big(&words), Order::Big, packing, SAMPLES.len(), &mut found).unwrap();
        assert_eq!(found, as_f64(&SAMPLES), "{packing:?}");
    }
}

#[test]
fn damaged_frames_are_refused() {
    let mut out = Vec::new();
    let mut damaged = STEIM2;
    damaged[4] ^= 1;
    let message = decode(&big(&damaged), Order::Big, Packing::Steim2, 29, &mut out).unwrap_err();
    assert!(
        message.contains("states 536872228 as its last sample"),
        "{message}"
    );
    let message = decode(&big(&STEIM2), Order::Big, Packing::Steim2, 30, &mut out).unwrap_err();
    assert!(message.contains("ends after 29 of 30"), "{message}");
    // Code 2 with the upper bits 00 means nothing.
    damaged = STEIM2;
    damaged[7] &= 0x3FFF_FFFF;
    damaged[0] = 0x03F6_8800 | 2 << 16;
    assert!(decode(&big(&damaged), Order::Big, Packing::Steim2, 29, &mut out).is_err());
    assert!(
        decode(&[0; 10], Order::Big, Packing::Steim1, 1, &mut out)
            .unwrap_err()
            .contains("no room")
    );
}

/// Differences in the widest words that hold them, so that a frame holds 15 and the first 13.
fn steim1(samples: &[i32], order: Order) -> Vec<u8> {
    let put = |word: u32| {
        if order == Order::Big {
            word.to_be_bytes()
        } else {
            word.to_le_bytes()
        }
    };
    let differences: Vec<i32> = samples
        .iter()
        .enumerate()
        .map(|(i, x)| {
            if i == 0 {
                0
            } else {
                x.wrapping_sub(samples[i - 1])
            }
        })
        .collect();
    let (mut out, mut rest) = (Vec::new(), differences.as_slice());
    while !rest.is_empty() {
        let constants = out.is_empty();
        let words = if constants { 13 } else { 15 };
        let count = rest.len().min(words);
        let codes = (0..count).fold(0u32, |codes, i| codes | 3 << (30 - 2 * (i + 16 - words)));
        out.extend(put(codes));
        if constants {
            out.extend(put(samples[0].cast_unsigned()));
            out.extend(put(samples[samples.len() - 1].cast_unsigned()));
        }
        out.extend(
            rest[..count]
                .iter()
                .flat_map(|difference| put(difference.cast_unsigned())),
        );
        out.extend(vec![0; 4 * (words - count)]);
        rest = &rest[count..];
    }
    out
}

/// One record of version 2 as the SEED manual has it.
#[derive(Clone)]
struct Header {
    name: &'static [u8; 12],
    /// Of the year and the day 187 of 2019, in units of 0.1 ms.
    start: u64,
    factor: i16,
    multiplier: i16,
    encoding: Option<u8>,
    header_order: Order,
    data_order: Order,
    power: u8,
    quality: u8,
    /// Activity flags and the correction of the clock.
    clock: (u8, i32),
    microseconds: i8,
    rate_hz: Option<f32>,
}

const HEADER: Header = Header {
    name: b"CLC    HNECI",
    start: 119_630_383,
    factor: 100,
    multiplier: 1,
    encoding: Some(10),
    header_order: Order::Big,
    data_order: Order::Big,
    power: 9,
    quality: 0,
    clock: (0, 0),
    microseconds: 0,
    rate_hz: None,
};

fn record2(header: &Header, samples: usize, data: &[u8]) -> Vec<u8> {
    let short = |value: u16| {
        if header.header_order == Order::Big {
            value.to_be_bytes()
        } else {
            value.to_le_bytes()
        }
    };
    let long = |value: u32| {
        if header.header_order == Order::Big {
            value.to_be_bytes()
        } else {
            value.to_le_bytes()
        }
    };
    let data_at: usize = if header.encoding.is_some() { 128 } else { 64 };
    let mut out = b"000001D ".to_vec();
    out.extend(header.name);
    out.extend(short(2019));
    out.extend(short(187));
    let seconds = header.start / 10_000;
    out.extend([
        (seconds / 3600) as u8,
        (seconds / 60 % 60) as u8,
        (seconds % 60) as u8,
        0,
    ]);
    out.extend(short((header.start % 10_000) as u16));
    out.extend(short(samples as u16));
    out.extend(short(header.factor.cast_unsigned()));
    out.extend(short(header.multiplier.cast_unsigned()));
    out.extend([header.clock.0, 0, header.quality, 3]);
    out.extend(long(header.clock.1.cast_unsigned()));
    out.extend(short(data_at as u16));
    out.extend(short(if header.encoding.is_some() { 48 } else { 0 }));
    if let Some(encoding) = header.encoding {
        out.extend(short(1000));
        out.extend(short(56));
        out.extend([
            encoding,
            u8::from(header.data_order == Order::Big),
            header.power,
            0,
        ]);
        out.extend(short(1001));
        out.extend(short(if header.rate_hz.is_some() { 64 } else { 0 }));
        out.extend([100, header.microseconds.cast_unsigned(), 0, 0]);
    }
    if let Some(rate_hz) = header.rate_hz {
        out.extend(short(100));
        out.extend(short(0));
        out.extend(long(rate_hz.to_bits()));
    }
    out.resize(data_at, 0);
    out.extend(data);
    assert!(out.len() <= 1 << header.power, "the data fit");
    out.resize(1 << header.power, 0);
    out
}

fn record3(identifier: &str, encoding: u8, rate: f64, samples: u32, data: &[u8]) -> Vec<u8> {
    let mut out = b"MS\x03\x00".to_vec();
    out.extend(38_300_000u32.to_le_bytes());
    out.extend([2019u16.to_le_bytes(), 187u16.to_le_bytes()].concat());
    out.extend([3, 19, 23, encoding]);
    out.extend(rate.to_le_bytes());
    out.extend(samples.to_le_bytes());
    out.extend([0; 4]);
    out.extend([1, identifier.len() as u8]);
    out.extend(2u16.to_le_bytes());
    out.extend((data.len() as u32).to_le_bytes());
    out.extend(identifier.as_bytes());
    out.extend(b"{}");
    out.extend(data);
    let sum = crc32c(&out);
    out[28..32].copy_from_slice(&sum.to_le_bytes());
    out
}

fn read(bytes: &[u8]) -> Result<MotionFile, String> {
    let options = ReadOptions {
        unit: Some("m/s2".to_owned()),
        ..ReadOptions::default()
    };
    parse_motions(bytes.to_vec(), "x.mseed".as_ref(), &options)
        .map_err(|error| error.problems[0].to_string())
}

#[track_caller]
fn refused(bytes: &[u8], message: &str) {
    let error = read(bytes).unwrap_err();
    assert!(error.contains(message), "{error}");
}

fn values(file: &MotionFile) -> &[f64] {
    file.components[0].motion.accel_m_s2()
}

#[test]
fn every_encoding_in_either_order_is_read() {
    let samples: [i32; 5] = [0, -3, 32_767, -32_768, 12];
    for header_order in [Order::Big, Order::Little] {
        for data_order in [Order::Big, Order::Little] {
            let swap = |bytes: Vec<u8>| {
                if data_order == Order::Big {
                    bytes
                } else {
                    bytes.into_iter().rev().collect()
                }
            };
            let all = |to: fn(i32) -> Vec<u8>| {
                samples
                    .iter()
                    .flat_map(|&x| swap(to(x)))
                    .collect::<Vec<u8>>()
            };
            for (encoding, data) in [
                (1, all(|x| (x as i16).to_be_bytes().to_vec())),
                (3, all(|x| x.to_be_bytes().to_vec())),
                (4, all(|x| (x as f32).to_be_bytes().to_vec())),
                (5, all(|x| f64::from(x).to_be_bytes().to_vec())),
                (10, steim1(&samples, data_order)),
            ] {
                let header = Header {
                    encoding: Some(encoding),
                    header_order,
                    data_order,
                    ..HEADER
                };
                let file = read(&record2(&header, 5, &data)).unwrap();
                assert_eq!(
                    values(&file),
                    as_f64(&samples),
                    "{encoding} {header_order:?} {data_order:?}"
                );
            }
        }
    }
}

#[test]
fn a_record_names_its_channel_and_is_raw() {
    let file = read(&record2(&HEADER, 29, &big(&STEIM1))).unwrap();
    let one = &file.components[0];
    assert_eq!(
        (file.format, one.name.as_str(), one.unit, one.is_raw),
        ("miniSEED 2", "HNE", "m/s2", true)
    );
    assert_eq!(
        (one.station.as_deref(), one.direction),
        (Some("CI.CLC"), Some(Direction::Azimuth(90.0)))
    );
    // Exact: one division by a whole number.
    assert_eq!(one.motion.dt_s(), 0.01);
    assert!(
        file.notes[0].to_string().contains("CI.CLC..HNE")
            && file.notes[0].to_string().contains("m/s2"),
        "{:?}",
        file.notes
    );
}

/// A record of libmseed 3, byte for byte: header, check sum, Steim-1.
#[test]
fn a_record_of_version_3_is_read() {
    let mut bytes = b"MS\x03\x00\0\0\0\0\xE4\x07\x01\x00\0\0\0\x0A\0\0\0\0\0\0\x59\x40\x1D\0\0\0\xEF\xA4\xD7\xE6\0\x13\0\0\x40\0\0\0".to_vec();
    bytes.extend(b"FDSN:XX_TEST__H_N_E");
    bytes.extend(big(&STEIM1));
    let file = read(&bytes).unwrap();
    assert_eq!(
        (file.format, file.components[0].name.as_str()),
        ("miniSEED 3", "HNE")
    );
    assert_eq!(
        (
            file.components[0].station.as_deref(),
            file.components[0].motion.dt_s()
        ),
        (Some("XX.TEST"), 0.01)
    );
    assert_eq!(values(&file), as_f64(&SAMPLES));
    bytes[70] ^= 1;
    refused(&bytes, "record 1 (byte 0) does not match its checksum");
}

#[test]
fn version_3_has_periods_and_other_names() {
    let data: Vec<u8> = [1.5f64, -2.5]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let file = read(&record3("FDSN:XX_A_10_H_LONG_1", 5, -0.25, 2, &data)).unwrap();
    assert_eq!(
        (
            file.components[0].name.as_str(),
            file.components[0].motion.dt_s()
        ),
        ("H_LONG_1", 0.25)
    );
    assert_eq!(values(&file), [1.5, -2.5]);
    let file = read(&record3("XFDSN:mine", 5, 8.0, 2, &data)).unwrap();
    assert_eq!(
        (
            file.components[0].name.as_str(),
            &file.components[0].station
        ),
        ("XFDSN:mine", &None)
    );
    refused(
        &record3("FDSN:XX_A_10_H_N_1", 5, 8.0, 3, &data),
        "declares 3 samples, but has room for 2",
    );
    // A count that would fill the memory.
    refused(
        &record3("FDSN:XX_A_10_H_N_1", 11, 8.0, u32::MAX, &big(&STEIM2)),
        "ends after 29 of 4294967295",
    );
    let nan: Vec<u8> = [1.5f64, f64::NAN]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    refused(
        &record3("FDSN:XX_A_10_H_N_1", 5, 8.0, 2, &nan),
        "sample 2 is NaN",
    );
}

fn three(second: u64, third: u64) -> Vec<Vec<u8>> {
    // 29 samples at 100 Hz: 2900 units of 0.1 ms.
    [0, second, third]
        .map(|later| {
            record2(
                &Header {
                    start: HEADER.start + later,
                    ..HEADER
                },
                29,
                &big(&STEIM1),
            )
        })
        .to_vec()
}

#[test]
fn records_are_put_in_the_order_of_time_and_used_once() {
    let records = three(2900, 5800);
    let expected = [SAMPLES; 3].concat();
    for order in [vec![0, 1, 2], vec![2, 0, 1], vec![1, 2, 1, 0]] {
        let bytes: Vec<u8> = order.iter().flat_map(|&i| records[i].clone()).collect();
        let file = read(&bytes).unwrap();
        assert_eq!(values(&file), as_f64(&expected), "{order:?}");
        assert_eq!(
            file.notes
                .iter()
                .any(|note| note.to_string().ends_with(": 1 repeated record ignored")),
            order.len() == 4
        );
    }
}

#[test]
fn gaps_and_overlaps_name_time_and_record() {
    // Half a sample is 50 units.
    assert!(read(&three(2950, 5800).concat()).is_ok());
    refused(
        &three(2900, 5851).concat(),
        "CI.CLC..HNE: a gap of 0.005100 s (0.5 samples) before record 3 (byte 1024): 2019-07-06T03:19:23.623 follows",
    );
    refused(
        &three(2800, 5800).concat(),
        "an overlap of 0.010000 s (1.0 samples) before record 2 (byte 512)",
    );
    let drifting = read(&three(2940, 5880).concat()).unwrap();
    assert!(
        drifting.notes.iter().any(|note| note
            .to_string()
            .contains("begins 0.008000 s later than the samples before it")),
        "{:?}",
        drifting.notes
    );
    let mut slow = three(2900, 5800);
    slow[2] = record2(
        &Header {
            factor: 50,
            start: HEADER.start + 5800,
            ..HEADER
        },
        29,
        &big(&STEIM1),
    );
    refused(
        &slow.concat(),
        "record 3 (byte 1024) has 50 Hz, but the records before it have 100 Hz",
    );
}

/// The clock's correction counts unless it is in already; blockette 1001 adds microseconds.
#[test]
fn the_start_has_its_corrections() {
    for (clock, microseconds, fits) in [
        ((0, 0), 0, false),
        ((0, 60), 0, true),
        ((2, 60), 0, false),
        // 9 units of 0.1 ms leave 5.1 ms, which is more than half a sample; 127 us more leave less.
        ((0, 9), 0, false),
        ((0, 9), 127, true),
    ] {
        let mut records = three(2900, 5800);
        // The last record is 60 units of 0.1 ms early.
        let last = Header {
            start: HEADER.start + 5740,
            clock,
            microseconds,
            ..HEADER
        };
        records[2] = record2(&last, 29, &big(&STEIM1));
        assert_eq!(
            read(&records.concat()).is_ok(),
            fits,
            "{clock:?} {microseconds}"
        );
    }
}

#[test]
fn rates_are_exact() {
    for (factor, multiplier, dt_s) in [
        (200, 1, 0.005),
        (2, 100, 0.005),
        (-5, 1, 5.0),
        (-5, 2, 2.5),
        (1000, -3, 0.003),
        (-5, -2, 10.0),
        (50, 0, 0.02),
    ] {
        let header = Header {
            factor,
            multiplier,
            ..HEADER
        };
        let file = read(&record2(&header, 29, &big(&STEIM1))).unwrap();
        assert_eq!(
            file.components[0].motion.dt_s(),
            dt_s,
            "{factor} {multiplier}"
        );
    }
    let file = read(&record2(
        &Header {
            rate_hz: Some(99.9),
            ..HEADER
        },
        29,
        &big(&STEIM1),
    ))
    .unwrap();
    // The decimal 99.9, not its single-precision neighbour.
    assert_eq!(file.components[0].motion.dt_s(), 1.0 / 99.9);
    refused(
        &record2(
            &Header {
                factor: 0,
                ..HEADER
            },
            29,
            &big(&STEIM1),
        ),
        "holds no records with samples",
    );
}

#[test]
fn channels_have_names_of_their_own() {
    let names = |all: &[&'static [u8; 12]]| {
        let bytes: Vec<u8> = all
            .iter()
            .flat_map(|name| record2(&Header { name, ..HEADER }, 29, &big(&STEIM1)))
            .collect();
        read(&bytes)
            .unwrap()
            .components
            .iter()
            .map(|one| one.name.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(names(&[b"CLC    HNECI", b"CLC    HNNCI"]), ["HNE", "HNN"]);
    assert_eq!(
        names(&[b"CLC  00HNECI", b"CLC  10HNECI"]),
        ["00.HNE", "10.HNE"]
    );
    assert_eq!(
        names(&[b"CLC    HNECI", b"ABC    HNECI"]),
        ["CI.CLC..HNE", "CI.ABC..HNE"]
    );
    assert_eq!(names(&[b"            "]), ["x"]);
}

#[test]
fn a_record_without_its_length_is_measured() {
    let bare = Header {
        encoding: None,
        power: 8,
        ..HEADER
    };
    let next = Header {
        start: HEADER.start + 2900,
        ..bare.clone()
    };
    let two = [
        record2(&bare, 29, &big(&STEIM1)),
        record2(&next, 29, &big(&STEIM1)),
    ]
    .concat();
    let file = read(&two).unwrap();
    assert_eq!(
        (
            values(&file).len(),
            file.notes[0].to_string().contains("no encoding is stated")
        ),
        (58, true)
    );
    refused(
        &two[..two.len() - 1],
        "record 2 (byte 256) does not state its length",
    );
    refused(
        &record2(&bare, 29, &big(&STEIM2)),
        "states no encoding (blockette 1000); read as Steim-1, it",
    );
}

#[test]
fn what_is_no_motion_is_skipped_or_refused() {
    let text = record2(
        &Header {
            encoding: Some(0),
            ..HEADER
        },
        5,
        b"hello",
    );
    refused(&text, "holds no records with samples");
    let good = record2(&HEADER, 29, &big(&STEIM1));
    let blank = [b"000002".to_vec(), vec![b' '; 506]].concat();
    let volume = [b"000001V 0100001".to_vec(), vec![b'x'; 4096 - 15]].concat();
    for before in [&text, &blank, &volume] {
        let file = read(&[before.as_slice(), &good].concat()).unwrap();
        assert_eq!(values(&file), as_f64(&SAMPLES));
        // Counts in m/s2 are more than any ground.
        assert_eq!(
            file.notes.len(),
            if *before == blank { 2 } else { 3 },
            "{:?}",
            file.notes
        );
    }
    for (code, name) in [
        (16, "CDSN"),
        (30, "SRO"),
        (14, "GEOSCOPE"),
        (77, "encoding 77"),
    ] {
        refused(
            &record2(
                &Header {
                    encoding: Some(code),
                    ..HEADER
                },
                29,
                &big(&STEIM1),
            ),
            name,
        );
    }
    refused(
        &[good.clone(), vec![1; 600]].concat(),
        "record 2 (byte 512) does not begin like a miniSEED record",
    );
    refused(
        &[good.clone(), good[..300].to_vec()].concat(),
        "record 2 (byte 512) is cut off",
    );
    refused(
        &record2(
            &Header {
                power: 20,
                ..HEADER
            },
            0,
            &[],
        )
        .split_off(0)[..512],
        "states a length of 2^20",
    );
    let flagged = read(&record2(
        &Header {
            quality: 0x12,
            ..HEADER
        },
        29,
        &big(&STEIM1),
    ))
    .unwrap();
    assert!(
        flagged.notes[0]
            .to_string()
            .contains("clipped, missing or padded data"),
        "{:?}",
        flagged.notes
    );
}

/// In a SEED volume, control headers end where the volume says or shows, so that damaged data do
/// not pass for theirs.
#[test]
fn no_record_is_lost_behind_control_headers() {
    let header = |kind: &str, blockette: &str, length: usize| {
        let mut block = format!("000001{kind}{blockette}").into_bytes();
        block.resize(length, b' ');
        block
    };
    let stated = header("V ", "010009802.4102019,187~", 1024);
    let of_station = header("V ", "0080073 2.310CLC  ", 1024);
    let unstated = [
        header("V ", "011  21  1CLC  ", 1024),
        header("S ", "050", 1024),
    ]
    .concat();
    let good = three(2900, 5800);
    let mut damaged = good[0].clone();
    damaged[6] = b'X';
    for control in [&stated, &of_station, &unstated] {
        let file = read(&[control.as_slice(), &good.concat()].concat()).unwrap();
        assert_eq!(values(&file).len(), 87);
        assert!(
            file.notes
                .iter()
                .any(|note| note.to_string().contains("of control headers")),
            "{:?}",
            file.notes
        );
        let message = format!(
            "record 1 (byte {}) does not begin like a miniSEED record",
            control.len()
        );
        refused(
            &[control, damaged.as_slice(), &good[1], &good[2]].concat(),
            &message,
        );
        // A volume whose records are shorter than it states ends with the first of them.
        assert_eq!(
            values(&read(&[&control[..control.len() - 512], &good[0]].concat()).unwrap()),
            as_f64(&SAMPLES)
        );
        let message = format!(
            "record 2 (byte {}) does not begin like a miniSEED record",
            control.len() + 512
        );
        refused(&[control, good[0].as_slice(), &damaged].concat(), &message);
    }
    // If nothing states the length, bytes that are not text do not belong to a control header.
    let alone = header("V ", "011  21  1CLC  ", 1024);
    refused(
        &[alone.as_slice(), &damaged, &good[1]].concat(),
        "the control header at byte 0 has bytes at 1024 that are not text",
    );
}

#[test]
fn without_a_sensitivity_the_way_out_is_said() {
    let bytes = record2(&HEADER, 29, &big(&STEIM1));
    let error =
        parse_motions(bytes, "nowhere/x.mseed".as_ref(), &ReadOptions::default()).unwrap_err();
    let problem = &error.problems[0];
    assert!(
        problem.message.contains("sensitivity") && problem.line.is_none(),
        "{problem}"
    );
    let hint = problem.hint.as_deref().unwrap();
    assert!(
        ["`station_xml`", "CI.CLC.xml", "`unit`"]
            .iter()
            .all(|word| hint.contains(word)),
        "{hint}"
    );
    let options = ReadOptions {
        unit: Some("g".to_owned()),
        dt_s: Some(0.02),
        ..ReadOptions::default()
    };
    let error =
        parse_motions(record2(&HEADER, 29, &big(&STEIM1)), "x".as_ref(), &options).unwrap_err();
    assert!(
        error.problems[0]
            .to_string()
            .starts_with("x: CI.CLC..HNE: the time step is 0.01 s"),
        "{error}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn what_is_packed_is_unpacked(samples in prop::collection::vec(any::<i32>(), 1..200), is_big in any::<bool>()) {
        let order = if is_big { Order::Big } else { Order::Little };
        let mut found = Vec::new();
        decode(&steim1(&samples, order), order, Packing::Steim1, samples.len(), &mut found).unwrap();
        prop_assert_eq!(found, as_f64(&samples));
    }

    /// Whatever happens to a file, it is read or refused.
    #[test]
    fn damaged_files_are_read_or_refused(
        which in 0..4usize,
        cut in 0.0..1.0f64,
        damage in prop::collection::vec((0.0..1.0f64, any::<u8>()), 1..8),
    ) {
        let mut bytes = match which {
            0 => three(2900, 5800).concat(),
            1 => record3("FDSN:XX_TEST__H_N_E", 11, 100.0, 29, &big(&STEIM2)),
            2 => record2(&Header { encoding: None, power: 8, ..HEADER }, 29, &big(&STEIM1)).repeat(3),
            _ => [b"000001V 0100001".to_vec(), vec![b'x'; 497], three(0, 0).concat()].concat(),
        };
        if cut > 0.5 {
            bytes.truncate((cut * bytes.len() as f64) as usize);
        }
        for (at, byte) in damage {
            let at = (at * bytes.len() as f64) as usize;
            if let Some(target) = bytes.get_mut(at) {
                *target = byte;
            }
        }
        match read(&bytes) {
            Ok(file) => prop_assert!(file.components.iter().all(|one| one.motion.accel_m_s2().iter().all(|a| a.is_finite()))),
            Err(message) => prop_assert!(!message.contains(['\n', '\r']), "{}", message),
        }
    }
}

/// A damaged number of samples must not lose them in silence; a record of none has nothing where
/// they would stand.
#[test]
fn records_of_no_samples_that_hold_some_are_said() {
    let good = record2(&HEADER, 29, &big(&STEIM1));
    let told = |first: &[u8]| {
        let notes = read(&[first, &good].concat()).unwrap().notes;
        notes.iter().any(|note| {
            note.to_string()
                .starts_with("1 record with data, but 0 samples in the header")
        })
    };
    assert!(told(&record2(&HEADER, 0, &big(&STEIM1))));
    assert!(!told(&record2(&HEADER, 0, &[])));
    assert!(!told(&record2(
        &Header {
            encoding: Some(0),
            ..HEADER
        },
        0,
        b"a message"
    )));
}
