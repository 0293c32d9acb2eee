//! How strong pins are.

use sinew_body::humanoid::{Body, Node};
use sinew_body::strength_gravity_m_s2;

/// Maximum force of a pin: of a part of a leg, and of another one \[weights of the body\]; times
/// [`KdSettings::strength`](super::KdSettings::strength). A foot is held so firmly that it would lift whatever it is under.
const MAX_WEIGHTS: [f64; 2] = [1.5, 4.0];

/// Maximum forces of the pins of a body \[N\] in a world of this downward gravity \[m/s²\]; by [`Node::index`].
pub(super) fn max_pin_forces_n(body: &Body, gravity_m_s2: f64, strength: f64) -> [f64; Node::COUNT] {
    let strength_n = body.mass_kg() * strength_gravity_m_s2(gravity_m_s2) * strength;
    Node::ALL.map(|node| strength_n * MAX_WEIGHTS[usize::from(!node.is_leg())])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn on_the_moon_pins_pull_by_what_the_body_weighs_there() {
        let body = Body::standard(80.0, 1.7);
        let (earth, moon) = (max_pin_forces_n(&body, 9.81, 1.0), max_pin_forces_n(&body, 1.62, 1.0));
        for node in Node::ALL {
            let ratio = moon[node.index()] / earth[node.index()];
            // Rounding of two products.
            assert!((ratio - 1.62 / 9.81).abs() < 1e-12, "{node:?}: {ratio}");
        }
        // 1.5 weights of 80 kg: the standard body's parts are shares of its mass that do not add up to the last digit.
        assert!((earth[Node::LeftFoot.index()] - 1.5 * 80.0 * 9.81).abs() < 1.0);
    }

    #[test]
    fn what_weighs_nothing_can_still_be_held() {
        let body = Body::standard(80.0, 1.7);
        let (earth, nowhere) = (max_pin_forces_n(&body, 9.81, 1.0), max_pin_forces_n(&body, 0.0, 1.0));
        assert!(nowhere.iter().zip(earth).all(|(nowhere, earth)| (nowhere / earth - 0.1).abs() < 1e-12));
    }
}
