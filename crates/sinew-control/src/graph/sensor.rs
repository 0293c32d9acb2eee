//! Sensors of a graph.

use super::names::{Thing, Touchable};
use super::spec::Quantity;
use glam::DVec3;
use sinew_body::humanoid::support_margin_m;
use sinew_world::{BodyState, CharacterFrame, CharacterId, Entity, Frame};

/// A measured value and its thresholds, names resolved.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sensor {
    pub(super) of: Thing,
    pub(super) to: Option<Thing>,
    pub(super) is: Quantity,
    pub(super) below: Option<f64>,
    pub(super) above: Option<f64>,
}

/// Margin of a body in the air \[m\], a finite number that no polygon has.
const IN_THE_AIR_M: f64 = -1000.0;

impl Sensor {
    /// Its value, if it is beyond the thresholds.
    pub(super) fn fires(&self, frame: &Frame, own: CharacterId, step_secs: f64) -> Option<f64> {
        let value = self.value(frame, own, step_secs)?;
        let fires = self.below.is_none_or(|below| value < below) && self.above.is_none_or(|above| value > above);
        (fires && value.is_finite()).then_some(value)
    }

    /// `None` for an object that is not in the frame.
    fn value(&self, frame: &Frame, own: CharacterId, step_secs: f64) -> Option<f64> {
        let character = frame.character(own)?;
        let of = self.of.seen_by(own);
        Some(match self.is {
            Quantity::HeightM => centre(frame, of)?.y,
            Quantity::SpeedMS => {
                let velocity = velocity(frame, of)?;
                DVec3::new(velocity.x, 0.0, velocity.z).length()
            }
            Quantity::ForwardMS => velocity(frame, of)?.dot(character.facing),
            Quantity::UpMS => velocity(frame, of)?.y,
            Quantity::TiltDeg => tilt_deg(body(frame, of)?),
            Quantity::LoadN => {
                let impulses: f64 = frame
                    .contacts
                    .iter()
                    .filter(|contact| of.is(contact.a) || of.is(contact.b))
                    .map(|contact| contact.impulse.length())
                    .sum();
                impulses / step_secs
            }
            Quantity::DistanceM => (centre(frame, self.to?.seen_by(own))? - centre(frame, of)?).length(),
            Quantity::ComMarginM => com_margin_m(character),
        })
    }
}

/// How far the centre of mass lies inside the support polygon \[m\].
fn com_margin_m(character: &CharacterFrame) -> f64 {
    support_margin_m(&character.support, character.centre_of_mass).max(IN_THE_AIR_M)
}

fn tilt_deg(body: &BodyState) -> f64 {
    let up = body.rotation * DVec3::Y;
    libm::atan2((up.x * up.x + up.z * up.z).sqrt(), up.y).to_degrees()
}

fn body(frame: &Frame, thing: Touchable) -> Option<&BodyState> {
    match thing {
        Touchable::One(Entity::Floor) => None,
        Touchable::One(Entity::Prop(index)) => frame.prop(index),
        Touchable::One(Entity::Part(index, node)) => Some(frame.character(index)?.part(node)),
        // The rotation of a whole body is that of its hips.
        Touchable::Character(index) => frame.character(index)?.parts.first(),
    }
}

fn centre(frame: &Frame, thing: Touchable) -> Option<DVec3> {
    match thing {
        Touchable::Character(index) => Some(frame.character(index)?.centre_of_mass),
        one => body(frame, one).map(|body| body.centre),
    }
}

fn velocity(frame: &Frame, thing: Touchable) -> Option<DVec3> {
    match thing {
        Touchable::Character(index) => Some(frame.character(index)?.centre_velocity),
        one => body(frame, one).map(|body| body.velocity),
    }
}
