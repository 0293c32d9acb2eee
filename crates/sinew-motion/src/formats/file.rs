//! A motion file of any format, in metres and Y up, with its body parts found.

use super::{AnimationInfo, BodyShape, Document, Format, Parsed, SceneFile, Source, WriteJob, amc, bvh, fbx, gltf};
use crate::choice::listed;
use crate::{BodyHints, Clip, Error, Humanoid, Limits, Note, Part, Place, SourceSpace, guess_space, stature};
use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// The frame rate that readers, ours too, assume for an AMC \[Hz\].
const AMC_FPS: f64 = 120.0;

/// How a file is to be read.
#[derive(Clone, Debug, Default)]
pub struct ReadOptions {
    /// The ASF skeleton of an AMC motion; otherwise it is looked for beside the motion.
    pub skeleton: Option<PathBuf>,
    /// Length of one file unit \[m\]; otherwise what the file states, or a guess by stature.
    pub unit_m: Option<f64>,
    /// The animation to read, by name or by number from 1; otherwise the first one with keys of the skeleton. Only glTF and
    /// FBX hold several.
    pub animation: Option<String>,
    /// The person to take, by the name of their root joint or armature or by number from 1; otherwise the first one.
    pub person: Option<String>,
    /// Joints that are given parts, before anything is guessed.
    pub parts: Vec<(Part, String)>,
    /// Limits of the reader.
    pub limits: Limits,
}

/// A motion file, read.
#[derive(Clone, Debug)]
pub struct MotionFile {
    /// Where it was read from; empty when it came from memory.
    pub path: PathBuf,
    /// Its format.
    pub format: Format,
    /// The motion in metres, Y up.
    pub clip: Clip,
    /// The file's unit and axes.
    pub space: SourceSpace,
    /// Which joint is which part, or why the skeleton is not a human body.
    pub humanoid: Result<Humanoid, Error>,
    /// Standing height of the body \[m\]; 0 if it is not a human body.
    pub stature_m: f64,
    /// All animations of the file; empty for formats that hold one without a name (BVH, AMC).
    pub animations: Vec<AnimationInfo>,
    /// What was guessed, repaired or lost.
    pub notes: Vec<Note>,
    document: Document,
}

impl MotionFile {
    /// Reads a motion file; the extension decides the format.
    ///
    /// ```no_run
    /// use sinew_motion::formats::{MotionFile, ReadOptions};
    /// let file = MotionFile::read("walk.bvh".as_ref(), &ReadOptions::default())?;
    /// println!("{} frames, {:.2} m tall", file.clip.frames(), file.stature_m);
    /// # Ok::<(), sinew_motion::Error>(())
    /// ```
    ///
    /// # Errors
    /// A file that cannot be opened, is invalid or exceeds the limits. A skeleton that is not a human body is not an
    /// error: see [`MotionFile::humanoid`].
    pub fn read(path: &Path, options: &ReadOptions) -> Result<MotionFile, Error> {
        let format = format_of(path)?;
        let (limits, animation) = (&options.limits, options.animation.as_deref());
        let parsed = match format {
            Format::Bvh => bvh::read(&bytes_of(path, limits)?, limits),
            Format::Fbx => fbx::read_chosen(&bytes_of(path, limits)?, animation, limits),
            Format::Gltf | Format::Glb | Format::Vrm | Format::Vrma => gltf::read_chosen(path, animation, limits),
            Format::Amc if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("asf")) => {
                amc::read_rest(&bytes_of(path, limits)?, limits)
            }
            Format::Amc => {
                let skeleton = amc::find_skeleton(path, options.skeleton.as_deref())?;
                amc::read(&bytes_of(path, limits)?, &bytes_of(&skeleton, limits)?, limits)
            }
        }
        .map_err(|error| error.in_file(path))?;
        MotionFile::understood(path.to_owned(), format, parsed, options)
    }

    /// Reads a BVH from memory.
    ///
    /// # Errors
    /// As [`MotionFile::read`].
    pub fn from_bvh(bytes: &[u8], options: &ReadOptions) -> Result<MotionFile, Error> {
        let parsed = bvh::read(bytes, &options.limits)?;
        MotionFile::understood(PathBuf::new(), Format::Bvh, parsed, options)
    }

    /// Reads a motion from memory; the extension of `name` decides the format. No file is read: a glTF must contain its
    /// buffers, and an AMC, whose skeleton is another file, is refused.
    ///
    /// # Errors
    /// As [`MotionFile::read`].
    pub fn from_bytes(name: &Path, bytes: &[u8], options: &ReadOptions) -> Result<MotionFile, Error> {
        let format = format_of(name)?;
        let (limits, animation) = (&options.limits, options.animation.as_deref());
        let parsed = match format {
            Format::Bvh => bvh::read(bytes, limits),
            Format::Fbx => fbx::read_chosen(bytes, animation, limits),
            Format::Gltf | Format::Glb | Format::Vrm | Format::Vrma => {
                gltf::read_slice_chosen(bytes, None, animation, limits)
            }
            Format::Amc => {
                let problem = "the skeleton of an AMC is in another file";
                Err(Error::new(Place::File, problem, "convert it with `sinew convert` to .bvh or .glb"))
            }
        }
        .map_err(|error| error.in_file(name))?;
        MotionFile::understood(name.to_owned(), format, parsed, options)
    }

    fn understood(path: PathBuf, format: Format, parsed: Parsed, options: &ReadOptions) -> Result<MotionFile, Error> {
        if let Some(unit_m) = options.unit_m
            && !(1e-6..=1e3).contains(&unit_m)
        {
            let problem = format!("a unit of {unit_m:e} m is out of range");
            return Err(Error::new(Place::File, problem, "give metres per file unit, such as 0.01").in_file(&path));
        }
        if options.animation.is_some() && parsed.contents.animations.is_empty() {
            let problem = format!("it has no animations to choose from, as a {format} holds one motion");
            return Err(Error::new(Place::File, problem, "leave ReadOptions::animation out").in_file(&path));
        }
        let unit_m = options.unit_m.or(parsed.unit_m);
        let hints = BodyHints {
            parts: options.parts.clone(),
            person: options.person.clone(),
            stated: parsed.contents.parts,
            armatures: parsed.contents.armatures,
        };
        let humanoid = Humanoid::with(&parsed.clip, &hints).map_err(|error| error.in_file(&path));
        if let (Err(error), true) = (&humanoid, options.person.is_some() || !options.parts.is_empty()) {
            // Who names parts or a person means a body.
            return Err(error.clone());
        }
        let mut notes = parsed.notes;
        notes.extend(other_animations(&parsed.contents.animations));
        let (space, clip, stature_m) = match &humanoid {
            Ok(humanoid) => {
                let guess = guess_space(&parsed.clip, humanoid, unit_m, parsed.world_from_source);
                notes.extend(guess.notes);
                notes.extend(humanoid.notes().iter().cloned());
                let clip = guess.space.clip_to_world(&parsed.clip);
                let stature_m = stature(&clip, humanoid);
                (guess.space, clip, stature_m)
            }
            Err(_) => {
                let world_from_source = parsed.world_from_source.unwrap_or(glam::DQuat::IDENTITY);
                let space = SourceSpace { unit_m: unit_m.unwrap_or(1.0), world_from_source };
                (space, space.clip_to_world(&parsed.clip), 0.0)
            }
        };
        if let Some((frame, joint)) = clip.first_non_finite() {
            let joint = &clip.skeleton().joints()[joint].name;
            let problem = format!("frame {frame}, joint {joint:?}: not a number once in metres");
            return Err(Error::new(Place::File, problem, "check the values and the unit").in_file(&path));
        }
        let animations = parsed.contents.animations;
        Ok(MotionFile { path, format, clip, space, humanoid, stature_m, animations, notes, document: parsed.document })
    }

    /// The human body in the file.
    ///
    /// # Errors
    /// Why the skeleton is not a human body.
    pub fn body_parts(&self) -> Result<&Humanoid, Error> {
        self.humanoid.as_ref().map_err(Clone::clone)
    }

    /// Writes a motion to a file of the format that its extension names. Of the file's own format it is that file again,
    /// with nothing changed but what differs in `clip`; `rows` gives for each frame of `clip` the frame of this file that it
    /// came from. `body` is what a glTF made anew shows.
    ///
    /// The file is written atomically; what the format cannot hold is returned as notes.
    ///
    /// # Errors
    /// A format that cannot be written, a motion that the format cannot hold, or a folder that cannot be written to.
    pub fn write(&self, path: &Path, clip: &Clip, rows: &[usize], body: &[BodyShape]) -> Result<Vec<Note>, Error> {
        let source = Source { document: &self.document, clip: &self.clip, space: self.space, rows };
        write(path, &WriteJob { clip, source: Some(source) }, body)
    }
}

/// A note of those that are not read.
fn other_animations(all: &[AnimationInfo]) -> Option<Note> {
    let read = all.iter().position(|animation| animation.is_read).filter(|_| all.len() > 1)?;
    Some(Note::new(format!(
        "{} animations: number {}, {:?}, is read, of {}; ReadOptions::animation chooses another",
        all.len(),
        read + 1,
        all[read].shown(),
        listed(all.iter().map(AnimationInfo::shown))
    )))
}

/// Writes a motion to a file of the format that its extension names, see [`MotionFile::write`]. An `.amc` made anew gets its
/// `.asf` beside it.
///
/// # Errors
/// As [`MotionFile::write`].
pub fn write(path: &Path, job: &WriteJob, body: &[BodyShape]) -> Result<Vec<Note>, Error> {
    let mut bytes = Vec::new();
    let mut notes = Vec::new();
    match format_of(path)? {
        Format::Bvh => bvh::write_nearest(&mut bytes, job).map(|lost| notes = lost),
        Format::Amc => {
            let beside = path.with_extension("asf");
            match job.source {
                // The skeleton comes along where the new place has none.
                Some(Source { document: Document::Amc(document), .. }) => {
                    if amc::find_skeleton(path, None).is_err() {
                        write_whole(&beside, document.skeleton_bytes())?;
                    }
                }
                _ => {
                    let mut skeleton = Vec::new();
                    amc::write_skeleton(&mut skeleton, job.clip).map_err(|error| error.in_file(&beside))?;
                    write_whole(&beside, &skeleton)?;
                }
            }
            let written = amc::write_nearest(&mut bytes, job).map(|lost| notes = lost);
            let again = matches!(job.source, Some(Source { document: Document::Amc(_), .. }));
            if !again && (job.clip.fps() - AMC_FPS).abs() > 0.5 {
                notes.push(Note::new(format!(
                    "an AMC does not state its frame rate, and readers take {AMC_FPS}: this motion has {:.3} frames per second; \
                     resample it to {AMC_FPS}, and it fits",
                    job.clip.fps()
                )));
            }
            written
        }
        format @ (Format::Gltf | Format::Glb | Format::Vrm | Format::Vrma) => gltf::write(&mut bytes, job, format, body),
        Format::Fbx => Err(Error::new(
            Place::File,
            "FBX can be read but not written",
            "write .glb or .bvh, which every program that reads FBX reads too",
        )),
    }
    .map_err(|error| error.in_file(path))?;
    write_whole(path, &bytes)?;
    Ok(notes)
}

/// Writes a whole scene to a `.glb` or `.gltf`, atomically; see [`gltf::write_scene`].
///
/// # Errors
/// Another format, a scene that cannot be written, or a folder that cannot be written to.
pub fn write_scene(path: &Path, scene: &SceneFile) -> Result<(), Error> {
    let bytes = match format_of(path)? {
        format @ (Format::Gltf | Format::Glb) => gltf::write_scene(scene, format),
        other => {
            let problem = format!("a scene is not written as {other}");
            Err(Error::new(Place::File, problem, "name the output .glb or .gltf"))
        }
    };
    write_whole(path, &bytes.map_err(|error| error.in_file(path))?)
}

fn format_of(path: &Path) -> Result<Format, Error> {
    Format::of(path).ok_or_else(|| {
        let problem = match path.extension() {
            Some(extension) => format!("unknown format .{}", extension.display()),
            None => "no extension tells its format".to_owned(),
        };
        Error::new(Place::File, problem, "use .bvh, .amc (with .asf), .glb, .gltf, .vrm, .vrma, or .fbx (read only)")
            .in_file(path)
    })
}

/// Reads a file up to the maximum size.
///
/// # Errors
/// It is not a file, cannot be read, or is too large.
pub fn bytes_of(path: &Path, limits: &Limits) -> Result<Vec<u8>, Error> {
    let io = |error: std::io::Error| Error::io(path, &error);
    let file = fs::File::open(path).map_err(io)?;
    if !file.metadata().map_err(io)?.is_file() {
        return Err(Error::new(Place::File, "it is not a file", "name a motion file").in_file(path));
    }
    let mut bytes = Vec::new();
    // One byte more than the maximum, so that a file that grows while it is read is detected too.
    file.take(limits.file_bytes + 1).read_to_end(&mut bytes).map_err(io)?;
    if bytes.len() as u64 > limits.file_bytes {
        let problem = format!("larger than the maximum of {} bytes", limits.file_bytes);
        return Err(Error::new(Place::File, problem, "cut the motion into shorter files").in_file(path));
    }
    Ok(bytes)
}

/// Writes a file atomically: to a temporary file beside it, then renamed, so that a full disk or a crash never leaves a
/// partial file or destroys the old one.
///
/// # Errors
/// When the folder cannot be written to.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let io = |error: std::io::Error| Error::io(path, &error);
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.part", std::process::id()));
    let beside = path.with_file_name(name);
    let written = fs::File::create(&beside).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    let moved = written.and_then(|()| fs::rename(&beside, path));
    if moved.is_err() {
        let _ = fs::remove_file(&beside);
    }
    moved.map_err(io)
}
