//! The global functions of a script.

pub(super) use words::module_def;

use super::{character, interpreter, stage};
use rustpython_vm::builtins::PyDictRef;
use rustpython_vm::{PyResult, VirtualMachine};

/// Their names.
const WORDS: [&str; 10] = [
    "getCharacter",
    "getPosition",
    "getVelocity",
    "isColliding",
    "getTime",
    "getTimeStep",
    "getStep",
    "place",
    "accelerate",
    "say",
];

/// Those for props and joints.
const DEVICE_WORDS: [&str; 10] = [
    "push",
    "setGravity",
    "setMotor",
    "cut",
    "getRotation",
    "getSpin",
    "toWorld",
    "getJointPlace",
    "getJointSpeed",
    "isJointWhole",
];

/// Adds all functions and classes to a script's globals.
pub(super) fn offer(vm: &VirtualMachine, globals: &PyDictRef) -> PyResult<()> {
    // Imported when the interpreter was made; the gate before imports is closed to them now.
    let words = vm.sys_module.get_attr("modules", vm)?.get_item("_words", vm)?;
    for name in WORDS {
        globals.set_item(name, words.get_attr(vm.ctx.intern_str(name), vm)?, vm)?;
    }
    globals.set_item("Vector", interpreter::vector_class(vm).into(), vm)?;
    let devices = vm.sys_module.get_attr("modules", vm)?.get_item("_devices", vm)?;
    for name in DEVICE_WORDS {
        globals.set_item(name, devices.get_attr(vm.ctx.intern_str(name), vm)?, vm)?;
    }
    let (own, me) = stage::with(|stage| (stage.own, stage.me.clone()));
    globals.set_item("skeleton", own.map_or_else(|| vm.ctx.none(), |own| character::object(vm, own)), vm)?;
    globals.set_item("me", vm.ctx.new_str(me).into(), vm)?;
    globals.set_item("__name__", vm.ctx.new_str("controller").into(), vm)
}

#[rustpython_vm::pymodule(name = "_words")]
#[allow(non_snake_case, reason = "Python's names, as the paper prints them")]
pub(super) mod words {
    use crate::arguments::{raised, seconds, three, vector};
    use crate::stage::{self, Found, Stage};
    use crate::{MAX_TEXT, character, cut, sense};
    use rustpython_vm::builtins::PyUtf8StrRef;
    use rustpython_vm::{FromArgs, PyObjectRef, PyResult, VirtualMachine};
    use sinew_control::Action;
    use sinew_script::{ObjectState, Thing};

    #[pyfunction]
    fn getCharacter(name: PyUtf8StrRef, vm: &VirtualMachine) -> PyResult {
        let place = raised(vm, stage::with(|stage| stage.character_place(name.as_str())))?;
        Ok(character::object(vm, place))
    }

    /// Position and motion of a thing; of a character, those of its hips.
    pub(crate) fn state(stage: &Stage, found: Found) -> Result<ObjectState, String> {
        stage.ready()?;
        let of_part = |character: usize, part: usize| {
            let state = stage.character(character)?.parts.get(part);
            state
                .map(|state| ObjectState {
                    position: state.position,
                    velocity: state.velocity,
                    rotation: state.rotation,
                    ..ObjectState::default()
                })
                .ok_or_else(String::new)
        };
        match found {
            Found::Character(character) => of_part(character, 0),
            Found::Thing(Thing::Part(character, part)) => of_part(character, part),
            Found::Thing(Thing::Object(object)) => stage.snapshot.objects.get(object).copied().ok_or_else(String::new),
            Found::Thing(Thing::Ground) => Err("the ground is everywhere".to_owned()),
        }
    }

    #[pyfunction]
    fn getPosition(name: PyObjectRef, vm: &VirtualMachine) -> PyResult {
        let found = sense::found(vm, &name)?;
        vector(vm, raised(vm, stage::with(|stage| state(stage, found)))?.position)
    }

    #[pyfunction]
    fn getVelocity(name: PyObjectRef, vm: &VirtualMachine) -> PyResult {
        let found = sense::found(vm, &name)?;
        vector(vm, raised(vm, stage::with(|stage| state(stage, found)))?.velocity)
    }

    #[pyfunction]
    fn isColliding(a: PyObjectRef, b: PyObjectRef, vm: &VirtualMachine) -> PyResult<bool> {
        let (a, b) = (sense::found(vm, &a)?, sense::found(vm, &b)?);
        raised(vm, stage::with(|stage| sense::touch(stage, a, b)))
    }

    #[pyfunction]
    fn getTime(vm: &VirtualMachine) -> PyResult<f64> {
        raised(vm, stage::with(|stage| stage.ready().map(|()| stage.snapshot.time_secs)))
    }

    #[pyfunction]
    fn getTimeStep(vm: &VirtualMachine) -> PyResult<f64> {
        raised(vm, stage::with(|stage| stage.ready().map(|()| stage.snapshot.step_secs)))
    }

    #[pyfunction]
    fn getStep(vm: &VirtualMachine) -> PyResult<u64> {
        raised(vm, stage::with(|stage| stage.ready().map(|()| stage.snapshot.step)))
    }

    #[derive(FromArgs)]
    struct Place {
        #[pyarg(any)]
        object: PyUtf8StrRef,
        #[pyarg(any, default)]
        position: Option<PyObjectRef>,
        #[pyarg(any, default)]
        velocity: Option<PyObjectRef>,
    }

    #[pyfunction]
    fn place(place: Place, vm: &VirtualMachine) -> PyResult<()> {
        let position_m = place.position.map(|position| three(vm, &position, "position")).transpose()?;
        let velocity_m_s = place.velocity.map(|velocity| three(vm, &velocity, "velocity")).transpose()?;
        let acted = stage::with(|stage| {
            stage.object(place.object.as_str())?;
            let object = place.object.as_str().to_owned();
            stage.act(None, Action::Place { object, position_m, velocity_m_s })
        });
        raised(vm, acted)
    }

    #[derive(FromArgs)]
    struct Accelerate {
        #[pyarg(any)]
        object: PyUtf8StrRef,
        #[pyarg(any)]
        acceleration: PyObjectRef,
        #[pyarg(any)]
        seconds: PyObjectRef,
    }

    #[pyfunction]
    fn accelerate(accelerate: Accelerate, vm: &VirtualMachine) -> PyResult<()> {
        let acceleration_m_s2 = three(vm, &accelerate.acceleration, "acceleration")?;
        let for_secs = seconds(vm, Some(&accelerate.seconds))?.unwrap_or(0.0);
        let acted = stage::with(|stage| {
            stage.object(accelerate.object.as_str())?;
            let object = accelerate.object.as_str().to_owned();
            stage.act(None, Action::Accelerate { object, acceleration_m_s2, for_secs })
        });
        raised(vm, acted)
    }

    #[pyfunction]
    fn say(text: PyObjectRef, vm: &VirtualMachine) -> PyResult<()> {
        let text = cut(&text.str(vm)?.to_string_lossy(), MAX_TEXT);
        let acted = stage::with(|stage| {
            let own = stage.own;
            stage.act(own, Action::Say { text })
        });
        raised(vm, acted)
    }
}
