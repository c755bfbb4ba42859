"""Plain formulas at several places at once: compiled into the instructions of vector registers.

A formula in ``+ − × ÷``, whole powers and the NumPy functions below (:data:`FUNCTIONS`) can be called with numbers,
with arrays, and here, while a kernel is compiled, with :class:`Lanes`: each operation then writes one instruction for
LLVM's vectors, whose numbers, one for each place, go through registers of whatever width the processor has. So
physics is stated once, in plain Python, and costs per place a part of what a call would.

Sine and cosine, for which vectors have no instruction, are their Taylor series on [−π/4, π/4], to round-off; arguments
may be as large as a million.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

DOUBLE = ir.DoubleType()
CONTRACT = ("contract",)
"""A product and a sum may be rounded once instead of twice."""

QUADRANT = tuple(float.fromhex(x) for x in ("0x1.921fb544p+0", "0x1.0b4611a6p-34", "0x1.3198a2e037073p-69"))
"""π/2 in three parts, of which the first two leave room for a whole number: their product with it is exact."""

SINE = tuple((-1) ** k / math.factorial(2 * k + 1) for k in range(1, 9))
COSINE = tuple((-1) ** k / math.factorial(2 * k) for k in range(1, 10))
"""Coefficients of x³, x⁵, … and x², x⁴, … of the Taylor series: the next term is below 1e-17 at π/4."""


def index(value: int) -> Any:
    """Return a constant for addresses."""
    return ir.Constant(ir.IntType(64), value)


def vector(count: int) -> Any:
    """Return the type of a vector of doubles."""
    return ir.VectorType(DOUBLE, count)


def spread(builder: Any, one: Any, kind: Any) -> Any:
    """Vector of type ``kind`` whose numbers are all ``one``."""
    nothing = ir.Constant(kind, ir.Undefined)
    first = builder.insert_element(nothing, one, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(first, nothing, ir.Constant(ir.VectorType(ir.IntType(32), kind.count), None))


def load(builder: Any, pointer: Any, kind: Any) -> Any:
    """Vector of type ``kind`` from consecutive doubles at ``pointer``."""
    value = builder.load(builder.bitcast(pointer, kind.as_pointer()))
    value.align = 8
    return value


def store(builder: Any, value: Any, pointer: Any) -> None:
    """Write a vector to consecutive doubles at ``pointer``."""
    builder.store(value, builder.bitcast(pointer, value.type.as_pointer())).align = 8


class Lanes:
    """A number at each of several places (or, of type double, the same at all) in code that is being written.

    ``flags`` say what the compiler may do with sums and products: :data:`CONTRACT`, or nothing.
    """

    def __init__(self, builder: Any, value: Any, flags: tuple[str, ...] = CONTRACT) -> None:
        self.builder, self.value, self.flags = builder, value, flags

    def _new(self, value: Any) -> Lanes:
        return Lanes(self.builder, value, self.flags)

    def _like(self, other: Any) -> Any:
        """The value of ``other``, Lanes or number, of the type of this one or wider."""
        value = other.value if isinstance(other, Lanes) else ir.Constant(DOUBLE, float(other))
        wide = isinstance(self.value.type, ir.VectorType) and not isinstance(value.type, ir.VectorType)
        return spread(self.builder, value, self.value.type) if wide else value

    def _paired(self, other: Any) -> tuple[Any, Any]:
        """The values of both, of one type."""
        value = self._like(other)
        return self._new(value)._like(self), value

    def _with(self, instruction: str, other: Any, *, swapped: bool = False) -> Any:
        a, b = reversed(self._paired(other)) if swapped else self._paired(other)
        return self._new(getattr(self.builder, instruction)(a, b, flags=self.flags))

    def __add__(self, other: Any) -> Any:
        """Write the sum; zeros that are known are left out."""
        return self if _is_zero(other) else self._with("fadd", other)

    def __sub__(self, other: Any) -> Any:
        """Write the difference."""
        return self if _is_zero(other) else self._with("fsub", other)

    def __rsub__(self, other: Any) -> Any:
        """Write the difference from a plain number."""
        return self._with("fsub", other, swapped=True)

    def __mul__(self, other: Any) -> Any:
        """Write the product; zeros that are known stay known."""
        return 0.0 if _is_zero(other) else self._with("fmul", other)

    def __truediv__(self, other: Any) -> Any:
        """Write the quotient."""
        return self._with("fdiv", other)

    def __rtruediv__(self, other: Any) -> Any:
        """Write the quotient of a plain number."""
        return self._with("fdiv", other, swapped=True)

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self) -> Lanes:
        """Write the number with the other sign."""
        return self._new(self.builder.fneg(self.value))

    def __pow__(self, exponent: int) -> Any:
        """Write a whole power of 1 or more, by squaring; there is no other."""
        if not isinstance(exponent, int) or exponent < 1:
            return NotImplemented
        if exponent == 1:
            return self
        half = self ** (exponent // 2)
        return half * half * self if exponent % 2 else half * half

    def __array_ufunc__(self, function: np.ufunc, method: str, *operands: Any) -> Any:
        """Write what NumPy was asked for."""
        known = FUNCTIONS.get(function) if method == "__call__" else None
        if known is None:
            return NotImplemented
        return known(*(x if isinstance(x, Lanes) else float(x) for x in operands))

    def call(self, name: str, *others: Any) -> Lanes:
        """Write a call of one of LLVM's own functions."""
        kind = self.value.type
        suffix = f"v{kind.count}f64" if isinstance(kind, ir.VectorType) else "f64"
        signature = ir.FunctionType(kind, [kind] * (1 + len(others)))
        module = self.builder.module
        function = cgutils.get_or_insert_function(module, signature, f"llvm.{name}.{suffix}")  # type: ignore[no-untyped-call]
        return self._new(self.builder.call(function, [self.value, *others]))


def _is_zero(x: Any) -> bool:
    return not isinstance(x, Lanes) and x == 0


def _maximum(a: Any, b: Any) -> Lanes:
    one, other = (a, b) if isinstance(a, Lanes) else (b, a)
    x, y = one._paired(other)
    return one._new(x).call("maxnum", y)


def _series(x: Any, coefficients: Sequence[float]) -> Any:
    """Σ coefficients[k] xᵏ, by Horner's rule."""
    total: Any = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        total = total * x + coefficient
    return total


def _in_quadrant(x: Lanes) -> tuple[Lanes, Lanes, Any]:
    """Sine and cosine of x less k quarter turns, and the whole number k."""
    turns = (x * (2.0 / math.pi)).call("rint")
    rest: Any = x
    for part in QUADRANT:
        rest = rest - turns * part
    square = rest * rest
    whole = ir.IntType(32)
    if isinstance(x.value.type, ir.VectorType):
        whole = ir.VectorType(whole, x.value.type.count)
    sine, cosine = rest + rest * square * _series(square, SINE), 1.0 + square * _series(square, COSINE)
    return sine, cosine, x.builder.fptosi(turns.value, whole)


def _turned(x: Lanes, ahead: int) -> Lanes:
    """Sine of x and ``ahead`` quarter turns."""
    builder = x.builder
    sine, cosine, quarters = _in_quadrant(x)

    def constant(value: int) -> Any:
        kind = quarters.type
        return ir.Constant(kind, [value] * kind.count if isinstance(kind, ir.VectorType) else value)

    def bit(value: int) -> Any:
        return builder.icmp_signed("!=", builder.and_(quarters, constant(value)), constant(0))

    quarters = builder.add(quarters, constant(ahead))
    size = builder.select(bit(1), cosine.value, sine.value)
    return x._new(builder.select(bit(2), builder.fneg(size), size))


FUNCTIONS: dict[np.ufunc, Callable[..., Any]] = {
    np.add: operator.add,
    np.subtract: operator.sub,
    np.multiply: operator.mul,
    np.divide: operator.truediv,
    np.negative: operator.neg,
    np.sqrt: lambda x: x.call("sqrt"),
    np.absolute: lambda x: x.call("fabs"),
    np.maximum: _maximum,
    np.sin: lambda x: _turned(x, 0),
    np.cos: lambda x: _turned(x, 1),
}
"""What formulas may call, and what writes it: the arithmetic is here for NumPy's own numbers on the left."""


class _Row:
    """Arguments of a formula, read from memory where it first asks for them: ``arguments[i]``."""

    def __init__(self, builder: Any, base: Any, flags: tuple[str, ...], count: int = 0) -> None:
        self.builder, self.base, self.flags, self.count = builder, base, flags, count
        self.known: dict[int, Lanes] = {}

    def __getitem__(self, i: int) -> Lanes:
        if i not in self.known:
            pointer = self.builder.gep(self.base, [index(i * self.count if self.count else i)])
            value = load(self.builder, pointer, vector(self.count)) if self.count else self.builder.load(pointer)
            self.known[i] = Lanes(self.builder, value, self.flags)
        return self.known[i]


def on_lanes(formula_of: Callable[[Any], Callable[..., Sequence[Any]]], flags: tuple[str, ...] = CONTRACT) -> Any:
    """Return a function for compiled code that applies a formula to places that stand side by side.

    ``formula_of`` gives the formula for the class of a model, a named tuple; for another tuple, for its type. With
    ``flags`` empty each operation is rounded by itself. What is returned is called as
    ``apply(model, tag, rows, uniforms, out)``: ``tag`` is a tuple as long as there are places, m, ``rows`` (k, m) are
    the formula's first argument, the arrays of the tuple ``uniforms``, the same at all places, the others, and the
    i-th number that it returns is written to ``out[i]``. Arrays are contiguous; ``out`` may be a part of ``rows``.
    """

    @intrinsic
    def apply(typingctx, model, tag, rows, uniforms, out):  # type: ignore[no-untyped-def]
        formula, count = formula_of(getattr(model, "instance_class", model)), tag.count

        def write(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            def data(kind: Any, array: Any) -> Any:
                return context.make_array(kind)(context, builder, array).data

            base = data(signature.args[4], arguments[4])
            arrays = cgutils.unpack_tuple(builder, arguments[3])  # type: ignore[no-untyped-call]
            same = [_Row(builder, data(kind, array), flags) for kind, array in zip(uniforms.types, arrays, strict=True)]
            results = formula(_Row(builder, data(signature.args[2], arguments[2]), flags, count), *same)
            empty = Lanes(builder, ir.Constant(vector(count), [0.0] * count))
            for i, result in enumerate(results):
                store(builder, empty._like(result), builder.gep(base, [index(i * count)]))
            return context.get_dummy_value()

        return types.void(model, tag, rows, uniforms, out), write

    return apply
