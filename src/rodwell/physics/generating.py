"""From an energy density in symbols to plain arithmetic: value, gradient, Hessian, and derivatives by the parameters.

Densities of several models are generated with it. SymPy is needed for this step only: nothing that is imported at run
time imports this module.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp


def generated(
    density: sp.Expr,
    fields: Sequence[sp.Symbol],
    parameters: Sequence[sp.Symbol],
    cheap: Callable[[sp.Expr], sp.Expr],
    prelude: str,
    *,
    linear: int = 0,
) -> str:
    """Return the body of a function of the fields, ``parameters`` and their ``rates``.

    It returns energy, rate along ``rates``, gradient by the fields, its rate, and the Hessian. Of the fields, the first
    ``linear`` enter linearly and stand by themselves: they have no rows in the Hessian. ``cheap`` rewrites expressions
    in the quantities of ``prelude``, code that comes first.
    """
    gradient = [sp.diff(density, field) for field in fields]
    curved = range(linear, len(fields))
    outputs: dict[str, sp.Expr] = {"energy": density}
    outputs |= {f"gradient{i}": g for i, g in enumerate(gradient)}
    outputs |= {f"hessian{i}{j}": sp.diff(gradient[i], fields[j]) for i in curved for j in range(linear, i + 1)}
    rates = sp.symbols([f"{p.name}_rate" for p in parameters], real=True)

    def along_rates(expression: sp.Expr) -> sp.Expr:
        return sp.Add(*(r * sp.diff(expression, p) for r, p in zip(rates, parameters, strict=True)))

    outputs |= {f"mixed{i}": along_rates(g) for i, g in enumerate(gradient)}
    outputs["rate"] = along_rates(density)
    replacements, reduced = sp.cse(
        [cheap(e) for e in outputs.values()], symbols=sp.numbered_symbols("t"), order="canonical"
    )
    lines = [f"    {name} = {sp.pycode(expr)}" for name, expr in replacements]
    lines += [f"    {target} = {sp.pycode(expr)}" for target, expr in zip(outputs, reduced, strict=True)]
    vectors = [", ".join(f"{name}{i}" for i in range(len(fields))) for name in ("gradient", "mixed")]
    rows = [", ".join(f"hessian{max(i, j)}{min(i, j)}" for j in curved) for i in curved]
    whole = ", ".join(f"({row})" for row in rows)
    lines.append(f"    return energy, rate, ({vectors[0]}), ({vectors[1]}), ({whole})")
    used = [(i, p.name) for i, p in enumerate(parameters) if p in density.free_symbols]
    unpack = [f"    {name} = parameters[{i}]" for i, name in used]
    unpack += [f"    {name}_rate = rates[{i}]" for i, name in used]
    return "\n".join([*unpack, prelude, *lines])
