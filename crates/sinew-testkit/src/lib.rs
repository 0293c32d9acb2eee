//! What the tests of several crates share: a counting allocator, the finder of captured motion, and work on all cores. Only ever a
//! development dependency.

mod allocation;
mod captured;
mod work;

pub use allocation::{CountingAllocator, allocations};
pub use captured::{EVERY_CLIP, WALKS, capture, every_bvh, mocap, repository, shared};
pub use work::{none_of, work};
