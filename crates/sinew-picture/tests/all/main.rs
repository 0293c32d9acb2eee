//! Everything that `sinew-picture` is held to, as one program.

mod common;
mod odd_input;
mod pictures;
