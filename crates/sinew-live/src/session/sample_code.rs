//! Encoding of a performer's sample, small enough for one packet; every number keeps all its bits.

use super::wire::{Malformed, Reader};
use sinew_control::perform::{BodyProportions, PerformerSample, SampleStatus};
use sinew_motion::Part;

const HAS_NUMBER: u8 = 1;
const HAS_BUILD: u8 = 2;

pub(super) fn encode_sample(sample: &PerformerSample, out: &mut Vec<u8>) {
    let status = match sample.status {
        SampleStatus::Tracked => 0,
        SampleStatus::Untracked => 4,
        SampleStatus::NonFinite => 8,
    };
    let number = if sample.number.is_some() { HAS_NUMBER } else { 0 };
    let build = if sample.build.is_some() { HAS_BUILD } else { 0 };
    out.push(status | number | build);
    out.extend(sample.time_secs.to_le_bytes());
    if let Some(number) = sample.number {
        out.extend(number.to_le_bytes());
    }
    whole(&sample.hips_um, out);
    whole(sample.turns_e6.as_flattened(), out);
    if let Some(build) = &sample.build {
        whole(&build.hips_to_legs_um, out);
        whole(&[build.leg_um], out);
    }
}

pub(super) fn decode_sample(from: &mut Reader) -> Result<PerformerSample, Malformed> {
    let kind = from.u8()?;
    let status = match kind & !(HAS_NUMBER | HAS_BUILD) {
        0 => SampleStatus::Tracked,
        4 => SampleStatus::Untracked,
        8 => SampleStatus::NonFinite,
        _ => return Err(Malformed("the status of a sample is unknown")),
    };
    let time_secs = from.f64()?;
    let number = if kind & HAS_NUMBER != 0 { Some(from.u64()?) } else { None };
    let hips_um = read(from)?;
    let mut turns_e6 = [[0; 4]; Part::COUNT];
    for turn in &mut turns_e6 {
        *turn = read(from)?;
    }
    let build = if kind & HAS_BUILD != 0 {
        let (hips_to_legs_um, [leg_um]) = (read(from)?, read(from)?);
        Some(BodyProportions { hips_to_legs_um, leg_um })
    } else {
        None
    };
    Ok(PerformerSample { time_secs, number, status, hips_um, turns_e6, build })
}

fn whole(numbers: &[i32], out: &mut Vec<u8>) {
    for number in numbers {
        out.extend(number.to_le_bytes());
    }
}

fn read<const N: usize>(from: &mut Reader) -> Result<[i32; N], Malformed> {
    let mut numbers = [0; N];
    for number in &mut numbers {
        *number = from.i32()?;
    }
    Ok(numbers)
}
