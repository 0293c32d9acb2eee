//! What is kept of a reacher: its style, its random numbers, and everything that is on its way.

use crate::reacher::Reacher;
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer};

/// All but the body, from which everything else that does not change follows.
impl Snapshot for Reacher {
    fn save(&self, to: &mut Writer) {
        let Reacher {
            frame: _,
            style,
            rng,
            manner,
            now_secs,
            feet,
            twist,
            swing,
            squat,
            lean,
            tiptoe,
            onto_toes,
            reserve,
            heels,
            gaze_weight,
            gaze,
            arms,
            hips,
            trunk,
            knees,
            leg_turns,
            steps,
            outcome,
            goal,
            planned,
            replanned_secs,
            obstacles,
            followed,
            velocity,
        } = self;
        style.save(to);
        (*rng, *now_secs).save(to);
        manner.save(to);
        feet.save(to);
        [*twist, *squat, *tiptoe, *onto_toes, *reserve, *heels].save(to);
        [*swing, *lean, *gaze].save(to);
        gaze_weight.save(to);
        arms.save(to);
        hips.save(to);
        trunk.save(to);
        knees.save(to);
        leg_turns.save(to);
        steps.save(to);
        outcome.save(to);
        [*goal, *planned].save(to);
        replanned_secs.save(to);
        obstacles.save(to);
        followed.save(to);
        velocity.save(to);
    }

    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let mut style = self.style;
        style.restore(from)?;
        self.set_style(&style).map_err(|_| SnapshotError::invalid("style of a reach"))?;
        self.rng.restore(from)?;
        self.now_secs.restore(from)?;
        self.manner.restore(from)?;
        self.feet.restore(from)?;
        for value in [
            &mut self.twist,
            &mut self.squat,
            &mut self.tiptoe,
            &mut self.onto_toes,
            &mut self.reserve,
            &mut self.heels,
        ] {
            value.restore(from)?;
        }
        for value in [&mut self.swing, &mut self.lean, &mut self.gaze] {
            value.restore(from)?;
        }
        self.gaze_weight.restore(from)?;
        self.arms.restore(from)?;
        self.hips.restore(from)?;
        self.trunk.restore(from)?;
        self.knees.restore(from)?;
        self.leg_turns.restore(from)?;
        self.steps.restore(from)?;
        self.outcome.restore(from)?;
        self.goal.restore(from)?;
        self.planned.restore(from)?;
        self.replanned_secs.restore(from)?;
        self.obstacles.restore(from)?;
        self.obstacles.truncate(crate::route::MAX_OBSTACLES);
        self.followed.restore(from)?;
        self.velocity.restore(from)
    }
}
