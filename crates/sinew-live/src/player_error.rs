//! Why a file cannot be performed.

/// Why a file cannot be performed: a kind for programs, with words that name what is wrong and what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlayerError {
    /// The rate is out of range \[Hz\].
    #[error("a rate of {0} Hz is out of range; give 1 to 1000")]
    Rate(f64),
    /// The file holds no human body.
    #[error("{0}")]
    Body(String),
    /// There is nothing to play.
    #[error("the clip has no frames; give one that has")]
    NoFrames,
    /// The text is not BVH.
    #[error("the text is not BVH, which begins with HIERARCHY; give a .bvh file")]
    NotBvh,
    /// Its header does not say how long a frame lasts.
    #[error("it states no Frame Time from 0.0001 to 1 s; correct its header")]
    NoFrameTime,
}
