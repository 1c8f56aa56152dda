//! What measuring costs a tick: four readings of the clock, and a record into the queue. The loop
//! needs one reading without measuring.

fn main() {}
