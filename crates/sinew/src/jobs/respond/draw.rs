//! The picture of a response.

use super::answer::Answer;
use super::job::RespondJob;
use super::panels::Panels;
use super::report::preset_name;
use crate::jobs::moments::moments;
use sinew_body::humanoid::Node;
use sinew_motion::{Humanoid, floor_height_m, resample};
use sinew_picture::{Filmstrip, Limit, Mark, Movie, MovieStyle, Plot, Series, Sheet, Style};
use sinew_response::Deflection;

/// Panels of the filmstrip.
const PANELS: usize = 12;

/// Lines of the plot: the joints that move most.
const LINES: usize = 7;

/// Shown before the first push \[s\].
const BEFORE_SECS: f64 = 0.15;

/// A filmstrip of the answer with the input as a ghost, seen across the push, and every joint's deflection over time.
pub fn sheet(answer: &Answer, humanoid: &Humanoid, job: &RespondJob, title: &str) -> Sheet {
    let spans: Vec<(f64, f64)> = job
        .pushes
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
    let view = Panels { answer, job, ours: &answer.clip, input: answer.prepared.clip(), shown_secs: 0.0 };
    let frames = view.frames_between(from, to);
    let chosen = moments(&view.change_m(&frames), &view.happens(&frames), PANELS);
    let strip = Filmstrip {
        panels: chosen.into_iter().map(|index| view.panel(frames[index])).collect(),
        camera: view.camera(humanoid),
        style: Style {
            floor_m: floor_height_m(answer.prepared.clip(), humanoid),
            columns: 6,
            body_height_m: answer.report.height_m / answer.prepared.reduction().scale(),
            ..Style::default()
        },
        ..Filmstrip::default()
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
    if begins <= duration {
        sheet.pieces.push(plot(&deflection, job, (begins - 0.3).max(0.0), (to + 1.0).min(duration)).into());
    }
    sheet
}

/// The answer as moving pictures in real time, with the input as a ghost, seen across the push: from a second before the first
/// disturbance until a second after the body is back, or four after the last where it does not come back; the whole clip where nothing
/// disturbs it.
pub fn movie(answer: &Answer, humanoid: &Humanoid, job: &RespondJob, title: &str) -> Movie {
    let rate = f64::from(Movie::FRAMES_PER_SEC);
    let (ours, input) = (resample(&answer.clip, rate), resample(answer.prepared.clip(), rate));
    let view = Panels { answer, job, ours: &ours, input: &input, shown_secs: SHOWN_SECS };
    let duration = answer.clip.duration_secs();
    let spans = job.pushes.iter().map(|push| (push.at_secs, push.for_secs));
    let spans = spans.chain(job.ground.iter().map(|jerk| (jerk.at_secs, jerk.for_secs)));
    let begins = spans.clone().map(|(at, _)| at).fold(f64::INFINITY, f64::min);
    let ends = spans.map(|(at, lasts)| at + lasts).fold(0.0, f64::max);
    let (from, to) = if begins <= duration {
        let back = answer.report.recovered_after_s.map_or(AT_MOST_SECS, |secs| secs + AROUND_SECS);
        ((begins - AROUND_SECS).max(0.0), (ends + back).min(duration))
    } else {
        (0.0, duration)
    };
    let first = (from * rate).round() as usize;
    let last = (first + Movie::frames_in(to - from)).min(ours.frames());
    Movie {
        title: title.to_owned(),
        panels: (first..last).map(|frame| view.panel(frame)).collect(),
        camera: view.camera(humanoid),
        style: MovieStyle { floor_m: floor_height_m(answer.prepared.clip(), humanoid), ..MovieStyle::default() },
    }
}

/// In moving pictures the arrow of a push stays at least so long \[s\]: one that acts for a tenth of a second would only flash.
const SHOWN_SECS: f64 = 0.3;

/// What moving pictures show before the first disturbance and after the body is back; and after the last where it does not come
/// back \[s\].
const AROUND_SECS: f64 = 1.0;
const AT_MOST_SECS: f64 = 4.0;

fn subtitle(answer: &Answer, job: &RespondJob) -> String {
    let back = answer.report.recovered_after_s;
    let back =
        back.map_or("not recovered by the end".to_owned(), |secs| format!("recovered {secs:.2} s after it ended"));
    if answer.pushed.forces().iter().all(Option::is_none) && job.ground.is_empty() && !job.pushes.is_empty() {
        return "the push comes after the end of the clip and never acts".to_owned();
    }
    match (&job.pushes[..], &job.ground[..]) {
        ([], []) => "no push".to_owned(),
        ([push], []) => format!(
            "{:.0} N on the {} at {:.2} s for {:.2} s; {back}",
            push.force_n.length(),
            push.part.words(),
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

fn plot(deflection: &Deflection, job: &RespondJob, from: f64, to: f64) -> Plot {
    let pushes = job.pushes.iter().map(|push| Mark {
        from_secs: push.at_secs,
        to_secs: push.at_secs + push.for_secs,
        label: format!("{} {:.0} N", push.part.words(), push.force_n.length()),
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
        Series::new(
            node.part().words(),
            rows.map(|(secs, angles)| (*secs, angles[node.index()].to_degrees())).collect(),
        )
    });
    Plot {
        title: "Deflection of each joint from the undisturbed motion".to_owned(),
        x_label: "time (s)".to_owned(),
        y_label: "deflection (°)".to_owned(),
        unit: "°".to_owned(),
        series: series.collect(),
        marks: pushes.chain(jerks).collect(),
        limits: vec![Limit { value: 2.0, label: "recovered below 2°".to_owned() }],
        ..Plot::default()
    }
}
