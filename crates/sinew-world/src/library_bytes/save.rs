//! Saving.

use super::{Fault, JOINT, LeftOut, POSE, SHAPE};
use serde::ser::{self, Serialize};
use sinew_snapshot::{Snapshot, SnapshotError, Writer};

/// Appends a value, what is left out left out.
pub(crate) fn save<T: Serialize>(value: &T, left_out: LeftOut<'_>, to: &mut Writer) -> Result<(), SnapshotError> {
    value
        .serialize(&mut Saver { to, left_out: Some(left_out), joints: 0, is_rewritten: false, is_frame2: false })
        .map_err(|fault| fault.0)
}

/// All bytes of a value.
pub(super) fn whole<T: Serialize + ?Sized>(value: &T) -> Result<Vec<u8>, Fault> {
    let mut to = Writer::new();
    value.serialize(&mut Saver { to: &mut to, left_out: None, joints: 0, is_rewritten: false, is_frame2: false })?;
    Ok(to.into_bytes())
}

struct Saver<'a, 'l> {
    to: &'a mut Writer,
    /// `None` where nothing is.
    left_out: Option<LeftOut<'l>>,
    /// Joints that have begun, and whether the present one is written anew in the next step.
    joints: usize,
    is_rewritten: bool,
    /// In the frame of a joint on its second body.
    is_frame2: bool,
}

/// Numbers that stand as they are.
macro_rules! numbers {
    ($($name:ident: $number:ty),* $(,)?) => { $(
        #[inline]
        fn $name(self, value: $number) -> Result<(), Fault> {
            value.save(self.to);
            Ok(())
        }
    )* };
}

impl ser::Serializer for &mut Saver<'_, '_> {
    type Ok = ();
    type Error = Fault;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Self;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    numbers! {
        serialize_bool: bool, serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64, serialize_i128: i128,
        serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64, serialize_u128: u128,
        serialize_f32: f32, serialize_f64: f64,
    }

    fn serialize_char(self, value: char) -> Result<(), Fault> {
        self.serialize_u32(value.into())
    }
    fn serialize_str(self, value: &str) -> Result<(), Fault> {
        self.serialize_bytes(value.as_bytes())
    }
    fn serialize_bytes(self, value: &[u8]) -> Result<(), Fault> {
        self.to.blob(value);
        Ok(())
    }
    fn serialize_none(self) -> Result<(), Fault> {
        self.serialize_bool(false)
    }
    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), Fault> {
        true.save(self.to);
        value.serialize(self)
    }
    fn serialize_unit(self) -> Result<(), Fault> {
        Ok(())
    }
    fn serialize_unit_struct(self, _: &'static str) -> Result<(), Fault> {
        Ok(())
    }
    fn serialize_unit_variant(self, _: &'static str, index: u32, _: &'static str) -> Result<(), Fault> {
        self.variant(index)
    }
    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, name: &'static str, value: &T) -> Result<(), Fault> {
        let Some(LeftOut { poses: Some(poses), .. }) = self.left_out.as_mut().filter(|_| name == POSE) else {
            return value.serialize(self);
        };
        let expected = poses.next().ok_or_else(|| Fault::of("number of colliders"))?;
        let (bytes, expected) = (whole(value)?, whole(&expected)?);
        let is_expected = bytes == expected;
        is_expected.save(self.to);
        if !is_expected {
            self.to.bytes(&bytes);
        }
        Ok(())
    }
    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        name: &'static str,
        index: u32,
        _: &'static str,
        value: &T,
    ) -> Result<(), Fault> {
        if SHAPE.contains(&name) && self.left_out.is_some() {
            return Ok(());
        }
        self.variant(index)?;
        value.serialize(self)
    }
    fn serialize_seq(self, length: Option<usize>) -> Result<Self, Fault> {
        self.to.length(length.ok_or_else(|| Fault::of("list without a length"))?);
        Ok(self)
    }
    fn serialize_tuple(self, _: usize) -> Result<Self, Fault> {
        Ok(self)
    }
    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Self, Fault> {
        Ok(self)
    }
    fn serialize_tuple_variant(self, _: &'static str, index: u32, _: &'static str, _: usize) -> Result<Self, Fault> {
        self.variant(index)?;
        Ok(self)
    }
    fn serialize_map(self, length: Option<usize>) -> Result<Self, Fault> {
        self.serialize_seq(length)
    }
    fn serialize_struct(self, name: &'static str, _: usize) -> Result<Self, Fault> {
        if name == JOINT
            && let Some(left_out) = &self.left_out
        {
            self.is_rewritten = left_out.rewritten_joints.get(self.joints).is_some_and(|rewritten| *rewritten);
            self.joints += 1;
        }
        Ok(self)
    }
    fn serialize_struct_variant(self, _: &'static str, index: u32, _: &'static str, _: usize) -> Result<Self, Fault> {
        self.variant(index)?;
        Ok(self)
    }
    fn is_human_readable(&self) -> bool {
        false
    }
}

impl Saver<'_, '_> {
    /// What stands in the place of a field whose value is found again in the next step: what it is in a new body or joint.
    #[inline]
    fn in_place_of(&mut self, key: &'static str) -> Option<&'static [f64]> {
        let left_out = self.left_out.as_ref()?;
        if left_out.has_bodies {
            return match key {
                "force" | "torque" => Some(&[0.0; 3]),
                "ccd_vels" => Some(&[0.0; 6]),
                _ => None,
            };
        }
        if !self.is_rewritten {
            return None;
        }
        match key {
            "target_vel" | "target_pos" | "stiffness" | "damping" => Some(&[0.0]),
            "local_frame1" | "local_frame2" | "locked_axes" => {
                self.is_frame2 = key == "local_frame2";
                None
            }
            "rotation" if self.is_frame2 => Some(&[0.0, 0.0, 0.0, 1.0]),
            _ => None,
        }
    }

    fn variant(&mut self, index: u32) -> Result<(), Fault> {
        self.to.byte(u8::try_from(index).map_err(|_| Fault::of("variant"))?);
        Ok(())
    }
}

/// What follows a beginning: one element after the other.
macro_rules! elements {
    ($($of:ident: $element:ident),* $(,)?) => { $(
        impl ser::$of for &mut Saver<'_, '_> {
            type Ok = ();
            type Error = Fault;
            #[inline]
            fn $element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Fault> {
                value.serialize(&mut **self)
            }
            fn end(self) -> Result<(), Fault> {
                Ok(())
            }
        }
    )* };
}

elements! {
    SerializeSeq: serialize_element,
    SerializeTuple: serialize_element,
    SerializeTupleStruct: serialize_field,
    SerializeTupleVariant: serialize_field,
}

/// The same with names, which are not in the bytes.
macro_rules! fields {
    ($($of:ident),*) => { $(
        impl ser::$of for &mut Saver<'_, '_> {
            type Ok = ();
            type Error = Fault;
            #[inline]
            fn serialize_field<T: Serialize + ?Sized>(&mut self, key: &'static str, value: &T) -> Result<(), Fault> {
                if let Some(numbers) = self.in_place_of(key) {
                    numbers.iter().for_each(|number| number.save(self.to));
                    return Ok(());
                }
                value.serialize(&mut **self)
            }
            fn end(self) -> Result<(), Fault> {
                Ok(())
            }
        }
    )* };
}

fields!(SerializeStruct, SerializeStructVariant);

impl ser::SerializeMap for &mut Saver<'_, '_> {
    type Ok = ();
    type Error = Fault;
    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Fault> {
        key.serialize(&mut **self)
    }
    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Fault> {
        value.serialize(&mut **self)
    }
    fn end(self) -> Result<(), Fault> {
        Ok(())
    }
}
