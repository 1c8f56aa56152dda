//! The secret in the address.

use base64::{Engine as _, engine::general_purpose::URL_SAFE_NO_PAD};
use std::hint::black_box;

/// Bytes of a token.
const BYTES: usize = 16;

/// 128 random bits, in the letters of base64url.
#[derive(Clone)]
pub(crate) struct Token(String);

impl Token {
    /// A new one from the system's generator.
    ///
    /// # Errors
    /// Where the system has none.
    pub(crate) fn random() -> Result<Self, getrandom::Error> {
        let mut bytes = [0; BYTES];
        getrandom::fill(&mut bytes)?;
        Ok(Self(URL_SAFE_NO_PAD.encode(bytes)))
    }

    /// A token that was kept; `None` for other text.
    pub(crate) fn restored(text: String) -> Option<Self> {
        let bytes = URL_SAFE_NO_PAD.decode(&text).ok()?;
        (bytes.len() == BYTES).then_some(Self(text))
    }

    /// The letters.
    pub(crate) fn text(&self) -> &str {
        &self.0
    }

    /// Compares a guess with this token. The time depends on the guess's length alone, so that no one learns the token
    /// letter by letter.
    pub(crate) fn is(&self, guess: &str) -> bool {
        if guess.len() != self.0.len() {
            return false;
        }
        let pairs = self.0.bytes().zip(guess.bytes());
        let differing = pairs.fold(0, |differing, (a, b)| black_box(differing | (a ^ b)));
        differing == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_is_22_letters_of_an_address_and_only_itself() {
        let token = Token::random().unwrap();
        assert_eq!(token.text().len(), 22);
        let letter = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
        assert!(token.text().chars().all(letter), "{}", token.text());
        assert!(token.is(token.text()));
        let other = Token::random().unwrap();
        for wrong in [other.text(), "", &token.text()[1..]] {
            assert!(!token.is(wrong), "{wrong}");
        }
        for place in 0..22 {
            let mut near = token.text().to_owned().into_bytes();
            near[place] ^= 1;
            assert!(!token.is(std::str::from_utf8(&near).unwrap()), "{place}");
        }
    }
}
