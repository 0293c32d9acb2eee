//! What is kept of a character.

use crate::Solid;
use crate::character::{Character, Hold};
use crate::extra_shape::ExtraShape;
use crate::snapshot::{Handle, handles};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::Node;
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer, snapshot};

snapshot!(enum Hold { 0: Free, 1: Drifting, 2: Told });

/// Its joints' handles are those with which it was built; its shapes are kept by [`Character::save_shapes`].
impl Snapshot for Character {
    fn save(&self, to: &mut Writer) {
        let Character {
            spec: _,
            bodies: _,
            colliders: _,
            joints: _,
            drives,
            pins,
            holds,
            outboard: _,
            gravity_scales,
            planes,
            warm_starts,
            extra_shapes: _,
            solids: _,
            pushes,
            // It is found at the beginning of a step and read at its end.
            before: _,
            reaction_body,
            stays_awake,
        } = self;
        drives.save(to);
        pins.save(to);
        holds.save(to);
        gravity_scales.save(to);
        to.length(planes.len());
        planes.iter().for_each(|handle| handle.save_to(to));
        warm_starts.save(to);
        pushes.save(to);
        reaction_body.save(to);
        stays_awake.save(to);
    }

    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.drives.restore(from)?;
        self.pins.restore(from)?;
        self.holds.restore(from)?;
        self.gravity_scales.restore(from)?;
        self.planes = handles::<ImpulseJointHandle>(from)?;
        self.warm_starts.restore(from)?;
        self.pushes.restore(from)?;
        self.reaction_body.restore(from)?;
        self.stays_awake.restore(from)
    }
}

impl Character {
    /// Shapes that are not its body's own: from them the colliders are made before the rest is restored.
    pub fn save_shapes(&self, to: &mut Writer) {
        self.solids.each_ref().map(Option::is_some).save(to);
        self.solids.iter().flatten().for_each(|solid| solid.save(to));
        to.length(self.extra_shapes.len());
        for extra in &self.extra_shapes {
            extra.node.save(to);
            extra.name.save(to);
            extra.collider.save_to(to);
            extra.solid.save(to);
        }
    }

    pub fn restore_shapes(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let mut has_other = [false; Node::COUNT];
        has_other.restore(from)?;
        for (solid, has_other) in self.solids.iter_mut().zip(has_other) {
            *solid = has_other.then(|| restored(from)).transpose()?;
        }
        self.extra_shapes.clear();
        for _ in 0..from.length()? {
            let (mut node, mut name) = (Node::Hips, String::new());
            node.restore(from)?;
            name.restore(from)?;
            let collider = ColliderHandle::restored(from)?;
            self.extra_shapes.push(ExtraShape { node, name, collider, solid: restored(from)? });
        }
        Ok(())
    }
}

fn restored(from: &mut Reader<'_>) -> Result<Solid, SnapshotError> {
    let mut solid = Solid::default();
    solid.restore(from)?;
    if crate::sanitize::is_solid(&solid) { Ok(solid) } else { Err(SnapshotError::invalid("shape of a part")) }
}
