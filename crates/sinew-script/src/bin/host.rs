//! The child process alone, for the tests and benchmarks of this crate. `sinew` is its own child.

fn main() {
    sinew_script::host::main()
}
