//! Everything that `sinew-picture` is held to, as one program.

mod common;
mod movies;
mod odd_input;
mod pictures;
