//! Everything that the program `sinew` is held to, as one program.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod command;
mod command_ground;
mod command_inspect;
mod command_perform;
mod command_reach;
mod command_respond;
mod command_run;
mod command_stop;
mod command_video;
mod without_parts;
