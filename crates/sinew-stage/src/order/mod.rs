//! Commands, understood: names are ids of what is on the stage, numbers lie in their ranges, and what concerns a character is
//! apart from what concerns the stage.
//!
//! A [`Command`] is the text form, in scenes, keys, takes, scripts and the network. [`Resolver::resolve`] makes an [`Order`] of it,
//! once, and is the only door: what passes it names what exists. [`Stage::apply`](crate::Stage) then can only fail on how
//! the stage is now. [`Order::to_command`] is the way back, so that an order can stand in a take.
//!
//! ```
//! use sinew_control::{Action, Command, OrderErrorKind};
//! use sinew_stage::order::{CharacterOrder, Order};
//! use sinew_stage::{Scene, Stage};
//! let stage = Stage::new(Scene::from_text("format = 1\n[characters.one]")?, None)?;
//! let softer = Command::to("one", Action::Gain { factor: 0.5, part: None });
//! let order = stage.resolve(&softer)?;
//! assert!(matches!(order, Order::Character { order: CharacterOrder::Gain { factor: 0.5, .. }, .. }));
//! assert_eq!(order.to_command(stage.cast()), softer);
//! let absurd = Command::to("one", Action::Gain { factor: 1e30, part: None });
//! assert_eq!(stage.resolve(&absurd).unwrap_err().kind(), OrderErrorKind::OutOfRange);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Command`]: sinew_control::Command

mod character_order;
mod resolve;
mod resolve_character;
mod resolve_stage;
mod snapshot;
mod stage_order;
mod text;
mod undo;

pub use character_order::{CharacterOrder, KdChange, ShapeChoice};
pub use resolve::Resolver;
pub(crate) use resolve::one_of;
pub(crate) use resolve_character::FADE_SECS;
pub use stage_order::StageOrder;
pub use undo::Undo;

use crate::Cast;
use sinew_body::humanoid::Node;
use sinew_world::{CharacterId, Entity, PropId, PropJointId};

/// A command whose names and numbers are known to be good.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// For one character.
    Character {
        /// Which.
        id: CharacterId,
        /// What it is to do.
        order: CharacterOrder,
    },
    /// For the stage, its props, joints and controllers.
    Stage(StageOrder),
}

impl Order {
    /// What it names that is not there any more; `None` when all is.
    pub(crate) fn stale(&self, cast: &Cast) -> Option<String> {
        let gone = |entity: Entity| (!cast.has(entity)).then_some(entity);
        let prop = |prop: PropId| gone(Entity::Prop(prop)).map(|_| format!("prop {prop}"));
        let entity = |one: Entity| match one {
            Entity::Prop(id) => prop(id),
            Entity::Part(id, _) => gone(one).map(|_| format!("character {id}")),
            Entity::Floor => None,
        };
        let joint = |joint: PropJointId| (!cast.has_joint(joint)).then(|| format!("joint {joint}"));
        match self {
            Order::Character { id, order } => entity(Entity::Part(*id, Node::Hips)).or_else(|| match order {
                CharacterOrder::Attach { object: Some(object), .. }
                | CharacterOrder::Detach { object: Some(object), .. } => entity(*object),
                CharacterOrder::Reach(order) => order.object.iter().chain(&order.avoid).find_map(|id| prop(*id)),
                _ => None,
            }),
            Order::Stage(order) => match order {
                StageOrder::PlaceProp { prop: id, .. }
                | StageOrder::AccelerateProp { prop: id, .. }
                | StageOrder::PushProp { prop: id, .. }
                | StageOrder::PropGravity { prop: id, .. } => prop(*id),
                StageOrder::Motor { joint: id, .. } | StageOrder::CutJoint { joint: id } => joint(*id),
                StageOrder::Reload { .. } | StageOrder::ScriptKilled { .. } | StageOrder::Say { .. } => None,
            },
        }
    }

    /// Whether two orders set the same thing, to whatever value: the newer one then replaces the older.
    pub(crate) fn sets_the_same(&self, other: &Order) -> bool {
        match (self, other) {
            (Order::Character { id: a, order: one }, Order::Character { id: b, order: two }) => {
                a == b && one.sets_the_same(two)
            }
            (Order::Stage(one), Order::Stage(two)) => one.sets_the_same(two),
            _ => false,
        }
    }
}
