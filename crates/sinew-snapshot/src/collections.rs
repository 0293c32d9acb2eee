//! Several values, and values that may be missing.

use crate::{Reader, Snapshot, SnapshotError, Writer};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Elements in place: the number of them must be the same.
impl<T: Snapshot> Snapshot for [T] {
    fn save(&self, to: &mut Writer) {
        to.length(self.len());
        self.iter().for_each(|element| element.save(to));
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let length = from.length()?;
        if length != self.len() {
            return Err(SnapshotError::mismatch(format!("it has {length} where there are {} elements", self.len())));
        }
        self.iter_mut().try_for_each(|element| element.restore(from))
    }
}

impl<T: Snapshot, const N: usize> Snapshot for [T; N] {
    #[inline]
    fn save(&self, to: &mut Writer) {
        self.iter().for_each(|element| element.save(to));
    }
    #[inline]
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.iter_mut().try_for_each(|element| element.restore(from))
    }
}

/// Elements that are there already are restored in place; the vector keeps its capacity.
impl<T: Snapshot + Default> Snapshot for Vec<T> {
    fn save(&self, to: &mut Writer) {
        self.as_slice().save(to);
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let length = from.length()?;
        self.truncate(length);
        self.iter_mut().try_for_each(|element| element.restore(from))?;
        self.reserve(from.capacity::<T>(length - self.len()));
        while self.len() < length {
            self.push(restored(from)?);
        }
        Ok(())
    }
}

impl<T: Snapshot + Default> Snapshot for VecDeque<T> {
    fn save(&self, to: &mut Writer) {
        to.length(self.len());
        self.iter().for_each(|element| element.save(to));
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let length = from.length()?;
        self.clear();
        self.reserve(from.capacity::<T>(length));
        for _ in 0..length {
            self.push_back(restored(from)?);
        }
        Ok(())
    }
}

impl<T: Snapshot + Default> Snapshot for Option<T> {
    fn save(&self, to: &mut Writer) {
        self.is_some().save(to);
        if let Some(value) = self {
            value.save(to);
        }
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let mut is_some = false;
        is_some.restore(from)?;
        if is_some {
            self.get_or_insert_default().restore(from)?;
        } else {
            *self = None;
        }
        Ok(())
    }
}

impl<T: Snapshot + ?Sized> Snapshot for Box<T> {
    fn save(&self, to: &mut Writer) {
        self.as_ref().save(to);
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.as_mut().restore(from)
    }
}

impl<K: Snapshot + Default + Ord, V: Snapshot + Default> Snapshot for BTreeMap<K, V> {
    fn save(&self, to: &mut Writer) {
        to.length(self.len());
        for (key, value) in self {
            key.save(to);
            value.save(to);
        }
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let length = from.length()?;
        let mut old = std::mem::take(self);
        for _ in 0..length {
            let key: K = restored(from)?;
            if self.last_key_value().is_some_and(|(last, _)| *last >= key) {
                return Err(SnapshotError::invalid("order of keys"));
            }
            let mut value = old.remove(&key).unwrap_or_default();
            value.restore(from)?;
            self.insert(key, value);
        }
        Ok(())
    }
}

impl<K: Snapshot + Default + Ord> Snapshot for BTreeSet<K> {
    fn save(&self, to: &mut Writer) {
        to.length(self.len());
        self.iter().for_each(|key| key.save(to));
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let length = from.length()?;
        self.clear();
        for _ in 0..length {
            let key: K = restored(from)?;
            if self.last().is_some_and(|last| *last >= key) {
                return Err(SnapshotError::invalid("order of keys"));
            }
            self.insert(key);
        }
        Ok(())
    }
}

fn restored<T: Snapshot + Default>(from: &mut Reader<'_>) -> Result<T, SnapshotError> {
    let mut value = T::default();
    value.restore(from)?;
    Ok(value)
}

macro_rules! tuples {
    ($(($($name:ident $place:tt),+))*) => { $(
        impl<$($name: Snapshot),+> Snapshot for ($($name,)+) {
            #[inline]
            fn save(&self, to: &mut Writer) {
                $( self.$place.save(to); )+
            }
            #[inline]
            fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
                $( self.$place.restore(from)?; )+
                Ok(())
            }
        }
    )* };
}

tuples! {
    (A 0)
    (A 0, B 1)
    (A 0, B 1, C 2)
    (A 0, B 1, C 2, D 3)
}
