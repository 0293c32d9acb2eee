//! What one does on one machine reaches another who holds the same rope.

use sinew::jobs::session::{ServeJob, first_effect, serve};
use sinew::live::session::{Client, LinkConditions, Relay, Role, SceneManifest, Server, ServerSettings, Token};
use sinew::stage::Scene;
use std::time::Duration;

#[path = "../../../sinew-live/tests/all/session_setup/scene.rs"]
mod scene;

use scene::SCENE;

/// The way takes 40 ms each way; what is left is how long the server takes, and that is counted in its own steps. Whether the whole
/// takes no longer by the clock is measured on real hosts, by `cargo xtask two-hosts`: a test that reads no clock cannot fail
/// because the machine is busy.
#[test]
fn a_pull_reaches_the_other_within_two_steps_of_its_arrival() {
    let scene = Scene::from_text(SCENE).expect("the scene is sound");
    let settings = ServerSettings { bind: ([127, 0, 0, 1], 0).into(), ..ServerSettings::default() };
    let (server, queue) =
        Server::open(&settings, SceneManifest::of(&scene).expect("it is small")).expect("loopback is there");
    let conditions = LinkConditions { delay: Duration::from_millis(40), ..LinkConditions::default() };
    let relay = Relay::start(([127, 0, 0, 1], 0).into(), server.address(), conditions).expect("loopback is there");
    let token = Token { port: relay.address().port(), ..server.token(Role::Actor).clone() };
    let actors = std::thread::spawn(move || {
        let join = |name: &str| Client::join(&token, &[name.to_owned()]).expect("it is let in");
        let (red, blue) = (join("red"), join("blue"));
        for _ in 0..3 {
            for _ in 0..30 {
                red.next_frame(Duration::from_secs(10)).expect("frames come");
            }
            red.press("p");
        }
        // Until the stage ends: what it shows goes on arriving.
        while red.next_frame(Duration::from_secs(2)).is_some() {}
        (red.stats(), blue.stats())
    });
    let job = ServeJob { for_secs: Some(6.0), keeps_take: true, ..ServeJob::default() };
    let served = serve(scene, &job, &server, queue, &mut []).expect("it runs");
    drop(server);
    let (red, blue) = actors.join().expect("the actors end well");
    let take = served.take.expect("it was asked for");
    assert_eq!(served.report.applied.len(), 3, "{red:?}");
    for (place, applied) in served.report.applied.iter().enumerate() {
        assert_eq!(take.commands[place].step, applied.step, "the take has it where it was applied");
        let reached = first_effect(&take, place, "blue", None).expect("the take is sound").expect("the rope is taut");
        assert!(reached - applied.arrived_step <= 2, "{applied:?}, reached blue at {reached}");
    }
    for stats in [red, blue] {
        assert_eq!((stats.frames_that_differ, stats.frames_malformed), (0, 0));
        // Two ways of 40 ms, and no less.
        assert!(stats.round_trip_ms >= 80.0, "{}", stats.round_trip_ms);
        let common: Vec<&u64> = stats.hashes.keys().collect();
        assert!(!common.is_empty());
        for step in common {
            assert_eq!(stats.hashes[step], served.report.hashes[step], "step {step}");
        }
    }
}
