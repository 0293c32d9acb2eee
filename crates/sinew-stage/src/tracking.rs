//! From what actors want to what their bodies do.

use crate::Stage;
use crate::scene::TrackerKind;
use sinew_body::humanoid::{Node, Pose};
use sinew_control::graph::Cause;

impl Stage {
    /// Every actor decides, and its tracker tells the world.
    pub(crate) fn step_actors(&mut self) {
        let gravity = self.world.settings().gravity_m_s2;
        for index in 0..self.actors.len() {
            if let Some((cause, effect)) = self.actors[index].decide(&self.world, gravity) {
                let name = &self.cast.characters()[index];
                let effect = format!("{name}: {effect}");
                let cause = match cause {
                    Cause::Touch(touch) => format!(
                        "{} touches {} with {:.2} N s",
                        self.cast.name_of(touch.a),
                        self.cast.name_of(touch.b),
                        touch.impulse.length()
                    ),
                    other => other.to_string(),
                };
                self.note(cause, effect);
            }
            self.track(index);
        }
    }

    fn track(&mut self, index: usize) {
        let actor = &self.actors[index];
        match actor.tracker {
            TrackerKind::Pd => actor.pd.apply(&mut self.world, index, actor.target()),
            TrackerKind::Kinematic => {
                let target = actor.target();
                let frame = &self.world.frame().characters[index];
                let mut locals = target.joints.map(|joint| joint.rotation);
                let (hips, rotation) = target.root.unwrap_or((frame.parts[0].position, frame.parts[0].rotation));
                locals[0] = rotation;
                let pose = Pose::from_locals(hips, &locals);
                let Some(body) = self.world.body(index) else { return };
                let positions = pose.positions(body);
                for node in Node::ALL {
                    self.world.move_part(index, node, positions[node.index()], pose.world[node.index()]);
                }
            }
            TrackerKind::Response | TrackerKind::None => {}
        }
    }

    /// Follows with another tracker from the next step on, from where the body is now.
    pub(crate) fn set_tracker(&mut self, index: usize, kind: TrackerKind) -> Result<(), String> {
        let before = self.actors[index].tracker;
        if before == TrackerKind::Kinematic && kind != before {
            for node in Node::ALL {
                self.world.set_forces(index, node, true);
            }
        }
        if kind == TrackerKind::None || kind == TrackerKind::Response {
            self.world.set_limp(index);
        }
        if kind != before && kind == TrackerKind::Pd {
            self.actors[index].take_over(&self.world);
        }
        self.actors[index].tracker = kind;
        Ok(())
    }
}
