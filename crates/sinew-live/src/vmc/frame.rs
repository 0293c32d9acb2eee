//! One sample of a performer as one VMC datagram.

use super::axes::{mirrored, mirrored_turn};
use super::{BONE, OK, ROOT, SEQ, TIME};
use glam::{DQuat, DVec3};
use rosc::{OscBundle, OscMessage, OscPacket, OscTime, OscType};
use sinew_body::humanoid::{Body, Node};
use sinew_control::perform::{PerformerSample, SampleStatus, TPose};
use sinew_motion::Part;

/// The contents of one datagram, in our axes. Numbers are not checked, so that tests can send invalid ones.
#[derive(Clone, Debug)]
pub struct VmcFrame {
    /// Sender's time \[s\].
    pub time_secs: f64,
    /// Sequence number, of our own sender.
    pub number: Option<u64>,
    /// Whether the capture system tracks the performer.
    pub is_seen: bool,
    /// Position of every part in its parent's frame \[m\], of the hips in the world; in the order of [`Part::ALL`].
    pub positions: [DVec3; Part::COUNT],
    /// `parent_from_part` rotations, in the order of [`Part::ALL`].
    pub rotations: [DQuat; Part::COUNT],
}

impl VmcFrame {
    /// The datagram for a sample of a performer with this body.
    pub fn of(sample: &PerformerSample, body: &Body) -> VmcFrame {
        let mut positions = [DVec3::ZERO; Part::COUNT];
        for node in Node::ALL {
            let Some(parent) = node.parent() else { continue };
            // Offsets are in the parent node's frame: arms hang there, and stand out in the T-pose of parts.
            positions[node.part() as usize] = TPose::part_from_node(parent) * body.link(node).offset;
        }
        // The chest's joint is shared by the two parts below it.
        positions[Part::Spine as usize] = positions[Part::Chest as usize];
        positions[Part::Chest as usize] = DVec3::ZERO;
        positions[Part::Hips as usize] = sample.hips_m();
        VmcFrame {
            time_secs: sample.time_secs,
            number: sample.number,
            is_seen: sample.status == SampleStatus::Tracked,
            positions,
            rotations: std::array::from_fn(|at| sample.turn(Part::ALL[at])),
        }
    }

    /// The datagram as bytes: one OSC bundle, single precision as VMC specifies.
    pub fn to_bytes(&self) -> Vec<u8> {
        let message = |addr: &str, args: Vec<OscType>| OscPacket::Message(OscMessage { addr: addr.to_owned(), args });
        let int = |value: bool| OscType::Int(i32::from(value));
        let mut content = Vec::with_capacity(Part::COUNT + 4);
        // Loaded, calibrated, normal mode, tracked.
        content.push(message(OK, vec![int(true), OscType::Int(3), OscType::Int(0), int(self.is_seen)]));
        content.push(message(TIME, vec![OscType::Float(self.time_secs as f32)]));
        if let Some(number) = self.number {
            let number = OscType::Long(i64::try_from(number).unwrap_or(i64::MAX));
            content.push(message(SEQ, vec![number, OscType::Double(self.time_secs)]));
        }
        content.push(message(ROOT, placed("root", DVec3::ZERO, DQuat::IDENTITY)));
        for &part in Part::ALL {
            let name = unity_name(part);
            content.push(message(BONE, placed(&name, self.positions[part as usize], self.rotations[part as usize])));
        }
        // "Immediately", in OSC.
        let timetag = OscTime { seconds: 0, fractional: 1 };
        // The encoder fails only on nesting deeper than the address space.
        rosc::encoder::encode(&OscPacket::Bundle(OscBundle { timetag, content })).unwrap_or_default()
    }
}

/// Unity's name of a bone: as VRM's, with a capital letter.
fn unity_name(part: Part) -> String {
    let name = part.name();
    name[..1].to_uppercase() + &name[1..]
}

fn placed(name: &str, place: DVec3, turn: DQuat) -> Vec<OscType> {
    let (place, turn) = (mirrored(place), mirrored_turn(turn));
    let numbers = place.to_array().into_iter().chain(turn.to_array());
    std::iter::once(OscType::String(name.to_owned())).chain(numbers.map(|value| OscType::Float(value as f32))).collect()
}
