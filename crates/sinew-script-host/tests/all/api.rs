//! Every word of the Python API, and what it says when it is used wrongly.

use crate::scene::{HIPS, LEFT_FOOT, RIGHT_HAND, error_of, snapshot, start, step_of};
use serde_json::{Value, json};
use sinew_script::{Contact, Thing};

/// The commands of a step, as a take would hold them.
fn commands(body: &str) -> Vec<Value> {
    let outcome = step_of(body);
    assert_eq!((outcome.error, outcome.killed), (None, None));
    outcome.commands.iter().map(|command| serde_json::to_value(command).unwrap()).collect()
}

/// The one command that a line makes, without its character.
fn own(line: &str) -> Value {
    let mut commands = commands(line);
    assert_eq!(commands.len(), 1, "{line}");
    let mut command = commands.remove(0);
    assert_eq!(command.as_object_mut().unwrap().remove("character"), Some(json!("left")), "{line}");
    command
}

/// What is left out is the same as null.
fn stated(mut command: Value) -> Value {
    if let Some(keys) = command.as_object_mut() {
        keys.retain(|_, value| !value.is_null());
    }
    command
}

#[test]
fn every_word_that_steers_makes_its_command() {
    let cases = [
        ("setTargetPose('Landing')", json!({"do": "pose", "name": "Landing"})),
        (
            "setIKTarget((1, 2, 3), link='leftFoot')",
            json!({"do": "ik", "link": "leftFoot", "target_m": [1.0, 2.0, 3.0]}),
        ),
        ("setIKTarget([1, 2, 3.5])", json!({"do": "ik", "link": null, "target_m": [1.0, 2.0, 3.5]})),
        (
            "reach((1, 2, 3), hand='left', time=1.5)",
            json!({"do": "reach", "hand": "left", "target_m": [1.0, 2.0, 3.0], "grasp": false, "avoid": [],
                "flexibility": 1.0, "time_secs": 1.5}),
        ),
        (
            "reach('Ball', grasp=True)",
            json!({"do": "reach", "hand": "auto", "object": "Ball", "grasp": true, "avoid": [], "flexibility": 1.0}),
        ),
        ("endReach()", json!({"do": "reach_end"})),
        ("releaseIK()", json!({"do": "ik_release", "link": null})),
        ("releaseIK('RightArm')", json!({"do": "ik_release", "link": "rightHand"})),
        (
            "attachLink('RightArm', 'Ball', soft=True, breakForce=50)",
            json!({"do": "attach", "link": "rightHand", "object": "Ball", "soft": true, "break_n": 50.0}),
        ),
        (
            "attachLink('RightArm', 'right.leftFoot')",
            json!({"do": "attach", "link": "rightHand", "object": "right.leftFoot", "soft": false, "break_n": null}),
        ),
        ("detachLink('RightArm', 'Ball')", json!({"do": "detach", "link": "rightHand", "object": "Ball"})),
        (
            "push('hips', (0, 0, -100), 0.1)",
            json!({"do": "push", "on": "hips", "force_n": [0.0, 0.0, -100.0], "for_secs": 0.1, "facing": false}),
        ),
        (
            "push('hips', (0, 0, 9), 0.1, facing=True)",
            json!({"do": "push", "on": "hips", "force_n": [0.0, 0.0, 9.0], "for_secs": 0.1, "facing": true}),
        ),
        ("setGain(2)", json!({"do": "gain", "factor": 2.0, "part": null})),
        ("setGain(0.5, part='RightArm')", json!({"do": "gain", "factor": 0.5, "part": "rightHand"})),
        ("forcesOff()", json!({"do": "forces_off", "parts": [], "for_secs": null})),
        ("forcesOff('hips', seconds=0.2)", json!({"do": "forces_off", "parts": ["hips"], "for_secs": 0.2})),
        ("forcesOn(['hips', 'RightArm'])", json!({"do": "forces_on", "parts": ["hips", "rightHand"]})),
        ("holdToPlane()", json!({"do": "plane", "facing_deg": null, "for_secs": null})),
        ("holdToPlane(90, seconds=2)", json!({"do": "plane", "facing_deg": 90.0, "for_secs": 2.0})),
        ("freePlane()", json!({"do": "plane_off"})),
        ("setGravity(0.5, seconds=1)", json!({"do": "gravity", "scale": 0.5, "on": null, "for_secs": 1.0})),
        ("setShape('leftFoot', 'skis')", json!({"do": "shape", "part": "leftFoot", "shape": "skis", "for_secs": null})),
        ("startGraph('walk', state='left')", json!({"do": "graph", "name": "walk", "state": "left"})),
        ("signal('go')", json!({"do": "signal", "name": "go"})),
        ("enableLayer('reflexes', False)", json!({"do": "layer", "layer": "reflexes", "on": false})),
        ("useReflex('balance')", json!({"do": "reflex", "name": "balance", "on": true})),
        ("useTracker('response')", json!({"do": "tracker", "name": "response"})),
    ];
    for (word, expected) in cases {
        assert_eq!(stated(own(&format!("skeleton.{word}"))), stated(expected), "{word}");
    }
    assert_eq!(own("say('hello')"), json!({"do": "say", "text": "hello"}));
}

#[test]
fn words_for_props_make_commands_of_the_stage() {
    assert_eq!(
        commands("place('Ball', position=(0, 1, 0), velocity=(0, 0, 2))\naccelerate('Rim', (1, 0, 0), 0.5)"),
        [
            json!({"do": "place", "object": "Ball", "position_m": [0.0, 1.0, 0.0], "velocity_m_s": [0.0, 0.0, 2.0]}),
            json!({"do": "accelerate", "object": "Rim", "acceleration_m_s2": [1.0, 0.0, 0.0], "for_secs": 0.5}),
        ]
    );
}

#[test]
fn every_word_that_senses_says_what_the_snapshot_holds() {
    let cases = [
        ("getPosition('Ball')", "(0.25, 1.5, 0.5)"),
        ("getPosition('left')", "(0.0, 0.0, 0.5)"),
        ("getPosition('right.leftFoot')", "(2.0, 2.0, 0.5)"),
        ("getPosition('RightArm')", "(0.0, 1.0, 0.5)"),
        ("getPosition(skeleton)", "(0.0, 0.0, 0.5)"),
        ("getVelocity('right.leftFoot')", "(0.0, 0.0, 2.0)"),
        ("skeleton.getPosition('leftFoot')", "(0.0, 2.0, 0.5)"),
        ("skeleton.getPosition()", "(0.0, 0.0, 0.5)"),
        ("skeleton.getVelocity('RightArm')", "(0.0, 0.0, 1.0)"),
        ("skeleton.getRotation('hips')", "(0.0, 0.0, 0.0, 1.0)"),
        ("skeleton.getFacing()", "(0.0, 0.0, 1.0)"),
        ("skeleton.getLeft()", "(1.0, 0.0, -0.0)"),
        ("skeleton.getCenterOfMass()", "(0.0, 0.9, 0.0)"),
        ("skeleton.getCenterOfMassVelocity()", "(0.0, -0.5, 0.0)"),
        ("len(skeleton.getSupport()), skeleton.getSupport()[2]", "3 (0.0, 0.0, 0.2)"),
        ("getCharacter('right').getCenterOfMass()", "(2.0, 0.9, 0.0)"),
        ("getCharacter('right').name, skeleton.name, skeleton", "right left <character left>"),
        ("getTime(), getStep(), getTimeStep() == 1 / 240", "0.05 12 True"),
        ("skeleton.isColliding(), isColliding('Ball', 'ground')", "False False"),
        ("skeleton.getContacts()", "[]"),
    ];
    for (word, expected) in cases {
        let outcome = step_of(&format!("print({word})"));
        assert_eq!(outcome.error, None, "{word}");
        assert_eq!(outcome.printed, [expected], "{word}");
    }
}

#[test]
fn contacts_are_told_from_the_character_s_own_side() {
    let mut snapshot = snapshot();
    let point = [0.1, 0.0, 0.2];
    let contact = |a, b| Contact { a, b, point, impulse: [0.0, 5.0, 0.0] };
    snapshot.contacts = vec![
        contact(Thing::Ground, Thing::Part(0, LEFT_FOOT)),
        contact(Thing::Part(0, RIGHT_HAND), Thing::Part(1, HIPS)),
        contact(Thing::Object(0), Thing::Object(1)),
    ];
    let text = "class C:\n    def step(self):\n        for c in skeleton.getContacts(): print(*c)\n        \
                print(skeleton.isColliding(), skeleton.isColliding('ground'), skeleton.isColliding(getCharacter('right')))\n        \
                print(isColliding('right', 'ground'), isColliding('right', 'RightArm'), isColliding('Rim', 'Ball'))\n";
    let outcome = start(text).unwrap().step(&snapshot);
    assert_eq!(outcome.error, None);
    assert_eq!(
        outcome.printed,
        [
            "leftFoot ground None (0.1, 0.0, 0.2) (0.0, 5.0, 0.0)",
            "rightHand right hips (0.1, 0.0, 0.2) (-0.0, -5.0, -0.0)",
            "True True True",
            "False True True",
        ]
    );
}

#[test]
fn unknown_names_are_answered_with_the_known_ones() {
    let cases = [
        ("skeleton.setTargetPose('Landin')", "no pose 'Landin'; there are: PrepareDunk, Landing"),
        ("skeleton.getPosition('arm')", "no part 'arm'; there are: hips, rightHand, leftFoot, RightArm"),
        ("skeleton.attachLink('RightArm', 'ball')", "no object 'ball'; there are: Ball, Rim"),
        ("skeleton.attachLink('RightArm', 'left.hips')", "no object 'left.hips'; there are: Ball, Rim"),
        ("skeleton.startGraph('run')", "no graph 'run'; there are: walk"),
        ("skeleton.setShape('hips', 'ski')", "no shape 'ski'; there are: own, none, skis"),
        ("skeleton.useReflex('fall')", "no reflex 'fall'; there are: balance"),
        ("skeleton.useTracker('kd')", "no tracker 'kd'; there are: kinematic, pd, response"),
        ("skeleton.enableLayer('script', True)", "no layer 'script'; there are: poses, scripts, reflexes"),
        ("getCharacter('middle')", "no character 'middle'; there are: left, right"),
        ("getPosition('rim')", "there are: Ball, Rim, left, right, ground, hips"),
        ("getPosition('right.arm')", "no part 'arm'; there are: hips"),
        ("isColliding('Ball', 'rim')", "no object, character or part 'rim'"),
        ("place('ball', (0, 0, 0))", "no object 'ball'"),
        ("getPosition('ground')", "everywhere"),
    ];
    for (line, expected) in cases {
        let message = error_of(line);
        assert!(message.contains(expected), "{line}: {message}");
    }
}

#[test]
fn wrong_values_are_refused_at_the_script_s_own_line() {
    let cases = [
        ("skeleton.setIKTarget((1, 2))", "pos must be three numbers (x, y, z), not 2"),
        ("skeleton.setIKTarget(5)", "pos must be three numbers (x, y, z), not int"),
        ("skeleton.setIKTarget((1, 'a', 2))", "pos must be a number, not str"),
        ("skeleton.setIKTarget((1, float('nan'), 2))", "pos must be finite"),
        ("skeleton.setIKTarget((1, 10 ** 400, 2))", "OverflowError"),
        ("skeleton.push('hips', (0, 1e400, 0), 1)", "force must be finite"),
        ("skeleton.push('hips', (0, 0, 0), -1)", "seconds must not be negative"),
        ("skeleton.push('hips')", "TypeError"),
        ("skeleton.setGain(-1)", "factor must not be negative"),
        ("skeleton.attachLink('hips', 'Ball', breakForce=0)", "breakForce must be above 0"),
        ("skeleton.setTargetPose(3)", "TypeError"),
        ("skeleton.forcesOff([3])", "parts must be names, not int"),
        ("getPosition(3)", "expected a name or a character, not int"),
        ("getCharacter('right').setTargetPose('Landing')", "controls 'left'; it can watch 'right' but not steer it"),
        ("skeleton.setTargetPos('Landing')", "AttributeError"),
    ];
    for (line, expected) in cases {
        let error = step_of(&format!("x = 1\ndef f():\n    {line}\nf()")).error.unwrap();
        assert!(error.message.contains(expected), "{line}: {error}");
        assert_eq!(error.line, Some(5), "{line}: {error}");
    }
}
