//! Commands of a script to the tracker `kd`.

use super::arguments::{raised, seconds};
use super::drive::{act, at_least_zero, parts};
use super::stage::one_of;
use rustpython_vm::builtins::PyUtf8StrRef;
use rustpython_vm::{FromArgs, PyObjectRef, PyResult, VirtualMachine};
use sinew_control::Action;
use sinew_control::tracker::KdPreset;

/// `(parts=(), pin=None, joint=None, fade=None, seconds=None)`.
#[derive(FromArgs)]
pub(super) struct Weights {
    #[pyarg(any, default)]
    parts: Option<PyObjectRef>,
    #[pyarg(any, default)]
    pin: Option<PyObjectRef>,
    #[pyarg(any, default)]
    joint: Option<PyObjectRef>,
    #[pyarg(any, default)]
    fade: Option<PyObjectRef>,
    #[pyarg(any, default)]
    seconds: Option<PyObjectRef>,
}

/// `(preset=None, kp=None, dp=None, kq=None, dq=None, fade=None, seconds=None)`.
#[derive(FromArgs)]
pub(super) struct Kd {
    #[pyarg(any, default)]
    preset: Option<PyUtf8StrRef>,
    #[pyarg(any, default)]
    kp: Option<PyObjectRef>,
    #[pyarg(any, default)]
    dp: Option<PyObjectRef>,
    #[pyarg(any, default)]
    kq: Option<PyObjectRef>,
    #[pyarg(any, default)]
    dq: Option<PyObjectRef>,
    #[pyarg(any, default)]
    fade: Option<PyObjectRef>,
    #[pyarg(any, default)]
    seconds: Option<PyObjectRef>,
}

/// `(fade=None, seconds=None)`.
#[derive(FromArgs)]
pub(super) struct Pins {
    #[pyarg(any, default)]
    fade: Option<PyObjectRef>,
    #[pyarg(any, default)]
    seconds: Option<PyObjectRef>,
}

fn some(vm: &VirtualMachine, value: Option<&PyObjectRef>, what: &str) -> PyResult<Option<f64>> {
    value.map(|value| at_least_zero(vm, value, what)).transpose()
}

pub(super) fn weights(vm: &VirtualMachine, place: usize, weights: Weights) -> PyResult<()> {
    let parts = parts(vm, place, weights.parts.as_ref())?;
    let (pin, joint) = (some(vm, weights.pin.as_ref(), "pin")?, some(vm, weights.joint.as_ref(), "joint")?);
    let (fade_secs, for_secs) = (some(vm, weights.fade.as_ref(), "fade")?, seconds(vm, weights.seconds.as_ref())?);
    act(vm, place, |_| Ok(Action::Weights { parts, pin, joint, fade_secs, for_secs }))
}

pub(super) fn kd(vm: &VirtualMachine, place: usize, gains: Kd) -> PyResult<()> {
    let names = KdPreset::ALL.map(|preset| preset.name().to_owned());
    let preset = match &gains.preset {
        Some(name) => Some(KdPreset::ALL[raised(vm, one_of("preset", name.as_str(), &names))?]),
        None => None,
    };
    let (k_p, d_p) = (some(vm, gains.kp.as_ref(), "kp")?, some(vm, gains.dp.as_ref(), "dp")?);
    let (k_q, d_q) = (some(vm, gains.kq.as_ref(), "kq")?, some(vm, gains.dq.as_ref(), "dq")?);
    let (fade_secs, for_secs) = (some(vm, gains.fade.as_ref(), "fade")?, seconds(vm, gains.seconds.as_ref())?);
    act(vm, place, |_| {
        Ok(Action::Kd { preset, k_p, d_p, k_q, d_q, damping: None, feed_forward: None, fade_secs, for_secs })
    })
}

pub(super) fn pins(vm: &VirtualMachine, place: usize, on: bool, pins: Pins) -> PyResult<()> {
    let (fade_secs, for_secs) = (some(vm, pins.fade.as_ref(), "fade")?, seconds(vm, pins.seconds.as_ref())?);
    act(vm, place, |_| Ok(Action::Pins { on, fade_secs, for_secs }))
}
