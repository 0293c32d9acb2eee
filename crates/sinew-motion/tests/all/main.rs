//! Everything that `sinew-motion` is held to, as one program.

mod analysis;
mod binary_support;
mod choosing;
mod fbx_hostile;
mod fbx_read;
mod from_memory;
mod gltf_hostile;
mod gltf_read;
mod gltf_rewrite;
mod gltf_scene;
mod gltf_write;
mod humanoid_dialects;
mod humanoid_files;
mod motion_files;
mod odd_files;
mod signal;
mod text;
mod text_dialects;
mod text_edits;
mod text_files;
mod text_hostile;
