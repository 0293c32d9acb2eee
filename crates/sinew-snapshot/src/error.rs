//! Why a snapshot cannot be restored.

/// Why a snapshot cannot be restored.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SnapshotError {
    /// The bytes begin with another magic number, or are shorter than the shortest snapshot.
    #[error("this is no snapshot of this kind; take one with the same program")]
    NotASnapshot,
    /// The snapshot is of another version of the layout.
    #[error("the snapshot has version {found}, this program reads version {expected}; take it anew with this program")]
    Version {
        /// What the bytes say.
        found: u32,
        /// What this program writes and reads.
        expected: u32,
    },
    /// Bytes were changed, lost or added since the snapshot was taken.
    #[error("the snapshot's checksum does not fit its content: bytes were changed, lost or added; copy it again")]
    Corrupt,
    /// The bytes end before the state is complete.
    #[error("the snapshot ends too early: {wanted} more bytes are wanted and {left} are left; it is of something else")]
    TooShort {
        /// Bytes that the next value needs.
        wanted: usize,
        /// Bytes that are left.
        left: usize,
    },
    /// Bytes are left over after the state was complete.
    #[error("the snapshot goes on for {bytes} bytes after its end; it is of something else")]
    TooLong {
        /// How many are left.
        bytes: usize,
    },
    /// A value is invalid for its type.
    #[error("the snapshot holds an invalid {what}; it is of something else")]
    Invalid {
        /// Which value.
        what: &'static str,
    },
    /// The snapshot is of something else: another scene, another number of joints.
    #[error("the snapshot is of something else: {what}")]
    Mismatch {
        /// What differs.
        what: String,
    },
}

impl SnapshotError {
    /// A value is invalid for its type.
    pub fn invalid(what: &'static str) -> SnapshotError {
        SnapshotError::Invalid { what }
    }

    /// The snapshot is of something else.
    pub fn mismatch(what: impl Into<String>) -> SnapshotError {
        SnapshotError::Mismatch { what: what.into() }
    }
}
