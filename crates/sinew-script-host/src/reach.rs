//! `skeleton.reach(...)`: reaching with the whole body.

use super::arguments::{number, three};
use super::drive::act;
use rustpython_vm::builtins::{PyList, PyTuple, PyUtf8StrRef};
use rustpython_vm::{FromArgs, PyObjectRef, PyResult, VirtualMachine};
use sinew_control::{Action, ReachHand, ReachOrder};

/// `(target, hand="auto", grasp=False, time=None, speed=None, flexibility=None, avoid=())`.
#[derive(FromArgs)]
pub(super) struct Reaching {
    #[pyarg(any)]
    target: PyObjectRef,
    #[pyarg(any, default)]
    hand: Option<PyUtf8StrRef>,
    #[pyarg(any, default = false)]
    grasp: bool,
    #[pyarg(any, default)]
    time: Option<PyObjectRef>,
    #[pyarg(any, default)]
    speed: Option<PyObjectRef>,
    #[pyarg(any, default)]
    flexibility: Option<PyObjectRef>,
    #[pyarg(any, default)]
    avoid: Option<PyObjectRef>,
}

fn hand(vm: &VirtualMachine, name: &str) -> PyResult<ReachHand> {
    Ok(match name {
        "auto" => ReachHand::Auto,
        "left" => ReachHand::Left,
        "right" => ReachHand::Right,
        "both" => ReachHand::Both,
        _ => return Err(vm.new_value_error("hand must be 'auto', 'left', 'right' or 'both'")),
    })
}

fn names(vm: &VirtualMachine, value: &PyObjectRef) -> PyResult<Vec<String>> {
    let all: Vec<PyObjectRef> = if let Some(tuple) = value.downcast_ref::<PyTuple>() {
        tuple.as_slice().to_vec()
    } else if let Some(list) = value.downcast_ref::<PyList>() {
        list.borrow_vec().to_vec()
    } else {
        vec![value.clone()]
    };
    all.into_iter().map(|name| Ok(name.try_into_value::<PyUtf8StrRef>(vm)?.as_str().to_owned())).collect()
}

pub(super) fn reach(vm: &VirtualMachine, place: usize, reaching: Reaching) -> PyResult<()> {
    let some =
        |value: &Option<PyObjectRef>, what: &str| value.as_ref().map(|value| number(vm, value, what)).transpose();
    let mut order = ReachOrder {
        hand: reaching.hand.map_or(Ok(ReachHand::Auto), |name| hand(vm, name.as_str()))?,
        grasp: reaching.grasp,
        time_secs: some(&reaching.time, "time")?,
        speed_m_s: some(&reaching.speed, "speed")?,
        flexibility: some(&reaching.flexibility, "flexibility")?.unwrap_or(1.0),
        avoid: reaching.avoid.map_or(Ok(Vec::new()), |value| names(vm, &value))?,
        ..ReachOrder::default()
    };
    match reaching.target.clone().try_into_value::<PyUtf8StrRef>(vm) {
        Ok(name) => order.object = Some(name.as_str().to_owned()),
        Err(_) => order.target_m = Some(three(vm, &reaching.target, "target")?),
    }
    act(vm, place, |stage| {
        order.check().map_err(|error| error.to_string())?;
        for name in order.object.iter().chain(&order.avoid) {
            stage.object(name)?;
        }
        Ok(Action::Reach(order))
    })
}

pub(super) fn end(vm: &VirtualMachine, place: usize) -> PyResult<()> {
    act(vm, place, |_| Ok(Action::ReachEnd {}))
}
