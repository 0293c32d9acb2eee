//! Body parts, named as VRM 1.0 humanoid bones.

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
        other.parse().unwrap_or(self)
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// An unknown name of a body part.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no body part is called {0:?}; parts are the VRM 1.0 bones: hips, spine, chest, head, leftHand, ...")]
pub struct UnknownPart(String);

impl FromStr for Part {
    type Err = UnknownPart;

    fn from_str(text: &str) -> Result<Part, UnknownPart> {
        Part::ALL
            .iter()
            .copied()
            .find(|part| part.name().eq_ignore_ascii_case(text))
            .ok_or_else(|| UnknownPart(text.to_owned()))
    }
}
