//! Errors of key poses.

use super::PartName;

/// Why key poses cannot be resolved on a body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PoseError {
    /// A base pose that does not exist.
    #[error("pose {pose:?} starts from {base:?}, which does not exist; there are: {known}")]
    UnknownBase {
        /// The pose.
        pose: String,
        /// Its base.
        base: String,
        /// What there is.
        known: String,
    },
    /// A cycle of base poses.
    #[error("pose {pose:?} starts from itself: {way}; let one of them start from \"stand\"")]
    Cycle {
        /// One of them.
        pose: String,
        /// From base to base.
        way: String,
    },
    /// A number out of range.
    #[error("pose {pose:?}, {place}: {problem}")]
    Number {
        /// The pose.
        pose: String,
        /// The joint or key.
        place: String,
        /// What is wrong and what is right.
        problem: String,
    },
    /// The hips have no joint.
    #[error("pose {pose:?} turns the hips, which hang from nothing; turn the chest and the upper legs instead")]
    Root {
        /// The pose.
        pose: String,
    },
    /// A joint beyond its range.
    #[error("pose {pose:?}: {joint} is {excess_deg:.1} degrees beyond its limit; turn it less")]
    Limit {
        /// The pose.
        pose: String,
        /// The joint.
        joint: PartName,
        /// By how much \[degrees\].
        excess_deg: f64,
    },
    /// A part that does not belong to a limb.
    #[error("pose {pose:?}: {link} ends no limb; ik takes leftHand, rightHand, leftFoot or rightFoot")]
    NoLimb {
        /// The pose.
        pose: String,
        /// What was named.
        link: PartName,
    },
    /// A target out of reach.
    #[error("pose {pose:?}: {link} stays {miss_m:.3} m from its target; bring the target nearer")]
    OutOfReach {
        /// The pose.
        pose: String,
        /// The limb's end.
        link: PartName,
        /// The distance \[m\].
        miss_m: f64,
    },
    /// A count above its maximum.
    #[error("{what}: {count} are too many; up to {most} are taken")]
    TooMany {
        /// Of what.
        what: String,
        /// The count.
        count: usize,
        /// The maximum.
        most: usize,
    },
    /// A name of the built-in pose.
    #[error("pose \"stand\" is built in; give yours another name")]
    Stand,
}

/// Why a pose file cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PoseFileError {
    /// The text is not a valid pose file.
    #[error("{file}, line {line}: {problem}")]
    Line {
        /// The file's name as it was given.
        file: String,
        /// Counted from 1.
        line: usize,
        /// What is wrong and what to do.
        problem: String,
    },
    /// The text is too long.
    #[error("{file} has {bytes} bytes; a pose file has at most {most}")]
    TooLong {
        /// The file's name as it was given.
        file: String,
        /// Its length.
        bytes: usize,
        /// The maximum.
        most: usize,
    },
}
