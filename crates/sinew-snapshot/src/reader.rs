//! Where state is read from.

use crate::SnapshotError;

/// Where state is read from: bytes that are used up from the front.
#[derive(Clone, Debug)]
pub struct Reader<'a> {
    left: &'a [u8],
}

impl<'a> Reader<'a> {
    /// Reads these bytes, which carry neither version nor checksum; [`crate::FrameKind`] checks both.
    pub fn new(bytes: &'a [u8]) -> Reader<'a> {
        Reader { left: bytes }
    }

    /// The next `count` bytes.
    ///
    /// # Errors
    /// When fewer are left.
    #[inline]
    pub fn bytes(&mut self, count: usize) -> Result<&'a [u8], SnapshotError> {
        let (bytes, left) = self.left.split_at_checked(count).ok_or_else(|| self.too_short(count))?;
        self.left = left;
        Ok(bytes)
    }

    /// The next `N` bytes.
    ///
    /// # Errors
    /// When fewer are left.
    #[inline]
    pub fn array<const N: usize>(&mut self) -> Result<[u8; N], SnapshotError> {
        let (bytes, left) = self.left.split_first_chunk::<N>().ok_or_else(|| self.too_short(N))?;
        self.left = left;
        Ok(*bytes)
    }

    /// The next byte, such as the number of an enum's variant.
    ///
    /// # Errors
    /// When none is left.
    #[inline]
    pub fn byte(&mut self) -> Result<u8, SnapshotError> {
        self.array::<1>().map(|[byte]| byte)
    }

    /// The number of elements that follow, each of which takes at least one byte.
    ///
    /// # Errors
    /// When more are promised than bytes are left.
    #[inline]
    pub fn length(&mut self) -> Result<usize, SnapshotError> {
        let length = u32::from_le_bytes(self.array()?) as usize;
        if length > self.left.len() { Err(self.too_short(length)) } else { Ok(length) }
    }

    /// Bytes with their length, as [`crate::Writer::blob`] wrote them.
    ///
    /// # Errors
    /// When more are promised than are left.
    pub fn blob(&mut self) -> Result<&'a [u8], SnapshotError> {
        let length = self.length()?;
        self.bytes(length)
    }

    /// How many elements of type `T` may be allocated at once for `length` of them: no more memory than there are bytes left.
    /// A collection grows beyond that only while elements are in fact read.
    pub fn capacity<T>(&self, length: usize) -> usize {
        length.min(self.left.len() / size_of::<T>().max(1))
    }

    /// How many bytes are left.
    pub fn left(&self) -> usize {
        self.left.len()
    }

    /// Says that the state is complete.
    ///
    /// # Errors
    /// When bytes are left over.
    pub fn end(&self) -> Result<(), SnapshotError> {
        if self.left.is_empty() { Ok(()) } else { Err(SnapshotError::TooLong { bytes: self.left.len() }) }
    }

    fn too_short(&self, wanted: usize) -> SnapshotError {
        SnapshotError::TooShort { wanted, left: self.left.len() }
    }
}
