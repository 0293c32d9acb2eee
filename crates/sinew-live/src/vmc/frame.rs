//! A performer as one datagram.

use super::axes::{mirrored, mirrored_turn};
use super::{BONE, OK, ROOT, SEQ, TIME};
use glam::{DQuat, DVec3};
use rosc::{OscBundle, OscMessage, OscPacket, OscTime, OscType};
use sinew_body::humanoid::{Body, Node};
use sinew_control::perform::{PerformerSample, SampleStatus, TPose};
use sinew_motion::Part;

/// What one datagram says: numbers as they go out, in our axes, sound or not.
#[derive(Clone, Debug)]
pub struct VmcFrame {
    /// Sender's time \[s\].
    pub time_secs: f64,
    /// Running number, of our own sender.
    pub number: Option<u64>,
    /// Whether the performer is seen.
    pub is_seen: bool,
    /// Place of every part in its parent \[m\], the hips' in the space; by [`Part::ALL`].
    pub places: [DVec3; Part::COUNT],
    /// `parent_from_part` turns.
    pub turns: [DQuat; Part::COUNT],
}

impl VmcFrame {
    /// A sample of somebody with this body.
    pub fn of(sample: &PerformerSample, body: &Body) -> VmcFrame {
        let mut places = [DVec3::ZERO; Part::COUNT];
        for node in Node::ALL {
            let Some(parent) = node.parent() else { continue };
            // Offsets are in the parent node's frame, which hangs where the part's stands out.
            places[node.part() as usize] = TPose::part_from_node(parent) * body.link(node).offset;
        }
        // The chest's joint is shared by the two parts below it.
        places[Part::Spine as usize] = places[Part::Chest as usize];
        places[Part::Chest as usize] = DVec3::ZERO;
        places[Part::Hips as usize] = sample.hips_m();
        VmcFrame {
            time_secs: sample.time_secs,
            number: sample.number,
            is_seen: sample.status == SampleStatus::Tracked,
            places,
            turns: std::array::from_fn(|at| sample.turn(Part::ALL[at])),
        }
    }

    /// The datagram: one bundle. Single precision, as VMC has it.
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
            content.push(message(BONE, placed(&name, self.places[part as usize], self.turns[part as usize])));
        }
        // "Immediately", in OSC.
        let timetag = OscTime { seconds: 0, fractional: 1 };
        // Only a nesting deeper than an address space fails.
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
