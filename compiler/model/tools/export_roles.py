"""Fits which words of a sentence say what is touched: compiler/language/src/roles/tagger.bin.

    pip install torch numpy
    cargo run --release -p asperity-corpus --example roles -- roles.bin     # 5 minutes
    python export_roles.py roles.bin                                        # 8 minutes on two cores
    python export_roles.py roles.bin --hold literary spoken                 # scores two files, writes nothing

A token's input is its state in the third layer of the embedded encoder (384 numbers) and 14 flags; a layer with ReLU, a
GRU of both directions, and a layer over both give the evidence of five roles. Texts are those of
training/corpora/sentences, as written and filled with other names and qualities; texts without a surface count
twice. Flags of names are dropped of a tenth of the tokens and flags of qualities of three
tenths, as words that no table holds have none. Weights are rounded to int8 with a scale of each column.
"""

import argparse
import pathlib
import random

import numpy as np
import torch
from torch import nn

STATE, FLAGS, UNITS, ROLES, SURFACE = 384, 14, 256, 5, 1
EPOCHS, BATCH, RATE, DROPOUT = 5, 32, 2e-3, 0.25
# Flags that are dropped together, and of what share of tokens.
DROPPED = [((1, 2, 3, 4, 10, 11), 0.1), ((5, 6, 10, 11), 0.3)]
OUTPUT = pathlib.Path(__file__).resolve().parents[3] / "compiler/language/src/roles/tagger.bin"


def read(path):
    """Texts as (file, whether filled, inputs [tokens, 398] in half precision, roles)."""
    data, at, texts = memoryview(pathlib.Path(path).read_bytes()), 0, []
    token = np.dtype([("role", "u1"), ("input", "<f4", STATE + FLAGS)])
    while at < len(data):
        end = at + 1 + data[at]
        name, filled = bytes(data[at + 1 : end]).decode(), bool(data[end])
        count = int.from_bytes(data[end + 1 : end + 3], "little")
        tokens = np.frombuffer(data, token, count, end + 3)
        at = end + 3 + count * token.itemsize
        texts.append((name, filled, tokens["input"].astype(np.float16), tokens["role"].astype(np.int64)))
    return texts


class Tagger(nn.Module):
    def __init__(self):
        super().__init__()
        self.first = nn.Linear(STATE + FLAGS, UNITS)
        self.gru = nn.GRU(UNITS, UNITS // 2, batch_first=True, bidirectional=True)
        self.last = nn.Linear(2 * UNITS, ROLES)
        self.drop = nn.Dropout(DROPOUT)

    def forward(self, inputs):
        units = self.drop(torch.relu(self.first(self.drop(inputs))))
        both, _ = self.gru(units)
        return self.last(self.drop(torch.cat([units, both], -1)))


def padded(texts):
    inputs = [torch.from_numpy(text[2].astype(np.float32)) for text in texts]
    roles = [torch.from_numpy(text[3]) for text in texts]
    pad = nn.utils.rnn.pad_sequence
    return pad(inputs, True), pad(roles, True, -100)


def fit(texts):
    torch.manual_seed(0)
    random.seed(0)
    silent = [text for text in texts if not text[1] and SURFACE not in text[3]]
    texts = texts + silent
    tagger = Tagger()
    optimizer = torch.optim.AdamW(tagger.parameters(), RATE, weight_decay=1e-4)
    steps = EPOCHS * -(-len(texts) // BATCH)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, RATE, total_steps=steps)
    for epoch in range(EPOCHS):
        # Texts of about one length make a batch.
        texts.sort(key=lambda text: len(text[3]) + 6 * random.random())
        batches = [texts[at : at + BATCH] for at in range(0, len(texts), BATCH)]
        random.shuffle(batches)
        total = 0.0
        for batch in batches:
            inputs, roles = padded(batch)
            for flags, share in DROPPED:
                kept = torch.rand(inputs.shape[:2]) >= share
                inputs[..., [STATE + flag for flag in flags]] *= kept[..., None]
            evidence = tagger(inputs)
            loss = nn.functional.cross_entropy(
                evidence.flatten(0, 1), roles.flatten(), label_smoothing=0.02
            )
            optimizer.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_(tagger.parameters(), 1.0)
            optimizer.step()
            schedule.step()
            total += loss.item()
        print(f"epoch {epoch + 1}: loss {total / len(batches):.3f}", flush=True)
    return tagger.eval()


@torch.no_grad()
def score(tagger, texts):
    """Shares of texts whose surface is tagged exactly, and of tokens whose role is right."""
    exact = right = tokens = 0
    for text in texts:
        found = tagger(padded([text])[0])[0].argmax(-1).numpy()
        exact += bool(((found == SURFACE) == (text[3] == SURFACE)).all())
        right += int((found == text[3]).sum())
        tokens += len(found)
    return exact / len(texts), right / tokens


def layer(weights, offsets):
    weights = weights.detach().numpy().T.astype(np.float64)
    scales = np.maximum(np.abs(weights).max(0), 1e-9) / 127
    codes = np.round(weights / scales).astype(np.int8)
    return codes.tobytes() + scales.astype("<f4").tobytes() + offsets.detach().numpy().astype("<f4").tobytes()


def weights(tagger):
    """A tagger as bytes, in the order of `compiler/language/src/roles/tagger.rs`."""
    state = tagger.state_dict()
    out = layer(state["first.weight"], state["first.bias"])
    for end in ("", "_reverse"):
        for kind in ("ih", "hh"):
            out += layer(state[f"gru.weight_{kind}_l0{end}"], state[f"gru.bias_{kind}_l0{end}"])
    return out + layer(state["last.weight"], state["last.bias"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("texts")
    parser.add_argument("--hold", nargs="*", default=[], help="files that are scored instead of fitted to")
    arguments = parser.parse_args()
    texts = read(arguments.texts)
    tagger = fit([text for text in texts if text[0] not in arguments.hold])
    for name in arguments.hold:
        exact, right = score(tagger, [text for text in texts if text[0] == name and not text[1]])
        print(f"{name}: surface exact {exact:.1%}, roles {right:.1%}")
    if not arguments.hold:
        OUTPUT.write_bytes(weights(tagger))


if __name__ == "__main__":
    main()
