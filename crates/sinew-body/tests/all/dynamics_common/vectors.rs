//! Reference numbers from the shared folder.

use serde_json::Value;

use super::bodies::{Body, joined, letters, unit};
use sinew_body::dynamics::{Freedom, Joint, Link, Sym3, V3};

/// The four files.
pub const FILES: [&str; 4] = ["pendulum1", "pendulum2_planar", "ball_xzy", "humanoid42_random"];

/// Reads a file, or says that it is skipped.
pub fn load(name: &str) -> Option<Value> {
    let path = sinew_testkit::shared(&format!("vectors/{name}.json"))?;
    let text = std::fs::read_to_string(path).expect("it can be read");
    Some(serde_json::from_str(&text).expect("a JSON file"))
}

pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        other => vec![other.as_f64().expect("a number")],
    }
}

pub fn vector(value: &Value) -> V3<f64> {
    let n = numbers(value);
    V3::new(n[0], n[1], n[2])
}

fn heavy(link: Link<f64>, body: &Value) -> Link<f64> {
    if body.is_null() {
        return link;
    }
    let i = numbers(&body["inertia"]);
    Link {
        mass: body["mass"].as_f64().expect("a mass"),
        centre: vector(&body["com"]),
        inertia: Sym3::new(i[0], i[4], i[8], i[1], i[5], i[2]),
        ..link
    }
}

struct OneDof<'a> {
    parent: Option<usize>,
    offset: V3<f64>,
    freedom: Freedom,
    letter: &'a str,
    body: &'a Value,
}

fn one_dofs(file: &Value) -> Vec<OneDof<'_>> {
    let joints = file["joints"].as_array().expect("joints");
    joints
        .iter()
        .map(|joint| OneDof {
            parent: usize::try_from(joint["parent"].as_i64().expect("a parent")).ok(),
            offset: vector(&joint["offset"]),
            freedom: if joint["type"] == "revolute" { Freedom::Turn } else { Freedom::Slide },
            letter: joint["axis"].as_str().expect("an axis"),
            body: &joint["body"],
        })
        .collect()
}

/// The file's tree as it stands, one link per degree of freedom; and per file joint its link.
pub fn as_chain(file: &Value) -> (Body, Vec<Option<usize>>) {
    let joints = one_dofs(file);
    let links = joints.iter().map(|joint| {
        let link =
            Link { parent: joint.parent, offset: joint.offset, freedom: joint.freedom, axes: 1, ..Link::default() };
        heavy(link, joint.body)
    });
    let kinds = joints.iter().map(|joint| {
        let axis = V3::from_array(unit(letters(joint.letter)[0]));
        if joint.freedom == Freedom::Turn { Joint::Revolute(axis) } else { Joint::Prismatic(axis) }
    });
    let count = joints.len();
    (joined(links.collect(), kinds.collect()), (0..count).map(Some).collect())
}

/// The same tree with runs of coinciding massless joints as one link each; and per file joint the link that moves with
/// it, where there is one.
pub fn as_composite(file: &Value) -> (Body, Vec<Option<usize>>) {
    let joints = one_dofs(file);
    let (mut links, mut kinds): (Vec<Link<f64>>, Vec<Joint<f64>>) = Default::default();
    let mut link_of: Vec<Option<usize>> = Vec::new();
    for (index, joint) in joints.iter().enumerate() {
        // A joint joins the run of the one before it if that is its massless parent, of the same kind, in one place.
        let run_on = index > 0
            && joint.parent == Some(index - 1)
            && joints[index - 1].body.is_null()
            && joints[index - 1].freedom == joint.freedom
            && joint.offset == V3::ZERO;
        let letter = letters(joint.letter);
        if run_on {
            let at = links.len() - 1;
            links[at] = heavy(Link { axes: links[at].axes + 1, ..links[at] }, joint.body);
            match kinds.last_mut() {
                Some(Joint::Turns(run) | Joint::Slides(run)) => run.extend(letter),
                _ => unreachable!("only runs are pushed"),
            }
            link_of[index - 1] = None;
        } else {
            let parent = joint.parent.map(|parent| link_of[parent].expect("a run has ended where another begins"));
            let link = Link { parent, offset: joint.offset, freedom: joint.freedom, axes: 1, ..Link::default() };
            links.push(heavy(link, joint.body));
            kinds.push(if joint.freedom == Freedom::Turn { Joint::Turns(letter) } else { Joint::Slides(letter) });
        }
        link_of.push(Some(links.len() - 1));
    }
    (joined(links, kinds), link_of)
}
