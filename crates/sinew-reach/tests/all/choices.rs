//! Whether to step, and how: the choices of ten thousand seeds against the probabilities that the paper states.

use sinew_body::humanoid::Body;
use sinew_reach::{Rng, StepKind, Style, Values, decide_step, half_probability, step_probability};

const SEEDS: u64 = 10_000;

/// Four standard deviations of a share of so many draws: one failure in sixteen thousand, were the seeds not fixed.
fn tolerance(p: f64, draws: f64) -> f64 {
    4.0 * (p * (1.0 - p) / draws).sqrt() + 1e-9
}

#[test]
fn steps_and_half_steps_are_as_frequent_as_stated() {
    let values = Values::of(&Body::standard(80.0, 1.7), &Style::default());
    let (near, far) = (values.convenient_m, values.maximal_m);
    for share in [-0.5, 0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.5] {
        let distance = near + share * (far - near);
        let (mut steps, mut halves) = (0.0, 0.0);
        for seed in 0..SEEDS {
            if let Some(step) = decide_step(distance, &mut Rng::new(seed), &values) {
                steps += 1.0;
                halves += f64::from(u8::from(step.kind == StepKind::Half));
            }
        }
        let stated = share.clamp(0.0, 1.0);
        assert!((step_probability(distance, &values) - stated).abs() < 1e-12);
        let found = steps / SEEDS as f64;
        assert!((found - stated).abs() <= tolerance(stated, SEEDS as f64), "at {share}: {found} of {stated} step");
        let half = values.half_step_most + (values.half_step_least - values.half_step_most) * stated;
        assert!((half_probability(distance, &values) - half).abs() < 1e-12);
        if steps > 0.0 {
            let found = halves / steps;
            assert!((found - half).abs() <= tolerance(half, steps), "at {share}: {found} of {half} are half steps");
        }
    }
}

#[test]
fn lengths_lie_between_the_shortest_and_the_longest_and_grow_with_the_distance() {
    let values = Values::of(&Body::standard(80.0, 1.7), &Style::default());
    let mean = |share: f64| {
        let distance = values.convenient_m + share * (values.maximal_m - values.convenient_m);
        let lengths: Vec<f64> = (0..SEEDS)
            .filter_map(|seed| decide_step(distance, &mut Rng::new(seed), &values))
            .map(|step| step.length_m)
            .collect();
        assert!(lengths.iter().all(|length| (values.shortest_step_m..=values.longest_step_m).contains(length)));
        lengths.iter().sum::<f64>() / lengths.len() as f64
    };
    let means = [0.1, 0.3, 0.5, 0.7, 0.9].map(mean);
    assert!(means.windows(2).all(|pair| pair[1] > pair[0]), "{means:?}");
    // In the middle, where p's mean is a half, short and long weigh the same.
    let middle = 0.5 * (values.shortest_step_m + values.longest_step_m);
    assert!((means[2] - middle).abs() < 0.01, "{} against {middle}", means[2]);
}
