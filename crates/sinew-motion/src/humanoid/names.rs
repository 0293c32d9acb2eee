//! Parses joint names of all known dialects into body parts.
//!
//! One normaliser splits a name (`mixamorig:LeftUpLeg`, `Bip01 L Thigh`, `upper_arm.L`, `lfemur`), one table gives the
//! meaning of the rest. Ambiguous names, which mean different parts in different dialects (`LeftShoulder`, `LeftLeg`,
//! `LeftHip`), have their own kind here; [`super::by_name`] decides by their neighbours.

use crate::{Part, Side};
use std::collections::BTreeMap;

/// What the stem of a joint's name means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Hips or pelvis. With a side (`LeftHip`) it is the pivot of the upper leg.
    Hips,
    /// The root of the file: the hips when nothing better is named.
    Root,
    /// Lower trunk, and anything between hips and neck.
    Trunk,
    /// Upper chest, as VRM names it.
    UpperChest,
    Neck,
    Head,
    /// A collar bone whatever else there is.
    Collar,
    /// A collar bone (`LeftShoulder`, `LeftArm`) or an upper arm (`LeftCollar`, `LeftShoulder`, `LeftElbow`).
    Shoulder,
    UpperArm,
    /// An upper arm (`LeftArm`, `LeftForeArm`), or any joint of an arm.
    Arm,
    LowerArm,
    /// The hand, named after its pivot. Where `hand` hangs from it, this one is the hand.
    Wrist,
    Hand,
    UpperLeg,
    /// A lower leg (`LeftUpLeg`, `LeftLeg`) or an upper leg (`LeftLeg`, `LeftKnee`).
    Leg,
    LowerLeg,
    /// The foot, named after its pivot. Where `foot` hangs from it, this one is the foot.
    Ankle,
    Foot,
    Toes,
    Tail,
    /// Known, but not one of our parts: fingers, face, twists, helpers.
    Other,
}

/// The stems of all dialects, without side, case, digits and separators.
const STEMS: &[(Kind, &[&str])] = &[
    (Kind::Hips, &["hips", "hip", "pelvis"]),
    (Kind::Root, &["root", "reference", "bodyroot"]),
    (
        Kind::Trunk,
        &[
            "spine",
            "chest",
            "torso",
            "trunk",
            "abdomen",
            "waist",
            "belly",
            "stomach",
            "lowerback",
            "upperback",
            "back",
            "thorax",
            "lowerspine",
            "middlespine",
            "midspine",
            "upperspine",
            "lumbar",
            "lowerchest",
            "ribcage",
            "lowertorso",
            "uppertorso",
            "abdomenlower",
            "abdomenupper",
            "chestlower",
            "sternum",
            "tospine",
        ],
    ),
    (Kind::UpperChest, &["upperchest", "chestupper"]),
    (Kind::Neck, &["neck", "lowerneck", "upperneck", "necklower", "neckupper", "necktwist", "cervical"]),
    (Kind::Head, &["head", "skull"]),
    (
        Kind::Collar,
        &["collar", "clavicle", "clav", "collarbone", "clavicula", "shoulderjoint", "scapula", "innershoulder"],
    ),
    (Kind::Shoulder, &["shoulder"]),
    (Kind::UpperArm, &["upperarm", "uparm", "humerus", "shldr", "shldrbend", "bicep", "armupper", "uarm"]),
    (Kind::Arm, &["arm"]),
    (Kind::LowerArm, &["lowerarm", "forearm", "lowarm", "elbow", "radius", "forearmbend", "armlower", "ulna"]),
    (Kind::Wrist, &["wrist"]),
    (Kind::Hand, &["hand", "palm"]),
    (Kind::UpperLeg, &["upperleg", "upleg", "thigh", "femur", "thighbend", "legupper", "uleg"]),
    (Kind::Leg, &["leg"]),
    (Kind::LowerLeg, &["lowerleg", "lowleg", "calf", "shin", "knee", "tibia", "leglower", "crus"]),
    (Kind::Ankle, &["ankle"]),
    (Kind::Foot, &["foot"]),
    (Kind::Toes, &["toe", "toes", "toebase", "ball", "foottoe", "forefoot"]),
    (Kind::Tail, &["tail"]),
    (
        Kind::Other,
        &[
            "hipjoint",
            "buttock",
            "finger",
            "fingers",
            "fingerbase",
            "thumb",
            "index",
            "middle",
            "mid",
            "ring",
            "pinky",
            "eye",
            "jaw",
            "face",
            "headtop",
            "headend",
            "headnub",
        ],
    ),
];

/// Words that mark a joint as not one of our parts, anywhere in its name.
const HELPERS: &[&str] = &[
    "ik",
    "fk",
    "twist",
    "roll",
    "nub",
    "end",
    "site",
    "target",
    "pole",
    "ctrl",
    "control",
    "helper",
    "weapon",
    "prop",
    "hair",
    "skirt",
    "cloth",
    "cape",
    "breast",
    "eye",
    "ear",
    "face",
    "facial",
    "cheek",
    "chin",
    "eyelid",
    "forehead",
    "jaw",
    "mouth",
    "brow",
    "tongue",
    "teeth",
    "lip",
    "nose",
    "thumb",
    "index",
    "middle",
    "ring",
    "pinky",
    "little",
    "finger",
    "fingers",
    "metacarpal",
    "carpal",
    "footsteps",
    "camera",
    "handle",
    "attach",
    "socket",
    "dummy",
    "corrective",
    "muscle",
];

/// Prefixes without meaning for the body.
const PREFIXES: &[&str] = &[
    "mixamorig",
    "bip",
    "bone",
    "valve",
    "valvebiped",
    "biped",
    "j",
    "b",
    "c",
    "m",
    "def",
    "org",
    "mch",
    "cc",
    "base",
    "jnt",
    "joint",
    "bn",
    "bind",
    "skel",
    "skeleton",
    "armature",
    "character",
    "rig",
    "sk",
    "hik",
    "actor",
    "body",
];

/// Suffixes without meaning for the body.
const SUFFIXES: &[&str] = &["joint", "jnt", "bone", "bind", "base", "jt", "skin"];

/// The signs for left and right in Chinese and Japanese.
const SIGNS: [char; 2] = ['左', '右'];

/// Words for left: English, German, Dutch, French, Spanish, Portuguese, Italian, Scandinavian, Finnish, Polish, Russian,
/// Japanese, Chinese, Korean. Words that mean something else too (French `droit`, Spanish `der`) count as words of their own only.
const LEFT: &[&str] = &[
    "l",
    "left",
    "lft",
    "links",
    "linke",
    "linker",
    "linkes",
    "linken",
    "gauche",
    "izq",
    "izquierda",
    "izquierdo",
    "esquerda",
    "esquerdo",
    "esq",
    "sinistra",
    "sinistro",
    "sx",
    "vänster",
    "vänstra",
    "venstre",
    "vasen",
    "lewy",
    "lewa",
    "lewe",
    "левый",
    "левая",
    "левое",
    "левой",
    "лев",
    "hidari",
    "左",
    "왼",
    "왼쪽",
];

/// The same words for right.
const RIGHT: &[&str] = &[
    "r",
    "right",
    "rgt",
    "rechts",
    "rechte",
    "rechter",
    "rechtes",
    "rechten",
    "droite",
    "droit",
    "der",
    "derecha",
    "derecho",
    "direita",
    "direito",
    "destra",
    "destro",
    "dx",
    "höger",
    "högra",
    "høyre",
    "højre",
    "oikea",
    "prawy",
    "prawa",
    "prawe",
    "правый",
    "правая",
    "правое",
    "правой",
    "прав",
    "migi",
    "右",
    "오른",
    "오른쪽",
];

/// A parsed joint name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    /// The side that the name gives.
    pub side: Option<Side>,
    /// What its stem means, where the table knows it.
    pub kind: Option<Kind>,
}

/// Reads the names of a whole skeleton: a first word that most of the names share is a prefix.
pub(super) fn read(names: &[&str]) -> Vec<Name> {
    let words: Vec<Vec<String>> = names.iter().map(|name| split(name)).collect();
    let mut first: BTreeMap<&str, usize> = BTreeMap::new();
    for word in words.iter().filter(|words| words.len() > 1).map(|words| words[0].as_str()) {
        *first.entry(word).or_default() += 1;
    }
    // The sides each begin about 40 % of the names at most.
    let shared = first.into_iter().find(|&(_, count)| names.len() > 3 && count * 2 > names.len()).map(|(word, _)| word);
    words.iter().map(|words| understand(words, shared)).collect()
}

/// The lower-case words of a name, digits left out: cut at separators, case changes and digits.
fn split(name: &str) -> Vec<String> {
    let name = name.rsplit([':', '|']).next().unwrap_or(name);
    let letters: Vec<char> = name.chars().collect();
    let mut words = Vec::new();
    let mut word = String::new();
    for (at, &letter) in letters.iter().enumerate() {
        let cut = letter.is_uppercase()
            && at > 0
            && (letters[at - 1].is_lowercase()
                || letters[at - 1].is_uppercase() && letters.get(at + 1).is_some_and(|next| next.is_lowercase()));
        if (cut || !letter.is_alphabetic()) && !word.is_empty() {
            words.push(std::mem::take(&mut word));
        }
        if letter.is_alphabetic() {
            word.extend(letter.to_lowercase());
        }
        // Chinese and Japanese write no spaces: the sign for a side is a word of its own.
        if word.ends_with(SIGNS) {
            let sign = word.pop();
            words.extend((!word.is_empty()).then(|| std::mem::take(&mut word)));
            words.extend(sign.map(String::from));
        }
    }
    if !word.is_empty() {
        words.push(word);
    }
    words
}

fn understand(words: &[String], shared: Option<&str>) -> Name {
    let mut words: Vec<&str> = words.iter().map(String::as_str).collect();
    if let Some(shared) = shared
        && words.len() > 1
        && words[0] == shared
    {
        words.remove(0);
    }
    let mut side = words.iter().find_map(|word| side_word(word));
    words.retain(|word| side_word(word).is_none());
    while words.len() > 1 && PREFIXES.contains(&words[0]) {
        words.remove(0);
    }
    if words.iter().any(|word| HELPERS.contains(word)) {
        // `neckTwist01` is Daz's neck; everything else that twists only helps the skin.
        let kind = kind_of(&words.concat()).unwrap_or(Kind::Other);
        return Name { side, kind: Some(kind) };
    }
    side = side.or_else(|| words.iter().find_map(|word| side_at_end(word)));
    let mut kind = kind_of(&words.concat());
    while kind.is_none() && words.len() > 1 && words.last().is_some_and(|word| SUFFIXES.contains(word)) {
        words.pop();
        kind = kind_of(&words.concat());
    }
    if kind.is_none() && side.is_none() {
        // `lefthand`, `lfemur`: the side is stuck to the stem. Longest marker first.
        let stem = words.concat();
        for (marker, marked) in [("left", Side::Left), ("right", Side::Right), ("l", Side::Left), ("r", Side::Right)] {
            if let Some(found) = stem.strip_prefix(marker).and_then(kind_of) {
                (side, kind) = (Some(marked), Some(found));
                break;
            }
        }
    }
    Name { side, kind }
}

fn side_word(word: &str) -> Option<Side> {
    let is_one_of = |words: &[&str]| words.contains(&word);
    if is_one_of(LEFT) {
        Some(Side::Left)
    } else if is_one_of(RIGHT) {
        Some(Side::Right)
    } else {
        None
    }
}

/// The side of a word with the word for a side stuck to it: `armlinks`, `왼팔`. Short ones would be found in other words.
fn side_at_end(word: &str) -> Option<Side> {
    const LETTERS: usize = 6;
    let has = |sides: &[&str], short: &str| {
        let long = sides.iter().copied().filter(|side| side.chars().count() >= LETTERS || !side.is_ascii());
        long.chain([short]).any(|side| word.starts_with(side) || word.ends_with(side))
    };
    match (has(LEFT, "links"), has(RIGHT, "rechts")) {
        (true, false) => Some(Side::Left),
        (false, true) => Some(Side::Right),
        _ => None,
    }
}

/// The part that a name means in any dialect, as [`Part`](crate::Part) reads it: an arm is an upper arm and a leg a lower leg, as
/// Mixamo has them.
pub(crate) fn part_of_name(text: &str) -> Option<Part> {
    // A long text is no name.
    let text = text.get(..MOST_BYTES).map_or(text, |_| "");
    let name = understand(&split(text), None);
    let left = match (name.kind?, name.side) {
        (Kind::Trunk, None) => return trunk_of_name(text),
        (Kind::Hips, None) => return Some(Part::Hips),
        (Kind::UpperChest, None) => return Some(Part::UpperChest),
        (Kind::Neck, None) => return Some(Part::Neck),
        (Kind::Head, None) => return Some(Part::Head),
        (_, None) => return None,
        (Kind::Collar | Kind::Shoulder, _) => Part::LeftShoulder,
        (Kind::UpperArm | Kind::Arm, _) => Part::LeftUpperArm,
        (Kind::LowerArm, _) => Part::LeftLowerArm,
        (Kind::Hand | Kind::Wrist, _) => Part::LeftHand,
        (Kind::UpperLeg, _) => Part::LeftUpperLeg,
        (Kind::LowerLeg | Kind::Leg, _) => Part::LeftLowerLeg,
        (Kind::Foot | Kind::Ankle, _) => Part::LeftFoot,
        (Kind::Toes, _) => Part::LeftToes,
        _ => return None,
    };
    Some(if name.side == Some(Side::Left) { left } else { left.mirrored() })
}

/// Longest name of a part in bytes.
const MOST_BYTES: usize = 64;

/// `Spine`, `Spine1`, `Spine2` of Mixamo and `spine_01` to `spine_03` of Unreal, from below; and the chest.
fn trunk_of_name(text: &str) -> Option<Part> {
    let text = text.to_lowercase();
    let text = text.rsplit([':', '|']).next()?;
    let digits = text.trim_start_matches(|letter: char| !letter.is_ascii_digit());
    let stem: String = text[..text.len() - digits.len()].chars().filter(char::is_ascii_lowercase).collect();
    match (stem.as_str(), digits) {
        ("spine", "" | "01" | "001") => Some(Part::Spine),
        ("spine", "1" | "02" | "002") | ("chest", "") => Some(Part::Chest),
        ("spine", "2" | "03" | "003") => Some(Part::UpperChest),
        _ => None,
    }
}

fn kind_of(stem: &str) -> Option<Kind> {
    STEMS.iter().find(|(_, stems)| stems.contains(&stem)).map(|&(kind, _)| kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(name: &str) -> (Option<Side>, Option<Kind>) {
        let name = read(&[name]).remove(0);
        (name.side, name.kind)
    }

    #[test]
    fn every_dialect_names_the_left_thigh_or_arm() {
        for name in [
            "LeftUpLeg",
            "lThigh",
            "lfemur",
            "mixamorig:LeftUpLeg",
            "Bip01 L Thigh",
            "thigh_l",
            "J_Bip_L_UpperLeg",
            "thigh.L",
            "ValveBiped.Bip01_L_Thigh",
            "CC_Base_L_Thigh",
            "DEF-thigh.L",
            "leftUpperLeg",
            "Character1_LeftUpLeg",
        ] {
            let names = ["Character1_Hips", "Character1_Spine", "Character1_Head", name];
            let read = read(&names).remove(3);
            assert_eq!((read.side, read.kind), (Some(Side::Left), Some(Kind::UpperLeg)), "{name}");
        }
        for name in ["upper_arm.R", "upperarm_r", "rShldr", "rhumerus", "J_Bip_R_UpperArm", "Bip01 R UpperArm"] {
            assert_eq!(one(name), (Some(Side::Right), Some(Kind::UpperArm)), "{name}");
        }
    }

    #[test]
    fn helpers_and_fingers_are_no_parts() {
        for name in [
            "ik_foot_l",
            "upperarm_twist_01_l",
            "Bip01LFinger0Nub",
            "LeftHandIndex1",
            "LeftInHandMiddle",
            "LThumb",
            "LeftFootThumb1",
            "Head_Nub",
            "LHipJoint",
            "lhipjoint",
            "rButtock",
            "LFingers",
            "leftEye",
            "Bip01 Footsteps",
        ] {
            assert_eq!(one(name).1, Some(Kind::Other), "{name}");
        }
    }

    #[test]
    fn words_that_begin_like_a_side_are_no_side() {
        for (name, kind) in
            [("lowerback", Kind::Trunk), ("root", Kind::Root), ("lowerneck", Kind::Neck), ("Ribcage", Kind::Trunk)]
        {
            assert_eq!(one(name), (None, Some(kind)), "{name}");
        }
        assert_eq!(one("Lefthand"), (Some(Side::Left), Some(Kind::Hand)));
        assert_eq!(one("lshoulderjoint"), (Some(Side::Left), Some(Kind::Collar)));
    }
}
