//! The running stage becomes that of another scene: things go and come, and what stays reads poses, graphs and commands anew.

use super::plan::Plan;
use crate::Stage;
use crate::build::{self, StageError};
use crate::cast::Cast;
use crate::event::{Cause, Effect};
use crate::populate::{populate, pose_book, springs};
use crate::reaction::Reactions;
use crate::scene::Scene;
use crate::script_snapshot::names;
use crate::scripts::Owner;
use crate::stage::timed_orders;
use sinew_control::source::PoseBook;
use sinew_control::tracker::TrackerKind;
use sinew_world::{BodyState, CharacterId, Entity, World};
use std::collections::BTreeMap;
use std::sync::Arc;

impl Stage {
    /// Becomes the stage of another scene, between two steps.
    ///
    /// # Errors
    /// When something new cannot be built: nothing is changed then.
    pub(super) fn restructure(&mut self, scene: Scene) -> Result<(), StageError> {
        let (old, new) = (Arc::clone(&self.scene), Arc::new(scene));
        let mut plan = Plan::between(&old, &new);
        for &name in &plan.rebuilt {
            if let Some(place) = self.place_of(&old, &new, name) {
                plan.new.places.insert(name, place);
            }
        }
        // All that can fail happens to copies.
        let (mut cast, mut world) = (self.cast.clone(), self.world.clone());
        remove(&plan, &mut cast, &mut world);
        for (id, name) in self.cast.characters() {
            if let Some(spec) = new.characters.get(name) {
                cast.set_aliases(id, spec);
            }
        }
        world.set_world_gravity(new.stage.gravity_m_s2);
        let newcomers = populate(&new, &mut cast, &mut world, &plan.new)?;
        let is_same_cast = plan.is_empty();
        let mut books = BTreeMap::<CharacterId, PoseBook>::new();
        if !is_same_cast || (&old.poses, &old.graphs) != (&new.poses, &new.graphs) {
            for (id, actor) in self.actors.iter().filter(|(id, _)| cast.has_character(**id)) {
                books.insert(*id, pose_book(&new, &cast, cast.character_name(*id), actor.body())?);
            }
        }
        let (step, step_secs) = (world.frame().step, world.settings().step_secs());
        let timed = match is_same_cast && old.at == new.at {
            true => self.timed.clone(),
            false => timed_orders(&new, &cast, step, step_secs)?,
        };
        let reactions = match is_same_cast && old.when == new.when {
            true => self.reactions.clone(),
            false => Reactions::of(&new, &cast)
                .map_err(|error| crate::populate::at(&new, build::StageErrorKind::Refused, "when".to_owned(), error))?
                .continued(&self.reactions),
        };
        let before = self.snapshot_of_run();
        let scripts: Vec<Owner> = self.owners();
        (self.scene, self.cast, self.world) = (Arc::clone(&new), cast, world);
        (self.timed, self.reactions) = (timed, reactions);
        self.actors.retain(|id, _| self.cast.has_character(*id));
        for (id, book) in books {
            if let Some(actor) = self.actors.get_mut(&id) {
                actor.sources.set_book(Arc::new(book));
            }
        }
        self.actors.extend(newcomers);
        self.forget_stale();
        self.edit_files.extend(new.files().iter().map(|(path, held)| (path.clone(), held.clone())));
        let begun = self.read_springs_anew(&old, &new).and_then(|()| {
            build::begin(self, &plan.new.characters, &plan.new.props)?;
            self.change_prop_controllers(&old, &new)
        });
        if let Err(error) = begun {
            self.put_back(&before);
            self.scripts.retain(|owner, _| scripts.contains(owner));
            return Err(error);
        }
        let cast = &self.cast;
        for orders in &mut self.history {
            orders.retain(|order| order.stale(cast).is_none());
        }
        self.history.retain(|orders| !orders.is_empty());
        self.scripts.retain(|owner, _| match *owner {
            Owner::Character(id) => cast.has_character(id),
            Owner::Prop(id) => cast.has(Entity::Prop(id)),
        });
        self.rename_for_scripts();
        let come = plan.new.characters.iter().chain(&plan.new.props).filter(|name| !plan.rebuilt.contains(name));
        let gone = plan.characters_gone.iter().chain(&plan.props_gone).filter(|name| !plan.rebuilt.contains(name));
        let (came, left) =
            (come.map(|name| (*name).to_owned()).collect(), gone.map(|name| (*name).to_owned()).collect());
        self.note(Cause::Command, Effect::SceneEdited { came, left });
        Ok(())
    }

    /// Where a prop that is built anew begins: as it is now, unless the scene says otherwise by now.
    fn place_of(&self, old: &Scene, new: &Scene, name: &str) -> Option<BodyState> {
        let (before, spec) = (old.props.get(name)?, new.props.get(name)?);
        let begins = spec.in_world()?;
        let mut place = *self.world.frame().prop(self.cast.prop(name)?)?;
        if before.turn_deg != spec.turn_deg {
            place.rotation = begins.rotation;
        }
        if before.spin_rad_s != spec.spin_rad_s {
            place.angular_velocity = begins.spin;
        }
        Some(place)
    }

    /// What concerned somebody who is gone is forgotten.
    fn forget_stale(&mut self) {
        let cast = &self.cast;
        self.timed_effects.forget_stale(cast);
        self.shapes.retain(|(id, _), _| cast.has_character(*id));
        self.broken.retain(|joint| cast.has_joint(*joint));
    }

    /// Joints carry other loads in another gravity, and have other springs when the scene says so.
    fn read_springs_anew(&mut self, old: &Scene, new: &Scene) -> Result<(), StageError> {
        let is_other_gravity = old.stage.gravity_m_s2 != new.stage.gravity_m_s2;
        let gravity_m_s2 = self.world.settings().gravity_m_s2;
        let mut responding = Vec::new();
        for (id, actor) in &mut self.actors {
            let name = self.cast.character_name(*id);
            let (Some(before), Some(spec)) = (old.characters.get(name), new.characters.get(name)) else { continue };
            if is_other_gravity || before.joints != spec.joints {
                let springs = springs(spec, actor.body(), gravity_m_s2);
                actor.set_springs(springs);
            }
            if is_other_gravity && actor.tracker().kind() == TrackerKind::Response {
                responding.push(*id);
            }
        }
        for id in responding {
            self.set_tracker(id, TrackerKind::Response).map_err(|error| {
                let place = format!("characters.{}", self.cast.character_name(id));
                crate::populate::at(new, build::StageErrorKind::Refused, place, error)
            })?;
        }
        Ok(())
    }

    /// Props that stay and have another controller by now.
    fn change_prop_controllers(&mut self, old: &Scene, new: &Scene) -> Result<(), StageError> {
        for (name, spec) in &new.props {
            let is_changed = old.props.get(name).is_some_and(|before| before.controller != spec.controller);
            let Some(id) = self.cast.prop(name).filter(|_| is_changed) else { continue };
            self.scripts.remove(&Owner::Prop(id));
            if let Some(controller) = &spec.controller {
                self.start_prop_controller(id, controller).map_err(|error| {
                    crate::populate::at(new, build::StageErrorKind::Script, format!("props.{name}"), error)
                })?;
            }
        }
        Ok(())
    }

    /// Controllers that run hear of other names.
    fn rename_for_scripts(&mut self) {
        let names = names(&self.scene, &self.cast, self.world.frame());
        let step = self.world.frame().step;
        for owner in self.owners() {
            let Some(running) = self.scripts.get_mut(&owner) else { continue };
            if let Err(error) = running.script.set_names(names.clone()) {
                let name = running.name.clone();
                self.note_kill(step, &name, error.message);
            }
        }
    }
}

/// Takes out of cast and world what goes. Ids of the cast are those of the world, so that none is stale.
fn remove(plan: &Plan, cast: &mut Cast, world: &mut World) {
    let joints: Vec<_> = plan.joints_gone.iter().filter_map(|name| cast.joint(name)).collect();
    let within_ropes: Vec<_> = plan.ropes_gone.iter().flat_map(|name| cast.rope_joints(name)).collect();
    for id in joints.into_iter().chain(within_ropes) {
        let _ = world.remove_prop_joint(id);
        cast.remove_joint(id);
    }
    for id in plan.props_gone.iter().filter_map(|name| cast.prop(name)).collect::<Vec<_>>() {
        let _ = world.remove_prop(id);
        cast.remove_prop(id);
    }
    for id in plan.characters_gone.iter().filter_map(|name| cast.character(name)).collect::<Vec<_>>() {
        let _ = world.remove_character(id);
        cast.remove_character(id);
    }
}
