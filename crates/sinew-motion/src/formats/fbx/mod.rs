//! Autodesk FBX, read only, by way of [ufbx](https://github.com/ufbx/ufbx).
//!
//! The skeleton is made of the bones (limb nodes) and the nodes above them; without bones, of the animated nodes. The
//! motion is one animation stack's, the first with keys unless another is told, evaluated at the rate of its keys, or at the file's rate where the keys have
//! none. ufbx turns axes and units into Y up and metres. Joints get their positions from ufbx's world transforms, so
//! pivots, pre-rotations, scales and the inheritance modes of FBX are all in them; scale itself is left out.
//!
//! ufbx takes sines from the platform's C library: the last bits of a clip read from FBX may differ between platforms.
//! This is the one exception to "same input, same bits on any machine".

mod motion;
mod skeleton;

use super::{Contents, Document, Parsed};
use crate::choice::choose;
use crate::{Error, Limits, Place};

/// Constant part of the maximum memory for reading \[bytes\].
const BASE_MEMORY_BYTES: usize = 64 << 20;
/// Maximum bytes of memory per byte of the file: its arrays are compressed, at about 5 : 1.
const MEMORY_PER_BYTE: usize = 32;

/// Reads an FBX file (binary or ASCII) from memory. Other files that it names are not opened.
///
/// ```
/// use sinew_motion::{Limits, formats::fbx};
///
/// let error = fbx::read(b"no fbx at all", &Limits::default()).unwrap_err();
/// assert!(error.remedy().contains("FBX"));
/// ```
///
/// # Errors
/// Bytes that are not FBX, exceed the limits, or hold neither bones nor animated nodes.
pub fn read(bytes: &[u8], limits: &Limits) -> Result<Parsed, Error> {
    read_chosen(bytes, None, limits)
}

/// [`read`], of the animation that `animation` names or numbers.
pub(crate) fn read_chosen(bytes: &[u8], animation: Option<&str>, limits: &Limits) -> Result<Parsed, Error> {
    if bytes.len() as u64 > limits.file_bytes {
        let problem = format!("{} bytes, the maximum is {}", bytes.len(), limits.file_bytes);
        return Err(whole(problem, "export only the character, without media"));
    }
    let scene = ufbx::load_memory(bytes, options(bytes.len(), limits)).map_err(|error| refused(&error))?;
    let mut notes = Vec::new();
    let stacks: Vec<&ufbx::AnimStack> = scene.anim_stacks.into_iter().collect();
    let chosen = match animation {
        Some(wanted) => {
            let names: Vec<Vec<&str>> = stacks.iter().map(|stack| vec![&*stack.element.name]).collect();
            choose(("animation", "animations"), wanted, &names)?
        }
        // Mixamo puts an empty `Take 001` first.
        None => stacks.iter().position(|stack| motion::has_keys(stack)).unwrap_or(0),
    };
    let rig = skeleton::rig(&scene, stacks.get(chosen).copied(), limits)?;
    let clip = motion::sample(&scene, stacks.get(chosen).copied(), &rig, allocator(bytes.len()), limits, &mut notes)?;
    let animations = motion::list(&scene, &stacks, chosen, &clip, limits);
    Ok(Parsed {
        clip,
        unit_m: Some(1.0),
        world_from_source: Some(glam::DQuat::IDENTITY),
        document: Document::None,
        contents: Contents { animations, ..Contents::default() },
        notes,
    })
}

fn options(file_bytes: usize, limits: &Limits) -> ufbx::LoadOpts<'static> {
    ufbx::LoadOpts {
        temp_allocator: allocator(file_bytes),
        result_allocator: allocator(file_bytes),
        file_format: ufbx::FileFormat::Fbx,
        ignore_geometry: true,
        ignore_embedded: true,
        skip_skin_vertices: true,
        load_external_files: false,
        node_depth_limit: u32::try_from(limits.depth).unwrap_or(u32::MAX).saturating_add(1),
        space_conversion: ufbx::SpaceConversion::ModifyGeometry,
        target_axes: ufbx::CoordinateAxes::right_handed_y_up(),
        target_unit_meters: 1.0,
        ..Default::default()
    }
}

fn allocator(file_bytes: usize) -> ufbx::AllocatorOpts {
    let memory_limit = file_bytes.saturating_mul(MEMORY_PER_BYTE).saturating_add(BASE_MEMORY_BYTES);
    ufbx::AllocatorOpts { memory_limit, ..Default::default() }
}

fn refused(error: &ufbx::Error) -> Error {
    whole(format!("not readable as FBX: {}", &*error.description), "export as FBX 7.4 binary, or convert it to glTF")
}

fn whole(problem: impl Into<String>, remedy: &str) -> Error {
    Error::new(Place::File, problem, remedy)
}

/// An error at a node.
fn at_node(name: &str, problem: impl Into<String>, remedy: &str) -> Error {
    Error::new(Place::Element(format!("node {name:?}")), problem, remedy)
}

/// Entry point of the fuzz target `fbx`: reads any bytes as FBX under tight limits; what is read is finite.
///
/// # Panics
/// If a value is not finite.
#[doc(hidden)]
pub fn fuzz(bytes: &[u8]) {
    let limits = Limits { file_bytes: 1 << 21, joints: 200, depth: 32, frames: 500, values: 200_000, name_bytes: 128 };
    if let Ok(parsed) = read(bytes, &limits) {
        assert_eq!(parsed.clip.first_non_finite(), None, "what is read is finite");
    }
}
