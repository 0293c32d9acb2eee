//! The channels of a joint and where they stand in a row.

use crate::Transform;
use crate::formats::text::{Axis, compose};
use glam::DVec3;

/// What one channel holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Channel {
    /// Position along an axis of the parent \[file unit\].
    Position(Axis),
    /// Rotation about an axis of the turning joint \[deg\].
    Rotation(Axis),
}

impl Channel {
    /// The channel of a name such as `Xposition`, in any case.
    pub(super) fn of(name: &[u8]) -> Option<Channel> {
        let (first, kind) = name.split_first()?;
        let axis = Axis::of(*first)?;
        if kind.eq_ignore_ascii_case(b"position") {
            Some(Channel::Position(axis))
        } else if kind.eq_ignore_ascii_case(b"rotation") {
            Some(Channel::Rotation(axis))
        } else {
            None
        }
    }

    /// The name as files write it.
    pub(super) fn name(self) -> String {
        match self {
            Channel::Position(axis) => format!("{}position", axis.letter()),
            Channel::Rotation(axis) => format!("{}rotation", axis.letter()),
        }
    }
}

/// The channels of one joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Columns {
    /// Column of the first channel; the others follow.
    pub(super) first: usize,
    /// In file order, no two alike.
    pub(super) channels: Vec<Channel>,
}

impl Columns {
    /// Whether the joint has a position channel.
    pub(super) fn moves(&self) -> bool {
        self.channels.iter().any(|channel| matches!(channel, Channel::Position(_)))
    }

    /// The columns of position channels and their axes.
    pub(super) fn positions(&self) -> impl Iterator<Item = (usize, Axis)> + '_ {
        self.channels.iter().enumerate().filter_map(|(index, channel)| match channel {
            Channel::Position(axis) => Some((self.first + index, *axis)),
            Channel::Rotation(_) => None,
        })
    }

    /// The columns of rotation channels and their axes, in the order in which they multiply.
    pub(super) fn rotations(&self) -> impl Iterator<Item = (usize, Axis)> + '_ {
        self.channels.iter().enumerate().filter_map(|(index, channel)| match channel {
            Channel::Rotation(axis) => Some((self.first + index, *axis)),
            Channel::Position(_) => None,
        })
    }

    /// `parent_from_joint` from a row of values: positions replace those of the offset.
    pub(super) fn local(&self, row: &[f64], offset: DVec3) -> Transform {
        let mut translation = offset;
        for (column, axis) in self.positions() {
            translation[axis.index()] = row[column];
        }
        let turns = self.turns(row);
        Transform::new(compose(turns.axes(), turns.degrees()), translation)
    }

    /// The rotation channels' axes with their angles in a row.
    pub(super) fn turns(&self, row: &[f64]) -> Turns {
        let mut turns = Turns { count: 0, axes: [Axis::X; 3], degrees: [0.0; 3] };
        for (column, axis) in self.rotations().take(3) {
            turns.axes[turns.count] = axis;
            turns.degrees[turns.count] = row[column];
            turns.count += 1;
        }
        turns
    }
}

/// Up to three turns about axes.
pub(super) struct Turns {
    count: usize,
    axes: [Axis; 3],
    degrees: [f64; 3],
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
}
