"""The innermost product of assembly, Bᵀ H B over the points of an element, in vector registers.

Compilers keep the sums of such small products in memory, and cannot see that its arrays do not overlap. Here they are
written for LLVM's vector types instead, which become code for every processor: rows of B go through registers in
chunks of four numbers, and the sums of up to four rows of the product stay there.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

LANES = 4
"""Numbers in a vector, and rows of the product that are summed at a time."""

_DOUBLE = ir.DoubleType()
_CONTRACT = ("contract",)


def _chunks(local: int) -> list[tuple[int, ir.VectorType]]:
    """First column and vector type of the chunks of a row of ``local`` numbers."""
    return [(first, ir.VectorType(_DOUBLE, min(LANES, local - first))) for first in range(0, local, LANES)]


class _Writer:
    """Writes loads, stores and multiply-adds of chunks of doubles."""

    def __init__(self, builder: Any) -> None:
        self.builder = builder

    def index(self, value: int) -> Any:
        return ir.Constant(ir.IntType(64), value)

    def at(self, base: Any, *offset: Any) -> Any:
        """Pointer to the number at the sum of the offsets, plain integers or values."""
        for part in offset:
            base = self.builder.gep(base, [self.index(part) if isinstance(part, int) else part])
        return base

    def load(self, pointer: Any, kind: Any) -> Any:
        value = self.builder.load(self.builder.bitcast(pointer, kind.as_pointer()))
        value.align = 8
        return value

    def store(self, value: Any, pointer: Any) -> None:
        self.builder.store(value, self.builder.bitcast(pointer, value.type.as_pointer())).align = 8

    def spread(self, pointer: Any, kind: Any) -> Any:
        """Vector whose numbers are all the one at ``pointer``."""
        nothing = ir.Constant(kind, ir.Undefined)
        one = self.builder.insert_element(nothing, self.builder.load(pointer), ir.Constant(ir.IntType(32), 0))
        lanes = ir.Constant(ir.VectorType(ir.IntType(32), kind.count), [0] * kind.count)
        return self.builder.shuffle_vector(one, nothing, lanes)

    def add_product(self, x: Any, y: Any, total: Any) -> Any:
        return self.builder.fadd(self.builder.fmul(x, y, flags=_CONTRACT), total, flags=_CONTRACT)


@intrinsic
def congruence(typingctx, tags, table, start, terms, e, f, product):
    """Write to ``product`` (local + 2, local) what an element adds to the block of fields ``e`` and ``f``.

    ``tags`` holds two tuples, as long as there are local functions and points in the element: the compiler knows
    lengths of tuples. ``table`` (m, 3, local) holds the functions B and two derivatives at all points, those of the
    element from ``start``; ``terms`` (points, 3 nf + 2, 3 nf) weighted Hessians H and below them gradients g and
    mixed derivatives m, for each point::

        product[a, b] = Σ_q B[q, :, a] · H[q, e, f] B[q, :, b]     for b ≥ a, other entries are not to be used
        product[local, b] = Σ_q g[q, f] · B[q, :, b]               product[local+1, b] likewise with m

    All arrays are contiguous.
    """
    local, points = (tag.count for tag in tags.types)
    signature = types.void(tags, table, start, terms, e, f, product)

    def write(context, builder, signature, arguments):
        def data(i: int) -> Any:
            return context.make_array(signature.args[i])(context, builder, arguments[i])

        writer = _Writer(builder)
        rows, array, out = data(1).data, data(3), data(6).data
        size = cgutils.unpack_tuple(builder, array.shape)[2]
        per_point = builder.mul(size, builder.add(size, writer.index(2)))
        basis = writer.at(rows, builder.mul(arguments[2], writer.index(3 * local)))
        three = writer.index(3)
        columns = writer.at(array.data, builder.mul(arguments[5], three))
        hessian = writer.at(columns, builder.mul(builder.mul(arguments[4], three), size))
        slopes = writer.at(columns, builder.mul(size, size))
        left = builder.bitcast(
            cgutils.alloca_once(builder, ir.ArrayType(_DOUBLE, 3 * points * local)), _DOUBLE.as_pointer()
        )

        def loop() -> Any:
            return cgutils.for_range(builder, writer.index(points))

        def row(base: Any, q: Any, d: int) -> Any:
            return writer.at(base, builder.mul(q, writer.index(3 * local)), d * local)

        def entry(base: Any, q: Any, d: int, k: int) -> Any:
            """Pointer to row ``d``, column ``k`` of the part of ``terms`` at ``base`` for point ``q``."""
            return writer.at(base, builder.mul(q, per_point), builder.mul(size, writer.index(d)), k)

        with loop() as point:  # left = H B
            q = point.index
            for first, kind in _chunks(local):
                chunk = [writer.load(writer.at(row(basis, q, d), first), kind) for d in range(3)]
                for d in range(3):
                    total = ir.Constant(kind, [0.0] * kind.count)
                    for k in range(3):
                        total = writer.add_product(writer.spread(entry(hessian, q, d, k), kind), chunk[k], total)
                    writer.store(total, writer.at(row(left, q, d), first))

        def sums(first_row: int, count: int, chunks: list[tuple[int, Any]], source: Any, factor: Any) -> None:
            """Rows ``first_row`` … of the product: Σ_q Σ_d factor(q, d, row) source[q, d]."""
            totals = {
                (i, first): cgutils.alloca_once_value(builder, ir.Constant(kind, [0.0] * kind.count))
                for i in range(count)
                for first, kind in chunks
            }  # LLVM keeps these in registers
            with loop() as point:
                for d in range(3):
                    for first, kind in chunks:
                        chunk = writer.load(writer.at(row(source, point.index, d), first), kind)
                        for i in range(count):
                            total, scale = totals[i, first], writer.spread(factor(point.index, d, i), kind)
                            builder.store(writer.add_product(scale, chunk, builder.load(total)), total)
            for (i, first), total in totals.items():
                writer.store(builder.load(total), writer.at(out, (first_row + i) * local + first))

        for a in range(0, local, LANES):  # Bᵀ (H B), entries on and above the diagonal
            chunks = [chunk for chunk in _chunks(local) if chunk[0] >= a]
            sums(a, min(LANES, local - a), chunks, left, lambda q, d, i, a=a: writer.at(row(basis, q, d), a + i))
        sums(local, 2, _chunks(local), basis, lambda q, d, i: entry(slopes, q, i, d))
        return context.get_dummy_value()

    return signature, write
