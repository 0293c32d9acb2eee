//! A list whose places are used again.

use crate::id::SlotId;
use std::marker::PhantomData;

/// Values by slot. A value that is removed leaves its slot vacant; the next that is inserted takes the first vacant slot, under
/// the slot's next generation. Two of them to which the same is done give the same ids: so names can be kept beside a
/// [`World`](crate::World).
///
/// ```
/// use sinew_world::{PropId, Slots};
/// let mut names = Slots::<PropId, &str>::new();
/// let ball = names.insert("ball");
/// assert_eq!(names.remove(ball), Some("ball"));
/// let club = names.insert("club");
/// assert_eq!((club.slot(), club.generation()), (0, 1));
/// assert_eq!((names.get(ball), names.get(club)), (None, Some(&"club")));
/// ```
#[derive(Clone, Debug)]
pub struct Slots<I, T> {
    slots: Vec<Slot<T>>,
    ids: PhantomData<I>,
}

#[derive(Clone, Debug)]
struct Slot<T> {
    /// Of the value that is there, or of the next.
    generation: u32,
    value: Option<T>,
}

impl<I: SlotId, T> Slots<I, T> {
    /// Without any slot.
    pub const fn new() -> Slots<I, T> {
        Slots { slots: Vec::new(), ids: PhantomData }
    }

    /// Number of slots, vacant ones too.
    pub fn count(&self) -> usize {
        self.slots.len()
    }

    /// The id that the next value will have.
    pub fn next_id(&self) -> I {
        let slot = self.slots.iter().position(|slot| slot.value.is_none()).unwrap_or(self.slots.len());
        I::of(slot, self.slots.get(slot).map_or(0, |slot| slot.generation))
    }

    /// Puts a value into the first vacant slot.
    pub fn insert(&mut self, value: T) -> I {
        let id = self.next_id();
        let (slot, generation) = id.place();
        let filled = Slot { generation, value: Some(value) };
        match self.slots.get_mut(slot) {
            Some(vacant) => *vacant = filled,
            None => self.slots.push(filled),
        }
        id
    }

    /// Takes a value out; `None` for a stale id.
    pub fn remove(&mut self, id: I) -> Option<T> {
        let (slot, generation) = id.place();
        let slot = self.slots.get_mut(slot).filter(|slot| slot.generation == generation)?;
        let value = slot.value.take()?;
        slot.generation = slot.generation.wrapping_add(1);
        Some(value)
    }

    /// The value of an id; `None` for a stale one.
    pub fn get(&self, id: I) -> Option<&T> {
        let (slot, generation) = id.place();
        self.slots.get(slot).filter(|slot| slot.generation == generation)?.value.as_ref()
    }

    /// The value of an id, to change it; `None` for a stale one.
    pub fn get_mut(&mut self, id: I) -> Option<&mut T> {
        let (slot, generation) = id.place();
        self.slots.get_mut(slot).filter(|slot| slot.generation == generation)?.value.as_mut()
    }

    /// All values with their ids, by slot.
    pub fn iter(&self) -> impl Iterator<Item = (I, &T)> {
        let slots = self.slots.iter().enumerate();
        slots.filter_map(|(at, slot)| Some((I::of(at, slot.generation), slot.value.as_ref()?)))
    }

    /// All values, by slot.
    pub fn values(&self) -> impl Iterator<Item = &T> {
        self.slots.iter().filter_map(|slot| slot.value.as_ref())
    }

    /// All values, by slot, to change.
    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.slots.iter_mut().filter_map(|slot| slot.value.as_mut())
    }

    /// Generation of each slot, and whether it is vacant.
    pub fn places(&self) -> impl Iterator<Item = (u32, bool)> {
        self.slots.iter().map(|slot| (slot.generation, slot.value.is_none()))
    }

    /// Vacates a slot for the value of a generation, or keeps the value that is there. False when it has another.
    pub fn set_place(&mut self, slot: usize, generation: u32, is_vacant: bool) -> bool {
        let Some(slot) = self.slots.get_mut(slot) else { return false };
        if is_vacant {
            *slot = Slot { generation, value: None };
        }
        slot.generation == generation && slot.value.is_none() == is_vacant
    }

    /// Who is in a slot.
    pub fn id_in(&self, slot: usize) -> Option<I> {
        let found = self.slots.get(slot)?;
        found.value.is_some().then(|| I::of(slot, found.generation))
    }
}

impl<I: SlotId, T> Default for Slots<I, T> {
    fn default() -> Slots<I, T> {
        Slots::new()
    }
}

#[cfg(test)]
mod tests {
    use super::Slots;
    use crate::PropId;

    #[test]
    fn a_slot_is_used_again_and_the_old_id_means_nobody() {
        let mut slots = Slots::<PropId, &str>::new();
        let (one, other) = (slots.insert("one"), slots.insert("other"));
        assert_eq!((one, other), (PropId::first_in(0), PropId::first_in(1)));
        assert_eq!(slots.remove(one), Some("one"));
        assert_eq!(slots.remove(one), None);
        assert_eq!((slots.id_in(0), slots.count(), slots.iter().count()), (None, 2, 1));
        let again = slots.insert("again");
        assert_eq!(again, PropId::new(0, 1));
        assert_eq!((slots.get(one), slots.get(again), slots.get(other)), (None, Some(&"again"), Some(&"other")));
        assert_eq!(format!("{one} {again}"), "0 0.1");
    }
}
