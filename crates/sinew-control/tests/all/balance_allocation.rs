//! A step of the balance reflex allocates nothing: a counting allocator says so.

use crate::pushed::{Place, Push, STRIDE, Standing};
use sinew_body::humanoid::Body;
use sinew_control::reflex::{BalanceSettings, Reflex, Sense};
use sinew_testkit::allocations;
use sinew_world::CharacterId;
#[test]
fn a_step_of_the_balance_reflex_allocates_nothing() {
    let mut standing = Standing::new(Body::standard(80.0, 1.7), STRIDE, BalanceSettings::default());
    let push = Push { azimuth_deg: 30.0, impulse_n_s: 30.0, for_secs: 0.1, place: Place::Centre };
    let mut count = 0;
    for _ in 0..240 * 4 {
        standing.step(Some(&push));
        let sense = Sense {
            frame: standing.world.frame(),
            own: CharacterId::first_in(0),
            body: &standing.body,
            gains: standing.tracker.gains(),
            step_secs: 1.0 / 240.0,
            gravity_m_s2: 9.81,
        };
        count += allocations(|| standing.reflex.step(&sense, &mut standing.target)).1;
    }
    assert_eq!(count, 0);
}
