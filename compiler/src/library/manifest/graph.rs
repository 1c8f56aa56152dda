//! Which textures are made of which.

use super::entry::Entry;

/// All textures in an order in which each comes after those that it is made of.
///
/// # Errors
/// The first cycle, as indices in the order of making, the first again at the end.
pub(in crate::library) fn order(entries: &[Entry]) -> Result<Vec<usize>, Vec<usize>> {
    // Without recursion, because a chain may be as long as the manifest.
    let mut order = Vec::with_capacity(entries.len());
    let mut state = vec![State::New; entries.len()];
    for start in 0..entries.len() {
        let mut path = vec![(start, entries[start].origin.parts())];
        if state[start] != State::New {
            continue;
        }
        state[start] = State::Open;
        while let Some((texture, parts)) = path.last_mut() {
            let Some(part) = parts.pop() else {
                state[*texture] = State::Done;
                order.push(*texture);
                path.pop();
                continue;
            };
            match state[part] {
                State::Done => {}
                State::New => {
                    state[part] = State::Open;
                    path.push((part, entries[part].origin.parts()));
                }
                State::Open => {
                    let from = path.iter().position(|(open, _)| *open == part);
                    let open = path[from.unwrap_or(0)..].iter().map(|(open, _)| *open);
                    return Err(open.chain([part]).collect());
                }
            }
        }
    }
    Ok(order)
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    Open,
    Done,
}
