//! Resolves the URI of a buffer: data inside the file, or a file in its folder and nowhere else.

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// Some exporters leave out the padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// What a glTF buffer written into JSON starts with.
const OURS: &str = "data:application/octet-stream;base64,";

/// Bytes as a data URI.
pub(super) fn to_data_uri(bytes: &[u8]) -> String {
    let mut uri = String::with_capacity(OURS.len() + bytes.len().div_ceil(3) * 4);
    uri.push_str(OURS);
    BASE64.encode_string(bytes, &mut uri);
    uri
}

/// The bytes of a URI, or the problem and its remedy.
pub(super) fn load(uri: &str, folder: Option<&Path>, max_bytes: u64) -> Result<Vec<u8>, (String, String)> {
    let fail = |problem: String, remedy: &str| Err((problem, remedy.to_owned()));
    if uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:")) {
        let Some((_, text)) = uri.split_once(";base64,") else {
            return fail("its data URI is not base64".into(), "export as .glb");
        };
        return BASE64.decode(text).or_else(|error| fail(format!("its base64 is broken: {error}"), "export as .glb"));
    }
    let Some(folder) = folder else {
        return fail(
            format!("its bytes are in another file, {uri:?}, which cannot be read from memory"),
            "give the file by its path, or export as .glb",
        );
    };
    let Some(path) = beside(uri, folder) else {
        return fail(
            format!("its URI {uri:?} leads out of the folder of the glTF file"),
            "put the file beside the glTF file and name it without a path, or export as .glb",
        );
    };
    read_at_most(&path, max_bytes).or_else(|problem| fail(format!("{uri:?}: {problem}"), "check that file"))
}

/// The path of a relative URI if it stays, links resolved, inside the folder. A file that does not exist keeps its
/// name, so that reading it reports the error.
fn beside(uri: &str, folder: &Path) -> Option<PathBuf> {
    let name = percent_decoded(uri)?;
    if name.is_empty() || name.contains(['\\', ':', '\0']) {
        return None;
    }
    let relative = Path::new(&name);
    if !relative.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir)) {
        return None;
    }
    let path = folder.join(relative);
    match (path.canonicalize(), folder.canonicalize()) {
        (Ok(real), Ok(real_folder)) => real.starts_with(&real_folder).then_some(real),
        _ => Some(path),
    }
}

/// The text with percent-encoding (`%20`) decoded.
fn percent_decoded(uri: &str) -> Option<String> {
    let bytes = uri.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        if bytes[at] == b'%' {
            let digits = uri.get(at + 1..at + 3).filter(|digits| digits.bytes().all(|d| d.is_ascii_hexdigit()))?;
            decoded.push(u8::from_str_radix(digits, 16).ok()?);
            at += 3;
        } else {
            decoded.push(bytes[at]);
            at += 1;
        }
    }
    String::from_utf8(decoded).ok()
}

/// The content of a plain file up to a maximum size.
pub(super) fn read_at_most(path: &Path, max_bytes: u64) -> Result<Vec<u8>, String> {
    let metadata = std::fs::metadata(path).map_err(|error| error.to_string())?;
    if !metadata.is_file() {
        return Err("not a plain file".into());
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|error| error.to_string())?;
    file.take(max_bytes.saturating_add(1)).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 > max_bytes {
        return Err(format!("larger than the maximum of {max_bytes} bytes"));
    }
    Ok(bytes)
}
