//! Checks whether a mapping is a complete human body.

use super::by_name::{self, Names, SIDES};
use super::draft::Draft;
use super::names::Kind;
use crate::pose::sample_poses;
use crate::{Clip, Error, Part, Place, Skeleton};

/// Parts of which each must hang from the one before, where they are there.
const CHAINS: [&[Part]; 4] = [
    &[Part::Hips, Part::LeftUpperLeg, Part::LeftLowerLeg, Part::LeftFoot, Part::LeftToes],
    &[Part::LeftShoulder, Part::LeftUpperArm, Part::LeftLowerArm, Part::LeftHand],
    &[Part::Hips, Part::Spine, Part::Chest, Part::UpperChest, Part::Head],
    &[Part::Hips, Part::Spine, Part::Chest, Part::Neck, Part::Head],
];

const LIMBS: [Part; 5] =
    [Part::LeftUpperArm, Part::LeftLowerArm, Part::LeftUpperLeg, Part::LeftLowerLeg, Part::LeftFoot];

const REMEDY: &str = "name the joints of the parts in ReadOptions::parts, or give a file with a human skeleton";

/// An error about the skeleton, with the joints that it has.
pub(super) fn error(problem: String, skeleton: &Skeleton) -> Error {
    Error::new(
        Place::File,
        format!("this skeleton cannot be mapped onto a human body: {problem}"),
        format!("{REMEDY}; its joints are {}", joint_names(skeleton)),
    )
}

/// Why neither names nor shape give a body.
pub(super) fn refusal(draft: &Draft, names: &Names, clip: &Clip, why: &str) -> Error {
    let skeleton = clip.skeleton();
    let mut draft = draft.clone();
    by_name::offer_stumps(&mut draft, names);
    let problem = match limbs(&draft, skeleton) {
        Err(problem) if Part::ALL.iter().any(|&part| draft.joint(part).is_some()) => {
            format!("{problem}, and by shape {why}")
        }
        _ => format!("its names are unknown, and {why}"),
    };
    error(problem, skeleton)
}

/// The joints' names, cut short when there are many.
pub(super) fn joint_names(skeleton: &Skeleton) -> String {
    const SHOWN: usize = 40;
    let mut text: Vec<String> = skeleton.joints().iter().take(SHOWN).map(|joint| format!("{:?}", joint.name)).collect();
    if skeleton.len() > SHOWN {
        text.push(format!("and {} more", skeleton.len() - SHOWN));
    }
    text.join(", ")
}

/// Whether limbs and head are complete and hang together; `Err` says what is missing or wrong.
pub(super) fn limbs(draft: &Draft, skeleton: &Skeleton) -> Result<(), String> {
    let sided = LIMBS.iter().flat_map(|&part| [part, part.mirrored()]);
    let mut missing: Vec<&str> = sided.filter(|&part| draft.joint(part).is_none()).map(Part::name).collect();
    for (arm, hand) in [Part::LeftLowerArm, Part::RightLowerArm].into_iter().zip([Part::LeftHand, Part::RightHand]) {
        // A body may be without hands; an arm that ends above them lacks them too.
        if draft.joint(arm).is_none() && draft.joint(hand).is_none() {
            missing.push(hand.name());
        }
    }
    if !missing.is_empty() {
        return Err(format!("no joint was found for {}", missing.join(", ")));
    }
    if draft.joint(Part::Head).or(draft.joint(Part::Neck)).is_none() {
        return Err("no joint was found for head or neck".to_owned());
    }
    chains(draft, skeleton)
}

fn chains(draft: &Draft, skeleton: &Skeleton) -> Result<(), String> {
    for side in SIDES {
        for chain in CHAINS {
            let mut above: Option<(Part, usize)> = None;
            for &part in chain {
                let part = Draft::sided(part, side);
                let Some(joint) = draft.joint(part) else { continue };
                if let Some((upper, upper_joint)) = above
                    && !skeleton.is_ancestor(upper_joint, joint)
                {
                    let name = |joint: usize| &skeleton.joints()[joint].name;
                    return Err(format!(
                        "{part} ({:?}) does not hang from {upper} ({:?})",
                        name(joint),
                        name(upper_joint)
                    ));
                }
                above = Some((part, joint));
            }
        }
    }
    Ok(())
}

/// Whether the whole mapping is complete and hangs together.
pub(super) fn all(draft: &Draft, skeleton: &Skeleton) -> Result<(), Error> {
    limbs(draft, skeleton).map_err(|problem| error(problem, skeleton))?;
    let chest = draft.joint(Part::UpperChest).or(draft.joint(Part::Chest));
    if draft.joint(Part::Hips).is_none() || chest.is_none() {
        return Err(error("hips or chest cannot be found".to_owned(), skeleton));
    }
    // One arm must not be part of the other, nor of a leg.
    for part in LIMBS.iter().flat_map(|&part| [part, part.mirrored()]) {
        let Some(joint) = draft.joint(part) else { continue };
        for upper in [Part::LeftUpperArm, Part::RightUpperArm, Part::LeftUpperLeg, Part::RightUpperLeg] {
            let same_limb = upper.side() == part.side() && (is_arm(upper) == is_arm(part));
            if let Some(above) = draft.joint(upper).filter(|_| !same_limb)
                && skeleton.is_ancestor(above, joint)
            {
                return Err(error(format!("{part} hangs from {upper}"), skeleton));
            }
        }
    }
    Ok(())
}

fn is_arm(part: Part) -> bool {
    matches!(part, Part::LeftUpperArm | Part::RightUpperArm | Part::LeftLowerArm | Part::RightLowerArm)
}

/// Refuses four-legged animals, whose joints are often named as ours.
///
/// They go on four limbs of about the same reach with a level trunk, *and* have a tail or stand on their toes (a foot
/// about as long as the shin). A crawling person has neither.
pub(super) fn stands_on_two_legs(draft: &Draft, clip: &Clip, names: &Names) -> Result<(), Error> {
    let at = |part| draft.joint(part);
    let (Some(hips), Some(chest)) = (at(Part::Hips), at(Part::UpperChest).or(at(Part::Chest))) else { return Ok(()) };
    let mut on_fours = 0;
    let mut on_toes = 0;
    let poses = sample_poses(clip, 16);
    for pose in &poses {
        let point = |joint: usize| pose[joint].translation;
        let trunk = (point(chest) - point(hips)).normalize_or_zero();
        let reach =
            |upper, end, side| Some((point(draft.on(end, side)?) - point(draft.on(upper, side)?)).normalize_or_zero());
        let mut level = true;
        let mut foot_to_shin = 0.0;
        for side in SIDES {
            let leg = reach(Part::LeftUpperLeg, Part::LeftFoot, side).unwrap_or_default();
            let arm = reach(Part::LeftUpperArm, Part::LeftHand, side)
                .or(reach(Part::LeftUpperArm, Part::LeftLowerArm, side))
                .unwrap_or_default();
            // Legs square to the trunk and arms beside them: on all fours, or sitting with the arms held out.
            level &= trunk.dot(leg).abs() < 0.7 && trunk.dot(arm).abs() < 0.7 && leg.dot(arm) > 0.6;
            if let (Some(shin), Some(foot), Some(toes)) =
                (draft.on(Part::LeftLowerLeg, side), draft.on(Part::LeftFoot, side), draft.on(Part::LeftToes, side))
            {
                foot_to_shin += 0.5 * point(foot).distance(point(toes)) / point(shin).distance(point(foot)).max(1e-9);
            }
        }
        on_fours += usize::from(level);
        on_toes += usize::from(foot_to_shin > 0.65);
    }
    let tail = (0..clip.skeleton().len()).find(|&joint| names.kind(joint) == Some(Kind::Tail));
    let most = |count: usize| count * 4 > poses.len() * 3;
    if most(on_fours) && (tail.is_some() || most(on_toes)) {
        let why = match tail {
            Some(tail) => format!("has a tail ({:?})", clip.skeleton().joints()[tail].name),
            None => "stands on its toes".to_owned(),
        };
        return Err(error(
            format!(
                "it goes on four limbs with a level trunk and {why}: a four-legged animal, where Sinew needs a biped"
            ),
            clip.skeleton(),
        ));
    }
    Ok(())
}
