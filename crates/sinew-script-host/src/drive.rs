//! Commands of a script to its character: each function sends one command.

use super::arguments::{number, raised, seconds, three};
use super::stage::{self, Stage, one_of};
use super::{MAX_TEXT, cut};
use rustpython_vm::builtins::{PyList, PyStr, PyTuple, PyUtf8StrRef};
use rustpython_vm::{FromArgs, PyObject, PyObjectRef, PyResult, VirtualMachine};
use sinew_control::{Action, Layer};

/// `(name, state=None)`.
#[derive(FromArgs)]
pub(super) struct Graph {
    #[pyarg(any)]
    name: PyUtf8StrRef,
    #[pyarg(any, default)]
    state: Option<PyUtf8StrRef>,
}

/// `(pos, link=None)`.
#[derive(FromArgs)]
pub(super) struct Reach {
    #[pyarg(any)]
    pos: PyObjectRef,
    #[pyarg(any, default)]
    link: Option<PyUtf8StrRef>,
}

/// `(link=None)`.
#[derive(FromArgs)]
pub(super) struct OneLink {
    #[pyarg(any, default)]
    link: Option<PyUtf8StrRef>,
}

/// `(link, obj=None, soft=False, breakForce=None)`.
#[derive(FromArgs)]
pub(super) struct Hold {
    #[pyarg(any)]
    link: PyUtf8StrRef,
    #[pyarg(any, default)]
    obj: Option<PyUtf8StrRef>,
    #[pyarg(any, default = false)]
    soft: bool,
    #[pyarg(any, name = "breakForce", default)]
    break_force: Option<PyObjectRef>,
}

/// `(link, obj=None)`.
#[derive(FromArgs)]
pub(super) struct LetGo {
    #[pyarg(any)]
    link: PyUtf8StrRef,
    #[pyarg(any, default)]
    obj: Option<PyUtf8StrRef>,
}

/// `(part, force, seconds, facing=False)`.
#[derive(FromArgs)]
pub(super) struct Push {
    #[pyarg(any)]
    part: PyUtf8StrRef,
    #[pyarg(any)]
    force: PyObjectRef,
    #[pyarg(any)]
    seconds: PyObjectRef,
    #[pyarg(any, default = false)]
    facing: bool,
}

/// `(factor, part=None)`.
#[derive(FromArgs)]
pub(super) struct Gain {
    #[pyarg(any)]
    factor: PyObjectRef,
    #[pyarg(any, default)]
    part: Option<PyUtf8StrRef>,
}

/// `(parts=(), seconds=None)`.
#[derive(FromArgs)]
pub(super) struct SomeParts {
    #[pyarg(any, default)]
    parts: Option<PyObjectRef>,
    #[pyarg(any, default)]
    seconds: Option<PyObjectRef>,
}

/// `(facing=None, seconds=None)`.
#[derive(FromArgs)]
pub(super) struct Plane {
    #[pyarg(any, default)]
    facing: Option<PyObjectRef>,
    #[pyarg(any, default)]
    seconds: Option<PyObjectRef>,
}

/// `(scale, seconds=None, over=None, part=None)`.
#[derive(FromArgs)]
pub(super) struct Gravity {
    #[pyarg(any)]
    scale: PyObjectRef,
    #[pyarg(any, default)]
    seconds: Option<PyObjectRef>,
    #[pyarg(any, default)]
    over: Option<PyObjectRef>,
    #[pyarg(any, default)]
    part: Option<PyUtf8StrRef>,
}

/// `(part, shape, seconds=None)`.
#[derive(FromArgs)]
pub(super) struct Shape {
    #[pyarg(any)]
    part: PyUtf8StrRef,
    #[pyarg(any)]
    shape: PyUtf8StrRef,
    #[pyarg(any, default)]
    seconds: Option<PyObjectRef>,
}

/// `(name, on=True)`.
#[derive(FromArgs)]
pub(super) struct Switch {
    #[pyarg(any)]
    name: PyUtf8StrRef,
    #[pyarg(any, default = true)]
    on: bool,
}

/// Builds the command and sends it.
pub(super) fn act(
    vm: &VirtualMachine,
    place: usize,
    action: impl FnOnce(&Stage) -> Result<Action, String>,
) -> PyResult<()> {
    raised(
        vm,
        stage::with(|stage| {
            let action = action(stage)?;
            stage.act(Some(place), action)
        }),
    )
}

pub(super) fn pose(vm: &VirtualMachine, place: usize, name: &str) -> PyResult<()> {
    act(vm, place, |stage| {
        one_of("pose", name, &stage.names.poses)?;
        Ok(Action::Pose { name: name.to_owned() })
    })
}

pub(super) fn graph(vm: &VirtualMachine, place: usize, graph: Graph) -> PyResult<()> {
    act(vm, place, |stage| {
        one_of("graph", graph.name.as_str(), &stage.names.graphs)?;
        let state = graph.state.map(|state| cut(state.as_str(), MAX_TEXT));
        Ok(Action::Graph { name: graph.name.as_str().to_owned(), state })
    })
}

pub(super) fn signal(vm: &VirtualMachine, place: usize, name: &str) -> PyResult<()> {
    act(vm, place, |_| Ok(Action::Signal { name: cut(name, MAX_TEXT) }))
}

pub(super) fn reach(vm: &VirtualMachine, place: usize, reach: Reach) -> PyResult<()> {
    let target_m = three(vm, &reach.pos, "pos")?;
    act(vm, place, |stage| {
        let link = reach.link.map(|link| stage.part_name(place, link.as_str())).transpose()?;
        Ok(Action::Ik { link, target_m })
    })
}

pub(super) fn release(vm: &VirtualMachine, place: usize, link: OneLink) -> PyResult<()> {
    act(vm, place, |stage| {
        let link = link.link.map(|link| stage.part_name(place, link.as_str())).transpose()?;
        Ok(Action::IkRelease { link })
    })
}

pub(super) fn attach(vm: &VirtualMachine, place: usize, hold: Hold) -> PyResult<()> {
    let break_n = hold.break_force.map(|force| number(vm, &force, "breakForce")).transpose()?;
    if break_n.is_some_and(|force| force <= 0.0) {
        return Err(vm.new_value_error("breakForce must be above 0"));
    }
    act(vm, place, |stage| {
        let link = stage.part_name(place, hold.link.as_str())?;
        Ok(Action::Attach { link, object: some_holdable(stage, place, hold.obj)?, soft: hold.soft, break_n })
    })
}

pub(super) fn detach(vm: &VirtualMachine, place: usize, let_go: LetGo) -> PyResult<()> {
    act(vm, place, |stage| {
        let link = stage.part_name(place, let_go.link.as_str())?;
        Ok(Action::Detach { link, object: some_holdable(stage, place, let_go.obj)? })
    })
}

/// The name of the held object; empty for the nearest one.
fn some_holdable(stage: &Stage, place: usize, name: Option<PyUtf8StrRef>) -> Result<String, String> {
    name.map_or(Ok(String::new()), |name| holdable(stage, place, name.as_str()))
}

/// A prop, or another character's part as `character.part`.
fn holdable(stage: &Stage, place: usize, name: &str) -> Result<String, String> {
    if stage.object(name).is_err()
        && let Ok(stage::Found::Thing(thing @ sinew_script::Thing::Part(character, _))) = stage.find(name)
        && character != place
        && let (character, Some(part)) = stage.called(thing)
    {
        return Ok(format!("{character}.{part}"));
    }
    stage.object(name).map(|_| name.to_owned())
}

pub(super) fn push(vm: &VirtualMachine, place: usize, push: Push) -> PyResult<()> {
    let force_n = three(vm, &push.force, "force")?;
    let for_secs = seconds(vm, Some(&push.seconds))?.unwrap_or(0.0);
    act(vm, place, |stage| {
        Ok(Action::Push {
            on: stage.part_name(place, push.part.as_str())?,
            force_n,
            for_secs,
            facing: push.facing,
            at_m: None,
        })
    })
}

pub(super) fn gain(vm: &VirtualMachine, place: usize, gain: Gain) -> PyResult<()> {
    let factor = at_least_zero(vm, &gain.factor, "factor")?;
    act(vm, place, |stage| {
        let part = gain.part.map(|part| stage.part_name(place, part.as_str())).transpose()?;
        Ok(Action::Gain { factor, part })
    })
}

pub(super) fn forces_off(vm: &VirtualMachine, place: usize, some: SomeParts) -> PyResult<()> {
    let for_secs = seconds(vm, some.seconds.as_ref())?;
    let parts = parts(vm, place, some.parts.as_ref())?;
    act(vm, place, |_| Ok(Action::ForcesOff { parts, for_secs }))
}

pub(super) fn forces_on(vm: &VirtualMachine, place: usize, some: SomeParts) -> PyResult<()> {
    if some.seconds.is_some() {
        return Err(vm.new_type_error("forcesOn() has no seconds: it lasts until forcesOff()"));
    }
    let parts = parts(vm, place, some.parts.as_ref())?;
    act(vm, place, |_| Ok(Action::ForcesOn { parts }))
}

pub(super) fn plane(vm: &VirtualMachine, place: usize, plane: Plane) -> PyResult<()> {
    let facing_deg = plane.facing.map(|facing| number(vm, &facing, "facing")).transpose()?;
    let for_secs = seconds(vm, plane.seconds.as_ref())?;
    act(vm, place, |_| Ok(Action::Plane { facing_deg, for_secs }))
}

pub(super) fn free_plane(vm: &VirtualMachine, place: usize) -> PyResult<()> {
    act(vm, place, |_| Ok(Action::PlaneOff {}))
}

pub(super) fn gravity(vm: &VirtualMachine, place: usize, gravity: Gravity) -> PyResult<()> {
    let scale = number(vm, &gravity.scale, "scale")?;
    let for_secs = seconds(vm, gravity.seconds.as_ref())?;
    let over_secs = seconds(vm, gravity.over.as_ref())?;
    act(vm, place, |stage| {
        let part = gravity.part.map(|part| stage.part_name(place, part.as_str())).transpose()?;
        Ok(Action::Gravity { scale, on: None, part, over_secs, for_secs })
    })
}

pub(super) fn shape(vm: &VirtualMachine, place: usize, shape: Shape) -> PyResult<()> {
    let for_secs = seconds(vm, shape.seconds.as_ref())?;
    act(vm, place, |stage| {
        one_of("shape", shape.shape.as_str(), &stage.names.shapes)?;
        let part = stage.part_name(place, shape.part.as_str())?;
        Ok(Action::Shape { part, shape: shape.shape.as_str().to_owned(), for_secs })
    })
}

pub(super) fn layer(vm: &VirtualMachine, place: usize, switch: Switch) -> PyResult<()> {
    const LAYERS: [(&str, Layer); 3] =
        [("poses", Layer::Poses), ("scripts", Layer::Scripts), ("reflexes", Layer::Reflexes)];
    act(vm, place, |_| {
        let at = one_of("layer", switch.name.as_str(), &LAYERS.map(|(name, _)| name.to_owned()))?;
        Ok(Action::Layer { layer: LAYERS[at].1, on: switch.on })
    })
}

pub(super) fn reflex(vm: &VirtualMachine, place: usize, switch: Switch) -> PyResult<()> {
    act(vm, place, |stage| {
        one_of("reflex", switch.name.as_str(), &stage.names.reflexes)?;
        Ok(Action::Reflex { name: switch.name.as_str().to_owned(), on: switch.on })
    })
}

pub(super) fn tracker(vm: &VirtualMachine, place: usize, name: &str) -> PyResult<()> {
    act(vm, place, |stage| {
        one_of("tracker", name, &stage.names.trackers)?;
        Ok(Action::Tracker { name: name.to_owned() })
    })
}

pub(super) fn at_least_zero(vm: &VirtualMachine, value: &PyObject, what: &str) -> PyResult<f64> {
    let number = number(vm, value, what)?;
    if number >= 0.0 { Ok(number) } else { Err(vm.new_value_error(format!("{what} must not be negative: {number}"))) }
}

/// One part's name, or a tuple or list of names.
pub(super) fn parts(vm: &VirtualMachine, place: usize, value: Option<&PyObjectRef>) -> PyResult<Vec<String>> {
    let of = |elements: &[PyObjectRef]| -> PyResult<Vec<String>> {
        let of_one = |element: &PyObjectRef| {
            let Some(name) = element.downcast_ref::<PyStr>() else {
                let kind = element.class().name().to_string();
                return Err(vm.new_type_error(format!("parts must be names, not {kind}")));
            };
            raised(vm, stage::with(|stage| stage.part_name(place, &name.to_string_lossy())))
        };
        if elements.len() > 100 {
            return Err(vm.new_value_error("that is more parts than a character has"));
        }
        elements.iter().map(of_one).collect()
    };
    let Some(value) = value else { return Ok(Vec::new()) };
    if let Some(tuple) = value.downcast_ref::<PyTuple>() {
        of(tuple.as_slice())
    } else if let Some(list) = value.downcast_ref::<PyList>() {
        of(&list.borrow_vec())
    } else {
        of(std::slice::from_ref(value))
    }
}
