//! The humanoids of the tests and benchmarks, 18 bodies and 42 degrees of freedom each.

use sinew_body::dynamics::{Coordinates, Freedom, Joint, Letter, Link, Sym3, Tree, V3};

/// One body: parent, joint in the parent's frame [m], turns in order, mass [kg], centre of mass [m], principal moments
/// of inertia about it [kg m²]. All frames are parallel when every coordinate is zero.
pub struct Row {
    pub name: &'static str,
    pub parent: &'static str,
    pub offset: [f64; 3],
    pub turns: &'static str,
    pub mass: f64,
    pub centre: [f64; 3],
    pub inertia: [f64; 3],
}

const fn row(
    name: &'static str,
    parent: &'static str,
    offset: [f64; 3],
    turns: &'static str,
    mass: f64,
    centre: [f64; 3],
    inertia: [f64; 3],
) -> Row {
    Row { name, parent, offset, turns, mass, centre, inertia }
}

/// A tree with its joints.
pub type Body = (Tree<f64>, Coordinates<f64>);

/// How the first body is free to move.
#[derive(Clone, Copy, PartialEq)]
pub enum Root {
    /// Three slides and the row's turns.
    Turns,
    /// Three slides and a quaternion.
    Quaternion,
    /// It is the base: only the bodies above it are in the tree.
    Base,
}

fn v(a: [f64; 3]) -> V3<f64> {
    V3::from_array(a)
}

pub fn letters(text: &str) -> Vec<Letter> {
    text.chars()
        .map(|letter| match letter {
            'X' => Letter::X,
            'Y' => Letter::Y,
            'Z' => Letter::Z,
            other => panic!("no axis is called {other}"),
        })
        .collect()
}

fn heavy(row: &Row, parent: Option<usize>, axes: usize) -> Link<f64> {
    let [x, y, z] = row.inertia;
    Link {
        parent,
        offset: v(row.offset),
        freedom: Freedom::Turn,
        axes,
        mass: row.mass,
        centre: v(row.centre),
        inertia: Sym3::new(x, y, z, 0.0, 0.0, 0.0),
    }
}

/// One link per body (and one that slides for a free root), only those that `keep` wants.
pub fn composite(rows: &[Row], root: Root, keep: impl Fn(&Row) -> bool) -> Body {
    let (mut links, mut joints, mut names): (Vec<Link<f64>>, Vec<Joint<f64>>, Vec<&str>) = Default::default();
    for row in rows.iter().filter(|row| keep(row)) {
        let parent = names.iter().position(|&name| name == row.parent);
        if row.parent.is_empty() {
            if root == Root::Base {
                continue;
            }
            links.push(Link { freedom: Freedom::Slide, axes: 3, ..Link::default() });
            joints.push(Joint::Slides(letters("XYZ")));
            names.push("");
            let mut pelvis = heavy(row, Some(0), 3);
            pelvis.offset = V3::ZERO;
            links.push(pelvis);
            joints.push(if root == Root::Turns { Joint::Turns(letters("YXZ")) } else { Joint::Spherical });
        } else {
            links.push(heavy(row, parent, row.turns.len()));
            joints.push(Joint::Turns(letters(row.turns)));
        }
        names.push(row.name);
    }
    joined(links, joints)
}

/// One link per degree of freedom, massless but for the last of each body. The root is three slides and three turns.
pub fn chain(rows: &[Row]) -> Body {
    let (mut links, mut joints): (Vec<Link<f64>>, Vec<Joint<f64>>) = Default::default();
    let mut last_of: Vec<(&str, usize)> = Vec::new();
    for row in rows {
        let is_root = row.parent.is_empty();
        let mut parent = last_of.iter().find(|(name, _)| *name == row.parent).map(|&(_, link)| link);
        let mut offset = if is_root { [0.0; 3] } else { row.offset };
        let slides = letters(if is_root { "XYZ" } else { "" }).into_iter().map(|letter| (Freedom::Slide, letter));
        let turns = letters(if is_root { "YXZ" } else { row.turns }).into_iter().map(|letter| (Freedom::Turn, letter));
        for (freedom, letter) in slides.chain(turns) {
            links.push(Link { parent, offset: v(offset), freedom, axes: 1, ..Link::default() });
            let axis = v(unit(letter));
            joints.push(if freedom == Freedom::Turn { Joint::Revolute(axis) } else { Joint::Prismatic(axis) });
            (parent, offset) = (Some(links.len() - 1), [0.0; 3]);
        }
        let at = links.len() - 1;
        let body = heavy(row, links[at].parent, 1);
        links[at] = Link { offset: links[at].offset, ..body };
        last_of.push((row.name, at));
    }
    joined(links, joints)
}

pub fn unit(letter: Letter) -> [f64; 3] {
    let mut axis = [0.0; 3];
    axis[letter as usize] = 1.0;
    axis
}

pub fn joined(links: Vec<Link<f64>>, joints: Vec<Joint<f64>>) -> Body {
    let tree = Tree::new(links).expect("a good tree");
    let coordinates = Coordinates::new(&tree, joints).expect("joints that fit");
    (tree, coordinates)
}

/// Whether a body is above the pelvis, or the pelvis itself.
pub fn is_upper(row: &Row) -> bool {
    !["thigh", "shank", "foot"].iter().any(|part| row.name.contains(part))
}

/// The canonical body: Y up, facing +Z.
pub const CANONICAL: [Row; 18] = [
    row("pelvis", "", [0.0, 0.0, 0.0], "YXZ", 8.936, [0.0, -0.02, 0.0], [0.04325024, 0.0732752, 0.0732752]),
    row("chest", "pelvis", [0.0, 0.111, 0.0], "XZY", 24.232, [0.0, 0.10752, 0.0], [0.1647776, 0.20984912, 0.2350504]),
    row("neck", "chest", [0.0, 0.224, 0.0], "XZ", 1.12, [0.0, 0.094, 0.0], [0.00365654016, 0.0016128, 0.00365654016]),
    row("head", "neck", [0.0, 0.188, 0.0], "Y", 4.432, [0.0, 0.0657, 0.015], [0.02162816, 0.01418794, 0.0180881]),
    row("lclav", "chest", [0.025, 0.194, 0.0], "YZ", 0.8, [0.0978, 0.0474, 0.0], [0.000656, 0.002289856, 0.002145856]),
    row(
        "luarm",
        "lclav",
        [0.163, 0.079, 0.0],
        "XZY",
        2.168,
        [0.0, -0.1650792, 0.0],
        [0.0144039320568, 0.00442695918579, 0.0128320458918],
    ),
    row(
        "lfarm",
        "luarm",
        [0.0, -0.286, 0.0],
        "XY",
        1.296,
        [0.0, -0.0901078, 0.0],
        [0.00383138344166, 0.000736390529424, 0.0035320691844],
    ),
    row(
        "lhand",
        "lfarm",
        [0.0, -0.197, 0.0],
        "ZX",
        0.488,
        [0.0, -0.0935, 0.0],
        [0.00273037952, 0.0008259398048, 0.0022116074112],
    ),
    row(
        "rclav",
        "chest",
        [-0.025, 0.194, 0.0],
        "YZ",
        0.8,
        [-0.0978, 0.0474, 0.0],
        [0.000656, 0.002289856, 0.002145856],
    ),
    row(
        "ruarm",
        "rclav",
        [-0.163, 0.079, 0.0],
        "XZY",
        2.168,
        [0.0, -0.1650792, 0.0],
        [0.0144039320568, 0.00442695918579, 0.0128320458918],
    ),
    row(
        "rfarm",
        "ruarm",
        [0.0, -0.286, 0.0],
        "XY",
        1.296,
        [0.0, -0.0901078, 0.0],
        [0.00383138344166, 0.000736390529424, 0.0035320691844],
    ),
    row(
        "rhand",
        "rfarm",
        [0.0, -0.197, 0.0],
        "ZX",
        0.488,
        [0.0, -0.0935, 0.0],
        [0.00273037952, 0.0008259398048, 0.0022116074112],
    ),
    row(
        "lthigh",
        "pelvis",
        [0.092, -0.104, 0.0],
        "XZY",
        11.328,
        [0.0, -0.168714, 0.0],
        [0.208132292724, 0.0426894155704, 0.208132292724],
    ),
    row(
        "lshank",
        "lthigh",
        [0.0, -0.412, 0.0],
        "X",
        3.464,
        [0.0, -0.1944124, 0.0],
        [0.0428184776736, 0.0069859473993, 0.0408271962205],
    ),
    row(
        "lfoot",
        "lshank",
        [0.0, -0.436, 0.0],
        "XZ",
        1.096,
        [0.0, -0.021192, 0.0516555],
        [0.0040552, 0.00414836, 0.0007946],
    ),
    row(
        "rthigh",
        "pelvis",
        [-0.092, -0.104, 0.0],
        "XZY",
        11.328,
        [0.0, -0.168714, 0.0],
        [0.208132292724, 0.0426894155704, 0.208132292724],
    ),
    row(
        "rshank",
        "rthigh",
        [0.0, -0.412, 0.0],
        "X",
        3.464,
        [0.0, -0.1944124, 0.0],
        [0.0428184776736, 0.0069859473993, 0.0408271962205],
    ),
    row(
        "rfoot",
        "rshank",
        [0.0, -0.436, 0.0],
        "XZ",
        1.096,
        [-0.0, -0.021192, 0.0516555],
        [0.0040552, 0.00414836, 0.0007946],
    ),
];

/// The body that the peers are measured with: Z up, facing +X.
pub const PEERS: [Row; 18] = [
    row("pelvis", "", [0.0, 0.0, 0.96], "", 8.936, [0.0, 0.0, 0.0], [0.0816154666667, 0.0387226666667, 0.0911472]),
    row(
        "thigh_l",
        "pelvis",
        [0.0, 0.09, -0.05],
        "ZYX",
        11.328,
        [0.0, 0.0, -0.2075],
        [0.144277137014, 0.144277137014, 0.0263470827149],
    ),
    row(
        "shank_l",
        "thigh_l",
        [0.0, 0.0, -0.415],
        "Y",
        3.464,
        [0.0, 0.0, -0.2075],
        [0.0446147884279, 0.0446147884279, 0.00417873362445],
    ),
    row(
        "foot_l",
        "shank_l",
        [0.0, 0.0, -0.415],
        "YX",
        1.096,
        [0.05, 0.0, -0.045],
        [0.00118733333333, 0.00615586666667, 0.00644813333333],
    ),
    row(
        "thigh_r",
        "pelvis",
        [0.0, -0.09, -0.05],
        "ZYX",
        11.328,
        [0.0, 0.0, -0.2075],
        [0.144277137014, 0.144277137014, 0.0263470827149],
    ),
    row(
        "shank_r",
        "thigh_r",
        [0.0, 0.0, -0.415],
        "Y",
        3.464,
        [0.0, 0.0, -0.2075],
        [0.0446147884279, 0.0446147884279, 0.00417873362445],
    ),
    row(
        "foot_r",
        "shank_r",
        [0.0, 0.0, -0.415],
        "YX",
        1.096,
        [0.05, 0.0, -0.045],
        [0.00118733333333, 0.00615586666667, 0.00644813333333],
    ),
    row(
        "abdomen",
        "pelvis",
        [0.0, 0.0, 0.07],
        "ZYX",
        13.064,
        [0.0, 0.0, 0.08],
        [0.101463733333, 0.0631426666667, 0.108866666667],
    ),
    row(
        "thorax",
        "abdomen",
        [0.0, 0.0, 0.16],
        "ZY",
        11.168,
        [0.0, 0.0, 0.12],
        [0.1373664, 0.0908330666667, 0.120986666667],
    ),
    row(
        "head",
        "thorax",
        [0.0, 0.0, 0.25],
        "ZYX",
        5.552,
        [0.0, 0.0, 0.13],
        [0.0307987946667, 0.0307987946667, 0.019787328],
    ),
    row("clavicle_l", "thorax", [0.0, 0.03, 0.2], "XZ", 0.8, [0.0, 0.07, 0.0], [0.0015488, 0.0005888, 0.0015488]),
    row(
        "uarm_l",
        "clavicle_l",
        [0.0, 0.15, 0.0],
        "ZYX",
        2.168,
        [0.0, 0.0, -0.14],
        [0.0125765318667, 0.0125765318667, 0.0020897352],
    ),
    row(
        "farm_l",
        "uarm_l",
        [0.0, 0.0, -0.28],
        "Y",
        1.296,
        [0.0, 0.0, -0.13],
        [0.00651748816901, 0.00651748816901, 0.000762495211268],
    ),
    row("hand_l", "farm_l", [0.0, 0.0, -0.26], "YX", 0.488, [0.0, 0.0, -0.09], [0.0013542, 0.001464, 0.000183]),
    row("clavicle_r", "thorax", [0.0, -0.03, 0.2], "XZ", 0.8, [0.0, -0.07, 0.0], [0.0015488, 0.0005888, 0.0015488]),
    row(
        "uarm_r",
        "clavicle_r",
        [0.0, -0.15, 0.0],
        "ZYX",
        2.168,
        [0.0, 0.0, -0.14],
        [0.0125765318667, 0.0125765318667, 0.0020897352],
    ),
    row(
        "farm_r",
        "uarm_r",
        [0.0, 0.0, -0.28],
        "Y",
        1.296,
        [0.0, 0.0, -0.13],
        [0.00651748816901, 0.00651748816901, 0.000762495211268],
    ),
    row("hand_r", "farm_r", [0.0, 0.0, -0.26], "YX", 0.488, [0.0, 0.0, -0.09], [0.0013542, 0.001464, 0.000183]),
];
