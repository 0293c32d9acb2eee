//! The picture of a response.

use super::answer::Answer;
use super::job::RespondJob;
use super::report::preset_name;
use crate::figure::figure;
use glam::DVec3;
use sinew_body::humanoid::{Node, Shape};
use sinew_motion::{Humanoid, facing, floor_height_m};
use sinew_picture::{Arrow, Camera, Filmstrip, Limit, Mark, Panel, Plot, Series, Sheet, Style};
use sinew_response::{Deflection, Push};

/// Panels of the filmstrip.
const PANELS: usize = 16;

/// Lines of the plot: the joints that move most.
const LINES: usize = 7;

/// Shown before the first push \[s\].
const BEFORE_SECS: f64 = 0.15;

/// A filmstrip of the answer with the input as a ghost, and every joint's deflection over time.
pub fn sheet(answer: &Answer, humanoid: &Humanoid, job: &RespondJob, title: &str) -> Sheet {
    let pushes = &job.pushes;
    let spans: Vec<(f64, f64)> = pushes
        .iter()
        .map(|push| (push.at_secs, push.for_secs))
        .chain(job.ground.iter().map(|jerk| (jerk.at_secs, jerk.for_secs)))
        .collect();
    let deflection = Deflection::between(&answer.pushed, &answer.unpushed);
    let begins = spans.iter().map(|(at, _)| *at).fold(f64::INFINITY, f64::min);
    let duration = answer.clip.duration_secs();
    let (from, to) = if begins <= duration {
        let recovered = answer.report.recovered_after_s.unwrap_or(2.5).clamp(0.6, 2.5);
        let ends = spans.iter().map(|(at, lasts)| at + lasts).fold(0.0, f64::max);
        ((begins - BEFORE_SECS).max(0.0), (ends + recovered).min(duration))
    } else {
        (answer.prepared.first_frame() as f64 * answer.clip.frame_time_secs(), duration.min(2.5))
    };
    let shapes = answer.prepared.reduction().shapes();
    let strip = Filmstrip {
        title: String::new(),
        subtitle: String::new(),
        panels: panels(answer, pushes, &shapes, from, to),
        camera: camera(answer, humanoid, from),
        style: Style { floor_m: floor_height_m(answer.prepared.clip(), humanoid), ..Style::default() },
    };
    let settings = answer.prepared.motion().stable_settings();
    let mut sheet = Sheet {
        title: title.to_owned(),
        subtitle: subtitle(answer, job),
        pieces: vec![strip.into()],
        footer: format!(
            "preset {}, k = {}, compliance {:.2}; {:.0} kg, {:.2} m; pale body: the input",
            preset_name(settings.preset),
            settings.k,
            settings.compliance,
            answer.report.mass_kg,
            answer.report.height_m
        ),
        ..Sheet::default()
    };
    if !spans.is_empty() {
        sheet.pieces.push(plot(&deflection, job, (begins - 0.3).max(0.0), (to + 1.0).min(duration)).into());
    }
    sheet
}

fn subtitle(answer: &Answer, job: &RespondJob) -> String {
    let back = answer.report.recovered_after_s;
    let back =
        back.map_or("not recovered by the end".to_owned(), |secs| format!("recovered {secs:.2} s after it ended"));
    match (&job.pushes[..], &job.ground[..]) {
        ([], []) => "no push".to_owned(),
        ([push], []) => format!(
            "{:.0} N on the {} at {:.2} s for {:.2} s; {back}",
            push.force_n.length(),
            push.part,
            push.at_secs,
            push.for_secs
        ),
        ([], [jerk]) => format!(
            "ground jerked by {:.1} m/s² at {:.2} s for {:.2} s, seen from the ground; {back}",
            jerk.acceleration.length(),
            jerk.at_secs,
            jerk.for_secs
        ),
        (pushes, []) => format!("{} pushes; the last {back}", pushes.len()),
        (pushes, jerks) => format!("{} pushes and {} jerks of the ground; the last {back}", pushes.len(), jerks.len()),
    }
}

fn panels(answer: &Answer, pushes: &[Push], shapes: &[(Node, usize, Shape)], from: f64, to: f64) -> Vec<Panel> {
    let frame_time = answer.clip.frame_time_secs();
    let hips = answer.prepared.reduction().joint(Node::Hips).unwrap_or(0);
    let last = answer.clip.frames().saturating_sub(1);
    (0..PANELS)
        .map(|index| {
            let wanted = from + (to - from) * index as f64 / (PANELS - 1) as f64;
            let frame = ((wanted / frame_time).round() as usize).min(last);
            let time_secs = frame as f64 * frame_time;
            // Seen from the ground, which may have been jerked.
            let ground = answer.pushed.deviation_at(time_secs).ground_shift / answer.prepared.reduction().scale();
            let (mut ours, input) = (answer.clip.world(frame), answer.prepared.clip().world(frame));
            for joint in &mut ours {
                joint.translation -= ground;
            }
            // A push that falls between two panels is shown in the nearer one.
            let step = (to - from) / (PANELS - 1) as f64;
            let acting = |push: &Push| {
                let slack = if push.for_secs < step { 0.5 * (step - push.for_secs) } else { 0.0 };
                (push.at_secs - slack..=push.at_secs + push.for_secs + slack).contains(&time_secs)
            };
            let arrows = pushes.iter().enumerate().filter(|(_, push)| acting(push)).filter_map(|(index, push)| {
                let force_n = answer.pushed.forces()[index]?;
                let node = Node::of(push.part);
                let (_, joint, shape) = shapes.iter().find(|(other, _, _)| *other == node)?;
                Some(Arrow { at: ours[*joint].point((shape.from + shape.to) * 0.5), force_n, label: String::new() })
            });
            Panel {
                time_secs,
                figure: figure(shapes, &ours),
                ghost: Some(figure(shapes, &input)),
                arrows: arrows.collect(),
                follow: Some(input[hips].translation),
                caption: String::new(),
            }
        })
        .collect()
}

fn camera(answer: &Answer, humanoid: &Humanoid, secs: f64) -> Camera {
    let frame = (secs / answer.clip.frame_time_secs()) as usize;
    let world = answer.prepared.clip().world(frame.min(answer.prepared.clip().frames().saturating_sub(1)));
    Camera::three_quarter().about_heading(facing(&world, humanoid).unwrap_or(DVec3::Z))
}

fn plot(deflection: &Deflection, job: &RespondJob, from: f64, to: f64) -> Plot {
    let pushes = job.pushes.iter().map(|push| Mark {
        from_secs: push.at_secs,
        to_secs: push.at_secs + push.for_secs,
        label: format!("{} {:.0} N", push.part, push.force_n.length()),
    });
    let jerks = job.ground.iter().map(|jerk| Mark {
        from_secs: jerk.at_secs,
        to_secs: jerk.at_secs + jerk.for_secs,
        label: format!("ground {:.1} m/s²", jerk.acceleration.length()),
    });
    let mut peaks: Vec<(Node, f64)> = Node::ALL
        .into_iter()
        .map(|node| (node, deflection.rows().iter().map(|(_, angles)| angles[node.index()]).fold(0.0, f64::max)))
        .collect();
    peaks.sort_by(|a, b| b.1.total_cmp(&a.1));
    let series = peaks.iter().take(LINES).map(|(node, _)| {
        let rows = deflection.rows().iter().filter(|(secs, _)| (from..=to).contains(secs));
        Series::new(node.part().name(), rows.map(|(secs, angles)| (*secs, angles[node.index()].to_degrees())).collect())
    });
    Plot {
        title: "Deflection of each joint from the undisturbed motion".to_owned(),
        x_label: "time (s)".to_owned(),
        y_label: "deflection (°)".to_owned(),
        series: series.collect(),
        marks: pushes.chain(jerks).collect(),
        limits: vec![Limit { value: 2.0, label: "recovered below 2°".to_owned() }],
        ..Plot::default()
    }
}
