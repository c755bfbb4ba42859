"""The paper recomputed, as files: agreement table (Markdown, HTML, JSON) and figures (PDF, PNG)."""

from __future__ import annotations

import html
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path

from rodwell.analysis.discrete import first_run
from rodwell.errors import checked_whole
from rodwell.quantities.text import minus
from rodwell.quantities.tolerance import RTOL
from rodwell.report.reports.texts import number, short
from rodwell.store.folder import whole_folder
from rodwell.store.text import write_json
from rodwell.studies.paper.agreement import CONVENTION, Agreement, agreement
from rodwell.studies.paper.claims import Finding
from rodwell.studies.paper.items import ITEMS, Item, chosen
from rodwell.studies.paper.work import Work

Progress = Callable[[str, float], None]

HEAD = ("Place in the paper", "Quantity", "Printed", "Computed", "Error", "Verdict")
DPI = 200
MOST_JOBS = 64


def write_paper(
    out: Path,
    only: Sequence[str] | None = None,
    *,
    figures: bool = True,
    rtol: float = RTOL,
    jobs: int | None = None,
    progress: Progress | None = None,
) -> tuple[Agreement, tuple[str, ...]]:
    """Recompute the paper, or the items named in ``only``, and write tables and figures to ``out``: all files, or none.

    Parameters
    ----------
    out
        Folder.
    only
        Names of items, see :data:`rodwell.studies.paper.items.ITEMS`; None for all.
    figures
        Whether to draw.
    rtol
        Relative tolerance of every computed number.
    jobs
        Processes that compute and draw figures; None: two, where there are two processors and more than two figures.
        With 1 all is done in this process.
    progress
        Called with what is being done and the part done.

    Returns
    -------
    tuple
        The agreement table, and the names of the files.

    Raises
    ------
    InputError
        For an unknown name, a number out of range, or if ``out`` cannot be written.
    NotConvergedError
        If something cannot be computed to the tolerance.
    """
    work, items = Work(rtol), chosen(only)
    drawn = [item for item in items if figures and item.figure is not None]
    usual = min(2, os.cpu_count() or 1) if len(drawn) > 2 else 1
    jobs = checked_whole("jobs", usual if jobs is None else jobs, 1, MOST_JOBS)
    tell = progress or (lambda _what, _done: None)
    share = 1.0 / (1.0 + 2.0 * len(drawn))
    if jobs > 1 and drawn and not first_run.done():  # first run of all: let one process compile
        work.branch(Work.WARM)
    with whole_folder(out) as folder, _drawing(drawn, work, folder, jobs) as finished:
        table = agreement(only, work=work, progress=lambda what, done: tell(what, share * done))
        for count, name in enumerate(finished, start=1):
            tell(f"figures: {name} done", share + (1.0 - share) * count / len(drawn))
        write_tables(table, folder)
        return table, tuple(sorted(file.name for file in folder.iterdir()))


@contextmanager
def _drawing(items: Sequence[Item], work: Work, folder: Path, jobs: int) -> Iterator[Iterator[str]]:
    """Yield the names of figures as they are finished; with several processes they are begun at once."""
    slowest_first = sorted(items, key=lambda item: item.name not in ("fig6", "fig5", "fig3", "fig11"))
    if jobs == 1 or not items:
        yield (draw_item(item.name, work.rtol, folder) for item in items)
        return
    pool = ProcessPoolExecutor(min(jobs, len(items)), mp_context=get_context("spawn"))
    try:
        tasks: list[Future[str]] = [pool.submit(draw_item, item.name, work.rtol, folder) for item in slowest_first]
        yield (task.result() for task in as_completed(tasks))
    finally:
        pool.shutdown(cancel_futures=True)


def draw_item(name: str, rtol: float, folder: Path) -> str:
    """Compute and draw one figure as PDF and PNG; return its name."""
    from rodwell.plots.paper.figures import DRAW  # noqa: PLC0415 - nothing is drawn without figures
    from rodwell.plots.paper.frame import context  # noqa: PLC0415

    compute = ITEMS[name].figure
    assert compute is not None
    figure = DRAW[name](compute(Work(rtol)))
    with context():
        figure.savefig(folder / f"{name}.png", dpi=DPI, pil_kwargs={"compress_level": 2})
        figure.set_layout_engine("none")  # keep the layout found for the first file
        figure.savefig(folder / f"{name}.pdf", dpi=DPI, metadata={"CreationDate": None, "ModDate": None})
    return name


def write_tables(table: Agreement, folder: Path) -> None:
    """Write the agreement table to a folder in three forms."""
    write_json(table.as_dict(), folder / "agreement.json")
    (folder / "agreement.md").write_text(f"# The paper recomputed\n\n{markdown(table)}", encoding="utf-8")
    (folder / "agreement.html").write_text(page(table), encoding="utf-8")


def cells(finding: Finding) -> tuple[str, ...]:
    """The columns ``HEAD`` of one finding."""
    claim, computed = finding.claim, finding.computed
    error = "0" if computed.error == 0.0 else short(computed.error)
    return claim.place, claim.quantity, minus(claim.printed), number(computed), error, finding.verdict


def markdown(table: Agreement) -> str:
    """The table as Markdown, with explanations below."""
    lines = [HEAD, ("---",) * len(HEAD), *(cells(finding) for finding in table)]
    rows = ["| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines]
    text = f"{table.summary} Relative tolerance {_tolerance(table)}. {CONVENTION}\n\n" + "\n".join(rows) + "\n"
    for title, findings in remarks(table):
        text += f"\n## {title}\n\n" + "\n\n".join(f"**{_name(f)}.** {f.remark}" for f in findings) + "\n"
    return text


def page(table: Agreement) -> str:
    """The table as a page of its own that needs no network."""
    escape = html.escape
    head = "".join(f"<th>{escape(cell)}</th>" for cell in HEAD)
    rows = "\n".join(
        f'<tr class="{"good" if f.agrees else "known" if f.documented else "bad"}">'
        + "".join(f"<td>{escape(cell)}</td>" for cell in cells(f))
        + "</tr>"
        for f in table
    )
    notes = ""
    for title, findings in remarks(table):
        notes += f"<h2>{title}</h2>\n" + "\n".join(
            f"<p><b>{escape(_name(f))}.</b> {escape(f.remark)}</p>" for f in findings
        )
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>The paper recomputed</title>\n'
        f"<style>{_CSS}</style></head><body>\n<h1>The paper recomputed</h1>\n"
        f"<p><b>{escape(table.summary)}</b> Relative tolerance {_tolerance(table)}. {escape(CONVENTION)}</p>\n"
        f"<table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}\n</tbody></table>\n{notes}\n</body></html>\n"
    )


def remarks(table: Agreement) -> list[tuple[str, list[Finding]]]:
    """Findings that need words, under their titles: differences, then notes; each remark once."""
    differing = [finding for finding in table if not finding.agrees]
    noted = [finding for finding in table if finding.agrees and finding.remark]
    notes = [f for i, f in enumerate(noted) if f.remark not in {other.remark for other in noted[:i]}]
    return [(title, found) for title, found in (("Differences", differing), ("Notes", notes)) if found]


def _name(finding: Finding) -> str:
    return f"{finding.claim.place}: {finding.claim.quantity}"


def _tolerance(table: Agreement) -> str:
    return minus(f"{table.rtol:g}")


_CSS = """
body { font: 15px/1.45 system-ui, sans-serif; color: #1f2933; max-width: 72rem; margin: 2rem auto; padding: 0 1rem }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 13.5px }
th, td { text-align: left; padding: .18rem .7rem; border-bottom: 1px solid #e3e7eb; vertical-align: top }
td:nth-child(n+3):nth-child(-n+5) { text-align: right; white-space: nowrap }
tr.known td { background: #fdf3df } tr.bad td { background: #fbe3e1 }
@media print { body { max-width: none } }
"""
