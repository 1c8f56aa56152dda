//! The session on a machine with an operating system: prints its hashes.
#![forbid(unsafe_code)]

fn main() -> std::fmt::Result {
    let mut hashes = String::new();
    asperity_machines::write_hashes(&mut hashes)?;
    print!("{hashes}");
    Ok(())
}
