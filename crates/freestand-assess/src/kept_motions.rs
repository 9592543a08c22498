//! Ground motions of worlds on disk, so that the processes that share a study make each of them once.
//!
//! A file appears complete or not at all, and ends with the hash of what it holds: a file that is
//! damaged is made again. A motion that cannot be written is only made again by the next process.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use freestand::motion::Motion;
use freestand_input::problem::Problems;
use freestand_records::horizontal::HorizontalMotion;
use sha2::{Digest, Sha256};

/// The first bytes of every file.
const BEGINNING: &[u8; 8] = b"fs-mot-2";

/// Bytes of a SHA-256.
const HASH_BYTES: usize = 32;

/// A folder with the ground motions of the worlds of one study.
#[derive(Debug)]
pub(crate) struct KeptMotions {
    folder: PathBuf,
}

impl KeptMotions {
    pub(crate) fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_path_buf(),
        }
    }

    /// The horizontal and the vertical motion of a world, drawn again so often: read, or made and
    /// kept.
    pub(crate) fn motion(
        &self,
        (world, again): (u32, u32),
        make: impl FnOnce() -> Result<(HorizontalMotion, Option<Motion>), Problems>,
    ) -> Result<(HorizontalMotion, Option<Motion>), Problems> {
        let path = self.folder.join(format!("{world:06}-{again}.motion"));
        if let Some(found) = fs::read(&path).ok().and_then(|bytes| read(&bytes)) {
            return Ok(found);
        }
        let (motion, vertical) = make()?;
        let components = [
            Some(&motion.along),
            motion.across.as_ref(),
            vertical.as_ref(),
        ];
        // Nothing depends on the file: a disk that is full costs time and no result.
        let _ = self.keep(&path, &written(components));
        Ok((motion, vertical))
    }

    fn keep(&self, path: &Path, bytes: &[u8]) -> std::io::Result<()> {
        if fs::symlink_metadata(&self.folder).is_ok_and(|data| data.is_symlink()) {
            return Err(std::io::ErrorKind::InvalidInput.into());
        }
        fs::create_dir_all(&self.folder)?;
        // Created here, the file has the permissions that the umask of the user allows.
        let create = |path: &Path| fs::File::create_new(path);
        let mut file = tempfile::Builder::new()
            .prefix(".partial-")
            .make_in(&self.folder, create)?;
        file.as_file_mut().write_all(bytes)?;
        file.into_temp_path().persist(path)?;
        Ok(())
    }
}

/// For each component the number of its samples (0: there is none), its time step and its samples,
/// as little-endian 64-bit numbers; then the hash.
fn written(components: [Option<&Motion>; 3]) -> Vec<u8> {
    let mut bytes = BEGINNING.to_vec();
    for motion in components {
        let samples = motion.map_or(&[][..], Motion::accel_m_s2);
        bytes.extend((samples.len() as u64).to_le_bytes());
        bytes.extend(motion.map_or(0.0, Motion::dt_s).to_le_bytes());
        bytes.extend(samples.iter().flat_map(|sample| sample.to_le_bytes()));
    }
    let hash = Sha256::digest(&bytes);
    bytes.extend(hash);
    bytes
}

/// The motions of [`written`]; `None` where the bytes are not intact.
fn read(bytes: &[u8]) -> Option<(HorizontalMotion, Option<Motion>)> {
    let (content, hash) = bytes.split_at_checked(bytes.len().checked_sub(HASH_BYTES)?)?;
    if Sha256::digest(content).as_slice() != hash {
        return None;
    }
    let mut rest = content.strip_prefix(BEGINNING)?;
    let mut number = || {
        let (number, after) = rest.split_first_chunk::<8>()?;
        rest = after;
        Some(*number)
    };
    let mut component = || {
        let samples = u64::from_le_bytes(number()?);
        let dt_s = f64::from_le_bytes(number()?);
        let accel_m_s2: Option<Vec<f64>> = (0..samples)
            .map(|_| number().map(f64::from_le_bytes))
            .collect();
        match samples {
            0 => Some(None),
            _ => Some(Some(Motion::new(dt_s, accel_m_s2?).ok()?)),
        }
    };
    let [along, across, vertical] = [component()?, component()?, component()?];
    Some((
        HorizontalMotion {
            along: along?,
            across,
        },
        vertical,
    ))
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    fn motions() -> (HorizontalMotion, Option<Motion>) {
        let along = Motion::new(0.005, vec![0.1 + 0.2, -1e-300, 3.0]).unwrap();
        (
            HorizontalMotion {
                along,
                across: None,
            },
            Motion::new(0.01, vec![1.0 / 3.0, 0.0]).ok(),
        )
    }

    /// A motion is made once, and again where its file is damaged, whichever byte it is.
    #[test]
    fn a_motion_is_made_once_and_again_where_its_file_is_damaged() {
        let folder = tempfile::tempdir().unwrap();
        let kept = KeptMotions::new(&folder.path().join("motions"));
        let made = Cell::new(0);
        let ask = || {
            let make = || {
                made.set(made.get() + 1);
                Ok(motions())
            };
            kept.motion((7, 1), make).unwrap()
        };
        assert_eq!((ask(), ask(), made.get()), (motions(), motions(), 1));
        let files: Vec<PathBuf> = fs::read_dir(&kept.folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .collect();
        assert_eq!(files, [kept.folder.join("000007-1.motion")]);
        let whole = fs::read(&files[0]).unwrap();
        for cut in [0, 5, 40, whole.len() - 1] {
            fs::write(&files[0], &whole[..cut]).unwrap();
            assert_eq!(ask(), motions());
        }
        for place in (0..whole.len()).step_by(9) {
            let mut bytes = whole.clone();
            bytes[place] ^= 1;
            fs::write(&files[0], bytes).unwrap();
            assert_eq!(ask(), motions());
        }
        assert_eq!(made.get(), 5 + whole.len().div_ceil(9));
        assert_eq!(fs::read(&files[0]).unwrap(), whole);
    }
}
