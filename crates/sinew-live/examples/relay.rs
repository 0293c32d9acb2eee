//! Bad network between two addresses: `relay LISTEN TO DELAY_MS [JITTER_MS [LOSS]]`, until it is ended.
//!
//! It delays and loses whole UDP packets in both directions. It keeps no order among packets whose delays differ, and knows
//! nothing of bandwidth.

use sinew_live::session::{LinkConditions, Relay};
use std::time::Duration;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let usage =
        "usage: relay LISTEN TO DELAY_MS [JITTER_MS [LOSS]], such as relay 127.0.0.1:4000 127.0.0.1:47110 40 10 0.05";
    let [listen, to, delay, more @ ..] = &words[..] else { return Err(usage.into()) };
    let number = |place: usize| more.get(place).map_or(Ok(0.0), |text| text.parse::<f64>());
    let millis = |secs: f64| Duration::try_from_secs_f64(secs / 1e3);
    let conditions = LinkConditions {
        delay: millis(delay.parse()?)?,
        jitter: millis(number(0)?)?,
        loss: number(1)?.clamp(0.0, 1.0),
        seed: 1,
    };
    let relay = Relay::start(listen.parse()?, to.parse()?, conditions)?;
    println!("{} leads to {to}: {conditions:?}", relay.address());
    loop {
        std::thread::sleep(Duration::from_secs(3600));
    }
}
