//! Words of grammar: they name nothing themselves, and there is a fixed number of them.

use crate::phrase;

/// Determiners and pronouns.
const DETERMINERS: &[&str] = &[
    "a",
    "an",
    "the",
    "this",
    "that",
    "these",
    "those",
    "some",
    "any",
    "every",
    "each",
    "my",
    "your",
    "his",
    "her",
    "its",
    "our",
    "their",
    "i",
    "you",
    "he",
    "she",
    "it",
    "we",
    "they",
    "me",
    "him",
    "us",
    "them",
    "mine",
    "yours",
    "ours",
    "theirs",
    "myself",
    "who",
    "which",
    "what",
    "whose",
    "something",
    "anything",
    "one",
    "ones",
    "thing",
    "stuff",
];
/// Auxiliaries, and verbs of being and having.
const AUXILIARIES: &[&str] = &[
    "is", "are", "was", "were", "be", "been", "being", "am", "do", "does", "did", "done", "has",
    "have", "had", "having", "can", "could", "will", "would", "shall", "should", "may", "might",
    "must", "let", "lets", "let's", "i'd", "i'm", "it's",
];
/// Words that join two objects, or an object and its qualities.
const LINKS: &[&str] = &[
    "of", "with", "without", "and", "but", "or", "than", "like", "between", "as", "not", "no",
    "never", "non", "lacking", "more", "less", "least", "most", "too", "is", "are", "was", "has",
    "have", "that", "at",
];
/// After these comes a place, an owner, a time or a use.
pub(super) const PLACES: &[&str] = &[
    "from",
    "in",
    "at",
    "near",
    "behind",
    "beside",
    "besides",
    "inside",
    "outside",
    "under",
    "underneath",
    "beneath",
    "above",
    "below",
    "by",
    "for",
    "next",
    "around",
    "about",
    "within",
    "upon",
    "opposite",
    "beyond",
    "onto",
    "into",
    "to",
    "via",
    "worth",
    "per",
    "off",
    "out",
    "up",
    "down",
    "where",
    "when",
    "while",
];
/// What is moved, and what it is moved across: "a finger over", "a pen on".
pub(super) const ACROSS: &[&str] = &[
    "over", "across", "along", "on", "against", "through", "onto",
];
/// What a surface is explored with.
pub(super) const TOOLS: &[&str] = &[
    "finger",
    "fingertip",
    "fingernail",
    "nail",
    "thumb",
    "hand",
    "palm",
    "knuckle",
    "pen",
    "stylus",
    "pencil",
    "probe",
    "tool",
    "tip",
    "stick",
    "screen",
    "tablet",
    "touchscreen",
    "device",
    "phone",
    "phone screen",
];
/// What a prompt says of itself or of touching, not of a surface.
const ACTS: &[&str] = &[
    "feel",
    "feels",
    "feeling",
    "touch",
    "touches",
    "touching",
    "texture",
    "textures",
    "surface",
    "surfaces",
    "sensation",
    "sensations",
    "haptic",
    "haptics",
    "tactile",
    "vibration",
    "vibrations",
    "vibrotactile",
    "feedback",
    "material",
    "materials",
    "rendering",
    "render",
    "renders",
    "simulate",
    "simulates",
    "simulating",
    "simulation",
    "emulate",
    "imitate",
    "mimic",
    "mimics",
    "recreate",
    "reproduce",
    "replicate",
    "generate",
    "create",
    "make",
    "makes",
    "give",
    "gives",
    "show",
    "produce",
    "build",
    "design",
    "want",
    "need",
    "needs",
    "wants",
    "like",
    "please",
    "pls",
    "imagine",
    "holding",
    "pretend",
    "suppose",
    "think",
    "print",
    "pattern",
    "patterned",
    "kind",
    "sort",
    "type",
    "sample",
    "example",
    "piece",
    "pieces",
    "version",
    "effect",
    "experience",
    "explore",
    "exploring",
    "explored",
    "stroke",
    "stroking",
    "strokes",
    "stroked",
    "rub",
    "rubbing",
    "rubbed",
    "run",
    "running",
    "slide",
    "sliding",
    "slid",
    "drag",
    "dragging",
    "dragged",
    "scrape",
    "scraping",
    "scraped",
    "scratch",
    "tap",
    "tapping",
    "tapped",
    "press",
    "pressing",
    "pressed",
    "move",
    "moving",
    "moved",
    "brush",
    "brushing",
    "draw",
    "write",
    "writing",
    "written",
    "trace",
    "tracing",
    "glide",
    "gliding",
    "swipe",
    "swiping",
    "pass",
    "passing",
    "pet",
    "petting",
    "sweep",
    "sweeping",
    "work",
    "working",
    "looks",
    "look",
    "looking",
];
/// Colours, and what speaks of them: a name before one of them is a shade.
const COLOURS: &[&str] = &[
    "red",
    "orange",
    "yellow",
    "green",
    "blue",
    "purple",
    "violet",
    "pink",
    "brown",
    "black",
    "white",
    "grey",
    "beige",
    "turquoise",
    "teal",
    "cyan",
    "magenta",
    "maroon",
    "crimson",
    "scarlet",
    "indigo",
    "mauve",
    "lilac",
    "olive",
    "navy",
    "pastel",
    "neon",
    "dyed",
    "dotted",
    "spotted",
    "checked",
    "tartan",
    "plaid",
    "floral",
    "cream",
    "colour",
    "colours",
    "coloured",
    "tinted",
    "toned",
    "shade",
    "shades",
    "hue",
    "striped",
    "stripes",
    "print",
    "printed",
    "pattern",
    "patterned",
];

/// Words for a picture of an object where "of" follows.
const PICTURES: &[&str] = &[
    "picture",
    "image",
    "photo",
    "photograph",
    "painting",
    "drawing",
    "sketch",
];
/// Words for a part of an object where "of" follows.
const PARTS: &[&str] = &[
    "back",
    "front",
    "top",
    "bottom",
    "side",
    "inside",
    "outside",
    "underside",
    "rim",
    "edge",
    "end",
    "ends",
    "corner",
    "face",
    "middle",
    "centre",
    "head",
    "handle",
    "blade",
    "half",
    "rest",
];
/// Further participles after which "in", "with" or "from" names the cover or the material of an object.
const COVERING: &[&str] = &[
    "soaked", "dipped", "drenched", "filled", "made", "cut", "carved", "woven", "knitted",
    "embedded", "bound", "dusted",
];

/// Whether a word is a colour or a pattern.
#[must_use]
pub fn is_colour(word: &str) -> bool {
    COLOURS.contains(&word) || word.ends_with("coloured") || word.ends_with("chequered")
}

/// Whether a word before "of" is a part of an object.
pub(super) fn is_part(word: &str) -> bool {
    PARTS.contains(&word)
}

/// Whether "in", "by" or "from" after this word names the cover or the material of an object.
pub(super) fn is_covering(word: &str) -> bool {
    phrase::is_cover(word) || COVERING.contains(&word)
}

/// Whether a word has no meaning of its own.
pub(super) fn is_function(word: &str) -> bool {
    DETERMINERS.contains(&word)
        || AUXILIARIES.contains(&word)
        || LINKS.contains(&word)
        || PLACES.contains(&word)
        || ACROSS.contains(&word)
}

/// Whether a word before "of" is a picture of what follows.
pub(super) fn is_picture(word: &str) -> bool {
    PICTURES.contains(&word)
}

/// Whether a word is of grammar, or speaks of touching itself.
#[must_use]
pub fn is_grammar(word: &str) -> bool {
    is_function(word) || is_act(word)
}

/// Whether a word is an article or a determiner.
pub(super) fn is_determiner(word: &str) -> bool {
    DETERMINERS.contains(&word)
}

/// Whether a word joins an object and its description.
pub(super) fn is_link(word: &str) -> bool {
    LINKS.contains(&word)
}

/// Whether a word speaks of touching or of the prompt itself.
pub(super) fn is_act(word: &str) -> bool {
    ACTS.contains(&word) || PICTURES.contains(&word)
}
