//! The degrees of freedom of a bone, and the transform that its values make.

use crate::Transform;
use crate::formats::text::{Axis, compose};
use glam::{DQuat, DVec3};

/// One value of a bone's line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dof {
    /// Shift along an axis \[file unit\].
    Shift(Axis),
    /// Turn about a fixed axis \[deg or rad\].
    Turn(Axis),
    /// Stretch of the bone: read and ignored.
    Length,
}

impl Dof {
    /// The degree of freedom of a word such as `rx`, in any case.
    pub(super) fn of(word: &[u8]) -> Option<Dof> {
        match word {
            [b'l' | b'L'] => Some(Dof::Length),
            [b't' | b'T', axis] => Axis::of(*axis).map(Dof::Shift),
            [b'r' | b'R', axis] => Axis::of(*axis).map(Dof::Turn),
            _ => None,
        }
    }
}

/// A bone with its values, apart from the [`Joint`](crate::Joint) that it becomes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bone {
    /// As it stands in the files.
    pub(super) name: String,
    /// `C`: its axes, in those of the file.
    pub(super) axes: DQuat,
    /// What its line in a frame holds.
    pub(super) dof: Vec<Dof>,
    /// Whether shifts are positions in the parent (the root's) or added to the rest along `C`.
    pub(super) is_root: bool,
}

impl Bone {
    /// Whether the joint's translation is animated.
    pub(super) fn moves(&self) -> bool {
        self.dof.iter().any(|dof| matches!(dof, Dof::Shift(_)))
    }

    /// `parent_from_joint` from the values of a line.
    pub(super) fn local(&self, values: &[f64], degrees: bool, rest: DVec3) -> Transform {
        let turns = self.turns(values, degrees);
        let turn = compose(turns.axes(), turns.degrees());
        let mut shift = if self.is_root { rest } else { DVec3::ZERO };
        for (dof, value) in self.dof.iter().zip(values) {
            if let Dof::Shift(axis) = dof {
                shift[axis.index()] = *value;
            }
        }
        let translation = if self.is_root { shift } else { rest + self.axes * shift };
        Transform::new(self.axes * turn * self.axes.conjugate(), translation)
    }

    /// The shift whose values make this translation.
    pub(super) fn shift(&self, translation: DVec3, rest: DVec3) -> DVec3 {
        if self.is_root { translation } else { self.axes.conjugate() * (translation - rest) }
    }

    /// `M` of a joint's rotation.
    pub(super) fn turn(&self, rotation: DQuat) -> DQuat {
        self.axes.conjugate() * rotation * self.axes
    }

    /// The turns of a line, outermost (listed last) first.
    pub(super) fn turns(&self, values: &[f64], degrees: bool) -> Turns {
        let mut turns = Turns { count: 0, axes: [Axis::X; 3], degrees: [0.0; 3], values: [0; 3] };
        for (index, dof) in self.dof.iter().enumerate().rev() {
            if let Dof::Turn(axis) = dof
                && turns.count < 3
            {
                turns.axes[turns.count] = *axis;
                turns.degrees[turns.count] = if degrees { values[index] } else { values[index].to_degrees() };
                turns.values[turns.count] = index;
                turns.count += 1;
            }
        }
        turns
    }
}

/// Up to three turns.
pub(super) struct Turns {
    count: usize,
    axes: [Axis; 3],
    degrees: [f64; 3],
    values: [usize; 3],
}

impl Turns {
    /// The axes, outermost first.
    pub(super) fn axes(&self) -> &[Axis] {
        &self.axes[..self.count]
    }

    /// The angles \[deg\].
    pub(super) fn degrees(&self) -> &[f64] {
        &self.degrees[..self.count]
    }

    /// Which values of the line they are.
    pub(super) fn values(&self) -> &[usize] {
        &self.values[..self.count]
    }
}
