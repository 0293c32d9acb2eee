//! Which joint is which part of a human body.
//!
//! Names come first ([`names`], [`by_name`]); what they leave open is found by the shape of the tree ([`by_shape`]);
//! the trunk is always found by what hangs from it ([`trunk`]); and in the end everything is checked ([`check`]). Where there
//! are several people, all this looks at the joints of one ([`people`]).

mod by_name;
mod by_shape;
mod check;
mod draft;
mod names;
mod people;
mod sides;
mod trunk;

use crate::{Clip, Error, Note, Part, Place, Side};
use draft::Draft;
pub(crate) use names::part_of_name;
pub(crate) use people::LEAST_JOINTS;
use people::Scope;

/// How a part was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The user named the joint.
    Override,
    /// The file says so: `humanBones` of VRM.
    Stated,
    /// The joint's name says so, in a dialect that Sinew knows.
    Name,
    /// Guessed from the shape of the tree: where limbs branch, how long bones are.
    Shape,
}

/// What is known of a body before it is looked for.
#[derive(Clone, Debug, Default)]
pub struct BodyHints {
    /// Joints that the user names for parts.
    pub parts: Vec<(Part, String)>,
    /// Which of several people: the name of their root joint or armature, or a number from 1 in the order of the joints. Without
    /// it the first.
    pub person: Option<String>,
    /// Parts as the file states them.
    pub stated: Vec<(Part, usize)>,
    /// Names of what stands above a root joint without being a joint.
    pub armatures: Vec<(usize, String)>,
}

/// A map from body parts to the joints of a skeleton, complete enough for a body: hips, chest, head or neck, and on both
/// sides upper and lower arm, upper and lower leg and foot. Hands, toes, shoulders, spine and neck may be missing.
///
/// ```
/// # use glam::DVec3;
/// # use sinew_motion::{Clip, Humanoid, Joint, Part, Skeleton, Transform};
/// # let mut skeleton = Skeleton::new();
/// # let mut add = |name: &str, parent: &str, x: f64, y: f64, z: f64| {
/// #     let parent = skeleton.find(parent);
/// #     let rest = Transform { translation: DVec3::new(x, y, z), ..Transform::IDENTITY };
/// #     skeleton.push(Joint { name: name.into(), parent, rest, tip: None });
/// # };
/// # add("Hips", "", 0.0, 0.9, 0.0);
/// # add("Spine", "Hips", 0.0, 0.1, 0.0);
/// # add("Chest", "Spine", 0.0, 0.2, 0.0);
/// # add("Head", "Chest", 0.0, 0.3, 0.0);
/// # for (side, x) in [("Left", 1.0), ("Right", -1.0)] {
/// #     for (name, parent, out, up, front) in [
/// #         ("UpLeg", "", 0.1, 0.0, 0.0), ("Leg", "UpLeg", 0.0, -0.4, 0.0), ("Foot", "Leg", 0.0, -0.4, 0.0),
/// #         ("ToeBase", "Foot", 0.0, -0.05, 0.1), ("Arm", "", 0.2, 0.2, 0.0), ("ForeArm", "Arm", 0.3, 0.0, 0.0),
/// #         ("Hand", "ForeArm", 0.25, 0.0, 0.0),
/// #     ] {
/// #         let parent = match name {
/// #             "UpLeg" => "Hips".to_owned(),
/// #             "Arm" => "Chest".to_owned(),
/// #             _ => format!("{side}{parent}"),
/// #         };
/// #         add(&format!("{side}{name}"), &parent, x * out, up, front);
/// #     }
/// # }
/// # let clip = Clip::new(skeleton, 1.0 / 60.0, vec![0]);
/// let humanoid = Humanoid::of(&clip, &[])?;
/// let shin = humanoid.joint(Part::LeftLowerLeg).unwrap();
/// assert_eq!(clip.skeleton().joints()[shin].name, "LeftLeg");
/// # Ok::<(), sinew_motion::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Humanoid {
    parts: Vec<Option<(usize, Origin)>>,
    unmapped: Vec<usize>,
    spine_chain: Vec<usize>,
    neck_chain: Vec<usize>,
    notes: Vec<Note>,
}

impl Humanoid {
    /// Finds the parts of the clip's skeleton. The clip may be in any unit and with any axis up: its frames are looked at
    /// only where names fail, and to tell a person from a four-legged animal.
    ///
    /// `overrides` name joints for parts, as the user wants them; they are taken before anything is guessed.
    ///
    /// # Errors
    /// The skeleton is not a human body, or its parts cannot be identified: the error says which part is missing or
    /// what contradicts a body, and lists the joints to choose from.
    pub fn of(clip: &Clip, overrides: &[(Part, String)]) -> Result<Humanoid, Error> {
        Humanoid::with(clip, &BodyHints { parts: overrides.to_vec(), ..BodyHints::default() })
    }

    /// The same, with all that may be known of the body before. What the user names comes before what the file states, and that
    /// before names and shape.
    ///
    /// # Errors
    /// As [`Humanoid::of`]; also, no person is called so.
    pub fn with(clip: &Clip, hints: &BodyHints) -> Result<Humanoid, Error> {
        let (scope, note) = people::choose(clip, hints)?;
        let mut humanoid = Humanoid::in_scope(clip, hints, &scope)?;
        humanoid.notes.splice(0..0, note);
        humanoid.notes.extend(sides::doubt(&humanoid, clip));
        Ok(humanoid)
    }

    fn in_scope(clip: &Clip, hints: &BodyHints, scope: &Scope) -> Result<Humanoid, Error> {
        let skeleton = clip.skeleton();
        let names = by_name::Names::new(skeleton, scope);
        let mut notes = Vec::new();
        let mut draft = overridden(clip, &hints.parts, scope)?;
        hints.stated.iter().for_each(|&(part, joint)| draft.offer(part, Some(joint), Origin::Stated));
        by_name::offer(&mut draft, &names);
        if check::limbs(&draft, skeleton).is_err() {
            let shape =
                by_shape::find(clip, scope, &names).map_err(|why| check::refusal(&draft, &names, clip, &why))?;
            sides::offer(&mut draft, clip, &names, &shape, &mut notes)?;
        }
        let trunk = trunk::find(&mut draft, skeleton, &names)?;
        check::all(&draft, skeleton)?;
        check::stands_on_two_legs(&draft, clip, &names)?;
        let parts: Vec<Option<(usize, Origin)>> =
            Part::ALL.iter().map(|&part| draft.joint(part).zip(draft.origin(part))).collect();
        let unmapped = (0..skeleton.len()).filter(|&joint| draft.part_of(joint).is_none()).collect();
        let (spine_chain, neck_chain) = (trunk.spine_chain, trunk.neck_chain);
        Ok(Humanoid { parts, unmapped, spine_chain, neck_chain, notes })
    }

    /// The joint of a part, `None` where the skeleton has none.
    pub fn joint(&self, part: Part) -> Option<usize> {
        self.parts[part as usize].map(|(joint, _)| joint)
    }

    /// How the part was found, `None` where the skeleton has none.
    pub fn origin(&self, part: Part) -> Option<Origin> {
        self.parts[part as usize].map(|(_, origin)| origin)
    }

    /// The part that a joint is.
    pub fn part(&self, joint: usize) -> Option<Part> {
        Part::ALL.iter().copied().find(|&part| self.joint(part) == Some(joint))
    }

    /// Every part that there is, with its joint, parents before children.
    pub fn parts(&self) -> impl Iterator<Item = (Part, usize)> + '_ {
        Part::ALL.iter().filter_map(|&part| self.joint(part).map(|joint| (part, joint)))
    }

    /// Joints that are not parts: fingers, helpers, joints in the middle of the spine. Ascending.
    pub fn unmapped(&self) -> &[usize] {
        &self.unmapped
    }

    /// The joints from above the hips up to and including the [chest](Humanoid::chest).
    pub fn spine_chain(&self) -> &[usize] {
        &self.spine_chain
    }

    /// The joints from above the chest up to and including the head (or the last of the neck).
    pub fn neck_chain(&self) -> &[usize] {
        &self.neck_chain
    }

    /// The joint that carries the legs and the trunk.
    pub fn hips(&self) -> usize {
        self.required(Part::Hips)
    }

    /// The joint that carries both arms and the neck: [`Part::UpperChest`] where a rig names one, else [`Part::Chest`].
    pub fn chest(&self) -> usize {
        self.joint(Part::UpperChest).unwrap_or_else(|| self.required(Part::Chest))
    }

    /// The head, or the last joint of the neck where there is no head.
    pub fn head(&self) -> usize {
        self.joint(Part::Head).unwrap_or_else(|| self.required(Part::Neck))
    }

    /// The upper leg, lower leg and foot of a side.
    pub fn leg(&self, side: Side) -> [usize; 3] {
        [Part::LeftUpperLeg, Part::LeftLowerLeg, Part::LeftFoot].map(|part| self.required(Draft::sided(part, side)))
    }

    /// The upper and lower arm of a side.
    pub fn arm(&self, side: Side) -> [usize; 2] {
        [Part::LeftUpperArm, Part::LeftLowerArm].map(|part| self.required(Draft::sided(part, side)))
    }

    /// The hand of a side; where there is none, the end of the lower arm is its tip.
    pub fn hand(&self, side: Side) -> Option<usize> {
        self.joint(Draft::sided(Part::LeftHand, side))
    }

    /// The toes of a side.
    pub fn toes(&self, side: Side) -> Option<usize> {
        self.joint(Draft::sided(Part::LeftToes, side))
    }

    /// What was guessed, and what looks odd.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// `Humanoid::of` has checked that it exists.
    fn required(&self, part: Part) -> usize {
        self.joint(part).expect("a part that every humanoid has")
    }
}

fn overridden(clip: &Clip, overrides: &[(Part, String)], scope: &Scope) -> Result<Draft, Error> {
    let mut draft = Draft::new();
    let joints = clip.skeleton().joints();
    for (part, name) in overrides {
        let is_called = |joint: &usize| joints[*joint].name == *name && scope.holds(*joint);
        let Some(joint) = (0..joints.len()).find(is_called) else {
            return Err(Error::new(
                Place::File,
                format!("no joint is called {name:?}, which was given for {part}"),
                format!("name one of {}", check::joint_names(clip.skeleton())),
            ));
        };
        if let Some(other) = draft.part_of(joint).filter(|other| other != part) {
            return Err(Error::new(
                Place::File,
                format!("joint {name:?} was given for both {other} and {part}"),
                "give each part a joint of its own",
            ));
        }
        draft.force(*part, joint, Origin::Override);
    }
    Ok(draft)
}
