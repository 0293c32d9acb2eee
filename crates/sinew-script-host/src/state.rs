//! Saved state of a script: the attributes of its instance and of its classes, and its global variables.
//!
//! Kept are `None`, bools, ints, floats, strings, lists, tuples, dicts, vectors, objects of the script's own classes and bound methods
//! of such objects; names that the text itself defines (functions, classes, modules) are kept as names. What two names share
//! they share afterwards. An attribute or a variable is kept whole or not at all: one that holds anything else, such as a
//! generator, stays as reading the text and making the object leave it, and is named as lost.

use super::controller::Controller;
use super::{cut, interpreter, stage};
use rustpython_vm::builtins::{
    PyBoundMethod, PyDict, PyDictRef, PyFloat, PyInt, PyList, PyStr, PyTuple, PyType, PyTypeRef,
};
use rustpython_vm::{AsObject, PyObject, PyObjectRef, PyResult, TryFromObject, VirtualMachine};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Maximum number of saved values of one script.
const MAX_VALUES: usize = 100_000;

/// Maximum number of reported names that could not be saved.
const MAX_LOST: usize = 20;

/// The saved state.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Kept {
    random: u64,
    starts: bool,
    is_stopped: bool,
    values: Vec<Value>,
    /// The object's attributes, the text's variables, then each class's attributes.
    spaces: Vec<Space>,
}

/// A space of names. What stands in `names` and has no value was there and is lost.
#[derive(Default, Serialize, Deserialize)]
struct Space {
    class: Option<String>,
    names: Vec<(String, Option<u32>)>,
}

/// A value; refers to others by their index in the table.
#[derive(Clone, Serialize, Deserialize)]
enum Value {
    None,
    Bool(bool),
    Int(i64),
    /// In decimal digits.
    Long(String),
    Float(f64),
    Text(String),
    Vector([f64; 3]),
    Tuple(Vec<u32>),
    List(Vec<u32>),
    Dict(Vec<(u32, u32)>),
    /// The object that steps.
    Own,
    /// Another of the script's own classes.
    Object(String, Vec<(String, u32)>),
    Method(u32, String),
    /// What the text defines under this name.
    Named(String),
}

/// What a text defined when it was read, by identity: what is the same object still is kept as a name.
pub(super) struct Defined(BTreeMap<usize, String>);

impl Defined {
    /// Of a text that has just been read: functions, classes, modules and whatever else is no plain value.
    pub fn of(vm: &VirtualMachine, globals: &PyDictRef) -> Defined {
        let items = globals.items_vec().into_iter();
        let defined = items.filter(|(_, value)| !is_plain(vm, value));
        Defined(defined.filter_map(|(name, value)| Some((value.get_id(), text_of(&name)?))).collect())
    }

    fn name(&self, value: &PyObject) -> Option<&str> {
        self.0.get(&value.get_id()).map(String::as_str)
    }

    /// The script's own classes.
    fn classes(&self, globals: &PyDictRef, vm: &VirtualMachine) -> Vec<(String, PyTypeRef)> {
        let found = self.0.values().filter_map(|name| {
            let class = globals.get_item_opt(name.as_str(), vm).ok()??.downcast::<PyType>().ok()?;
            is_own(vm, &class).then(|| (name.clone(), class))
        });
        // By name: identity differs from one process to the next.
        let mut found: Vec<_> = found.collect();
        found.sort_by(|(one, _), (other, _)| one.cmp(other));
        found
    }
}

/// A class of the script: made by it, from nothing else.
fn is_own(vm: &VirtualMachine, class: &PyTypeRef) -> bool {
    let module = class.as_object().get_attr("__module__", vm);
    let is_scripts = module.is_ok_and(|module| text_of(&module).as_deref() == Some("controller"));
    is_scripts
        && class.mro_collect().iter().all(|base| {
            base.is(vm.ctx.types.object_type)
                || base
                    .as_object()
                    .get_attr("__module__", vm)
                    .is_ok_and(|of| text_of(&of).as_deref() == Some("controller"))
        })
}

fn text_of(value: &PyObject) -> Option<String> {
    value.downcast_ref::<PyStr>()?.to_str().map(str::to_owned)
}

fn is_plain(vm: &VirtualMachine, value: &PyObjectRef) -> bool {
    let types = &vm.ctx.types;
    let plain = [
        types.bool_type,
        types.int_type,
        types.float_type,
        types.str_type,
        types.tuple_type,
        types.list_type,
        types.dict_type,
    ];
    vm.is_none(value) || plain.iter().any(|class| value.class().is(*class))
}

/// Saves a script.
pub(super) fn save(vm: &VirtualMachine, controller: &Controller) -> (Kept, Vec<String>) {
    let mut saver = Saver {
        vm,
        own: &controller.instance,
        defined: &controller.defined,
        classes: controller.defined.classes(&controller.globals, vm),
        values: Vec::new(),
        places: BTreeMap::new(),
        texts: BTreeMap::new(),
        held: Vec::new(),
        lost: Vec::new(),
    };
    let mut spaces = Vec::new();
    if let Some(attributes) = controller.instance.dict() {
        spaces.push(saver.space(None, "self", &attributes.items_vec()));
    }
    let globals: Vec<_> = controller.globals.items_vec();
    let variables = globals.into_iter().filter(|(name, value)| {
        let name = text_of(name);
        name.as_deref() != Some("__builtins__") && name.as_deref() != controller.defined.name(value)
    });
    let variables: Vec<_> = variables.collect();
    spaces.push(saver.space(None, "", &variables));
    for (name, class) in saver.classes.clone() {
        let attributes: Vec<_> = class
            .get_attributes()
            .into_iter()
            .filter(|(name, value)| !name.as_str().starts_with("__") && is_plain(vm, value))
            .map(|(name, value)| (vm.ctx.new_str(name.as_str()).into(), value))
            .collect();
        spaces.push(saver.space(Some(name.clone()), &name, &attributes));
    }
    let mut lost = saver.lost;
    let starts = match &controller.before {
        Some(Some(_)) => {
            lost.push("the object from before the reload".to_owned());
            true
        }
        before => before.is_some(),
    };
    if lost.len() > MAX_LOST {
        let more = lost.len() - MAX_LOST;
        lost.truncate(MAX_LOST);
        lost.push(format!("{more} more"));
    }
    let random = stage::with(|stage| stage.random);
    (Kept { random, starts, is_stopped: controller.is_stopped, values: saver.values, spaces }, lost)
}

struct Saver<'a> {
    vm: &'a VirtualMachine,
    own: &'a PyObjectRef,
    defined: &'a Defined,
    classes: Vec<(String, PyTypeRef)>,
    values: Vec<Value>,
    /// The place of each object in the table, by identity.
    places: BTreeMap<usize, u32>,
    /// The place of each text: which of them are one object is Python's own affair.
    texts: BTreeMap<String, u32>,
    /// Keeps objects alive whose identity the table uses.
    held: Vec<PyObjectRef>,
    lost: Vec<String>,
}

impl Saver<'_> {
    fn space(&mut self, class: Option<String>, prefix: &str, items: &[(PyObjectRef, PyObjectRef)]) -> Space {
        let mut names = Vec::new();
        for (name, value) in items {
            let Some(name) = text_of(name) else { continue };
            let kept = self.whole(value);
            if let Err(what) = &kept {
                let dot = if prefix.is_empty() { "" } else { "." };
                self.lost.push(format!("{} ({what})", cut(&format!("{prefix}{dot}{name}"), 80)));
            }
            names.push((name, kept.ok()));
        }
        Space { class, names }
    }

    /// Saves a value with everything that it refers to; on failure names the obstacle and leaves the table unchanged.
    fn whole(&mut self, value: &PyObjectRef) -> Result<u32, String> {
        let (values, held) = (self.values.len(), self.held.len());
        let kept = self.keep(value);
        if kept.is_err() {
            self.values.truncate(values);
            self.texts.retain(|_, place| (*place as usize) < values);
            for object in self.held.drain(held..) {
                self.places.remove(&object.get_id());
            }
        }
        kept
    }

    /// A list of what is still to be looked at in place of recursion: scripts nest as deep as they like.
    fn keep(&mut self, value: &PyObjectRef) -> Result<u32, String> {
        let mut to_do = Vec::new();
        let first = self.place(value, &mut to_do)?;
        while let Some((place, object)) = to_do.pop() {
            let value = self.inside(&object, &mut to_do)?;
            self.values[place as usize] = value;
        }
        Ok(first)
    }

    /// The index of a value in the table; adds it if it is new.
    fn place(&mut self, value: &PyObjectRef, to_do: &mut Vec<(u32, PyObjectRef)>) -> Result<u32, String> {
        if let Some(place) = self.places.get(&value.get_id()) {
            return Ok(*place);
        }
        if self.values.len() >= MAX_VALUES {
            return Err(format!("more than {MAX_VALUES} values"));
        }
        let place = self.values.len() as u32;
        if value.class().is(self.vm.ctx.types.str_type)
            && let Some(text) = text_of(value)
        {
            if let Some(place) = self.texts.get(&text) {
                return Ok(*place);
            }
            self.texts.insert(text, place);
        }
        self.values.push(Value::None);
        self.places.insert(value.get_id(), place);
        self.held.push(value.clone());
        to_do.push((place, value.clone()));
        Ok(place)
    }

    fn inside(&mut self, value: &PyObjectRef, to_do: &mut Vec<(u32, PyObjectRef)>) -> Result<Value, String> {
        let (vm, types) = (self.vm, &self.vm.ctx.types);
        let class = value.class().to_owned();
        let kind = || cut(&class.name(), 60);
        if vm.is_none(value) {
            return Ok(Value::None);
        }
        if value.is(self.own) {
            return Ok(Value::Own);
        }
        if let Some(name) = self.defined.name(value) {
            return Ok(Value::Named(name.to_owned()));
        }
        if class.is(types.bool_type) {
            return Ok(Value::Bool(bool::try_from_object(vm, value.clone()).map_err(|_| kind())?));
        }
        if class.is(types.int_type) {
            let number = value.downcast_ref::<PyInt>().ok_or_else(kind)?;
            let digits = number.to_str_radix_10();
            return Ok(digits.parse().map_or_else(|_| Value::Long(digits), Value::Int));
        }
        if class.is(types.float_type) {
            return Ok(Value::Float(value.downcast_ref::<PyFloat>().ok_or_else(kind)?.to_f64()));
        }
        if class.is(types.str_type) {
            return text_of(value).map(Value::Text).ok_or_else(kind);
        }
        if let Some(tuple) = value.downcast_ref::<PyTuple>() {
            if class.is(&interpreter::vector_class(vm)) {
                let numbers = tuple.as_slice().iter().map(|number| Some(number.downcast_ref::<PyFloat>()?.to_f64()));
                let numbers: Option<Vec<f64>> = numbers.collect();
                if let Some(numbers) = numbers.and_then(|numbers| numbers.try_into().ok()) {
                    return Ok(Value::Vector(numbers));
                }
            } else if class.is(types.tuple_type) {
                let places = tuple.as_slice().iter().map(|element| self.place(element, to_do));
                return Ok(Value::Tuple(places.collect::<Result<_, _>>()?));
            }
        } else if class.is(types.list_type) {
            let elements = value.downcast_ref::<PyList>().ok_or_else(kind)?.borrow_vec().to_vec();
            let places = elements.iter().map(|element| self.place(element, to_do));
            return Ok(Value::List(places.collect::<Result<_, _>>()?));
        } else if class.is(types.dict_type) {
            let items = value.downcast_ref::<PyDict>().ok_or_else(kind)?.to_owned().items_vec();
            let places = items.iter().map(|(key, value)| Ok((self.place(key, to_do)?, self.place(value, to_do)?)));
            return Ok(Value::Dict(places.collect::<Result<_, String>>()?));
        } else if value.downcast_ref::<PyBoundMethod>().is_some() {
            return self.method(value, to_do).ok_or_else(kind);
        } else if let Some((name, _)) = self.classes.iter().find(|(_, own)| own.is(&class)) {
            let name = name.clone();
            let attributes = value.dict().ok_or_else(kind)?.items_vec();
            let places = attributes.iter().map(|(name, value)| {
                let place = self.place(value, to_do)?;
                Ok((text_of(name).ok_or_else(|| "an attribute without a name".to_owned())?, place))
            });
            return Ok(Value::Object(name, places.collect::<Result<_, String>>()?));
        }
        Err(kind())
    }

    /// A method of an object, found again under its name.
    fn method(&mut self, value: &PyObjectRef, to_do: &mut Vec<(u32, PyObjectRef)>) -> Option<Value> {
        let object = value.get_attr("__self__", self.vm).ok()?;
        let name = text_of(&*value.get_attr("__name__", self.vm).ok()?)?;
        let same = object.get_attr(self.vm.ctx.intern_str(name.as_str()), self.vm).ok()?;
        let is_same = self.vm.bool_eq(&same, value).ok()?;
        let place = is_same.then(|| self.place(&object, to_do).ok()).flatten()?;
        Some(Value::Method(place, name))
    }
}

/// Restores a script whose text has just been read and whose object has just been made.
pub(super) fn restore(vm: &VirtualMachine, controller: &mut Controller, kept: &Kept) -> PyResult<()> {
    let broken = || vm.new_value_error("the kept state does not fit the text");
    let made = Maker { vm, controller, values: &kept.values }.make()?;
    let value = |place: u32| made.get(place as usize).cloned().flatten().ok_or_else(broken);
    for (index, space) in kept.spaces.iter().enumerate() {
        let names = &space.names;
        if let Some(class) = &space.class {
            let class = controller.globals.get_item(class.as_str(), vm)?;
            for (name, place) in names {
                if let Some(place) = place {
                    class.set_attr(vm.ctx.intern_str(name.as_str()), value(*place)?, vm)?;
                }
            }
            continue;
        }
        let dict = match (index, controller.instance.dict()) {
            (0, Some(attributes)) if kept.spaces.len() > 1 => attributes,
            _ => controller.globals.clone(),
        };
        let is_globals = dict.is(&controller.globals);
        let mut fresh = BTreeMap::new();
        for (name, present) in dict.items_vec() {
            let name = text_of(&name).unwrap_or_default();
            let is_fixed =
                is_globals && (name == "__builtins__" || controller.defined.name(&present) == Some(name.as_str()));
            if !is_fixed {
                dict.del_item(name.as_str(), vm)?;
                fresh.insert(name, present);
            }
        }
        // In the order of then, which a script can see. What is lost stays as it is.
        for (name, place) in names {
            let kept = place.map(&value).transpose()?;
            if let Some(value) = kept.or_else(|| fresh.remove(name)) {
                dict.set_item(name.as_str(), value, vm)?;
            }
        }
    }
    controller.before = kept.starts.then_some(None);
    controller.is_stopped = kept.is_stopped;
    stage::with(|stage| stage.random = kept.random);
    Ok(())
}

struct Maker<'a> {
    vm: &'a VirtualMachine,
    controller: &'a Controller,
    values: &'a [Value],
}

impl Maker<'_> {
    fn broken(&self) -> rustpython_vm::builtins::PyBaseExceptionRef {
        self.vm.new_value_error("the kept state does not fit the text")
    }

    /// All values: first those that hold no others and empty ones that will, then methods and tuples, then what is in the empty
    /// ones.
    fn make(&self) -> PyResult<Vec<Option<PyObjectRef>>> {
        let vm = self.vm;
        let mut made: Vec<Option<PyObjectRef>> = Vec::with_capacity(self.values.len());
        for value in self.values {
            made.push(self.alone(value)?);
        }
        for (place, value) in self.values.iter().enumerate() {
            if let Value::Method(object, name) = value {
                let object = made.get(*object as usize).cloned().flatten().ok_or_else(|| self.broken())?;
                made[place] = Some(object.get_attr(vm.ctx.intern_str(name.as_str()), vm)?);
            }
        }
        for place in 0..self.values.len() {
            self.tuples(place, &mut made)?;
        }
        let of = |place: &u32| made.get(*place as usize).cloned().flatten().ok_or_else(|| self.broken());
        for (value, object) in self.values.iter().zip(&made) {
            let Some(object) = object else { continue };
            match value {
                Value::List(places) => {
                    let list = object.downcast_ref::<PyList>().ok_or_else(|| self.broken())?;
                    *list.borrow_vec_mut() = places.iter().map(of).collect::<PyResult<_>>()?;
                }
                Value::Dict(items) => {
                    for (key, value) in items {
                        object.set_item(&*of(key)?, of(value)?, vm)?;
                    }
                }
                Value::Object(_, attributes) => {
                    let dict = object.dict().ok_or_else(|| self.broken())?;
                    for (name, value) in attributes {
                        dict.set_item(name.as_str(), of(value)?, vm)?;
                    }
                }
                _ => {}
            }
        }
        Ok(made)
    }

    /// A value that holds no others, or an empty one that will.
    fn alone(&self, value: &Value) -> PyResult<Option<PyObjectRef>> {
        let (vm, context) = (self.vm, &self.vm.ctx);
        Ok(Some(match value {
            Value::None => context.none(),
            Value::Bool(value) => context.new_bool(*value).into(),
            Value::Int(value) => context.new_int(*value).into(),
            Value::Long(digits) => context.types.int_type.as_object().call((digits.as_str(),), vm)?,
            Value::Float(value) => context.new_float(*value).into(),
            Value::Text(text) => context.new_str(text.as_str()).into(),
            Value::Vector(numbers) => super::arguments::vector(vm, *numbers)?,
            Value::Own => self.controller.instance.clone(),
            Value::List(_) => context.new_list(Vec::new()).into(),
            Value::Dict(_) => context.new_dict().into(),
            Value::Object(class, _) => {
                let class = self.controller.globals.get_item(class.as_str(), vm)?;
                let new = context.types.object_type.as_object().get_attr("__new__", vm)?;
                new.call((class,), vm)?
            }
            Value::Named(name) => self.controller.globals.get_item(name.as_str(), vm)?,
            Value::Tuple(_) | Value::Method(..) => return Ok(None),
        }))
    }

    /// Makes a tuple and those in it, the innermost first.
    fn tuples(&self, place: usize, made: &mut [Option<PyObjectRef>]) -> PyResult<()> {
        let mut open = vec![place];
        while let Some(&place) = open.last() {
            let (None, Some(Value::Tuple(places))) =
                (made.get(place).ok_or_else(|| self.broken())?, self.values.get(place))
            else {
                open.pop();
                continue;
            };
            let is_missing = |inner: &&u32| {
                let inner = **inner as usize;
                made.get(inner).is_some_and(Option::is_none) && matches!(self.values[inner], Value::Tuple(_))
            };
            if let Some(inner) = places.iter().find(is_missing) {
                // A tuple cannot hold itself but by way of a list; deeper than there are values means that it does.
                if open.len() > self.values.len() {
                    return Err(self.broken());
                }
                open.push(*inner as usize);
                continue;
            }
            let elements =
                places.iter().map(|inner| made.get(*inner as usize).cloned().flatten().ok_or_else(|| self.broken()));
            made[place] = Some(self.vm.ctx.new_tuple(elements.collect::<PyResult<_>>()?).into());
            open.pop();
        }
        Ok(())
    }
}
