//! VMC as other programs send it.

use glam::{DQuat, DVec3};
use rosc::{OscBundle, OscMessage, OscPacket, OscTime, OscType, encoder::encode};
use sinew_body::humanoid::{Body, Node, Pose, exp, log};
use sinew_control::perform::{BodyProportions, PerformerSample, SampleStatus};
use sinew_live::vmc::{VmcFrame, VmcReader};

fn message(addr: &str, args: Vec<OscType>) -> OscPacket {
    OscPacket::Message(OscMessage { addr: addr.to_owned(), args })
}

fn floats(name: &str, values: &[f32]) -> Vec<OscType> {
    let name = OscType::String(name.to_owned());
    std::iter::once(name).chain(values.iter().map(|value| OscType::Float(*value))).collect()
}

fn bone(name: &str, values: [f32; 7]) -> OscPacket {
    message("/VMC/Ext/Bone/Pos", floats(name, &values))
}

fn time(secs: f32) -> OscPacket {
    message("/VMC/Ext/T", vec![OscType::Float(secs)])
}

fn bundle(content: Vec<OscPacket>) -> Vec<u8> {
    encode(&OscPacket::Bundle(OscBundle { timetag: OscTime { seconds: 0, fractional: 1 }, content })).unwrap()
}

fn read(reader: &mut VmcReader, bytes: &[u8]) -> Vec<PerformerSample> {
    let mut heard = Vec::new();
    reader.datagram(bytes, 50.0, &mut |sample| heard.push(sample)).unwrap();
    heard
}

/// The sample of a frame of a few bones, which is known to be whole when it comes again.
fn read_again(bytes: &[u8]) -> PerformerSample {
    let mut reader = VmcReader::new();
    assert_eq!(read(&mut reader, bytes), [], "a frame may go on in the next datagram");
    let mut heard = read(&mut reader, bytes);
    assert_eq!(heard.len(), 1);
    heard.remove(0)
}

/// sin and cos of 45 degrees.
const HALF: f32 = std::f32::consts::FRAC_1_SQRT_2;

#[test]
fn unitys_right_is_our_minus_x_and_its_turns_are_mirrored() {
    // By Unity's own rules: left-handed, the character's left arm points to -X, and a turn about +Z takes -X to -Y.
    let hips = bone("Hips", [0.5, 0.9, 2.0, 0.0, 0.0, 0.0, 1.0]);
    let arm = bone("LeftUpperArm", [0.0, 0.0, 0.0, 0.0, 0.0, HALF, HALF]);
    let pose = read_again(&bundle(vec![hips, arm, time(1.0)])).pose();
    // A millionth is the sample's own step.
    assert!((pose.hips_position - DVec3::new(-0.5, 0.9, 2.0)).length() < 1e-5);
    assert!((pose.world[Node::LeftUpperArm.index()] * DVec3::NEG_Y + DVec3::Y).length() < 1e-5, "the arm hangs");
    assert!((pose.world[Node::RightUpperArm.index()] * DVec3::NEG_Y + DVec3::X).length() < 1e-5, "the other does not");
    // A turn about +Y takes +Z to +X: to the right.
    let turned = bone("Hips", [0.0, 0.9, 0.0, 0.0, HALF, 0.0, HALF]);
    let heard = read_again(&bundle(vec![turned, time(1.0)]));
    assert!((heard.pose().world[0] * DVec3::Z + DVec3::X).length() < 1e-5, "to the right is -X");
}

#[test]
fn the_root_carries_the_hips_in_both_of_its_forms() {
    let hips = bone("Hips", [0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    // Turned to the right by a right angle: what was in front is to the right, +X of Unity.
    let place = [3.0, 0.0, 0.0, 0.0, HALF, 0.0, HALF];
    let old = message("/VMC/Ext/Root/Pos", floats("root", &place));
    let mut newer = place.to_vec();
    newer.extend([0.5, 0.5, 0.5, 9.0, 9.0, 9.0]);
    let new = message("/VMC/Ext/Root/Pos", floats("root", &newer));
    for root in [old, new] {
        let heard = read_again(&bundle(vec![root, hips.clone(), time(1.0)]));
        assert!((heard.hips_m() - DVec3::new(-4.0, 1.0, 0.0)).length() < 1e-5, "{:?}", heard.hips_um);
    }
}

#[test]
fn a_frame_is_the_same_whole_in_pieces_and_message_by_message() {
    let body = Body::standard(70.0, 1.8);
    let locals = Node::ALL.map(|node| exp(DVec3::new(0.1, 0.2, -0.1) * node.index() as f64 / 9.0));
    let mut whole = Vec::new();
    let mut packets = Vec::new();
    for number in 0..10 {
        let pose = Pose::from_locals(DVec3::new(0.0, 0.9, 0.01 * f64::from(number)), &locals);
        let sample = PerformerSample::of_pose(f64::from(number) / 60.0, &pose, &body);
        let bytes = VmcFrame::of(&sample, &body).to_bytes();
        let (_, packet) = rosc::decoder::decode_udp(&bytes).unwrap();
        let OscPacket::Bundle(bundle) = packet else { panic!("one bundle") };
        whole.push(sample);
        packets.push(bundle.content);
    }
    let poses = |samples: &[PerformerSample]| samples.iter().map(PerformerSample::pose).collect::<Vec<_>>();
    // Three datagrams a frame, time first; and time last.
    for last in [false, true] {
        let mut reader = VmcReader::new();
        let mut heard = Vec::new();
        for packets in &packets {
            let mut packets = packets.clone();
            if last {
                packets.rotate_left(2);
            }
            for piece in packets.chunks(9) {
                heard.extend(read(&mut reader, &bundle(piece.to_vec())));
            }
        }
        let (heard, wanted) = (poses(&heard), poses(&whole));
        for pose in &heard {
            let apart = wanted.iter().map(|one| one.hips_position.distance(pose.hips_position));
            assert!(apart.fold(f64::INFINITY, f64::min) < 1e-5);
        }
        assert!(heard.len() >= 9, "{}", heard.len());
    }
    // Message by message, and without any time.
    let mut reader = VmcReader::new();
    let mut heard = Vec::new();
    for packets in &packets {
        for packet in packets.iter().skip(2) {
            heard.extend(read(&mut reader, &encode(packet).unwrap()));
        }
    }
    assert!(heard.len() >= 9);
    assert!(heard.iter().all(|sample| sample.time_secs == 50.0), "the time of arrival stands in for the sender's");
}

#[test]
fn a_pose_comes_back_from_the_wire_as_single_precision_has_it() {
    let body = Body::standard(70.0, 1.8);
    let locals = Node::ALL.map(|node| exp(DVec3::new(0.3, -0.4, 0.2) * (node.index() as f64 / 7.0 - 1.0)));
    let pose = Pose::from_locals(DVec3::new(1.0, 0.9, -3.0), &locals);
    let sample = PerformerSample { number: Some(5), ..PerformerSample::of_pose(1e5 + 1.0 / 3.0, &pose, &body) };
    let heard = &read(&mut VmcReader::new(), &VmcFrame::of(&sample, &body).to_bytes())[0];
    assert_eq!((heard.number, heard.time_secs), (Some(5), sample.time_secs), "our own address has all digits");
    let again = heard.pose();
    for node in Node::ALL {
        let apart: DQuat = pose.world[node.index()].conjugate() * again.world[node.index()];
        // A few millionths for each part on the way from the hips.
        assert!(log(apart.normalize()).length() < 2e-5, "{node:?}");
    }
    let (build, own) = (heard.build.unwrap(), BodyProportions::of(&body));
    // Single precision of half a metre.
    assert!((build.leg_m() - own.leg_m()).abs() < 1e-5);
}

#[test]
fn a_performer_who_is_not_seen_and_numbers_that_are_none_are_marked() {
    let body = Body::standard(70.0, 1.8);
    let sample = PerformerSample::of_pose(0.0, &Pose::STANDING, &body);
    let unseen = VmcFrame { is_seen: false, ..VmcFrame::of(&sample, &body) };
    assert_eq!(read(&mut VmcReader::new(), &unseen.to_bytes())[0].status, SampleStatus::Untracked);
    let mut none = VmcFrame::of(&sample, &body);
    none.rotations[3].y = f64::INFINITY;
    assert_eq!(read(&mut VmcReader::new(), &none.to_bytes())[0].status, SampleStatus::NonFinite);
    // A message that is too short has no numbers where they should be.
    let short = bundle(vec![message("/VMC/Ext/Bone/Pos", floats("Hips", &[0.0, 1.0])), time(0.0)]);
    assert_eq!(read_again(&short).status, SampleStatus::NonFinite);
}
