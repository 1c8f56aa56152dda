//! Numbers as people write them: "1.5", "1,5", "1 000", "1k", "1/2", "1 1/2", "eighty", "a quarter of".

use super::parts::Parts;
use crate::words::Token;

/// Largest number whose thousands a space may part; beyond, they are rather two.
const MOST_GROUPED: f64 = 30_000.0;
/// Largest whole number that a fraction belongs to: "60 1/2 inch thick" are two.
const MOST_MIXED: f64 = 20.0;

const UNITS: [&str; 20] = [
    "zero",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
];
const TENS: [&str; 8] = [
    "twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety",
];
const PARTS: [(&str, f64); 9] = [
    ("half", 2.0),
    ("third", 3.0),
    ("thirds", 3.0),
    ("quarter", 4.0),
    ("quarters", 4.0),
    ("eighth", 8.0),
    ("eighths", 8.0),
    ("sixteenth", 16.0),
    ("sixteenths", 16.0),
];

/// Returns true if a number may begin with this token.
pub(super) fn begins(token: &Token) -> bool {
    let Token::Word(word) = token else {
        return false;
    };
    let word = word.as_str();
    word.contains(|c: char| c.is_ascii_digit())
        || ["hundred", "thousand"].contains(&word)
        || UNITS.contains(&word)
        || TENS.contains(&word)
        || PARTS.iter().any(|(part, _)| *part == word)
}

impl Parts<'_> {
    /// Reads a number.
    pub(super) fn number(&mut self) -> Option<f64> {
        let start = self.clone();
        let found = self.signed();
        if found.is_none() {
            *self = start;
        }
        found
    }

    fn signed(&mut self) -> Option<f64> {
        let negative = self.eat(&["-", "−"]);
        if negative && !self.is_glued() {
            return None;
        }
        let value = self.digits().or_else(|| self.words())?;
        Some(if negative { -value } else { value })
    }

    /// A number in digits, with what belongs to it.
    fn digits(&mut self) -> Option<f64> {
        let text = self.text()?;
        let mut value = literal(text)?;
        self.next();
        // "P1.000", which a reader of another country writes
        let grouped = text.split_once('.').filter(|(_, after)| after.len() == 3);
        if self.grouped && value >= 1.0 && grouped.is_some() {
            return Some((1e3 * value).round());
        }
        if self.glued_letter(&["k"]).is_some() || self.eat(&["thousand"]) {
            return Some(1e3 * value);
        }
        if self.eat(&["hundred"]) {
            return Some(1e2 * value);
        }
        if text.contains(['.', ',', '/']) || self.is_glued() {
            return Some(value);
        }
        let after = self.text().unwrap_or_default();
        let whole = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        if self.grouped && text.len() < 3 && value > 0.0 && after.len() == 3 && whole(after) {
            let grouped = 1e3 * value + literal(after)?;
            if grouped <= MOST_GROUPED {
                self.next();
                return Some(grouped);
            }
        }
        let mut mixed = self.clone();
        mixed.eat(&["and"]);
        let part = match mixed.text() {
            Some(text) if text.contains('/') => mixed.digits(),
            _ => mixed.part_of_one(),
        };
        if let Some(part) = part.filter(|part| value <= MOST_MIXED && *part < 1.0) {
            value += part;
            *self = mixed;
        }
        Some(value)
    }

    /// A number in words: "one hundred and twenty", "twelve hundred", "two twenty", "three quarters of a".
    fn words(&mut self) -> Option<f64> {
        if let Some(part) = self.part_of_one() {
            return Some(part);
        }
        let (mut thousands, mut value) = (0.0, None::<f64>);
        loop {
            let before = self.clone();
            // "a hundred", "one hundred and twenty"
            match value {
                None => _ = thousands == 0.0 && self.eat(&["a"]),
                Some(value) => _ = value % 100.0 == 0.0 && self.eat(&["and"]),
            }
            let text = self.text().unwrap_or_default();
            let place = |words: &[&str]| words.iter().position(|word| *word == text);
            let said = value.unwrap_or(0.0);
            let next = if let Some(unit) = place(&UNITS) {
                let fits = value.is_none()
                    || (said >= 100.0 && said % 100.0 == 0.0)
                    || (said % 100.0 >= 20.0 && said % 10.0 == 0.0 && (1..10).contains(&unit));
                fits.then_some(said + unit as f64)
            } else if let Some(tens) = place(&TENS) {
                let tens = 10.0 * (tens + 2) as f64;
                match value {
                    // "two twenty"
                    Some(1.0..10.0) => Some(100.0 * said + tens),
                    _ => (said % 100.0 == 0.0).then_some(said + tens),
                }
            } else if text == "hundred" && said < 100.0 {
                Some(100.0 * value.unwrap_or(1.0))
            } else if text == "thousand" && thousands == 0.0 {
                thousands = 1e3 * value.unwrap_or(1.0);
                self.next();
                value = None;
                continue;
            } else {
                None
            };
            let Some(next) = next else {
                *self = before;
                break;
            };
            value = Some(next);
            self.next();
        }
        if thousands == 0.0 && value.is_none() {
            return None;
        }
        let whole = thousands + value.unwrap_or(0.0);
        let mut mixed = self.clone();
        // "three quarters", "two and a half"
        let joined = mixed.eat(&["and"]);
        match mixed.part_of_one() {
            Some(part) if whole <= MOST_MIXED => {
                *self = mixed;
                Some(if joined { whole + part } else { whole * part })
            }
            _ => Some(whole),
        }
    }

    /// "half", "a quarter of an"; no more of a word is read where none follows.
    fn part_of_one(&mut self) -> Option<f64> {
        let start = self.clone();
        self.eat(&["a"]);
        let text = self.text().unwrap_or_default();
        let Some((_, of)) = PARTS.iter().find(|(part, _)| *part == text) else {
            *self = start;
            return None;
        };
        self.next();
        self.eat(&["of"]);
        self.eat(&["a", "an"]);
        Some(1.0 / of)
    }
}

/// Digits with a point or a comma before decimals, or a fraction.
fn literal(text: &str) -> Option<f64> {
    if !text.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return None;
    }
    match text.split_once('/') {
        Some((above, below)) => {
            let [above, below] = [above, below].map(|digits| digits.parse::<f64>().ok());
            below
                .filter(|below| *below != 0.0)
                .and_then(|below| Some(above? / below))
        }
        None => text.replace(',', ".").parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::normalise;

    #[test]
    fn a_number_is_read_as_people_write_it() {
        for (text, expected) in [
            ("80", Some(80.0)),
            ("-5", Some(-5.0)),
            ("1,5", Some(1.5)),
            ("1,000", Some(1000.0)),
            ("1 000", Some(1000.0)),
            ("1.000", Some(1000.0)),
            ("1.2k", Some(1200.0)),
            ("2 thousand", Some(2000.0)),
            ("1/2", Some(0.5)),
            ("1 1/2", Some(1.5)),
            ("2 and a half", Some(2.5)),
            ("half an", Some(0.5)),
            ("three quarters of an", Some(0.75)),
            ("a quarter", Some(0.25)),
            ("two and a half", Some(2.5)),
            ("eighty", Some(80.0)),
            ("one hundred and twenty", Some(120.0)),
            ("a hundred twenty five", Some(125.0)),
            ("twelve hundred", Some(1200.0)),
            ("two twenty", Some(220.0)),
            ("thousand", Some(1000.0)),
            ("two thousand five hundred", Some(2500.0)),
            ("1/0", None),
            ("a brick", None),
            ("and", None),
        ] {
            let text = format!("x {text}");
            let tokens = normalise(&text);
            let mut parts = Parts::new(&tokens, true);
            parts.next();
            let number = parts.number();
            assert_eq!(number, expected, "{text}");
            if number.is_some() {
                assert_eq!(parts.tokens(), Some(tokens.len()), "{text}");
            }
        }
    }

    #[test]
    fn two_numbers_are_not_one() {
        for (text, first) in [
            ("80 400", 80.0),
            ("60 1/2", 60.0),
            ("twenty forty", 20.0),
            ("1.5 000", 1.5),
        ] {
            let tokens = normalise(text);
            assert_eq!(Parts::new(&tokens, true).number(), Some(first), "{text}");
        }
        let tokens = normalise("1 200");
        assert_eq!(Parts::new(&tokens, false).number(), Some(1.0));
    }
}
