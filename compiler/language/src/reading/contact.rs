//! Tagging of a sentence: the roles of its words, as groups that describe the touched surface.

use super::{
    Reader, Reading, Text,
    group::{
        Group, is_adjective, is_content, is_felt, is_thing, needs_owner, one_thing, phrase_of,
    },
    parts::is_owned,
    read,
    segment::{Class, Item},
};
use crate::{
    WordVectors,
    lexicon::closed_class::is_grammar,
    roles::{Role, WordStates, flags, tag},
    words::{Token, grade::Grade},
};

/// An item, what it does, and how probably it says what is touched.
struct Tagged {
    item: Item,
    role: Role,
    surface: f32,
}

impl<T: WordVectors, S: WordStates> Reader<T, S> {
    /// Reads the touched surface from a sentence; also returns the number of tokens that were read.
    pub(super) fn contact(&self, text: &Text<'_>, items: &[Item]) -> (Reading, usize) {
        let tags = tag(
            &self.states.states(&text.tokens),
            &flags(&text.tokens, &self.table),
        );
        // A name of a few words has no roles that might be taken for others.
        let sure = if items.len() > read::FEW {
            sure(&text.tokens, &tags)
        } else {
            1.0
        };
        let mut tagged = tagged(items, &tags);
        together(&mut tagged);
        let (mut groups, mut denied, mut others) = (Vec::new(), Vec::new(), Vec::new());
        for span in tagged.chunk_by(|a, b| a.role == b.role) {
            let own = span.iter().map(|tagged| tagged.item.clone());
            match span[0].role {
                Role::Context => {}
                Role::Surface => {
                    let surface = span.iter().map(|tagged| tagged.surface).sum::<f32>();
                    groups.push(Group::new(own.collect(), surface / span.len() as f32));
                }
                role => {
                    let said: Vec<String> = own.map(|item| item.said).collect();
                    others.push((role, said.join(" ")));
                    if role == Role::Denied {
                        denied.extend(span.iter().map(|tagged| tagged.item.clone()));
                    }
                }
            }
        }
        // "the horse whose coat is sleek"
        if needs_owner(&groups) {
            let owners = tagged.iter().filter(|tagged| tagged.role == Role::Object);
            let named = owners
                .map(|tagged| &tagged.item)
                .filter(|item| item.class == Class::Name);
            groups.extend(named.map(|item| Group::new(vec![item.clone()], 0.0)));
        }
        // "bark without its roughness"; but "not soft, scratchy" is scratchy.
        if !groups.iter().any(Group::is_felt) {
            groups.extend(denied.into_iter().filter(is_felt).map(Group::denied));
        }
        let contact = !groups.is_empty();
        let (words, names) = self.named(text, &phrase_of(one_thing(groups)));
        let words = if words.is_empty() {
            read::unread(items)
        } else {
            words
        };
        let reading = Reading {
            contact,
            sure,
            // Where nothing is named, a word that no one knows may say anything.
            says: !names.is_empty() || (contact && self.knows_all(&text.tokens)),
            words,
            names,
            others,
            ..Reading::default()
        };
        (reading, tags.len())
    }
}

/// The least probability with which a word of content is felt, or is not.
fn sure(tokens: &[Token], tags: &[(Role, f32)]) -> f32 {
    let content = tokens.iter().zip(tags);
    let content = content.filter(|(token, _)| token.word().is_some_and(|word| !is_grammar(word)));
    let sure = content.map(|(_, (_, surface))| libm::fmaxf(*surface, 1.0 - surface));
    sure.fold(1.0, libm::fminf)
}

/// Items with the role of their first token; of the surface if one of their tokens is. Items behind all tags are left out.
fn tagged(items: &[Item], tags: &[(Role, f32)]) -> Vec<Tagged> {
    let mut rest = tags;
    let tagged = items.iter().map_while(|item| {
        let (own, after) = rest.split_at_checked(item.tokens)?;
        rest = after;
        let surface = own.iter().filter(|(role, _)| *role == Role::Surface);
        let surface = surface.map(|(_, surface)| *surface).reduce(libm::fmaxf);
        Some(Tagged {
            item: item.clone(),
            role: surface.map_or(own.first()?.0, |_| Role::Surface),
            surface: surface.unwrap_or_default(),
        })
    });
    tagged.collect()
}

/// Gives adjacent words one role: the qualities, a number beside them, and the thing itself. A word between them parts
/// them no more than "grey" does in "wet grey slate".
fn together(tagged: &mut [Tagged]) {
    let content = |tagged: &Tagged| is_content(&tagged.item) || tagged.item.class == Class::Other;
    for run in tagged.chunk_by_mut(|a, b| content(a) && content(b)) {
        let is = |tagged: &Tagged, role: Role| tagged.role == role;
        let thing = run
            .iter()
            .rposition(|tagged| is(tagged, Role::Surface) && is_thing(&tagged.item));
        let first = run.iter().position(|tagged| is(tagged, Role::Surface));
        let named = |tagged: &Tagged| tagged.item.class == Class::Name && is_thing(&tagged.item);
        let more: Vec<usize> = match (thing, first) {
            (Some(thing), _) => {
                let part = is_owned(&run[thing].item.text);
                let felt = |n: &usize| {
                    let item = &run[*n].item;
                    let quality = match item.class {
                        Class::Touch => true,
                        Class::Name => is_adjective(item),
                        // "the dog's wiry coat"
                        _ => part && item.text.ends_with("'s"),
                    };
                    let quality = *n < thing && quality;
                    quality || Grade::of(&item.text).is_some()
                };
                (0..run.len()).filter(felt).collect()
            }
            // The thing behind its quality; "bread soaked in milk".
            (None, Some(first)) => {
                let behind = (first + 1..run.len()).rfind(|n| named(&run[*n]));
                let before = || (0..first).rfind(|n| named(&run[*n]));
                behind.or_else(before).into_iter().collect()
            }
            _ => Vec::new(),
        };
        for n in more {
            if is(&run[n], Role::Context) {
                run[n].role = Role::Surface;
                run[n].surface = 0.5;
            }
        }
    }
}
