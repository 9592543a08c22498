//! The range of a restitution: one check for studies, inventories and single commands.

use freestand::block::Block;
use freestand::rocking::Restitution;
use freestand_input::problem::Problem;
use freestand_input::words::number;

/// Returns a restitution after checking that no block gains energy with it.
///
/// # Errors
/// A value outside (0, 1], or a factor that is not positive or makes the restitution of a block
/// larger than 1.
///
/// # Example
/// Housner's ratio of the block is 0.940, so that a factor of 1.1 makes it 1.034.
/// ```
/// use freestand::block::Block;
/// use freestand::rocking::Restitution;
/// use freestand_study::restitution::checked;
/// let block = Block::uniform(2.0, 0.408)?;
/// assert!(checked(Restitution::Factor(1.05), &[block]).is_ok());
/// assert_eq!(checked(Restitution::Factor(1.1), &[block]).unwrap_err().keys, ["restitution_factor"]);
/// # Ok::<(), freestand::block::BlockError>(())
/// ```
pub fn checked(restitution: Restitution, blocks: &[Block]) -> Result<Restitution, Problem> {
    let largest_ratio = || blocks.iter().map(Block::landing_ratio).fold(0.0, f64::max);
    let (key, message, hint) = match restitution {
        Restitution::Value(value) if !(value > 0.0 && value <= 1.0) => (
            "restitution",
            format!("`restitution` must be above 0 and at most 1, not {value}"),
            "with 1 no energy is lost in an impact; leave it out for Housner's ratio of each object",
        ),
        Restitution::Factor(factor) if !(factor > 0.0 && factor.is_finite()) => (
            "restitution_factor",
            format!("`restitution_factor` must be positive, not {factor}"),
            "give a factor such as 0.95 (measured on concrete) or 0.67 (measured on rubber)",
        ),
        Restitution::Factor(factor) if factor * largest_ratio() > 1.0 => (
            "restitution_factor",
            format!(
                "`restitution_factor` {factor} makes the restitution of an object {}: it would gain energy",
                number(factor * largest_ratio(), 5)
            ),
            "give a smaller factor: times Housner's ratio of the object it must be at most 1",
        ),
        _ => return Ok(restitution),
    };
    Err(Problem::value(message, hint).of(&[key]))
}
