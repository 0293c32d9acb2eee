//! Loading.

use super::{Fault, POSE, SHAPE, save};
use rapier3d_f64::prelude::{Pose, SharedShape};
use serde::de::{self, Deserialize, DeserializeSeed, IntoDeserializer, Visitor};
use sinew_snapshot::{Reader, Snapshot, SnapshotError};

/// Loads what [`super::save()`] appended. `colliders` gives the collision shapes that are not in the bytes, one after the other, and
/// where the colliders are expected.
pub(crate) fn load<T: for<'de> Deserialize<'de>>(
    from: &mut Reader<'_>,
    colliders: &mut Colliders<'_>,
) -> Result<T, SnapshotError> {
    T::deserialize(&mut Loader { from, colliders: Some(colliders) }).map_err(|fault| fault.0)
}

/// What of colliders is not in the bytes.
pub(crate) struct Colliders<'a> {
    pub shapes: &'a mut dyn Iterator<Item = SharedShape>,
    pub poses: &'a mut dyn Iterator<Item = Pose>,
}

struct Loader<'a, 'b, 's, 'c> {
    from: &'a mut Reader<'b>,
    /// `None` inside of a value whose bytes are whole.
    colliders: Option<&'s mut Colliders<'c>>,
}

impl Loader<'_, '_, '_, '_> {
    fn value<T: Snapshot + Default>(&mut self) -> Result<T, Fault> {
        let mut value = T::default();
        value.restore(self.from)?;
        Ok(value)
    }
}

/// Numbers that stand as they are.
macro_rules! numbers {
    ($($name:ident: $visit:ident),* $(,)?) => { $(
        #[inline]
        fn $name<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
            let value = self.value()?;
            visitor.$visit(value)
        }
    )* };
}

impl<'de> de::Deserializer<'de> for &mut Loader<'_, '_, '_, '_> {
    type Error = Fault;

    numbers! {
        deserialize_bool: visit_bool, deserialize_i8: visit_i8, deserialize_i16: visit_i16, deserialize_i32: visit_i32,
        deserialize_i64: visit_i64, deserialize_i128: visit_i128, deserialize_u8: visit_u8, deserialize_u16: visit_u16,
        deserialize_u32: visit_u32, deserialize_u64: visit_u64, deserialize_u128: visit_u128, deserialize_f32: visit_f32,
        deserialize_f64: visit_f64, deserialize_string: visit_string,
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Fault> {
        Err(Fault::of("value without a type"))
    }
    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_any(visitor)
    }
    fn deserialize_identifier<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_any(visitor)
    }
    fn deserialize_char<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let value = char::from_u32(self.value()?).ok_or_else(|| Fault::of("character"))?;
        visitor.visit_char(value)
    }
    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_string(visitor)
    }
    fn deserialize_bytes<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_bytes(self.from.blob()?)
    }
    fn deserialize_byte_buf<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_bytes(visitor)
    }
    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        if self.value()? { visitor.visit_some(self) } else { visitor.visit_none() }
    }
    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_unit()
    }
    fn deserialize_unit_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_unit()
    }
    fn deserialize_newtype_struct<V: Visitor<'de>>(self, name: &'static str, visitor: V) -> Result<V::Value, Fault> {
        let Some(colliders) = self.colliders.as_mut().filter(|_| name == POSE) else {
            return visitor.visit_newtype_struct(self);
        };
        let expected = colliders.poses.next().ok_or_else(|| Fault::of("number of colliders"))?;
        if !self.value::<bool>()? {
            return visitor.visit_newtype_struct(self);
        }
        let bytes = save::whole(&expected)?;
        visitor.visit_newtype_struct(&mut Loader { from: &mut Reader::new(&bytes), colliders: None })
    }
    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let left = self.from.length()?;
        visitor.visit_seq(Elements { loader: self, left })
    }
    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_seq(Elements { loader: self, left: length })
    }
    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.deserialize_tuple(length, visitor)
    }
    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let left = self.from.length()?;
        visitor.visit_map(Elements { loader: self, left })
    }
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.deserialize_tuple(fields.len(), visitor)
    }
    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let Some(colliders) = self.colliders.as_mut().filter(|_| SHAPE.contains(&name)) else {
            return visitor.visit_enum(self);
        };
        let shape = colliders.shapes.next().ok_or_else(|| Fault::of("number of collision shapes"))?;
        let bytes = save::whole(&shape)?;
        visitor.visit_enum(&mut Loader { from: &mut Reader::new(&bytes), colliders: None })
    }
    fn is_human_readable(&self) -> bool {
        false
    }
}

/// Elements that follow each other.
struct Elements<'l, 'a, 'b, 's, 'c> {
    loader: &'l mut Loader<'a, 'b, 's, 'c>,
    left: usize,
}

impl<'de> de::SeqAccess<'de> for Elements<'_, '_, '_, '_, '_> {
    type Error = Fault;
    #[inline]
    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        if self.left == 0 {
            return Ok(None);
        }
        self.left -= 1;
        seed.deserialize(&mut *self.loader).map(Some)
    }
    fn size_hint(&self) -> Option<usize> {
        Some(self.left)
    }
}

impl<'de> de::MapAccess<'de> for Elements<'_, '_, '_, '_, '_> {
    type Error = Fault;
    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        de::SeqAccess::next_element_seed(self, seed)
    }
    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Fault> {
        seed.deserialize(&mut *self.loader)
    }
    fn size_hint(&self) -> Option<usize> {
        Some(self.left)
    }
}

impl<'de> de::EnumAccess<'de> for &mut Loader<'_, '_, '_, '_> {
    type Error = Fault;
    type Variant = Self;
    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Fault> {
        let index = u32::from(self.from.byte()?);
        let value = seed.deserialize(IntoDeserializer::<Fault>::into_deserializer(index))?;
        Ok((value, self))
    }
}

impl<'de> de::VariantAccess<'de> for &mut Loader<'_, '_, '_, '_> {
    type Error = Fault;
    fn unit_variant(self) -> Result<(), Fault> {
        Ok(())
    }
    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Fault> {
        seed.deserialize(self)
    }
    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        de::Deserializer::deserialize_tuple(self, length, visitor)
    }
    fn struct_variant<V: Visitor<'de>>(self, fields: &'static [&'static str], visitor: V) -> Result<V::Value, Fault> {
        de::Deserializer::deserialize_tuple(self, fields.len(), visitor)
    }
}
