//! Body parts, named as VRM 1.0 humanoid bones.

use crate::choice::nearest_name;
use crate::humanoid::part_of_name;
use std::fmt;
use std::str::FromStr;

/// A side of the body. The character's left is +X when it faces +Z with Y up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Side {
    Left,
    Right,
}

macro_rules! parts {
    ($($variant:ident $name:literal $parent:ident $side:ident),* $(,)?) => {
        /// A body part, with the name that the VRM 1.0 humanoid gives it.
        ///
        /// ```
        /// use sinew_motion::Part;
        /// let part: Part = "leftHand".parse().unwrap();
        /// assert_eq!(part.mirrored().name(), "rightHand");
        /// assert_eq!(part.parent(), Some(Part::LeftLowerArm));
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[allow(missing_docs, reason = "the VRM names say it")]
        #[repr(u8)]
        pub enum Part { $($variant),* }

        impl Part {
            /// Every part, parents before children.
            pub const ALL: &'static [Part] = &[$(Part::$variant),*];

            /// The VRM 1.0 bone name, as files, reports and the command line write it.
            pub const fn name(self) -> &'static str {
                match self { $(Part::$variant => $name),* }
            }

            /// The part that this one hangs from when every part is present; `None` for the hips.
            pub const fn parent(self) -> Option<Part> {
                let parent = match self { $(Part::$variant => Part::$parent),* };
                if matches!(self, Part::Hips) { None } else { Some(parent) }
            }

            /// Left, right, or `None` on the midline.
            pub const fn side(self) -> Option<Side> {
                const LEFT: Option<Side> = Some(Side::Left);
                const RIGHT: Option<Side> = Some(Side::Right);
                const NONE: Option<Side> = None;
                match self { $(Part::$variant => parts!(@side $side LEFT RIGHT NONE)),* }
            }
        }
    };
    (@side L $l:ident $r:ident $n:ident) => { $l };
    (@side R $l:ident $r:ident $n:ident) => { $r };
    (@side M $l:ident $r:ident $n:ident) => { $n };
}

parts! {
    Hips "hips" Hips M,
    Spine "spine" Hips M,
    Chest "chest" Spine M,
    UpperChest "upperChest" Chest M,
    Neck "neck" UpperChest M,
    Head "head" Neck M,
    LeftShoulder "leftShoulder" UpperChest L,
    LeftUpperArm "leftUpperArm" LeftShoulder L,
    LeftLowerArm "leftLowerArm" LeftUpperArm L,
    LeftHand "leftHand" LeftLowerArm L,
    RightShoulder "rightShoulder" UpperChest R,
    RightUpperArm "rightUpperArm" RightShoulder R,
    RightLowerArm "rightLowerArm" RightUpperArm R,
    RightHand "rightHand" RightLowerArm R,
    LeftUpperLeg "leftUpperLeg" Hips L,
    LeftLowerLeg "leftLowerLeg" LeftUpperLeg L,
    LeftFoot "leftFoot" LeftLowerLeg L,
    LeftToes "leftToes" LeftFoot L,
    RightUpperLeg "rightUpperLeg" Hips R,
    RightLowerLeg "rightLowerLeg" RightUpperLeg R,
    RightFoot "rightFoot" RightLowerLeg R,
    RightToes "rightToes" RightFoot R,
}

impl Part {
    /// Number of parts.
    pub const COUNT: usize = Part::ALL.len();

    /// The part of a VRM 1.0 name, in any case; allocates nothing. [`FromStr`] knows other dialects too.
    ///
    /// ```
    /// # use sinew_motion::Part;
    /// assert_eq!(Part::named("LeftHand"), Some(Part::LeftHand));
    /// assert_eq!(Part::named("hand_l"), None);
    /// ```
    pub fn named(text: &str) -> Option<Part> {
        Part::ALL.iter().copied().find(|part| part.name().eq_ignore_ascii_case(text))
    }

    /// Its name in words: `left upper arm`.
    ///
    /// ```
    /// # use sinew_motion::Part;
    /// assert_eq!(Part::LeftUpperArm.words(), "left upper arm");
    /// ```
    pub fn words(self) -> String {
        let mut words = String::new();
        for letter in self.name().chars() {
            if letter.is_ascii_uppercase() {
                words.push(' ');
            }
            words.push(letter.to_ascii_lowercase());
        }
        words
    }

    /// The same part on the other side of the body; a midline part is its own mirror image.
    pub fn mirrored(self) -> Part {
        let name = self.name();
        let other = match self.side() {
            Some(Side::Left) => name.replacen("left", "right", 1),
            Some(Side::Right) => name.replacen("right", "left", 1),
            None => return self,
        };
        Part::named(&other).unwrap_or(self)
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// An unknown name of a body part.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no body part is called {0:?}; {1}parts are the VRM 1.0 bones: {all}", all = all_names())]
pub struct UnknownPart(String, String);

fn all_names() -> String {
    Part::ALL.iter().map(|part| part.name()).collect::<Vec<_>>().join(", ")
}

/// The one rule for names of parts, wherever they are typed: the VRM 1.0 name in any case, or what a joint of the part is called in
/// any dialect that Sinew reads (`LeftHand`, `left_hand`, `hand.L`, `mixamorig:LeftHand`, Unreal's `hand_l`). Words that mean
/// different joints in different dialects are read as Mixamo's: `LeftArm` is the upper arm, `LeftLeg` the lower leg.
///
/// ```
/// use sinew_motion::Part;
/// for name in ["leftHand", "LEFTHAND", "left_hand", "hand.L", "mixamorig:LeftHand", "hand_l", "Bip01 L Hand"] {
///     assert_eq!(name.parse(), Ok(Part::LeftHand));
/// }
/// assert!("leftHnad".parse::<Part>().unwrap_err().to_string().contains("did you mean `leftHand`"));
/// ```
impl FromStr for Part {
    type Err = UnknownPart;

    fn from_str(text: &str) -> Result<Part, UnknownPart> {
        let text = text.trim();
        Part::named(text).or_else(|| part_of_name(text)).ok_or_else(|| {
            let near = nearest_name(text, Part::ALL.iter().map(|part| part.name()));
            let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
            // What comes from a file may be long.
            UnknownPart(text.chars().take(60).collect(), near)
        })
    }
}
