//! Numbers, vectors and text.

use crate::{Reader, Snapshot, SnapshotError, Writer};
use glam::{DMat3, DQuat, DVec2, DVec3};

/// Numbers that stand as their own little-endian bytes.
macro_rules! numbers {
    ($($number:ty),*) => { $(
        impl Snapshot for $number {
            #[inline]
            fn save(&self, to: &mut Writer) {
                to.bytes(&self.to_le_bytes());
            }
            #[inline]
            fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
                *self = <$number>::from_le_bytes(from.array()?);
                Ok(())
            }
        }
    )* };
}

numbers!(u8, u16, u32, u64, u128, i8, i16, i32, i64, i128, f32, f64);

impl Snapshot for usize {
    #[inline]
    fn save(&self, to: &mut Writer) {
        (*self as u64).save(to);
    }
    #[inline]
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let number = u64::from_le_bytes(from.array()?);
        *self = usize::try_from(number).map_err(|_| SnapshotError::invalid("index"))?;
        Ok(())
    }
}

impl Snapshot for bool {
    #[inline]
    fn save(&self, to: &mut Writer) {
        to.byte(u8::from(*self));
    }
    #[inline]
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        *self = match from.byte()? {
            0 => false,
            1 => true,
            _ => return Err(SnapshotError::invalid("bool")),
        };
        Ok(())
    }
}

/// What is an array of `f64` under another name.
macro_rules! vectors {
    ($($vector:ty),*) => { $(
        impl Snapshot for $vector {
            #[inline]
            fn save(&self, to: &mut Writer) {
                self.to_array().save(to);
            }
            #[inline]
            fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
                let mut numbers = self.to_array();
                numbers.restore(from)?;
                *self = <$vector>::from_array(numbers);
                Ok(())
            }
        }
    )* };
}

vectors!(DVec2, DVec3, DQuat);

impl Snapshot for DMat3 {
    #[inline]
    fn save(&self, to: &mut Writer) {
        self.to_cols_array().save(to);
    }
    #[inline]
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let mut numbers = self.to_cols_array();
        numbers.restore(from)?;
        *self = DMat3::from_cols_array(&numbers);
        Ok(())
    }
}

impl Snapshot for String {
    fn save(&self, to: &mut Writer) {
        to.blob(self.as_bytes());
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let text = str::from_utf8(from.blob()?).map_err(|_| SnapshotError::invalid("text"))?;
        self.clear();
        self.push_str(text);
        Ok(())
    }
}
