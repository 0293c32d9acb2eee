//! Everything that `sinew-control` is held to, as one program.

mod balance;
mod balance_allocation;
mod basic_poses;
mod graphs;
mod kd_following;
mod kd_free_fall;
mod kd_hits;
mod performer;
mod poses;
mod pushed;
mod response_tracker;
mod snapshots;
mod tracker_allocation;
mod walker;

use sinew_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
