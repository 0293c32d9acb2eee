//! The scene of the tests of sessions.

/// Two who hold on to each other, a performer, and a ball on the floor.
pub const SCENE: &str = r#"
format = 1
[characters.red]
position_m = [0, 0, 0]
[characters.blue]
position_m = [0, 0, 1.2]
facing_deg = 180
[characters.green]
position_m = [3, 0, 0]
source = { live = {} }
tracker = "kinematic"
[props.ball]
ball_radius_m = 0.1
mass_kg = 1
position_m = [1, 0.5, 0]
[[at]]
time_secs = 0
character = "red"
do = "attach"
link = "rightHand"
object = "blue.leftHand"
soft = true
[[keys]]
key = "p"
character = "red"
do = "push"
on = "rightHand"
force_n = [0, 0, -150]
for_secs = 0.2
[[keys]]
key = "b"
do = "place"
object = "ball"
velocity_m_s = [0, 2, 0]
"#;
