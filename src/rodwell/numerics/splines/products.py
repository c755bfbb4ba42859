"""The innermost products: sums of basis functions at places, and Bᵀ H B over an element, in vector registers.

Compilers keep the sums of such small products in memory, and cannot see that its arrays do not overlap. Here they are
written for LLVM's vector types instead, which become code for every processor: rows go through registers in chunks, and
four sums are completed together.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from rodwell.numerics.splines.lanes import CONTRACT, DOUBLE, index, load, spread, store, vector

WIDTH = 4
"""Sums that are completed together, and rows of a product that are summed at a time."""

HESSIAN_OF_ONE, ROWS_OF_ONE = 8, 17
"""For a model of one field: the row of ``terms`` in which the Hessian begins, and how many rows there are; see
:func:`congruence`."""

WIDEST = 8
"""Most numbers in a chunk of a row: narrower registers take them in two parts."""


def _chunks(first: int, last: int, widest: int = WIDEST) -> list[tuple[int, Any]]:
    """First column and vector type of the chunks of a row from column ``first`` to before ``last``."""
    return [(k, vector(min(widest, last - k))) for k in range(first, last, widest)]


class _Writer:
    """Writes loads, stores and multiply-adds of chunks of doubles."""

    def __init__(self, builder: Any) -> None:
        self.builder = builder

    def at(self, base: Any, *offset: Any) -> Any:
        """Pointer to the number at the sum of the offsets, plain integers or values."""
        for part in offset:
            base = self.builder.gep(base, [index(part) if isinstance(part, int) else part])
        return base

    def load(self, pointer: Any, kind: Any) -> Any:
        return load(self.builder, pointer, kind)

    def gathered(self, pointer: Any, step: int, kind: Any) -> Any:
        """Vector of numbers ``step`` apart."""
        if step == 1:
            return self.load(pointer, kind)
        value = ir.Constant(kind, ir.Undefined)
        for k in range(kind.count):
            one = self.builder.load(self.at(pointer, k * step))
            value = self.builder.insert_element(value, one, ir.Constant(ir.IntType(32), k))
        return value

    def store(self, value: Any, pointer: Any) -> None:
        store(self.builder, value, pointer)

    def spread(self, pointer: Any, kind: Any) -> Any:
        """Vector whose numbers are all the one at ``pointer``."""
        return spread(self.builder, self.builder.load(pointer), kind)

    def mixed(self, x: Any, y: Any, *places: int) -> Any:
        """The numbers at ``places`` of two vectors, one behind the other."""
        kind = ir.VectorType(ir.IntType(32), len(places))
        return self.builder.shuffle_vector(x, y, ir.Constant(kind, list(places)))

    def part(self, x: Any, count: int) -> Any:
        """The first ``count`` numbers of a vector."""
        return self.mixed(x, x, *range(count))

    def widened(self, x: Any) -> Any:
        """A chunk filled up with zeros."""
        count = x.type.count
        if count == WIDTH:
            return x
        return self.mixed(x, ir.Constant(x.type, [0.0] * count), *range(count), *[count] * (WIDTH - count))

    def sums(self, parts: list[Any]) -> Any:
        """Vector of the sums of the numbers in each of four vectors."""
        halves = [
            self.builder.fadd(self.mixed(x, y, 0, 4, 2, 6), self.mixed(x, y, 1, 5, 3, 7))
            for x, y in (parts[:2], parts[2:])
        ]
        return self.builder.fadd(self.mixed(*halves, 0, 1, 4, 5), self.mixed(*halves, 2, 3, 6, 7))

    def add_product(self, x: Any, y: Any, total: Any) -> Any:
        return self.builder.fadd(self.builder.fmul(x, y, flags=CONTRACT), total, flags=CONTRACT)


def _pointers(context: Any, builder: Any, signature: Any, arguments: Any) -> Callable[[int], Any]:
    """Return what gives the pointer to the numbers of an argument that is an array."""
    return lambda i: context.make_array(signature.args[i])(context, builder, arguments[i]).data


@intrinsic
def dots(typingctx, model, local_tag, count_tag, table, row, step, c, start, out, at):
    """Write Σ_a T[row + k step, a] c[start + a nf] to ``out.flat[at + k]``, for k below the length of ``count_tag``.

    T are all rows of ``table`` (…, p + 1) one after the other; the length of ``local_tag`` is p + 1, and ``model``
    tells the number of fields nf. All arrays are contiguous.
    """
    local, count = local_tag.count, count_tag.count
    signature = types.void(model, local_tag, count_tag, table, row, step, c, start, out, at)

    def write(context, builder, signature, arguments):
        data = _pointers(context, builder, signature, arguments)
        writer = _Writer(builder)
        base = writer.at(data(3), builder.mul(arguments[4], index(local)))
        step, out = builder.mul(arguments[5], index(local)), writer.at(data(8), arguments[9])
        own = writer.at(data(6), arguments[7])
        chunks = _chunks(0, local, WIDTH)
        factors = [writer.gathered(writer.at(own, first * model.count), model.count, kind) for first, kind in chunks]

        def partial(k: int) -> Any:
            """Vector of which the sum of the numbers is that of row ``k``."""
            rows = writer.at(base, builder.mul(step, index(k)))
            total = ir.Constant(vector(WIDTH), [0.0] * WIDTH)
            for (first, kind), factor in zip(chunks, factors, strict=True):
                chunk = writer.load(writer.at(rows, first), kind)
                total = writer.add_product(writer.widened(chunk), writer.widened(factor), total)
            return total

        for first in range(0, count, WIDTH):
            together = min(WIDTH, count - first)
            parts = [partial(first + min(k, together - 1)) for k in range(WIDTH)]
            writer.store(writer.part(writer.sums(parts), together), writer.at(out, first))
        return context.get_dummy_value()

    return signature, write


@intrinsic
def congruence(typingctx, model, tags, table, start, terms, e, f, product):
    """Write to ``product`` (local + 2, local) what an element adds to the block of fields ``e`` and ``f``.

    ``tags`` holds two tuples, as long as there are local functions and points in the element: the compiler knows
    lengths of tuples. ``table`` (m, 3, local) holds the functions B and two derivatives at all points, those of the
    element from ``start``; ``terms`` what the density of ``model`` gives at each point, times its weight: energy, rate,
    gradient g, mixed derivatives m and Hessian H in rows (2 + 3 nf (3 nf + 2), points)::

        product[a, b] = Σ_q B[q, :, a] · H[q, e, f] B[q, :, b]     for b ≥ a, other entries are not to be used
        product[local, b] = Σ_q g[q, f] · B[q, :, b]               product[local+1, b] likewise with m

    All arrays are contiguous. In full::

        S = 3 nf: fields and two derivatives;  unknown of function i, field f: i nf + f

        table (m, 3, p+1)             terms (2 + S(S+2), points of the element), weighted
            a=0 … p                   row
         q ┌ B    values              0                     energy density
           │ B'   1st derivatives     1                     its rate along `rates`
           └ B''  2nd derivatives     2     + 3f+d          gradient  g[f,d]
        q+1┌ B                        2+S   + 3f+d          mixed     m[f,d]
           ⋮                          2+2S  + S(3e+d)+3f+k  H[e,d; f,k]
                                      one field: 17 rows: energy 0, rate 1, g 2–4, m 5–7, H 8–16

        product (p+3, p+1) of block (e, f)
             b=0  1  …  p
        a=0 ┌ K   K  …  K ┐
          1 │ ·   K  …  K │  K[a,b] = Σ_q B[q,:,a] · H B[q,:,b], b ≥ a
          ⋮ │ ·   ·  ⋱  ⋮ │  ·  not to be used
          p │ ·   ·  ·  K │
        p+1 │ Σ_q g · B   │  gradient of field f
        p+2 └ Σ_q m · B   ┘  mixed

        band (n, (p+1) nf): band[j, k] = A[j+k, j];  K[b, a] of block (e, f) of an element is added at
        j = (start + b) nf + e,  k = (a − b) nf + f − e ≥ 0
    """
    local, points = (tag.count for tag in tags.types)
    size = 3 * model.count
    signature = types.void(model, tags, table, start, terms, e, f, product)

    def write(context, builder, signature, arguments):
        data = _pointers(context, builder, signature, arguments)
        writer = _Writer(builder)
        start, (e, f) = arguments[3], arguments[5:7]
        basis = writer.at(data(2), builder.mul(start, index(3 * local)))
        slopes = writer.at(data(4), 2 * points, builder.mul(f, index(3 * points)))
        hessian = writer.at(slopes, 2 * size * points, builder.mul(e, index(3 * size * points)))
        out = data(7)
        left = builder.bitcast(
            cgutils.alloca_once(builder, ir.ArrayType(DOUBLE, 3 * points * local)), DOUBLE.as_pointer()
        )

        def loop() -> Any:
            return cgutils.for_range(builder, index(points))

        def row(base: Any, q: Any, d: int) -> Any:
            return writer.at(base, builder.mul(q, index(3 * local)), d * local)

        def entry(base: Any, q: Any, d: int, k: int) -> Any:
            """Pointer to row ``d``, column ``k`` of the part of ``terms`` at ``base`` for point ``q``."""
            return writer.at(base, (d * size + k) * points, q)

        with loop() as point:  # left = H B
            q = point.index
            for first, kind in _chunks(0, local):
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

        for a in range(0, local, WIDTH):  # Bᵀ (H B), entries on and above the diagonal
            sums(
                a,
                min(WIDTH, local - a),
                _chunks(a, local),
                left,
                lambda q, d, i, a=a: writer.at(row(basis, q, d), a + i),
            )
        sums(local, 2, _chunks(0, local), basis, lambda q, d, i: entry(slopes, q, i, d))
        return context.get_dummy_value()

    return signature, write


@intrinsic
def add_element(typingctx, tags, product, start, gradient, mixed, band):
    """Add what :func:`congruence` wrote for an element to gradient, mixed derivatives and band; for one field.

    ``start`` is the first function of the element, ``band`` (n, local). All arrays are contiguous.
    """
    local = tags.types[0].count
    signature = types.void(tags, product, start, gradient, mixed, band)

    def write(context, builder, signature, arguments):
        data = _pointers(context, builder, signature, arguments)
        writer, start = _Writer(builder), arguments[2]
        own = writer.at(data(5), builder.mul(start, index(local)))
        rows = [(b * local + b, writer.at(own, b * local), local - b) for b in range(local)]
        rows += [((local + i) * local, writer.at(data(3 + i), start), local) for i in range(2)]
        for source, to, count in rows:
            for first, kind in _chunks(0, count):
                place = writer.at(to, first)
                more = writer.load(writer.at(data(1), source + first), kind)
                writer.store(builder.fadd(writer.load(place, kind), more), place)
        return context.get_dummy_value()

    return signature, write


@intrinsic
def subtract(typingctx, out, at, scale, x, start, count):
    """Subtract ``scale x.flat[start + k]`` from ``out.flat[at + k]``, for k below ``count``; they do not overlap."""
    signature = types.void(out, at, scale, x, start, count)

    def write(context, builder, signature, arguments):
        data = _pointers(context, builder, signature, arguments)
        writer = _Writer(builder)
        to, source = writer.at(data(0), arguments[1]), writer.at(data(3), arguments[4])
        scale = builder.fneg(arguments[2])

        def step(k: Any, kind: Any) -> None:
            y, place = spread(builder, scale, kind), writer.at(to, k)
            writer.store(
                writer.add_product(y, writer.load(writer.at(source, k), kind), writer.load(place, kind)), place
            )

        _in_chunks(builder, arguments[5], step)
        return context.get_dummy_value()

    return signature, write


def _in_chunks(builder: Any, count: Any, step: Callable[[Any, Any], None]) -> None:
    """Write ``step`` for chunks of four numbers, and for what is left: two, and one."""
    whole = builder.and_(count, index(-WIDTH))
    with cgutils.for_range_slice(builder, index(0), whole, index(WIDTH), inc=True) as (k, _):
        step(k, vector(WIDTH))
    with builder.if_then(builder.icmp_signed("!=", builder.and_(count, index(2)), index(0))):
        step(whole, vector(2))
    with builder.if_then(builder.icmp_signed("!=", builder.and_(count, index(1)), index(0))):
        step(builder.and_(count, index(-2)), vector(1))
