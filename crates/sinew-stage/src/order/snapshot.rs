//! Orders in a snapshot.

use super::{CharacterOrder, KdChange, Order, ShapeChoice, StageOrder};
use sinew_snapshot::snapshot;

/// Says nothing; for reading one.
impl Default for Order {
    fn default() -> Order {
        Order::Stage(StageOrder::default())
    }
}

/// Says nothing; for reading one.
impl Default for StageOrder {
    fn default() -> StageOrder {
        StageOrder::Say { text: String::new() }
    }
}

/// Says nothing; for reading one.
impl Default for CharacterOrder {
    fn default() -> CharacterOrder {
        CharacterOrder::Say { text: String::new() }
    }
}

snapshot!(enum Order { 0: Character { id, order }, 1: Stage(order) });
snapshot!(enum ShapeChoice { 0: Own, 1: None, 2: Named(name) });
snapshot!(KdChange { preset, k_p, d_p, k_q, d_q, damping, feed_forward });

snapshot!(enum CharacterOrder {
    0: Pose { name },
    1: Graph { name, state },
    2: Signal { name },
    3: LimbReach { node, target },
    4: LimbRelease { node },
    5: Attach { node, object, soft, break_force_n },
    6: Detach { node, object },
    7: Push { node, force, facing, at, for_secs },
    8: Gain { node, factor },
    9: ForcesOff { nodes, for_secs },
    10: ForcesOn { nodes },
    11: Plane { facing_deg, for_secs },
    12: PlaneOff,
    13: Gravity { node, scale, over_secs, for_secs },
    14: Shape { node, shape, for_secs },
    15: AddShape { node, shape, for_secs },
    16: RemoveShape { node, shape },
    17: Layer { layer, on },
    18: Reflex { name, on },
    19: Controller { name },
    20: Weights { nodes, pin, joint, fade_secs, for_secs },
    21: Kd { change, fade_secs, for_secs },
    22: Pins { on, fade_secs, for_secs },
    23: Tracker(kind),
    24: Perform(sample),
    25: Live { on },
    26: Source(source),
    27: Reach(order),
    28: ReachEnd,
    29: Say { text },
});

snapshot!(enum StageOrder {
    0: PlaceProp { prop, position, velocity },
    1: AccelerateProp { prop, acceleration, for_secs },
    2: PushProp { prop, force, at, for_secs },
    3: PropGravity { prop, scale, over_secs, for_secs },
    4: Motor { joint, aim },
    5: CutJoint { joint },
    6: Reload { controller, text },
    7: ScriptKilled { controller, reason },
    8: Say { text },
});
