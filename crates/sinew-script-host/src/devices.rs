//! Functions for props and their joints.

pub(super) use devices::module_def;

#[rustpython_vm::pymodule(name = "_devices")]
#[allow(non_snake_case, reason = "Python's names, as the paper prints them")]
pub(super) mod devices {
    use crate::arguments::{number, raised, seconds, three, vector};
    use crate::words::words::state;
    use crate::{sense, stage};
    use rustpython_vm::builtins::PyUtf8StrRef;
    use rustpython_vm::{FromArgs, PyObjectRef, PyResult, VirtualMachine};
    use sinew_control::Action;
    use sinew_script::JointState;

    #[derive(FromArgs)]
    struct Push {
        #[pyarg(any)]
        object: PyUtf8StrRef,
        #[pyarg(any)]
        force: PyObjectRef,
        #[pyarg(any, default)]
        seconds: Option<PyObjectRef>,
        #[pyarg(any, default)]
        at: Option<PyObjectRef>,
    }

    #[pyfunction]
    fn push(push: Push, vm: &VirtualMachine) -> PyResult<()> {
        let force_n = three(vm, &push.force, "force")?;
        let at_m = push.at.map(|at| three(vm, &at, "at")).transpose()?;
        let for_secs = seconds(vm, push.seconds.as_ref())?;
        let acted = stage::with(|stage| {
            stage.object(push.object.as_str())?;
            let for_secs = for_secs.unwrap_or(stage.snapshot.step_secs);
            let on = push.object.as_str().to_owned();
            stage.act(None, Action::Push { on, force_n, for_secs, facing: false, at_m })
        });
        raised(vm, acted)
    }

    #[derive(FromArgs)]
    struct Gravity {
        #[pyarg(any)]
        object: PyUtf8StrRef,
        #[pyarg(any)]
        scale: PyObjectRef,
        #[pyarg(any, default)]
        seconds: Option<PyObjectRef>,
        #[pyarg(any, default)]
        over: Option<PyObjectRef>,
    }

    #[pyfunction]
    fn setGravity(gravity: Gravity, vm: &VirtualMachine) -> PyResult<()> {
        let scale = number(vm, &gravity.scale, "scale")?;
        let (for_secs, over_secs) = (seconds(vm, gravity.seconds.as_ref())?, seconds(vm, gravity.over.as_ref())?);
        let acted = stage::with(|stage| {
            stage.object(gravity.object.as_str())?;
            let on = Some(gravity.object.as_str().to_owned());
            stage.act(None, Action::Gravity { scale, on, part: None, over_secs, for_secs })
        });
        raised(vm, acted)
    }

    #[derive(FromArgs)]
    struct Motor {
        #[pyarg(any)]
        joint: PyUtf8StrRef,
        #[pyarg(any, default)]
        speed: Option<PyObjectRef>,
        #[pyarg(any, default)]
        place: Option<PyObjectRef>,
    }

    #[pyfunction]
    fn setMotor(motor: Motor, vm: &VirtualMachine) -> PyResult<()> {
        let speed = motor.speed.map(|speed| number(vm, &speed, "speed")).transpose()?;
        let place = motor.place.map(|place| number(vm, &place, "place")).transpose()?;
        if speed.is_some() && place.is_some() {
            return Err(vm.new_type_error("a motor aims at a speed or at a place, not at both"));
        }
        let acted = stage::with(|stage| {
            let turns = stage.names.joints[stage.joint(motor.joint.as_str())?].turns;
            let joint = motor.joint.as_str().to_owned();
            let of_hinge = |value: Option<f64>| value.filter(|_| turns);
            let of_slider = |value: Option<f64>| value.filter(|_| !turns);
            let action = Action::Motor {
                joint,
                speed_rad_s: of_hinge(speed),
                angle_deg: of_hinge(place),
                speed_m_s: of_slider(speed),
                shift_m: of_slider(place),
            };
            stage.act(None, action)
        });
        raised(vm, acted)
    }

    #[pyfunction]
    fn cut(joint: PyUtf8StrRef, vm: &VirtualMachine) -> PyResult<()> {
        let acted = stage::with(|stage| {
            stage.joint(joint.as_str())?;
            stage.act(None, Action::Cut { joint: joint.as_str().to_owned() })
        });
        raised(vm, acted)
    }

    #[pyfunction]
    fn getRotation(name: PyObjectRef, vm: &VirtualMachine) -> PyResult {
        let found = sense::found(vm, &name)?;
        let rotation = raised(vm, stage::with(|stage| state(stage, found)))?.rotation;
        Ok(vm.ctx.new_tuple(rotation.iter().map(|&number| vm.ctx.new_float(number).into()).collect()).into())
    }

    #[pyfunction]
    fn getSpin(name: PyUtf8StrRef, vm: &VirtualMachine) -> PyResult {
        let spin = stage::with(|stage| {
            stage.ready()?;
            let object = stage.object(name.as_str())?;
            stage.snapshot.objects.get(object).map(|object| object.spin).ok_or_else(String::new)
        });
        vector(vm, raised(vm, spin)?)
    }

    #[pyfunction]
    fn toWorld(name: PyObjectRef, own: PyObjectRef, vm: &VirtualMachine) -> PyResult {
        let own = three(vm, &own, "vector")?;
        let found = sense::found(vm, &name)?;
        let [x, y, z, w] = raised(vm, stage::with(|stage| state(stage, found)))?.rotation;
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let twice = cross([x, y, z], own).map(|number| 2.0 * number);
        let more = cross([x, y, z], twice);
        vector(vm, std::array::from_fn(|at| own[at] + w * twice[at] + more[at]))
    }

    fn joint(vm: &VirtualMachine, name: &str) -> PyResult<JointState> {
        let found = stage::with(|stage| {
            stage.ready()?;
            let joint = stage.joint(name)?;
            stage.snapshot.joints.get(joint).copied().ok_or_else(String::new)
        });
        raised(vm, found)
    }

    #[pyfunction]
    fn getJointPlace(name: PyUtf8StrRef, vm: &VirtualMachine) -> PyResult<f64> {
        Ok(joint(vm, name.as_str())?.place)
    }

    #[pyfunction]
    fn getJointSpeed(name: PyUtf8StrRef, vm: &VirtualMachine) -> PyResult<f64> {
        Ok(joint(vm, name.as_str())?.speed)
    }

    #[pyfunction]
    fn isJointWhole(name: PyUtf8StrRef, vm: &VirtualMachine) -> PyResult<bool> {
        Ok(joint(vm, name.as_str())?.is_whole)
    }
}
