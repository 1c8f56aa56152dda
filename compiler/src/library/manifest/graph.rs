//! Which textures are made of which.

use super::entry::Entry;

/// The first cycle of textures that are made of each other, as indices in the order of making, the
/// first again at the end.
pub(super) fn cycle(entries: &[Entry]) -> Option<Vec<usize>> {
    // Without recursion, because a chain may be as long as the manifest.
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
                    return Some(open.chain([part]).collect());
                }
            }
        }
    }
    None
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    Open,
    Done,
}

/// All textures in an order in which each comes after those that it is made of. There is no cycle.
pub(in crate::library) fn order(entries: &[Entry]) -> Vec<usize> {
    let mut order = Vec::with_capacity(entries.len());
    let mut listed = vec![false; entries.len()];
    for start in 0..entries.len() {
        let mut stack = vec![start];
        while let Some(&top) = stack.last() {
            let parts = entries[top].origin.parts();
            let open: Vec<usize> = parts.into_iter().filter(|&part| !listed[part]).collect();
            if listed[top] {
                stack.pop();
            } else if open.is_empty() {
                listed[top] = true;
                order.push(top);
                stack.pop();
            } else {
                stack.extend(open);
            }
        }
    }
    order
}
