//! VMC as it is cut into datagrams, timed and sent from sockets by programs in use.

use glam::{DQuat, DVec3};
use rosc::{OscBundle, OscMessage, OscPacket, OscTime, OscType, encoder::encode};
use sinew_body::humanoid::{Body, Pose};
use sinew_control::perform::PerformerSample;
use sinew_live::Port;
use sinew_live::vmc::{VmcFrame, VmcReader};
use sinew_motion::Part;
use std::net::UdpSocket;
use std::time::{Duration, Instant};

/// Turn of the trunk in a frame, and of the arm against it: a sample of one frame has opposite ones \[rad\].
fn angle(number: usize) -> f64 {
    0.3 + 0.01 * number as f64
}

/// A frame's messages in the order of most programs, times apart.
fn messages(number: usize) -> Vec<OscPacket> {
    let body = Body::standard(70.0, 1.8);
    let mut frame = VmcFrame::of(&PerformerSample::of_pose(0.0, &Pose::STANDING, &body), &body);
    frame.rotations[Part::Spine as usize] = DQuat::from_rotation_z(angle(number));
    frame.rotations[Part::RightToes as usize] = DQuat::from_rotation_z(-angle(number));
    frame.positions[0] = DVec3::new(0.0, 0.9, 0.01 * number as f64);
    let Ok((_, OscPacket::Bundle(bundle))) = rosc::decoder::decode_udp(&frame.to_bytes()) else { panic!("a bundle") };
    let is_time = |packet: &OscPacket| matches!(packet, OscPacket::Message(one) if one.addr == "/VMC/Ext/T");
    bundle.content.into_iter().filter(|packet| !is_time(packet)).collect()
}

fn time(secs: f64) -> OscPacket {
    OscPacket::Message(OscMessage { addr: "/VMC/Ext/T".to_owned(), args: vec![OscType::Float(secs as f32)] })
}

fn blend() -> OscPacket {
    let args = vec![OscType::String("Joy".to_owned()), OscType::Float(0.5)];
    OscPacket::Message(OscMessage { addr: "/VMC/Ext/Blend/Val".to_owned(), args })
}

fn bundle(content: &[OscPacket]) -> Vec<u8> {
    let timetag = OscTime { seconds: 0, fractional: 1 };
    encode(&OscPacket::Bundle(OscBundle { timetag, content: content.to_vec() })).unwrap()
}

fn alone(packets: &[OscPacket]) -> Vec<Vec<u8>> {
    packets.iter().map(|packet| encode(packet).unwrap()).collect()
}

/// A way to cut a frame into datagrams; the time is the frame's first or last message, or there is none.
type Cut = fn(usize) -> Vec<Vec<u8>>;

fn in_sixes(mut packets: Vec<OscPacket>, time: OscPacket, is_last: bool) -> Vec<Vec<u8>> {
    packets.insert(if is_last { packets.len() } else { 0 }, time);
    packets.chunks(6).map(bundle).collect()
}

fn secs(number: usize) -> f64 {
    5.0 + number as f64 / 60.0
}

const CUTS: [(&str, Cut); 7] = [
    ("message by message, time first", |number| {
        alone(&[vec![time(secs(number))], messages(number), vec![blend()]].concat())
    }),
    ("message by message, time last", |number| alone(&[messages(number), vec![blend(), time(secs(number))]].concat())),
    ("message by message, without a time", |number| alone(&messages(number))),
    ("bundles of six, time first", |number| in_sixes(messages(number), time(secs(number)), false)),
    ("bundles of six, time last", |number| in_sixes(messages(number), time(secs(number)), true)),
    ("time and root, then bundles", |number| {
        let mut datagrams = vec![bundle(&[time(secs(number)), blend()])];
        datagrams.extend(messages(number).chunks(6).map(bundle));
        datagrams
    }),
    ("one bundle", |number| vec![bundle(&[vec![time(secs(number))], messages(number)].concat())]),
];

#[test]
fn no_sample_has_hips_alone_or_the_bones_of_two_frames_however_the_frame_is_cut() {
    for (name, cut) in CUTS {
        let frames: Vec<Vec<u8>> = (0..40).flat_map(cut).collect();
        let a_frame = frames.len() / 40;
        // The port may be opened at any moment of a frame.
        for skipped in 0..=a_frame {
            let mut reader = VmcReader::new();
            let mut heard = Vec::new();
            for (place, bytes) in frames.iter().enumerate().skip(skipped) {
                let arrival = (place / a_frame) as f64 / 60.0;
                reader.datagram(bytes, arrival, &mut |sample| heard.push(sample)).unwrap();
            }
            // A frame cut off at the start, and one to learn what belongs to a frame.
            assert!(heard.len() >= 37, "{name}, {skipped} skipped: {} samples", heard.len());
            for sample in &heard {
                let (spine, toes) = (sample.turn(Part::Spine), sample.turn(Part::RightToes));
                let number = ((2.0 * spine.z.asin() - 0.3) / 0.01).round();
                // Half a step between two frames, and far above single precision.
                assert!((2.0 * spine.z.asin() + 2.0 * toes.z.asin()).abs() < 0.005, "{name}, {skipped}: two frames");
                assert!(number >= 0.0, "{name}, {skipped}: a bone that has not arrived");
                // A sample without the hips of its frame would be a centimetre behind.
                assert!((sample.hips_m().z - 0.01 * number).abs() < 0.005, "{name}, {skipped}: hips of another frame");
            }
        }
    }
}

#[test]
fn clocks_that_stand_still_or_count_from_1970_are_replaced_by_the_arrival() {
    // Single precision has steps of 128 s there.
    for (name, told) in [("since 1970", 1_796_050_688.0), ("always zero", 0.0), ("always the same", 77.5)] {
        let mut reader = VmcReader::new();
        let mut heard = Vec::new();
        for number in 0..300 {
            let bytes = bundle(&[vec![time(told)], messages(0)].concat());
            reader.datagram(&bytes, 3.0 + number as f64 / 60.0, &mut |sample| heard.push(sample)).unwrap();
        }
        assert!(reader.goes_by_arrival(), "{name}");
        assert_eq!(heard.len(), 300);
        let times: Vec<f64> = heard.iter().map(|sample| sample.time_secs).collect();
        // The first three of a clock that stands still could be copies.
        for pair in times[3..].windows(2) {
            assert!((pair[1] - pair[0] - 1.0 / 60.0).abs() < 1e-9, "{name}: {pair:?}");
        }
        assert!(times[3] - times[0] < 0.1, "{name}: without a jump");
    }
    let mut reader = VmcReader::new();
    for number in 0..300 {
        let bytes = bundle(&[vec![time(secs(number))], messages(0)].concat());
        // Every datagram twice, as some networks deliver.
        for _ in 0..2 {
            reader.datagram(&bytes, number as f64 / 60.0, &mut |_| ()).unwrap();
        }
    }
    assert!(!reader.goes_by_arrival(), "copies are not a clock that stands still");
}

/// Sends 30 frames to a port through `send`, and returns the number of samples that come out.
fn heard_of(send: &mut dyn FnMut(usize, std::net::SocketAddr)) -> (usize, sinew_live::PortCounters) {
    let port = Port::vmc("127.0.0.1:0".parse().unwrap()).unwrap();
    let mut heard = 0;
    for number in 0..30 {
        send(number, port.address());
        heard += std::iter::from_fn(|| port.next()).count();
        // A burst would overflow the socket's buffer.
        std::thread::sleep(Duration::from_millis(2));
    }
    let began = Instant::now();
    while heard < 30 && began.elapsed() < Duration::from_secs(2) {
        heard += std::iter::from_fn(|| port.next()).count();
        std::thread::sleep(Duration::from_millis(5));
    }
    (heard, port.counters())
}

#[test]
fn a_socket_for_each_frame_or_message_is_one_performer() {
    for (cut, least) in [(CUTS[6].1, 30), (CUTS[0].1, 29), (CUTS[4].1, 29)] {
        let (heard, counters) = heard_of(&mut |number, to| {
            for bytes in cut(number) {
                UdpSocket::bind("127.0.0.1:0").unwrap().send_to(&bytes, to).unwrap();
            }
        });
        assert_eq!(counters.foreign, 0);
        assert!(heard >= least, "{heard} samples of 30");
    }
}

#[test]
fn a_face_beside_a_body_is_no_performer_and_a_second_body_is_foreign() {
    let [body, face, second] = [(); 3].map(|()| UdpSocket::bind("127.0.0.1:0").unwrap());
    let (heard, counters) = heard_of(&mut |number, to| {
        // The face has a clock of its own.
        face.send_to(&bundle(&[blend(), time(900.0 + number as f64)]), to).unwrap();
        body.send_to(&CUTS[6].1(number)[0], to).unwrap();
        if number >= 10 {
            second.send_to(&CUTS[6].1(number)[0], to).unwrap();
        }
    });
    assert_eq!(heard, 30, "of the body alone");
    assert_eq!(counters.foreign, 20, "every frame of the second body");
    assert!(counters.beside >= 25, "{}", counters.beside);
}
