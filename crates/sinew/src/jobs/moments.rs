//! Which frames of a motion are worth a picture.

/// Less change than this between two pictures is not seen \[m\].
const UNSEEN_M: f64 = 0.01;

/// At most `most` frames, in order: the first, those that something happens in, and others wherever most changes. `change_m` is for
/// each frame how far the body has moved since the one before \[m\]; `happens` lists frames with how much each matters. No two of
/// them look alike: a motion in which nothing changes has one.
pub(crate) fn moments(change_m: &[f64], happens: &[(usize, f64)], most: usize) -> Vec<usize> {
    let Some(last) = change_m.len().checked_sub(1) else { return Vec::new() };
    let travelled: Vec<f64> = change_m
        .iter()
        .scan(0.0, |sum, change| {
            *sum += if change.is_finite() { change.max(0.0) } else { 0.0 };
            Some(*sum)
        })
        .collect();
    let mut chosen = vec![0];
    let mut happens: Vec<(usize, f64)> = happens.iter().copied().filter(|(frame, _)| *frame <= last).collect();
    happens.sort_by(|one, other| other.1.total_cmp(&one.1).then(one.0.cmp(&other.0)));
    for (frame, _) in happens {
        if chosen.len() > most / 2 {
            break;
        }
        if !chosen.contains(&frame) {
            chosen.push(frame);
        }
    }
    chosen.sort_unstable();
    if chosen.len() < most && chosen.last().is_some_and(|&end| travelled[last] - travelled[end] > UNSEEN_M) {
        chosen.push(last);
    }
    while chosen.len() < most {
        let gap = |pair: &[usize]| travelled[pair[1]] - travelled[pair[0]];
        let widest = (1..chosen.len()).max_by(|&a, &b| gap(&chosen[a - 1..=a]).total_cmp(&gap(&chosen[b - 1..=b])));
        let Some(at) = widest.filter(|&at| gap(&chosen[at - 1..=at]) > 2.0 * UNSEEN_M) else { break };
        let middle = (travelled[chosen[at - 1]] + travelled[chosen[at]]) / 2.0;
        let frame = travelled.partition_point(|&sum| sum < middle).clamp(chosen[at - 1] + 1, chosen[at]);
        if frame == chosen[at] {
            break;
        }
        chosen.insert(at, frame);
    }
    chosen
}

/// Those of some frames, in order, that do not look like the one before.
pub(crate) fn without_repeats(frames: &[usize], change_m: &[f64]) -> Vec<usize> {
    let mut kept: Vec<usize> = Vec::new();
    for &frame in frames {
        let moved = |from: usize| change_m.get(from + 1..=frame).map_or(0.0, |changes| changes.iter().sum::<f64>());
        if kept.last().is_none_or(|&before| frame > before && moved(before) > UNSEEN_M) {
            kept.push(frame);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_still_motion_has_one_picture_and_a_steady_one_pictures_at_even_distances() {
        assert_eq!(moments(&[0.0; 300], &[], 12), [0]);
        // A change whose sums are exact.
        assert_eq!(moments(&[1.0 / 64.0; 101], &[], 5), [0, 25, 50, 75, 100]);
        assert_eq!(moments(&[], &[], 5), [0; 0]);
    }

    #[test]
    fn pictures_gather_where_most_changes_and_hold_what_happens() {
        let mut change = vec![0.001; 200];
        change[100..120].fill(0.1);
        let chosen = moments(&change, &[(110, 5.0), (30, 1.0)], 12);
        assert!(chosen.contains(&110) && chosen.contains(&30), "{chosen:?}");
        assert!(chosen.iter().filter(|frame| (100..120).contains(*frame)).count() >= 7, "{chosen:?}");
        assert!(chosen.windows(2).all(|pair| pair[0] < pair[1]) && chosen.len() == 12, "{chosen:?}");
    }

    #[test]
    fn stated_times_that_show_the_same_are_shown_once() {
        let mut change = vec![0.0; 100];
        change[10] = 1.0;
        assert_eq!(without_repeats(&[0, 5, 20, 90, 90, 99], &change), [0, 20]);
    }
}
