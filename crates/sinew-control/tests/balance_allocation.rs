//! A step of the balance reflex allocates nothing: a counting allocator says so.
#![allow(unsafe_code, reason = "a global allocator is unsafe to implement; it only counts and passes on")]

mod pushed;

use pushed::{Place, Push, STRIDE, Standing};
use sinew_body::humanoid::Body;
use sinew_control::reflex::{BalanceSettings, Reflex, Sense};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_step_of_the_balance_reflex_allocates_nothing() {
    let mut standing = Standing::new(Body::standard(80.0, 1.7), STRIDE, BalanceSettings::default());
    let push = Push { azimuth_deg: 30.0, impulse_n_s: 30.0, for_secs: 0.1, place: Place::Centre };
    let mut count = 0;
    for _ in 0..240 * 4 {
        standing.step(Some(&push));
        let sense = Sense {
            frame: standing.world.frame(),
            own: 0,
            body: &standing.body,
            gains: standing.tracker.gains(),
            step_secs: 1.0 / 240.0,
            gravity_m_s2: 9.81,
        };
        let before = COUNT.with(Cell::get);
        standing.reflex.step(&sense, &mut standing.target);
        count += COUNT.with(Cell::get) - before;
    }
    assert_eq!(count, 0);
}
