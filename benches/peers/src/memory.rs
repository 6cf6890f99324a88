//! Measures peak memory: the maximum total size of allocated blocks, without the overhead of the allocator.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicBool, AtomicIsize, Ordering::Relaxed};

/// An allocator that uses the system allocator and counts the allocated bytes while counting is enabled.
pub struct Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

static ON: AtomicBool = AtomicBool::new(false);
static NOW: AtomicIsize = AtomicIsize::new(0);
static MOST: AtomicIsize = AtomicIsize::new(0);

fn count(change: isize) {
    if ON.load(Relaxed) {
        let now = NOW.fetch_add(change, Relaxed) + change;
        MOST.fetch_max(now, Relaxed);
    }
}

// SAFETY: all calls are forwarded to the system allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        System.alloc(layout)
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        System.alloc_zeroed(layout)
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        System.dealloc(pointer, layout);
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size as isize - layout.size() as isize);
        System.realloc(pointer, layout, size)
    }
}

/// Returns the peak memory of `work` and the memory that its result occupies.
pub fn peak<T>(work: impl FnOnce() -> T) -> (usize, usize) {
    NOW.store(0, Relaxed);
    MOST.store(0, Relaxed);
    ON.store(true, Relaxed);
    let made = work();
    ON.store(false, Relaxed);
    let numbers = (MOST.load(Relaxed).max(0) as usize, NOW.load(Relaxed).max(0) as usize);
    drop(made);
    numbers
}

#[test]
fn counts_the_most_and_what_is_left() {
    let (most, left) = peak(|| {
        drop(vec![0_u8; 3_000_000]);
        vec![0_u8; 1_000_000]
    });
    // Allow some tolerance, because other tests of this program may allocate memory at the same time.
    assert!((3_000_000..3_100_000).contains(&most), "{most}");
    assert!((1_000_000..1_100_000).contains(&left), "{left}");
}
