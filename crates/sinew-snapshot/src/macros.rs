//! One list of fields for both directions.

/// Implements [`crate::Snapshot`] for a struct or an enum from one list of its fields.
///
/// A struct names its state, and behind `fixed` what is not saved because it does not change while a simulation runs. The list
/// is complete: a field that stands in neither is an error of the compiler.
///
/// ```
/// # use sinew_snapshot::snapshot;
/// struct Filter {
///     cutoff_hz: f64,
///     last: Option<f64>,
/// }
/// snapshot!(Filter { last } fixed { cutoff_hz });
/// ```
///
/// What only some values of the fields can be (an index into a list, a count below a maximum) is checked behind `valid`, so that
/// no bytes can cause a panic later.
///
/// ```
/// # use sinew_snapshot::{Reader, Snapshot, snapshot};
/// struct Ring {
///     values: [f64; 8],
///     next: usize,
/// }
/// snapshot!(Ring { values, next } valid |ring| ring.next < ring.values.len());
/// # let mut ring = Ring { values: [0.0; 8], next: 0 };
/// assert!(ring.restore(&mut Reader::new(&[9; 72])).is_err());
/// ```
///
/// Generic parameters stand in brackets before the type.
///
/// ```
/// # use sinew_snapshot::{Snapshot, snapshot};
/// struct Ramp<T> {
///     from: T,
///     to: T,
/// }
/// snapshot!([T: Snapshot] Ramp<T> { from, to });
/// ```
///
/// An enum names all its variants, each with the number that stands for it in the bytes. Fields of a variant need a `Default`,
/// because restoring may change the variant.
///
/// ```
/// # use sinew_snapshot::snapshot;
/// enum Phase {
///     Idle,
///     Moving { since_secs: f64, from: [f64; 3] },
///     Held(f64),
/// }
/// snapshot!(enum Phase { 0: Idle, 1: Moving { since_secs, from }, 2: Held(secs) });
/// ```
#[macro_export]
macro_rules! snapshot {
    (enum $name:ident { $( $tag:literal : $variant:ident $( { $($field:ident),* $(,)? } )? $( ( $($place:ident),* ) )? ),* $(,)? }) => {
        impl $crate::Snapshot for $name {
            fn save(&self, to: &mut $crate::Writer) {
                match self {
                    $( Self::$variant $( { $($field),* } )? $( ( $($place),* ) )? => {
                        to.byte($tag);
                        $( $( $crate::Snapshot::save($field, to); )* )?
                        $( $( $crate::Snapshot::save($place, to); )* )?
                    } )*
                }
            }
            fn restore(&mut self, from: &mut $crate::Reader<'_>) -> Result<(), $crate::SnapshotError> {
                *self = match from.byte()? {
                    $( $tag => {
                        $( $( let $field = Default::default(); )* )?
                        $( $( let $place = Default::default(); )* )?
                        // What the fields are is known only from the variant; a borrow of it has their types.
                        #[allow(unused_mut, reason = "a variant without fields has nothing to restore")]
                        let mut variant = Self::$variant $( { $($field),* } )? $( ( $($place),* ) )?;
                        #[allow(irrefutable_let_patterns, reason = "an enum of one variant")]
                        if let Self::$variant $( { $($field),* } )? $( ( $($place),* ) )? = &mut variant {
                            $( $( $crate::Snapshot::restore($field, from)?; )* )?
                            $( $( $crate::Snapshot::restore($place, from)?; )* )?
                        }
                        variant
                    } )*
                    _ => return Err($crate::SnapshotError::invalid(concat!("variant of ", stringify!($name)))),
                };
                Ok(())
            }
        }
    };
    (
        [$($generics:tt)*] $type:ty { $($field:ident),* $(,)? }
        $( fixed { $($fixed:ident),* $(,)? } )?
        $( valid $valid:expr )?
    ) => {
        impl<$($generics)*> $crate::Snapshot for $type {
            fn save(&self, to: &mut $crate::Writer) {
                let Self { $($field,)* $( $($fixed: _,)* )? } = self;
                let _ = &to;
                $( $crate::Snapshot::save($field, to); )*
            }
            fn restore(&mut self, from: &mut $crate::Reader<'_>) -> Result<(), $crate::SnapshotError> {
                let Self { $($field,)* $( $($fixed: _,)* )? } = self;
                let _ = &from;
                $( $crate::Snapshot::restore($field, from)?; )*
                $(
                    let is_valid: fn(&Self) -> bool = $valid;
                    if !is_valid(self) {
                        return Err($crate::SnapshotError::invalid(stringify!($type)));
                    }
                )?
                Ok(())
            }
        }
    };
    (
        $type:ty { $($field:ident),* $(,)? }
        $( fixed { $($fixed:ident),* $(,)? } )?
        $( valid $valid:expr )?
    ) => {
        $crate::snapshot!([] $type { $($field),* } $( fixed { $($fixed),* } )? $( valid $valid )?);
    };
}
