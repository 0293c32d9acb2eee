//! Queries about characters: positions, velocities, contacts.

use super::arguments::{raised, vector, vectors};
use super::character::Character;
use super::stage::{self, Found, Stage};
use rustpython_vm::builtins::{PyStr, PyUtf8StrRef};
use rustpython_vm::{FromArgs, PyObject, PyObjectRef, PyResult, VirtualMachine};
use sinew_script::Thing;

/// `(part=None)`.
#[derive(FromArgs)]
pub(super) struct OnePart {
    #[pyarg(any, default)]
    part: Option<PyUtf8StrRef>,
}

/// `(other=None)`.
#[derive(FromArgs)]
pub(super) struct Other {
    #[pyarg(any, default)]
    other: Option<PyObjectRef>,
}

impl OnePart {
    fn name(&self) -> Option<&str> {
        self.part.as_ref().map(|part| part.as_str())
    }
}

pub(super) fn position(vm: &VirtualMachine, place: usize, part: &OnePart) -> PyResult {
    let state = raised(vm, stage::with(|stage| stage.part_state(place, part.name())))?;
    vector(vm, state.position)
}

pub(super) fn rotation(vm: &VirtualMachine, place: usize, part: &OnePart) -> PyResult {
    let state = raised(vm, stage::with(|stage| stage.part_state(place, part.name())))?;
    let numbers = state.rotation.iter().map(|&number| vm.ctx.new_float(number).into()).collect();
    Ok(vm.ctx.new_tuple(numbers).into())
}

pub(super) fn velocity(vm: &VirtualMachine, place: usize, part: &OnePart) -> PyResult {
    let state = raised(vm, stage::with(|stage| stage.part_state(place, part.name())))?;
    vector(vm, state.velocity)
}

pub(super) fn facing(vm: &VirtualMachine, place: usize) -> PyResult {
    let facing = stage::with(|stage| stage.character(place).map(|state| state.facing));
    vector(vm, raised(vm, facing)?)
}

pub(super) fn left(vm: &VirtualMachine, place: usize) -> PyResult {
    let facing = stage::with(|stage| stage.character(place).map(|state| state.facing));
    let [x, _, z] = raised(vm, facing)?;
    vector(vm, [z, 0.0, -x])
}

pub(super) fn centre_of_mass(vm: &VirtualMachine, place: usize) -> PyResult {
    let centre = stage::with(|stage| stage.character(place).map(|state| state.centre_of_mass));
    vector(vm, raised(vm, centre)?)
}

pub(super) fn centre_velocity(vm: &VirtualMachine, place: usize) -> PyResult {
    let velocity = stage::with(|stage| stage.character(place).map(|state| state.centre_velocity));
    vector(vm, raised(vm, velocity)?)
}

pub(super) fn support(vm: &VirtualMachine, place: usize) -> PyResult {
    let corners = stage::with(|stage| stage.character(place).map(|state| state.support.clone()));
    vectors(vm, &raised(vm, corners)?)
}

pub(super) fn is_attached(vm: &VirtualMachine, place: usize, link: &str, object: &str) -> PyResult<bool> {
    let attached = stage::with(|stage| {
        let part = stage.part(place, link)?;
        let found = stage.find(object)?;
        let mut attached = stage.character(place)?.attached.iter();
        Ok(attached.any(|&(on, thing)| on == part && Stage::is(thing, found)))
    });
    raised(vm, attached)
}

/// Whether the character touches a thing; without one, anything but itself.
pub(super) fn is_touching(vm: &VirtualMachine, place: usize, other: Other) -> PyResult<bool> {
    match other.other {
        Some(other) => {
            let other = found(vm, &other)?;
            raised(vm, stage::with(|stage| touch(stage, Found::Character(place), other)))
        }
        None => raised(
            vm,
            stage::with(|stage| {
                stage.ready()?;
                let is_own = |thing| Stage::is(thing, Found::Character(place));
                Ok(stage.snapshot.contacts.iter().any(|contact| is_own(contact.a) != is_own(contact.b)))
            }),
        ),
    }
}

/// Whether two things touch.
pub(super) fn touch(stage: &Stage, one: Found, other: Found) -> Result<bool, String> {
    stage.ready()?;
    Ok(stage.snapshot.contacts.iter().any(|contact| {
        let (a, b) = (contact.a, contact.b);
        (Stage::is(a, one) && Stage::is(b, other)) || (Stage::is(a, other) && Stage::is(b, one))
    }))
}

/// Resolves an argument: a name, or a character object.
pub(super) fn found(vm: &VirtualMachine, value: &PyObject) -> PyResult<Found> {
    if let Some(character) = value.downcast_ref::<Character>() {
        return Ok(Found::Character(character.place));
    }
    let Some(name) = value.downcast_ref::<PyStr>() else {
        let kind = value.class().name().to_string();
        return Err(vm.new_type_error(format!("expected a name or a character, not {kind}")));
    };
    let name = name.to_string_lossy();
    raised(vm, stage::with(|stage| stage.find(&name)))
}

/// `(part, other, other_part, point, impulse)` of every contact of the character, the impulse on the character.
pub(super) fn contacts(vm: &VirtualMachine, place: usize) -> PyResult {
    struct Row {
        part: Option<String>,
        other: (String, Option<String>),
        point: [f64; 3],
        impulse: [f64; 3],
    }
    let rows = stage::with(|stage| {
        stage.ready()?;
        let mut rows = Vec::new();
        for contact in &stage.snapshot.contacts {
            let sides = [
                (contact.a, contact.b, contact.impulse.map(|impulse| -impulse)),
                (contact.b, contact.a, contact.impulse),
            ];
            for (own, other, impulse) in sides {
                if matches!(own, Thing::Part(character, _) if character == place) {
                    let (part, other) = (stage.called(own).1, stage.called(other));
                    rows.push(Row { part, other, point: contact.point, impulse });
                }
            }
        }
        Ok(rows)
    });
    let name = |name: Option<String>| match name {
        Some(name) => vm.ctx.new_str(name).into(),
        None => vm.ctx.none(),
    };
    let mut list = Vec::new();
    for row in raised(vm, rows)? {
        let (other, other_part) = row.other;
        let (point, impulse) = (vector(vm, row.point)?, vector(vm, row.impulse)?);
        let row = vec![name(row.part), vm.ctx.new_str(other).into(), name(other_part), point, impulse];
        list.push(vm.ctx.new_tuple(row).into());
    }
    Ok(vm.ctx.new_list(list).into())
}
