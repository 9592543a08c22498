//! Flags for how records are read and processed.

use crate::keys::{Key, KeySet, key, switch};

/// The keys of a study that say how records are read; the processing is in the order of its flags.
#[derive(Debug, Clone)]
pub(crate) struct ReadKeys;

impl KeySet for ReadKeys {
    const KEYS: &'static [(&'static str, &'static [Key])] = &[(
        "Reading records",
        &[
            key(
                "unit",
                "UNIT",
                "Unit of acceleration, such as g, m/s2 or gal, of a file that does not state it",
            ),
            key(
                "dt",
                "TIME",
                "Time step of a file without a column of times",
            ),
            key(
                "component",
                "NAME|NUMBER",
                "Component to read from a file with several, by name or by number (from 1)",
            ),
            key(
                "station_xml",
                "FILE",
                "StationXML file with the sensitivity of a miniSEED file [default: the one in the same folder]",
            ),
            switch(
                "keep_mean",
                "Do not remove the mean of raw records (counts, miniSEED, SAC)",
            ),
            key(
                "scale",
                "RATIO",
                "Factor that multiplies the samples [default: 1]",
            ),
        ],
    )];
    const DETAILS: &'static [(&'static str, &'static [Key])] = &[(
        "Processing records, in this order",
        &[
            key(
                "azimuth",
                "ANGLE",
                "Rotate the two horizontal components of a file to this azimuth, clockwise from north",
            ),
            key(
                "baseline",
                "BASELINE",
                "Baseline to remove: mean, pre-event:5s, linear, quadratic, cubic, poly:N, graizer, graizer:N:5s, \
                 boore:T1:T2\n\n\
                 mean and pre-event remove a constant: the mean of the record or of its first seconds. linear, \
                 quadratic, cubic and poly:N remove a polynomial fitted to the acceleration. graizer removes the \
                 derivative of a polynomial fitted to the velocity, of degree 2 or N, from 0 s or from the time \
                 given (Graizer 1979). boore removes two offsets, one from T1 to T2 and one after T2, so that the \
                 velocity ends near zero (Iwan 1985, Boore 2001).",
            ),
            key(
                "taper",
                "RATIO",
                "Length of the cosine taper at each end, as a share of the record",
            ),
            key(
                "low_cut",
                "FREQUENCY",
                "Corner frequency of a high-pass filter\n\n\
                 A Butterworth filter is run forwards and backwards: it shifts nothing in time and halves the \
                 amplitude at the corner. Zeros are added before and after the record for a time of 1.5 × order / \
                 corner, and are kept, so that the record starts earlier (Boore 2005).",
            ),
            key(
                "high_cut",
                "FREQUENCY",
                "Corner frequency of a low-pass filter of the same kind",
            ),
            key(
                "filter_order",
                "N",
                "Order of the filters, from 1 to 10 [default: 4]",
            ),
            key(
                "resample",
                "TIME",
                "New time step, by band-limited interpolation (by straight lines if samples are unevenly spaced)",
            ),
            key(
                "scale_to",
                "ACCELERATION",
                "Scale to this peak acceleration, such as \"0.3 g\"",
            ),
            key(
                "scale_to_sa",
                "ACCELERATION at PERIOD",
                "Scale to a pseudo-acceleration, such as \"0.4 g at 1.2 s\", or \"0.4 g at 1.2 s, 2 %\" for a \
                 damping other than 5 %",
            ),
            key(
                "scale_to_spectrum",
                "FILE[, PERIODS][, DAMPING]",
                "Scale to the spectrum of a file, such as target.csv; \"target.csv, 0.1 s to 2 s, 2 %\" uses a part \
                 of it and a damping of 2 %\n\n\
                 The file has columns of periods and pseudo-accelerations with units in their headings, such as \
                 \"period [s]; PSA [g]\", or is the spectrum.csv of `freestand motion spectrum --out`. The factor \
                 minimises the squared error of ln PSA, in which every period of the file has the same weight. The \
                 damping is that of the file if it states exactly one, and otherwise 5 %.",
            ),
        ],
    )];
}
