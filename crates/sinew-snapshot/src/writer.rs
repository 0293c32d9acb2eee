//! Where state is written to.

/// Where state is written to: bytes that grow.
#[derive(Clone, Debug, Default)]
pub struct Writer {
    bytes: Vec<u8>,
    sections: Vec<usize>,
}

impl Writer {
    /// An empty one.
    pub fn new() -> Writer {
        Writer::default()
    }

    /// One that writes into `buffer`, which is emptied and keeps its capacity: repeated snapshots allocate once.
    pub fn into_buffer(mut buffer: Vec<u8>) -> Writer {
        buffer.clear();
        Writer { bytes: buffer, sections: Vec::new() }
    }

    /// Appends bytes as they are, without their length.
    #[inline]
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// Appends one byte, such as the number of an enum's variant.
    #[inline]
    pub fn byte(&mut self, byte: u8) {
        self.bytes.push(byte);
    }

    /// Appends the number of elements that follow. No state of ours has more than `u32::MAX`; a longer one would not be
    /// restored.
    #[inline]
    pub fn length(&mut self, length: usize) {
        self.bytes(&u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes());
    }

    /// Appends bytes with their length.
    pub fn blob(&mut self, bytes: &[u8]) {
        self.length(bytes.len());
        self.bytes(bytes);
    }

    /// Another section begins here. It changes no byte: where two states of one thing are compared, what grew in one section does not
    /// move the next.
    pub fn section(&mut self) {
        self.sections.push(self.bytes.len());
    }

    /// Where sections begin, in rising order.
    pub fn sections(&self) -> &[usize] {
        &self.sections
    }

    /// How many bytes were written.
    pub fn len(&self) -> usize {
        self.bytes.len()
    }

    /// Whether nothing was written.
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// What was written.
    pub fn as_slice(&self) -> &[u8] {
        &self.bytes
    }

    /// What was written.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}
