//! Numbers into buffers: each array becomes a view and an accessor behind those that are there.

use serde_json::{Value, json};

pub(super) const ARRAY_BUFFER: u32 = 34_962;
pub(super) const ELEMENT_ARRAY_BUFFER: u32 = 34_963;
const UNSIGNED_BYTE: u32 = 5121;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// A buffer that grows, with the views and accessors of what was added.
#[derive(Debug, Default)]
pub(super) struct Append {
    /// The buffer, old bytes first.
    pub bytes: Vec<u8>,
    /// Index of the buffer.
    pub buffer: usize,
    /// How many views and accessors the file has already.
    pub views_before: usize,
    pub accessors_before: usize,
    /// What was added.
    pub views: Vec<Value>,
    pub accessors: Vec<Value>,
}

impl Append {
    /// Adds floats, `shape` being `SCALAR`, `VEC3`, `VEC4` or `MAT4`, and returns the accessor's index. Times and
    /// positions must state their bounds (glTF 2.0 sections 3.7.2.1 and 3.11).
    pub fn floats(&mut self, shape: &str, values: &[f32], bounds: bool, target: Option<u32>) -> usize {
        let width = width(shape);
        let bytes = values.iter().flat_map(|value| value.to_le_bytes());
        let mut accessor = self.view(bytes, FLOAT, shape, values.len() / width, target);
        if bounds {
            let bound = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
                let mut rows = values.chunks_exact(width);
                let first = rows.next().unwrap_or_default().to_vec();
                rows.fold(first, |bound, row| bound.iter().zip(row).map(|(&a, &b)| pick(a, b)).collect())
            };
            accessor["min"] = json!(bound(f32::min));
            accessor["max"] = json!(bound(f32::max));
        }
        self.accessor(accessor)
    }

    /// Adds indices, two bytes each where they fit.
    pub fn indices(&mut self, values: &[u32]) -> usize {
        let accessor = if values.iter().all(|&index| index < u32::from(u16::MAX)) {
            let bytes = values.iter().flat_map(|&index| (index as u16).to_le_bytes());
            self.view(bytes, UNSIGNED_SHORT, "SCALAR", values.len(), Some(ELEMENT_ARRAY_BUFFER))
        } else {
            let bytes = values.iter().flat_map(|index| index.to_le_bytes());
            self.view(bytes, UNSIGNED_INT, "SCALAR", values.len(), Some(ELEMENT_ARRAY_BUFFER))
        };
        self.accessor(accessor)
    }

    /// Adds joint numbers of skinned vertices, one joint each.
    pub fn joints(&mut self, joints: &[u16]) -> usize {
        let bytes = joints.iter().flat_map(|joint| {
            let [low, high] = joint.to_le_bytes();
            [low, high, 0, 0, 0, 0, 0, 0]
        });
        let accessor = self.view(bytes, UNSIGNED_SHORT, "VEC4", joints.len(), Some(ARRAY_BUFFER));
        self.accessor(accessor)
    }

    /// Adds the weights that go with one joint per vertex.
    pub fn whole_weights(&mut self, count: usize) -> usize {
        let bytes = (0..count).flat_map(|_| [255, 0, 0, 0]);
        let mut accessor = self.view(bytes, UNSIGNED_BYTE, "VEC4", count, Some(ARRAY_BUFFER));
        accessor["normalized"] = json!(true);
        self.accessor(accessor)
    }

    fn view(
        &mut self,
        bytes: impl Iterator<Item = u8>,
        component_type: u32,
        shape: &str,
        count: usize,
        target: Option<u32>,
    ) -> Value {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = json!({ "buffer": self.buffer, "byteOffset": offset, "byteLength": self.bytes.len() - offset });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        let index = self.views_before + self.views.len() - 1;
        json!({ "bufferView": index, "componentType": component_type, "count": count, "type": shape })
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors_before + self.accessors.len() - 1
    }
}

fn width(shape: &str) -> usize {
    match shape {
        "SCALAR" => 1,
        "VEC3" => 3,
        "VEC4" => 4,
        _ => 16,
    }
}
