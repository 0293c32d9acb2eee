//! An allocator that counts, for the claim that a step allocates nothing.
#![allow(unsafe_code, reason = "a global allocator is unsafe to implement; it only counts and passes on")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

/// The system's allocator, which also counts the allocations of each thread. A test program installs it with
/// `#[global_allocator]`; tests on other threads do not disturb the count.
#[derive(Debug)]
pub struct CountingAllocator;

unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

/// What some work returns, and how often this thread allocated in it.
///
/// ```
/// use sinew_testkit::{CountingAllocator, allocations};
///
/// #[global_allocator]
/// static ALLOCATOR: CountingAllocator = CountingAllocator;
///
/// let (list, count) = allocations(|| vec![0_u8; 64]);
/// assert_eq!((list.len(), count), (64, 1));
/// ```
///
/// # Panics
/// When the program has not installed [`CountingAllocator`]: a counter that never counts would prove anything.
pub fn allocations<T>(work: impl FnOnce() -> T) -> (T, u64) {
    let count = || COUNT.with(Cell::get);
    let before = count();
    drop(std::hint::black_box(Box::new(0_u8)));
    let start = count();
    assert_eq!(start - before, 1, "the test program must declare CountingAllocator as its #[global_allocator]");
    let result = work();
    (result, count() - start)
}
