//! What the program `sinew` does, as library calls: files and scenes in; motion, pictures and reports out.
//!
//! A job is a plain struct with a [`Default`]; the function of the same name runs it.

mod camera;
pub mod ground;
pub mod inspect;
mod moments;
pub mod reach;
pub mod respond;
pub mod run;
#[cfg(feature = "session")]
pub mod session;
