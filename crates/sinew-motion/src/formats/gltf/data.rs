//! Reads numbers from accessors; every bound is checked before a byte is read or allocated.

use super::element;
use super::schema::{Accessor, Root};
use super::uri;
use crate::{Error, Limits};
use std::borrow::Cow;
use std::cell::{Cell, OnceCell};
use std::path::Path;

const BYTE: u32 = 5120;
const UNSIGNED_BYTE: u32 = 5121;
const SHORT: u32 = 5122;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

const DAMAGED: &str = "the file is damaged or its exporter is wrong: export it again";

/// The file's buffers, loaded on first use, and the remaining allowance of bytes and values.
pub(super) struct Data<'a> {
    root: &'a Root,
    bin: Option<&'a [u8]>,
    folder: Option<&'a Path>,
    buffers: Vec<OnceCell<Cow<'a, [u8]>>>,
    /// Bytes that other files may still hold.
    bytes_left: Cell<u64>,
    /// Values that may still be decoded: accessors can overlap, so that a small file could expand to a large one.
    values_left: Cell<usize>,
}

/// The elements of an accessor: its bytes, the distance of elements and their size.
struct Span<'a> {
    bytes: &'a [u8],
    stride: usize,
}

impl<'a> Data<'a> {
    pub fn new(root: &'a Root, bin: Option<&'a [u8]>, folder: Option<&'a Path>, limits: &Limits) -> Data<'a> {
        Data {
            root,
            bin,
            folder,
            buffers: root.buffers.iter().map(|_| OnceCell::new()).collect(),
            bytes_left: Cell::new(limits.file_bytes),
            values_left: Cell::new(limits.values),
        }
    }

    /// The values of a float accessor of this shape (`SCALAR`, `VEC3`, ...), all finite. Normalised integers are
    /// turned into floats where `or_normalized` allows them. `user` names who asks.
    pub fn floats(&self, index: usize, shape: &str, or_normalized: bool, user: &str) -> Result<Vec<f32>, Error> {
        let width = match shape {
            "SCALAR" => 1,
            "VEC3" => 3,
            _ => 4,
        };
        let name = || format!("accessors[{index}]");
        let Some(accessor) = self.root.accessors.get(index) else {
            let problem = format!("accessor {index} does not exist, the file has {}", self.root.accessors.len());
            return Err(element(user, problem, DAMAGED));
        };
        if accessor.shape != shape {
            let problem = format!("type {:?} where {user} needs {shape:?}", accessor.shape);
            return Err(element(name(), problem, DAMAGED));
        }
        let size = match (accessor.component_type, accessor.normalized && or_normalized) {
            (FLOAT, _) => 4,
            (BYTE | UNSIGNED_BYTE, true) => 1,
            (SHORT | UNSIGNED_SHORT, true) => 2,
            (other, _) => {
                let problem = format!("component type {other} where {user} needs floats (5126)");
                return Err(element(name(), problem, DAMAGED));
            }
        };
        let Some(view) = accessor.buffer_view else {
            return Err(element(name(), "no buffer view, so it holds no motion", DAMAGED));
        };
        let span = self.span(view, accessor.byte_offset, accessor.count, size * width, &name())?;
        let count = accessor.count as usize; // the span exists, so it fits
        let Some(left) = count.checked_mul(width).and_then(|values| self.values_left.get().checked_sub(values)) else {
            return Err(element(name(), "more values than a clip may have", "cut the animation into shorter ones"));
        };
        self.values_left.set(left);
        let mut values = Vec::with_capacity(count * width);
        for at in 0..count {
            for component in 0..width {
                values.push(number(&span.bytes[at * span.stride + component * size..], accessor.component_type));
            }
        }
        if accessor.sparse.is_some() {
            self.patch(accessor, &mut values, width, size, &name())?;
        }
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            let problem = format!("element {} is not a finite number", at / width);
            return Err(element(name(), problem, "export again without broken keys"));
        }
        Ok(values)
    }

    /// Applies a sparse accessor's replacements.
    fn patch(&self, accessor: &Accessor, out: &mut [f32], width: usize, size: usize, name: &str) -> Result<(), Error> {
        let Some(sparse) = &accessor.sparse else { return Ok(()) };
        let name = format!("{name}.sparse");
        let index_size = match sparse.indices.component_type {
            UNSIGNED_BYTE => 1,
            UNSIGNED_SHORT => 2,
            UNSIGNED_INT => 4,
            other => return Err(element(name, format!("indices of component type {other}"), DAMAGED)),
        };
        let (indices, values) = (&sparse.indices, &sparse.values);
        let at = self.span(indices.buffer_view, indices.byte_offset, sparse.count, index_size, &name)?;
        let new = self.span(values.buffer_view, values.byte_offset, sparse.count, size * width, &name)?;
        for row in 0..sparse.count as usize {
            let mut word = [0; 4];
            word[..index_size].copy_from_slice(&at.bytes[row * at.stride..][..index_size]);
            let index = u32::from_le_bytes(word) as usize;
            let Some(target) = index.checked_mul(width).and_then(|start| out.get_mut(start..start + width)) else {
                return Err(element(name, format!("index {index} is beyond the accessor's end"), DAMAGED));
            };
            for (component, value) in target.iter_mut().enumerate() {
                *value = number(&new.bytes[row * new.stride + component * size..], accessor.component_type);
            }
        }
        Ok(())
    }

    /// The bytes of `count` elements of `size` bytes in a view, bounds checked.
    fn span(&self, view: usize, offset: u64, count: u64, size: usize, user: &str) -> Result<Span<'_>, Error> {
        let Some(of) = self.root.buffer_views.get(view) else {
            let problem = format!("buffer view {view} does not exist, the file has {}", self.root.buffer_views.len());
            return Err(element(user, problem, DAMAGED));
        };
        let name = format!("bufferViews[{view}]");
        let buffer = self.buffer(of.buffer, &name)?;
        let end = of.byte_offset.checked_add(of.byte_length);
        let Some(end) = end.filter(|&end| end <= buffer.len() as u64) else {
            let problem = format!(
                "bytes {} to {} of a buffer of {} bytes",
                of.byte_offset,
                of.byte_offset.saturating_add(of.byte_length),
                buffer.len()
            );
            return Err(element(name, problem, DAMAGED));
        };
        let bytes = &buffer[of.byte_offset as usize..end as usize];
        let stride = of.byte_stride.unwrap_or(size as u64);
        if stride < size as u64 {
            return Err(element(name, format!("a stride of {stride} bytes for elements of {size}"), DAMAGED));
        }
        if count == 0 {
            return Err(element(user, "no elements", DAMAGED));
        }
        let needed = (count - 1)
            .checked_mul(stride)
            .and_then(|bytes| bytes.checked_add(size as u64))
            .and_then(|bytes| bytes.checked_add(offset));
        if needed.is_none_or(|needed| needed > bytes.len() as u64) {
            let problem =
                format!("{count} elements from byte {offset} do not fit into {name} of {} bytes", bytes.len());
            return Err(element(user, problem, DAMAGED));
        }
        Ok(Span { bytes: &bytes[offset as usize..], stride: stride as usize })
    }

    /// The bytes of a buffer.
    pub fn buffer(&self, index: usize, user: &str) -> Result<&[u8], Error> {
        let (Some(of), Some(cell)) = (self.root.buffers.get(index), self.buffers.get(index)) else {
            let problem = format!("buffer {index} does not exist, the file has {}", self.root.buffers.len());
            return Err(element(user, problem, DAMAGED));
        };
        if let Some(bytes) = cell.get() {
            return Ok(bytes);
        }
        let name = || format!("buffers[{index}]");
        let bytes = match (&of.uri, self.bin) {
            (Some(uri), _) => {
                let bytes = uri::load(uri, self.folder, self.bytes_left.get())
                    .map_err(|(problem, remedy)| element(name(), problem, remedy))?;
                self.bytes_left.set(self.bytes_left.get().saturating_sub(bytes.len() as u64));
                Cow::Owned(bytes)
            }
            (None, Some(bin)) if index == 0 => Cow::Borrowed(bin),
            (None, _) => {
                return Err(element(name(), "neither a URI nor a binary chunk holds its bytes", DAMAGED));
            }
        };
        if of.byte_length > bytes.len() as u64 {
            let problem = format!("says {} bytes, {} are there", of.byte_length, bytes.len());
            return Err(element(name(), problem, "the file is truncated: copy or export it again"));
        }
        let bytes = match bytes {
            Cow::Borrowed(bytes) => Cow::Borrowed(&bytes[..of.byte_length as usize]),
            Cow::Owned(mut bytes) => {
                bytes.truncate(of.byte_length as usize);
                Cow::Owned(bytes)
            }
        };
        Ok(cell.get_or_init(|| bytes))
    }
}

/// One component; the caller has checked that its bytes are there. Integers are normalised as glTF 2.0 section
/// 3.11 says.
fn number(bytes: &[u8], component_type: u32) -> f32 {
    match component_type {
        BYTE => (f32::from(bytes[0] as i8) / 127.0).max(-1.0),
        UNSIGNED_BYTE => f32::from(bytes[0]) / 255.0,
        SHORT => (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])) / 32767.0).max(-1.0),
        UNSIGNED_SHORT => f32::from(u16::from_le_bytes([bytes[0], bytes[1]])) / 65535.0,
        _ => f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
    }
}
