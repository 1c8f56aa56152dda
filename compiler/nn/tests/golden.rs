//! The text encoder gives these bits on every processor, in debug and release.

use asperity_nn::{Bytes, Portable, Session, Tensor};

/// Number of token ids, and FNV-1a of the bits of the embedding.
///
/// After a deliberate change of the engine's arithmetic or of the model, run the test and take
/// the values that it prints.
const GOLDEN: [(usize, u64); 3] = [
    (4, 12_691_040_964_924_136_706),
    (12, 11_815_414_706_987_270_408),
    (128, 1_392_117_321_603_414_899),
];

fn tokens(count: usize) -> Tensor {
    let words = [5_931, 12_121]
        .into_iter()
        .chain((2..).map(|i| 1_996 + 7_919 * i % 28_000));
    let ids: Vec<i64> = [101]
        .into_iter()
        .chain(words.take(count - 2))
        .chain([102])
        .collect();
    Tensor::i64(&[1, count], ids)
}

fn fnv_1a(values: &[f32]) -> u64 {
    let bytes = values.iter().flat_map(|x| x.to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[test]
fn text_encoder_gives_the_same_bits_everywhere() {
    let bytes = Bytes::from_static(asperity_model::TEXT_ENCODER);
    let network = Portable::from_shared(bytes).unwrap();
    let found = GOLDEN.map(|(count, _)| {
        let results = network.run(&[("input_ids", &tokens(count))]).unwrap();
        let embedding = results[0].1.as_f32().unwrap();
        assert_eq!(results[0].1.shape(), [1, 384]);
        let length: f32 = embedding.iter().map(|x| x * x).sum();
        assert!((length - 1.0).abs() < 1e-5);
        (count, fnv_1a(embedding))
    });
    assert_eq!(found, GOLDEN);
}
