//! `--push part=leftHand,force=0:0:-100,at=1.0,for=0.1` and similar arguments.

use glam::DVec3;
use sinew::motion::Part;
use sinew::response::{GroundJerk, Push, PushFrame};

/// Parses a push: `part=` and `force=` are required; `at=`, `for=`, `point=` and `frame=` have defaults.
pub(crate) fn push(text: &str) -> Result<Push, String> {
    let mut fields = Fields::of(text, &["part", "force", "at", "for", "frame", "point"])?;
    let part: Part = fields.needed("part")?.parse().map_err(|error: sinew::motion::UnknownPart| error.to_string())?;
    Ok(Push {
        part,
        force_n: vector(fields.needed("force")?, "force")?,
        point: fields.take("point").map(|text| vector(text, "point")).transpose()?,
        frame: frame(fields.take("frame"))?,
        at_secs: seconds(fields.take("at"), "at", 1.0)?,
        for_secs: seconds(fields.take("for"), "for", 0.1)?,
    })
}

/// Parses an acceleration of the ground: `accel=` is required.
pub(crate) fn ground(text: &str) -> Result<GroundJerk, String> {
    let mut fields = Fields::of(text, &["accel", "at", "for", "frame"])?;
    Ok(GroundJerk {
        acceleration: vector(fields.needed("accel")?, "accel")?,
        frame: frame(fields.take("frame"))?,
        at_secs: seconds(fields.take("at"), "at", 1.0)?,
        for_secs: seconds(fields.take("for"), "for", 0.1)?,
    })
}

/// Parses `A..B`, frames from 0, both ends in.
pub(crate) fn cycle(text: &str) -> Result<(usize, usize), String> {
    let parsed = text.split_once("..").and_then(|(first, last)| Some((first.parse().ok()?, last.parse().ok()?)));
    parsed
        .filter(|(first, last)| first < last)
        .ok_or_else(|| format!("{text:?} is no range of frames; write FIRST..LAST, such as 55..186"))
}

struct Fields<'a> {
    pairs: Vec<(&'a str, &'a str)>,
}

impl<'a> Fields<'a> {
    fn of(text: &'a str, known: &[&str]) -> Result<Fields<'a>, String> {
        let mut pairs: Vec<(&str, &str)> = Vec::new();
        for field in text.split(',').filter(|field| !field.trim().is_empty()) {
            let (name, value) = field
                .split_once('=')
                .ok_or_else(|| format!("{field:?} is not name=value; names are {}", known.join(", ")))?;
            let (name, value) = (name.trim(), value.trim());
            if !known.contains(&name) {
                return Err(format!("unknown {name:?}; names are {}", known.join(", ")));
            }
            if pairs.iter().any(|(other, _)| *other == name) {
                return Err(format!("{name:?} is given twice"));
            }
            pairs.push((name, value));
        }
        Ok(Fields { pairs })
    }

    fn take(&mut self, name: &str) -> Option<&'a str> {
        let at = self.pairs.iter().position(|(other, _)| *other == name)?;
        Some(self.pairs.swap_remove(at).1)
    }

    fn needed(&mut self, name: &str) -> Result<&'a str, String> {
        self.take(name).ok_or_else(|| format!("{name}= is missing"))
    }
}

/// Maximum force, time or length, in newtons, seconds or metres.
const MAX_ABS: f64 = 1e6;

fn number(text: &str, what: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("{what}: {text:?} is no number"))?;
    if !value.is_finite() {
        return Err(format!("{what}: {text:?} is not finite"));
    }
    if value.abs() > MAX_ABS { Err(format!("{what}: {text} is more than {MAX_ABS:e}")) } else { Ok(value) }
}

pub(crate) fn vector(text: &str, what: &str) -> Result<DVec3, String> {
    let parts: Vec<f64> = text.split(':').map(|part| number(part, what)).collect::<Result<_, _>>()?;
    match parts[..] {
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        _ => Err(format!("{what}: {text:?} is no vector; write x:y:z, such as 0:0:-100")),
    }
}

fn seconds(text: Option<&str>, what: &str, default: f64) -> Result<f64, String> {
    let Some(text) = text else { return Ok(default) };
    let value = number(text, what)?;
    if value >= 0.0 { Ok(value) } else { Err(format!("{what}: {text} s is negative")) }
}

fn frame(text: Option<&str>) -> Result<PushFrame, String> {
    match text {
        None | Some("facing") => Ok(PushFrame::Facing),
        Some("world") => Ok(PushFrame::World),
        Some(other) => Err(format!("frame: {other:?} is neither facing nor world")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_push_reads_as_documented() {
        let push = push("part=leftHand,force=0:0:-100,at=1.5,for=0.2,frame=world").unwrap();
        assert_eq!(push.part, Part::LeftHand);
        assert_eq!(push.force_n, DVec3::new(0.0, 0.0, -100.0));
        assert_eq!((push.at_secs, push.for_secs, push.frame), (1.5, 0.2, PushFrame::World));
    }

    #[test]
    fn what_is_wrong_with_a_push_is_said() {
        for (text, word) in [
            ("force=0:0:1", "part= is missing"),
            ("part=leftHand", "force= is missing"),
            ("part=tail,force=0:0:1", "no body part"),
            ("part=head,force=0:0", "no vector"),
            ("part=head,force=0:0:nan", "not finite"),
            ("part=head,force=0:0:1e999", "not finite"),
            ("part=head,force=0:0:1e9", "more than"),
            ("part=head,force=0:0:1,at=-1", "negative"),
            ("part=head,force=0:0:1,frame=local", "neither"),
            ("part=head,force=0:0:1,when=3", "unknown"),
            ("part=head,force=0:0:1,part=hips", "twice"),
            ("head", "name=value"),
        ] {
            let error = push(text).unwrap_err();
            assert!(error.contains(word), "{text}: {error}");
        }
    }
}
