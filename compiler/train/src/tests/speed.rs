//! How long an epoch takes: `cargo test --release -- --ignored --nocapture seconds`.

use crate::{
    Captions, Config,
    fit::Session,
    progress::Silent,
    synthetic::{self, WordBag},
};
use std::time::Instant;

#[test]
#[ignore = "measures, asserts nothing"]
fn seconds_an_epoch_of_4000_instances() {
    let corpus = synthetic::corpus(200, 20);
    let captions = Captions::encode(&corpus, &[], &WordBag).unwrap();
    let all: Vec<usize> = (0..200).collect();
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        for batch in [32, 128, 256] {
            let mut config = Config::reference().unwrap();
            config.optimiser.batch = batch;
            let mut session = Session::new(&corpus, &all, &captions, &config).unwrap();
            pool.install(|| {
                for _ in 0..2 {
                    let start = Instant::now();
                    session.epoch(&mut Silent).unwrap();
                    let loss = session.state.history.last().unwrap();
                    println!(
                        "{threads} threads, batch {batch}: {:.2?} {loss:?}",
                        start.elapsed()
                    );
                }
            });
        }
    }
}
