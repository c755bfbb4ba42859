"""Colours can be told apart by eyes without red or green cones, on light and dark pages."""

from __future__ import annotations

import itertools
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from rodwell import Problem
from rodwell.plots.style import (
    DARK,
    DARK_TELLING,
    DARK_WARN,
    MARKS,
    MODES,
    TELLING,
    WARN,
    in_lines,
    parameters,
    with_dark_style,
)  # fmt: skip

ENOUGH = 20.0

EYES = {
    "normal": np.eye(3),
    # Machado, Oliveira, Fernandes (2009), severity 1.0, for linear light
    "protanopia": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
                            [-0.003882, -0.048116, 1.051998]]),
    "deuteranopia": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                              [-0.011820, 0.042940, 0.968881]]),
}  # fmt: skip


def lab(colour: str, eye: np.ndarray) -> np.ndarray:
    """CIELAB (D65) of a colour as an eye sees it."""
    srgb = np.array([int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)])
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    to_xyz = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
                       [0.0193339, 0.1191920, 0.9503041]])  # fmt: skip
    xyz = to_xyz @ np.clip(eye @ linear, 0.0, 1.0) / np.array([0.95047, 1.0, 1.08883])
    f = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.array([116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])])


def ciede2000(one: np.ndarray, two: np.ndarray) -> float:
    """Sharma, Wu, Dalal (2005), kL = kC = kH = 1."""
    (l1, a1, b1), (l2, a2, b2) = one, two
    mean = 0.5 * (np.hypot(a1, b1) + np.hypot(a2, b2))
    g = 0.5 * (1.0 - np.sqrt(mean**7 / (mean**7 + 25.0**7)))
    a1, a2 = (1.0 + g) * a1, (1.0 + g) * a2
    c1, c2 = np.hypot(a1, b1), np.hypot(a2, b2)
    h1, h2 = np.degrees(np.arctan2(b1, a1)) % 360.0, np.degrees(np.arctan2(b2, a2)) % 360.0
    turn = (h2 - h1 + 180.0) % 360.0 - 180.0 if c1 * c2 else 0.0
    between = 2.0 * np.sqrt(c1 * c2) * np.sin(np.radians(0.5 * turn))
    lm, cm, hm = 0.5 * (l1 + l2), 0.5 * (c1 + c2), (h1 + 0.5 * turn) % 360.0
    t = (1.0 - 0.17 * np.cos(np.radians(hm - 30.0)) + 0.24 * np.cos(np.radians(2.0 * hm))
         + 0.32 * np.cos(np.radians(3.0 * hm + 6.0)) - 0.20 * np.cos(np.radians(4.0 * hm - 63.0)))  # fmt: skip
    sl = 1.0 + 0.015 * (lm - 50.0) ** 2 / np.sqrt(20.0 + (lm - 50.0) ** 2)
    sc, sh = 1.0 + 0.045 * cm, 1.0 + 0.015 * cm * t
    rt = -2.0 * np.sqrt(cm**7 / (cm**7 + 25.0**7)) * np.sin(np.radians(60.0 * np.exp(-(((hm - 275.0) / 25.0) ** 2))))
    dl, dc, dh = (l2 - l1) / sl, (c2 - c1) / sc, between / sh
    return float(np.sqrt(dl**2 + dc**2 + dh**2 + rt * dc * dh))


def worst(one: str, two: str) -> float:
    return min(ciede2000(lab(one, eye), lab(two, eye)) for eye in EYES.values())


def test_the_measure_itself() -> None:
    """Pairs of Table 1 of Sharma, Wu, Dalal."""
    for one, two, expected in (
        ((50.0, 2.6772, -79.7751), (50.0, 0.0, -82.7485), 2.0425),
        ((50.0, 2.5, 0.0), (73.0, 25.0, -18.0), 27.1492),
        ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
    ):
        assert ciede2000(np.array(one), np.array(two)) == pytest.approx(expected, abs=1e-4)


@pytest.mark.parametrize("palette", [(*TELLING, WARN), (*DARK_TELLING, DARK_WARN)], ids=["light", "dark"])
def test_every_pair_can_be_told_apart(palette: tuple[str, ...]) -> None:
    assert min(worst(*pair) for pair in itertools.combinations(palette, 2)) >= ENOUGH


def test_modes_of_one_colour_have_another_mark() -> None:
    looks = list(zip(MODES, MARKS, strict=True))
    assert len(set(looks)) == len(looks)


def test_a_figure_has_a_rule_for_every_colour_on_a_dark_page() -> None:
    svg = with_dark_style('<?xml version="1.0"?>\n<svg xmlns="http://www.w3.org/2000/svg"><g/></svg>')
    assert ET.fromstring(svg).tag.endswith("svg")
    for light, dark in DARK.items():
        assert f'[style*="stroke: {light}"]{{stroke:{dark} !important}}' in svg


def test_what_a_figure_is_of_is_broken_into_lines_between_its_parts() -> None:
    text = parameters(Problem(15.0, 60.0, build=0.2, sections=((0.5, 1.0), (0.5, 0.5))))
    lines = in_lines(text, 40).split("\n")
    assert len(lines) > 1
    assert all(len(line) <= 41 for line in lines)  # the comma at the end stands beyond
    assert ",  ".join(line.removesuffix(",") for line in lines) == text
    assert in_lines(text, 200) == text
