//! Ids of what is in a world: a slot, and a generation that tells who is in it.
//!
//! An id is a place that is counted: the *slot* is the index in the [`Frame`](crate::Frame)'s lists, the *generation* says how often
//! the slot was used before. What is removed frees its slot; the next thing that is added takes the first free slot with the next
//! generation, so an id that was kept too long (a *stale* id) never means somebody else.
//!
//! A slot map of a library (`slotmap`) was looked at: its slots begin at 1 and its keys are opaque, while here the slot is the
//! place in the frame and slot and generation are part of a snapshot.

use std::fmt;

/// What [`Slots`](crate::Slots) are addressed by: one of the ids of this crate.
pub trait SlotId: Copy + Eq {
    /// The id of a slot and a generation.
    fn of(slot: usize, generation: u32) -> Self;
    /// Its slot and its generation.
    fn place(self) -> (usize, u32);
}

macro_rules! id {
    ($name:ident, $noun:literal, $by:literal) => {
        #[doc = concat!("The id of a ", $noun, ", given by [`World::", $by, "`](crate::World::", $by, ").")]
        ///
        /// Ordered by slot, then generation. Shown as its slot, with the generation behind it when the slot was used before:
        /// `3`, `3.1`.
        /// The default is the first in slot 0.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name {
            slot: u32,
            generation: u32,
        }

        sinew_snapshot::snapshot!($name { slot, generation });

        impl $name {
            /// The id of this slot and generation.
            pub const fn new(slot: usize, generation: u32) -> $name {
                // No world has as many: its frame would not fit into memory.
                $name { slot: slot as u32, generation }
            }

            /// The id of what is put first into a slot. In a world from which nothing was removed, the n-th that was added has
            /// `first_in(n)`, counted from 0.
            pub const fn first_in(slot: usize) -> $name {
                $name::new(slot, 0)
            }

            #[doc = concat!("Its index in lists by ", $noun, ", such as those of the [`Frame`](crate::Frame).")]
            pub const fn slot(self) -> usize {
                self.slot as usize
            }

            /// How often its slot was used before.
            pub const fn generation(self) -> u32 {
                self.generation
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self.generation {
                    0 => write!(f, "{}", self.slot),
                    generation => write!(f, "{}.{generation}", self.slot),
                }
            }
        }

        impl SlotId for $name {
            fn of(slot: usize, generation: u32) -> $name {
                $name::new(slot, generation)
            }

            fn place(self) -> (usize, u32) {
                (self.slot(), self.generation)
            }
        }
    };
}

id!(CharacterId, "character", "add_character");
id!(PropId, "prop", "add_prop");
id!(PropJointId, "joint between props", "add_prop_joint");
