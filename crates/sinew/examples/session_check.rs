//! Whether a session on several machines was what it should be: `session_check TAKE SERVER.json ROUND_TRIP_MS CLIENT.json...`,
//! from a take and the reports of `sinew serve` and `sinew join`.
//!
//! Every actor that has a performer was performed. The hashes of server and clients agree at every step that two of them have, and what one actor sent reached the other
//! characters within one round trip plus two physics steps: from the moment of sending to the moment at which the others are
//! shown the first frame in which another character is in another state than it would be otherwise. Both moments are told by
//! the stage's steps: a frame of step n is at every client half a round trip after step n, so the time between them is the
//! steps between the frame that the sender saw last and the changed one, less the time since that frame had arrived.

use serde_json::Value;
use sinew::jobs::session::first_effect;
use sinew::stage::Take;
use std::collections::BTreeMap;
use std::path::Path;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [take, server, round_trip, clients @ ..] = &words[..] else {
        return Err("usage: session_check TAKE SERVER.json ROUND_TRIP_MS CLIENT.json...".into());
    };
    let take = Take::open(Path::new(take))?;
    let server = report(server)?;
    let clients = clients.iter().map(|path| report(path)).collect::<Result<Vec<Value>, Failure>>()?;
    let mut compared = 0;
    for client in &clients {
        compared += agree(&server, client)?;
        for other in &clients {
            agree(client, other)?;
        }
    }
    println!("{compared} hashes of frames agree between the server and {} clients", clients.len());
    if compared == 0 {
        return Err("there was nothing to compare".into());
    }
    performed(&server)?;
    in_time(&take, &server, round_trip.parse()?, &clients)
}

/// Whoever has a performer followed it.
fn performed(server: &Value) -> Result<(), Failure> {
    for (name, actor) in server["actors"].as_object().into_iter().flatten() {
        println!(
            "{name}: {} samples of its performer, {} late, {} lost",
            actor["received"], actor["late"], actor["lost"]
        );
        if actor["received"] == 0 {
            return Err(format!("nobody performed {name}").into());
        }
    }
    Ok(())
}

fn report(path: &str) -> Result<Value, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?;
    Ok(serde_json::from_str(&text)?)
}

/// Compares the hashes of equal steps, and says how many there were.
fn agree(one: &Value, other: &Value) -> Result<usize, Failure> {
    let hashes = |report: &Value| -> BTreeMap<String, Value> {
        let hashes = report["hashes"].as_object();
        hashes.into_iter().flatten().map(|(step, hash)| (step.clone(), hash.clone())).collect()
    };
    let (one, other) = (hashes(one), hashes(other));
    let mut count = 0;
    for (step, hash) in &one {
        if let Some(seen) = other.get(step) {
            count += 1;
            if seen != hash {
                return Err(format!("step {step}: hashes {hash} and {seen} differ").into());
            }
        }
    }
    Ok(count)
}

/// Every order of every client against the time that it may take.
fn in_time(take: &Take, server: &Value, round_trip_ms: f64, clients: &[Value]) -> Result<(), Failure> {
    let allowed = round_trip_ms / 1e3 * f64::from(take.physics_hz) + 2.0;
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let mut applied = list(&server["applied"]);
    let (mut checked, mut late) = (0, Vec::new());
    for client in clients {
        let own: Vec<String> =
            list(&client["actors"]).iter().filter_map(|name| Some(name.as_str()?.to_owned())).collect();
        for sent in list(&client["sent"]) {
            // One that was sent when the client was about to be cut off may be missing.
            let is_it =
                |order: &Value| order["what"] == sent["what"] && order["step"].as_u64() >= sent["seen_step"].as_u64();
            let Some(place) = applied.iter().position(is_it) else { continue };
            let order = applied.remove(place);
            let step = order["step"].as_u64().unwrap_or_default();
            let Some(command) = take.commands.iter().position(|stamped| stamped.step == step) else { continue };
            let seen = sent["seen_step"].as_u64().unwrap_or_default();
            let scene = take.to_scene(None)?;
            for other in scene.characters.keys().filter(|name| !own.contains(name)) {
                let Some(reached) = first_effect(take, command, other, None)? else { continue };
                let since = sent["since_ms"].as_f64().unwrap_or_default() / 1e3 * f64::from(take.physics_hz);
                let steps = (reached - seen) as f64 - since;
                checked += 1;
                println!(
                    "{} sent {since:.1} steps after frame {seen}, arrived at {}, applied at {step}, reached {other} at {reached}: \
                     {steps:.1} steps, of {allowed:.1} allowed",
                    sent["what"], order["arrived_step"],
                );
                if steps > allowed {
                    late.push(steps);
                }
            }
        }
    }
    if checked == 0 {
        return Err("no order reached another character: press a key that pulls".into());
    }
    if late.is_empty() {
        println!("all {checked} within one round trip plus two steps");
        Ok(())
    } else {
        Err(format!("{} of {checked} took longer than one round trip plus two steps", late.len()).into())
    }
}
