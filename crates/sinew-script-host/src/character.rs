//! The Python class of `skeleton` and other characters: its queries are in `sense.rs`, its commands in `drive.rs`.

pub(super) use character::{Character, module_def};

#[rustpython_vm::pymodule(name = "_character")]
#[allow(non_snake_case, reason = "Python's names, as the paper prints them")]
pub(super) mod character {
    use crate::{drive, drive_kd, reach, sense, stage};
    use rustpython_vm::builtins::PyUtf8StrRef;
    use rustpython_vm::types::Representable;
    use rustpython_vm::{Py, PyObjectRef, PyPayload, PyResult, VirtualMachine, pyclass};

    #[pyattr]
    #[pyclass(name = "Character")]
    #[derive(Debug, PyPayload)]
    pub(crate) struct Character {
        pub place: usize,
    }

    impl Representable for Character {
        fn repr_str(zelf: &Py<Self>, _vm: &VirtualMachine) -> PyResult<String> {
            Ok(format!("<character {}>", zelf.name()))
        }
    }

    #[pyclass(with(Representable))]
    impl Character {
        #[pygetset]
        fn name(&self) -> String {
            stage::with(|stage| stage.names.characters.get(self.place).map(|names| names.name.clone()))
                .unwrap_or_default()
        }

        #[pymethod]
        fn getPosition(&self, part: sense::OnePart, vm: &VirtualMachine) -> PyResult {
            sense::position(vm, self.place, &part)
        }

        #[pymethod]
        fn getRotation(&self, part: sense::OnePart, vm: &VirtualMachine) -> PyResult {
            sense::rotation(vm, self.place, &part)
        }

        #[pymethod]
        fn getVelocity(&self, part: sense::OnePart, vm: &VirtualMachine) -> PyResult {
            sense::velocity(vm, self.place, &part)
        }

        #[pymethod]
        fn getFacing(&self, vm: &VirtualMachine) -> PyResult {
            sense::facing(vm, self.place)
        }

        #[pymethod]
        fn getLeft(&self, vm: &VirtualMachine) -> PyResult {
            sense::left(vm, self.place)
        }

        #[pymethod]
        fn getCenterOfMass(&self, vm: &VirtualMachine) -> PyResult {
            sense::centre_of_mass(vm, self.place)
        }

        #[pymethod]
        fn getCenterOfMassVelocity(&self, vm: &VirtualMachine) -> PyResult {
            sense::centre_velocity(vm, self.place)
        }

        #[pymethod]
        fn getSupport(&self, vm: &VirtualMachine) -> PyResult {
            sense::support(vm, self.place)
        }

        #[pymethod]
        fn getContacts(&self, vm: &VirtualMachine) -> PyResult {
            sense::contacts(vm, self.place)
        }

        #[pymethod]
        fn isColliding(&self, other: sense::Other, vm: &VirtualMachine) -> PyResult<bool> {
            sense::is_touching(vm, self.place, other)
        }

        #[pymethod]
        fn isLinkAttached(&self, link: PyUtf8StrRef, obj: PyUtf8StrRef, vm: &VirtualMachine) -> PyResult<bool> {
            sense::is_attached(vm, self.place, link.as_str(), obj.as_str())
        }

        #[pymethod]
        fn setTargetPose(&self, name: PyUtf8StrRef, vm: &VirtualMachine) -> PyResult<()> {
            drive::pose(vm, self.place, name.as_str())
        }

        #[pymethod]
        fn startGraph(&self, graph: drive::Graph, vm: &VirtualMachine) -> PyResult<()> {
            drive::graph(vm, self.place, graph)
        }

        #[pymethod]
        fn signal(&self, name: PyUtf8StrRef, vm: &VirtualMachine) -> PyResult<()> {
            drive::signal(vm, self.place, name.as_str())
        }

        #[pymethod]
        fn setIKTarget(&self, reach: drive::Reach, vm: &VirtualMachine) -> PyResult<()> {
            drive::reach(vm, self.place, reach)
        }

        #[pymethod]
        fn reach(&self, reaching: reach::Reaching, vm: &VirtualMachine) -> PyResult<()> {
            reach::reach(vm, self.place, reaching)
        }

        #[pymethod]
        fn endReach(&self, vm: &VirtualMachine) -> PyResult<()> {
            reach::end(vm, self.place)
        }

        #[pymethod]
        fn releaseIK(&self, link: drive::OneLink, vm: &VirtualMachine) -> PyResult<()> {
            drive::release(vm, self.place, link)
        }

        #[pymethod]
        fn attachLink(&self, hold: drive::Hold, vm: &VirtualMachine) -> PyResult<()> {
            drive::attach(vm, self.place, hold)
        }

        #[pymethod]
        fn detachLink(&self, let_go: drive::LetGo, vm: &VirtualMachine) -> PyResult<()> {
            drive::detach(vm, self.place, let_go)
        }

        #[pymethod]
        fn push(&self, push: drive::Push, vm: &VirtualMachine) -> PyResult<()> {
            drive::push(vm, self.place, push)
        }

        #[pymethod]
        fn setGain(&self, gain: drive::Gain, vm: &VirtualMachine) -> PyResult<()> {
            drive::gain(vm, self.place, gain)
        }

        #[pymethod]
        fn forcesOff(&self, parts: drive::SomeParts, vm: &VirtualMachine) -> PyResult<()> {
            drive::forces_off(vm, self.place, parts)
        }

        #[pymethod]
        fn forcesOn(&self, parts: drive::SomeParts, vm: &VirtualMachine) -> PyResult<()> {
            drive::forces_on(vm, self.place, parts)
        }

        #[pymethod]
        fn holdToPlane(&self, plane: drive::Plane, vm: &VirtualMachine) -> PyResult<()> {
            drive::plane(vm, self.place, plane)
        }

        #[pymethod]
        fn freePlane(&self, vm: &VirtualMachine) -> PyResult<()> {
            drive::free_plane(vm, self.place)
        }

        #[pymethod]
        fn setGravity(&self, gravity: drive::Gravity, vm: &VirtualMachine) -> PyResult<()> {
            drive::gravity(vm, self.place, gravity)
        }

        #[pymethod]
        fn setShape(&self, shape: drive::Shape, vm: &VirtualMachine) -> PyResult<()> {
            drive::shape(vm, self.place, shape)
        }

        #[pymethod]
        fn enableLayer(&self, layer: drive::Switch, vm: &VirtualMachine) -> PyResult<()> {
            drive::layer(vm, self.place, layer)
        }

        #[pymethod]
        fn useReflex(&self, reflex: drive::Switch, vm: &VirtualMachine) -> PyResult<()> {
            drive::reflex(vm, self.place, reflex)
        }

        #[pymethod]
        fn setWeights(&self, weights: drive_kd::Weights, vm: &VirtualMachine) -> PyResult<()> {
            drive_kd::weights(vm, self.place, weights)
        }

        #[pymethod]
        fn setKd(&self, gains: drive_kd::Kd, vm: &VirtualMachine) -> PyResult<()> {
            drive_kd::kd(vm, self.place, gains)
        }

        #[pymethod]
        fn pinsOff(&self, pins: drive_kd::Pins, vm: &VirtualMachine) -> PyResult<()> {
            drive_kd::pins(vm, self.place, false, pins)
        }

        #[pymethod]
        fn pinsOn(&self, pins: drive_kd::Pins, vm: &VirtualMachine) -> PyResult<()> {
            drive_kd::pins(vm, self.place, true, pins)
        }

        #[pymethod]
        fn useTracker(&self, name: PyUtf8StrRef, vm: &VirtualMachine) -> PyResult<()> {
            drive::tracker(vm, self.place, name.as_str())
        }
    }

    /// The Python object of a character.
    pub(crate) fn object(vm: &VirtualMachine, place: usize) -> PyObjectRef {
        Character { place }.into_pyobject(vm)
    }
}

pub(super) use character::object;
