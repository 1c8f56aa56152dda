//! Load time and latency of a model with one input of token ids: `latency MODEL.onnx [TOKENS…]`.

use std::{error::Error, time::Instant};

use asperity_nn::{Bytes, Portable, Session, Tensor};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments
        .next()
        .ok_or("usage: latency MODEL.onnx [TOKENS…]")?;
    let mut lengths: Vec<usize> = arguments
        .map(|text| text.parse())
        .collect::<Result<_, _>>()?;
    if lengths.is_empty() {
        lengths = vec![12, 128];
    }
    let bytes = Bytes::from(std::fs::read(path)?);
    let start = Instant::now();
    let network = Portable::from_shared(bytes)?;
    println!("load {:.2} ms", start.elapsed().as_secs_f64() * 1e3);
    let name = network.inputs()[0].name.clone();
    for length in lengths {
        let ids = (0..length).map(|i| 1000 + 37 * i as i64 % 20_000).collect();
        let ids = Tensor::i64(&[1, length], ids);
        let mut times = Vec::new();
        for _ in 0..30 {
            let start = Instant::now();
            std::hint::black_box(network.run(&[(&name, &ids)])?);
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        let first = times[0];
        times.sort_by(f64::total_cmp);
        println!(
            "{length} tokens: first {first:.2} ms, least {:.2} ms, median {:.2} ms",
            times[0], times[15]
        );
    }
    Ok(())
}
