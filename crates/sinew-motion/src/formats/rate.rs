//! The frame rate behind an animation's keys.

/// Usual rates of capture and animation \[Hz\].
const COMMON_HZ: [f64; 13] = [24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 72.0, 90.0, 100.0, 120.0, 150.0, 200.0, 240.0];
/// Rates of video in NTSC countries: a thousandth below the common ones \[Hz\].
const NTSC_HZ: [f64; 4] = [24_000.0 / 1001.0, 30_000.0 / 1001.0, 60_000.0 / 1001.0, 120_000.0 / 1001.0];
/// Keys nearer to frames than this are on them: single-precision times \[frames\].
const EXACT: f64 = 0.003;
/// How far a key may be from a frame \[frames\]: times are single precision, and some exporters round to milliseconds.
const ON_FRAME: f64 = 0.07;
/// Keys farther apart than this do not show the frame rate \[s\].
const SPARSE_SECS: f64 = 0.2;
/// Rates of their own that keys may have, where straight lines lead from one to the next \[Hz\].
const OWN_HZ: std::ops::RangeInclusive<f64> = 10.0..=1000.0;
/// Fewer keys than this would cut the corners of curves \[Hz\].
const CURVES_HZ: f64 = 24.0;

/// The common rate that the keys have, a thousandth less where that fits them clearly better; else their own uniform rate; else the
/// lowest common rate whose frames hold every key; `None` if the keys do not show a rate.
///
/// `tracks` holds the key times of each track \[s\], ascending; `curved` says that splines lead from key to key.
pub(crate) fn rate_hz<'a>(tracks: impl Iterator<Item = &'a [f64]> + Clone, curved: bool) -> Option<f64> {
    let densest = tracks.clone().max_by_key(|times| times.len()).filter(|times| times.len() > 2)?;
    let start = tracks.clone().filter_map(|times| times.first()).copied().fold(f64::INFINITY, f64::min);
    let mean_secs = (densest[densest.len() - 1] - densest[0]) / (densest.len() - 1) as f64;
    if mean_secs > SPARSE_SECS {
        return None;
    }
    let off_frames = |hz: f64| {
        let off_frame = |time: f64| {
            let frame = (time - start) * hz;
            (frame - frame.round()).abs()
        };
        tracks.clone().flatten().map(|&time| off_frame(time)).fold(0.0, f64::max)
    };
    // Times rounded to a fraction drift by no more than the rounding, so a fixed share of a frame bounds them.
    let holds_all = |hz: f64| hz * mean_secs > 0.9 && off_frames(hz) < ON_FRAME;
    let own_hz = 1.0 / mean_secs;
    let near = COMMON_HZ.iter().copied().filter(|hz| (hz / own_hz - 1.0).abs() < 0.02);
    let own = [own_hz.round(), own_hz].into_iter().filter(|hz| OWN_HZ.contains(hz) && (!curved || *hz >= CURVES_HZ));
    let video = |hz: f64| {
        let video = NTSC_HZ.into_iter().find(|video| (video / hz - 1.0).abs() < 0.0015)?;
        (off_frames(hz) > EXACT && off_frames(video) < 0.5 * off_frames(hz)).then_some(video)
    };
    let fits = |hz: f64| video(hz).filter(|video| holds_all(*video)).or_else(|| holds_all(hz).then_some(hz));
    near.chain(own).chain(COMMON_HZ).find_map(fits)
}

#[cfg(test)]
mod tests {
    use super::rate_hz;

    fn keys(hz: f64, count: usize) -> Vec<f64> {
        (0..count).map(|key| f64::from((key as f64 / hz) as f32)).collect()
    }

    #[test]
    fn keys_of_a_common_rate_are_recognised_through_single_precision() {
        for hz in [24.0, 25.0, 30.0, 60.0, 120.0, 240.0] {
            assert_eq!(rate_hz([keys(hz, 1000).as_slice()].into_iter(), false), Some(hz));
        }
    }

    #[test]
    fn video_rates_are_kept_from_four_keys_on() {
        for (hz, video) in [(24.0, 24_000.0), (30.0, 30_000.0), (60.0, 60_000.0), (120.0, 120_000.0)] {
            for count in [5, 24, 48, 73, 1000] {
                let found = rate_hz([keys(video / 1001.0, count).as_slice()].into_iter(), false);
                assert_eq!(found, Some(video / 1001.0), "{count} keys");
                assert_eq!(rate_hz([keys(hz, count).as_slice()].into_iter(), false), Some(hz), "{count} keys");
                // Times that an exporter printed in milliseconds.
                let rounded: Vec<f64> = keys(hz, count).iter().map(|time| (time * 1e3).round() / 1e3).collect();
                assert_eq!(rate_hz([rounded.as_slice()].into_iter(), false), Some(hz), "{count} keys");
            }
        }
    }

    #[test]
    fn a_sparse_track_does_not_hide_the_dense_one() {
        let (dense, sparse) = (keys(30.0, 91), vec![0.0, 3.0]);
        assert_eq!(rate_hz([sparse.as_slice(), &dense].into_iter(), false), Some(30.0));
    }

    #[test]
    fn keys_of_10_hz_are_frames_where_they_are_straight_and_too_few_where_they_curve() {
        let keys = keys(10.0, 50);
        assert_eq!(rate_hz([keys.as_slice()].into_iter(), false), Some(10.0));
        assert_eq!(rate_hz([keys.as_slice()].into_iter(), true), Some(30.0));
        // 30 Hz with most of its keys thinned out.
        assert_eq!(rate_hz([[0.0, 0.1, 0.3, 0.4, 1.0 / 3.0 + 0.2].as_slice()].into_iter(), false), Some(30.0));
    }

    #[test]
    fn an_odd_uniform_rate_is_kept_and_disorder_gives_none() {
        let own_hz = rate_hz([keys(85.0, 100).as_slice()].into_iter(), false).unwrap();
        assert!((own_hz - 85.0).abs() < 1e-3);
        assert_eq!(rate_hz([[0.0, 0.011, 0.0473, 0.05, 0.0911].as_slice()].into_iter(), false), None);
        assert_eq!(rate_hz([[0.0, 1.0].as_slice()].into_iter(), false), None);
        assert_eq!(rate_hz(std::iter::empty(), false), None);
    }
}
