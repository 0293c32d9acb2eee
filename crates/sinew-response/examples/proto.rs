//! scratch
use glam::{DQuat, DVec3};
use sinew_body::humanoid::*;
use sinew_motion::*;
use sinew_response::*;

fn butter(x: &[f64], fs: f64, fc: f64) -> Vec<f64> {
    let k = (std::f64::consts::PI * fc / fs).tan();
    let s = 2f64.sqrt();
    let n = 1.0 / (1.0 + s * k + k * k);
    let (b0, b1, b2) = (k * k * n, 2.0 * k * k * n, k * k * n);
    let (a1, a2) = (2.0 * (k * k - 1.0) * n, (1.0 - s * k + k * k) * n);
    let run = |x: &[f64]| {
        let (mut y, mut x1, mut x2, mut y1, mut y2) = (vec![], x[0], x[0], x[0], x[0]);
        for &v in x {
            let o = b0 * v + b1 * x1 + b2 * x2 - a1 * y1 - a2 * y2;
            y.push(o);
            x2 = x1;
            x1 = v;
            y2 = y1;
            y1 = o;
        }
        y
    };
    let p = 60.min(x.len() - 1);
    let mut e: Vec<f64> = (1..=p).rev().map(|i| 2.0 * x[0] - x[i]).collect();
    e.extend_from_slice(x);
    let l = x.len() - 1;
    e.extend((1..=p).map(|i| 2.0 * x[l] - x[l - i]));
    let mut f = run(&e);
    f.reverse();
    let mut f = run(&f);
    f.reverse();
    f[p..p + x.len()].to_vec()
}

fn filter(poses: &[Pose]) -> Vec<Pose> {
    let n = poses.len();
    let mut locals: Vec<[DQuat; 18]> = poses.iter().map(|p| Node::ALL.map(|k| p.local(k))).collect();
    for j in 0..18 {
        for i in 1..n {
            if locals[i][j].dot(locals[i - 1][j]) < 0.0 {
                locals[i][j] = -locals[i][j];
            }
        }
        let c: Vec<Vec<f64>> =
            (0..4).map(|c| butter(&locals.iter().map(|l| l[j].to_array()[c]).collect::<Vec<_>>(), 60.0, 6.0)).collect();
        for i in 0..n {
            locals[i][j] = DQuat::from_xyzw(c[0][i], c[1][i], c[2][i], c[3][i]).normalize();
        }
    }
    let c: Vec<Vec<f64>> = (0..3)
        .map(|c| butter(&poses.iter().map(|p| p.hips_position.to_array()[c]).collect::<Vec<_>>(), 60.0, 6.0))
        .collect();
    (0..n).map(|i| Pose::from_locals(DVec3::new(c[0][i], c[1][i], c[2][i]), &locals[i])).collect()
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let path = &args[1];
    let (a, b): (usize, usize) = {
        let mut s = args[2].split('-');
        (s.next().unwrap().parse().unwrap(), s.next().unwrap().parse().unwrap())
    };
    let k: usize = args[3].parse().unwrap();
    let preset = match args[4].as_str() {
        "paper" => Preset::Paper,
        "literal" => Preset::Literal,
        _ => Preset::Robust,
    };
    let newtons: f64 = args.get(5).map_or(100.0, |s| s.parse().unwrap());
    let secs: f64 = args.get(6).map_or(0.1, |s| s.parse().unwrap());
    let bytes = std::fs::read(path).unwrap();
    let parsed = formats::bvh::read(&bytes, &Limits::default()).unwrap();
    let humanoid = Humanoid::of(&parsed.clip, &[]).unwrap();
    let guess = guess_space(&parsed.clip, &humanoid, parsed.unit_m, parsed.world_from_source);
    let clip = guess.space.clip_to_world(&parsed.clip);
    let st = stature(&clip, &humanoid);
    let reduction = Reduction::new(&clip, &humanoid, st, Person { mass_kg: 80.0, height_m: Some(1.7) }).unwrap();
    let mut body = reduction.body().clone();
    println!("stature {st:.3} mass {:.2} unit {}", body.mass_kg(), guess.space.unit_m);
    for n in Node::ALL {
        let l = body.link(n);
        println!("  {:14} off {:.3} len {:.3} m {:.2}", n.part().name(), l.offset, l.tip.length(), l.mass_kg);
    }
    // 60 Hz poses over the cycle
    let count = ((b - a) as f64 * clip.frame_time_secs() * 60.0).round() as usize;
    let at = |t: f64| {
        let x = (a as f64) + t * (b - a) as f64;
        let i = (x.floor() as usize).min(clip.frames() - 2);
        let f = x - i as f64;
        let (p, q) = (reduction.pose(&clip.world(i)), reduction.pose(&clip.world(i + 1)));
        let locals = Node::ALL.map(|k| p.local(k).slerp(q.local(k), f));
        Pose::from_locals(p.hips_position.lerp(q.hips_position, f), &locals)
    };
    let first = at(0.0);
    let last = at(1.0);
    let cycles = 18;
    let mut raw = vec![];
    let gap = Node::ALL.map(|k| log(last.local(k).conjugate() * first.local(k)));
    let d = last.hips_position - first.hips_position;
    for c in 0..cycles {
        for i in 0..count {
            let t = i as f64 / count as f64;
            let p = at(t);
            let locals = Node::ALL.map(|k| p.local(k) * exp(gap[k.index()] * t));
            raw.push(Pose::from_locals(
                p.hips_position - DVec3::Y * d.y * t + DVec3::new(d.x, 0.0, d.z) * c as f64,
                &locals,
            ));
        }
    }
    let poses = filter(&raw);
    for n in Node::ALL {
        let mut worst: f64 = 0.0;
        let mut r = (9f64, -9f64, 9f64, -9f64, 9f64, -9f64);
        for p in &poses {
            let l = p.local(n);
            worst = worst.max(Limit::of(n).excess(l));
            let (x, z, t) = swing_twist(l);
            r.0 = r.0.min(x);
            r.1 = r.1.max(x);
            r.2 = r.2.min(z);
            r.3 = r.3.max(z);
            r.4 = r.4.min(t);
            r.5 = r.5.max(t);
        }
        let g = |x: f64| x.to_degrees().round();
        println!(
            "  {:14} x {}..{} z {}..{} twist {}..{} excess {:.1}",
            n.part().name(),
            g(r.0),
            g(r.1),
            g(r.2),
            g(r.3),
            g(r.4),
            g(r.5),
            worst.to_degrees()
        );
    }
    for p in &poses {
        body.widen_limits(p);
    }
    let settings = Settings { preset, k, ..Settings::default() };
    let basis = Basis::of_motion(&body, &poses[count..2 * count + 2], &settings).unwrap();
    println!("spectrum {:?}", basis.eigenvalues().map(|v| (v.sqrt() * 100.0).round() / 100.0));
    println!("growth {:.4} over {} frames", growth(&body, &basis, &settings, &poses[count..2 * count + 2]), count);
    let run = |push: Option<(Node, DVec3, usize)>| {
        let mut r = Response::new(body.clone(), basis.clone(), settings, &poses[0]);
        r.restart(&poses[0], &poses[1]);
        let mut out = vec![];
        let start = push.map_or(0, |p| p.2);
        let n = (secs * 60.0).round() as usize;
        for i in 2..poses.len() {
            let f = push.filter(|p| i > p.2 && i <= p.2 + n).map(|p| PointForce::at_centre(p.0, p.1));
            let p = r.step(&poses[i], f.as_slice());
            out.push((p, r.deviation(), r.report()));
        }
        (out, start)
    };
    let (base, _) = run(None);
    let unp = base.iter().map(|o| o.1.turns.iter().map(|t| t.length()).fold(0.0, f64::max)).fold(0.0, f64::max);
    println!("unpushed max deviation {:.6} deg", unp.to_degrees());
    for (node, name) in [
        (Node::LeftHand, "hand"),
        (Node::LeftLowerArm, "forearm"),
        (Node::LeftUpperArm, "upperarm"),
        (Node::LeftShoulder, "shoulder"),
        (Node::Head, "head"),
        (Node::Chest, "chest"),
    ] {
        let (mut peak, mut rec, mut nrec, mut tmax, mut total): (f64, f64, usize, f64, usize) = (0.0, 0.0, 0, 0.0, 0);
        let mut lim = 0;
        let mut per = [0f64; 18];
        for dir in [DVec3::X, -DVec3::X, DVec3::Z, -DVec3::Z] {
            for ph in 0..8 {
                let start = count * 2 + ph * count / 8;
                let (o, _) = run(Some((node, dir * newtons, start)));
                let mut pk: f64 = 0.0;
                let mut lastbad = 0;
                for (i, (p, q)) in o.iter().zip(&base).enumerate() {
                    lim += p.2.limited;
                    let mut w: f64 = 0.0;
                    for n in Node::ALL {
                        let a = log(q.0.local(n).conjugate() * p.0.local(n)).length();
                        if n.index() < 12 {
                            w = w.max(a);
                        }
                        per[n.index()] = per[n.index()].max(a);
                        if a > 2f64.to_radians() {
                            lastbad = i;
                        }
                    }
                    pk = pk.max(w);
                }
                total += 1;
                peak += pk;
                let end = start + (secs * 60.0).round() as usize;
                if lastbad + 2 < o.len() - 60 {
                    nrec += 1;
                    let t = (lastbad as f64 - end as f64 + 2.0) / 60.0;
                    rec += t;
                    tmax = tmax.max(t);
                }
            }
        }
        println!(
            "{name:9} mean peak {:.1} deg, recovered {nrec}/{total}, mean {:.2} s max {tmax:.2} s, limit hits {lim}; per {:?}",
            (peak / total as f64).to_degrees(),
            rec / nrec.max(1) as f64,
            per.map(|a| a.to_degrees().round())
        );
    }
}
