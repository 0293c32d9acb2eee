//! Everything that `sinew-body` is held to, as one program.

mod dynamics_agreement;
mod dynamics_allocation;
mod dynamics_common;
mod dynamics_lanes;
mod dynamics_vectors;
mod grounding;
#[path = "../../src/humanoid/limb/limb_random.rs"]
mod limb_random;
mod limb_targets;
mod sample_files;
mod soles;
mod walk;
mod walk_table;

use sinew_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
