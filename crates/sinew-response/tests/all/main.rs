//! Everything that `sinew-response` is held to, as one program.

mod claims_arms;
mod claims_compliance;
mod claims_input;
mod claims_legs;
mod claims_live;
mod claims_noise;
mod claims_presets;
mod claims_recovery;
mod claims_swing;
mod noisy;
mod pushing;
mod seen;
mod snapshots;
mod steps;

use sinew_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
