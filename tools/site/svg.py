"""A drawing in the plane as SVG; colours are classes of docs/_static/site.css, so that drawings follow the theme."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

Place = Sequence[float]


class Drawing:
    """From `low` to `high` in the drawing's own units, y upwards, `width` pixels wide, with a margin of `margin` pixels."""

    def __init__(self, low: Place, high: Place, *, width: float = 640, margin: float = 12) -> None:
        self.scale = (width - 2 * margin) / (high[0] - low[0])
        self.low, self.high, self.margin = low, high, margin
        self.size = width, (high[1] - low[1]) * self.scale + 2 * margin
        self.parts: list[str] = []

    def at(self, p: Place) -> tuple[float, float]:
        return self.margin + (p[0] - self.low[0]) * self.scale, self.margin + (self.high[1] - p[1]) * self.scale

    def line(
        self,
        points: Iterable[Place],
        kind: str = "line",
        *,
        width: float = 1.5,
        closed: bool = False,
        dashed: bool = False,
    ) -> None:
        path = "L".join("{:.1f} {:.1f}".format(*self.at(p)) for p in points)
        dash = ' stroke-dasharray="5 4"' if dashed else ""
        end = "Z" if closed else ""
        self.parts.append(
            f'<path class="{kind}" d="M{path}{end}" stroke-width="{width}" stroke-linejoin="round"{dash}/>'
        )

    def area(self, points: Iterable[Place], kind: str) -> None:
        self.line(points, kind, closed=True, width=1)

    def dot(self, p: Place, kind: str = "dot", *, radius: float = 4) -> None:
        x, y = self.at(p)
        self.parts.append(f'<circle class="{kind}" cx="{x:.1f}" cy="{y:.1f}" r="{radius}"/>')

    def text(self, p: Place, words: str, *, anchor: str = "start", shift: Place = (0, 0), size: float = 14) -> None:
        x, y = self.at(p)
        self.parts.append(
            f'<text x="{x + shift[0]:.1f}" y="{y - shift[1]:.1f}" text-anchor="{anchor}" font-size="{size}">{words}</text>'
        )

    def save(self, file: Path, about: str) -> None:
        width, height = self.size
        file.write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" role="img">'
            f"<title>{about}</title>" + "".join(self.parts) + "</svg>\n"
        )


class Chart(Drawing):
    """A chart with logarithmic axes: places are (x, y) as measured."""

    def __init__(self, x: Place, y: Place, labels: tuple[str, str], *, width: float = 640, height: float = 380) -> None:
        super().__init__((0, 0), (1, 1), width=width, margin=0)
        self.size = width, height
        self.x, self.y = np.log10(x), np.log10(y)
        self.frame = 62, 10, width - 16, height - 46  # left, top, right, bottom
        left, top, right, bottom = self.frame
        for power in range(int(np.ceil(self.x[0])), int(np.floor(self.x[1])) + 1):
            self.line([(10.0**power, y[0]), (10.0**power, y[1])], "thin", width=0.5)
            self.text((10.0**power, y[0]), power_of_ten(power), anchor="middle", shift=(0, -18), size=12)
        for power in range(int(np.ceil(self.y[0])), int(np.floor(self.y[1])) + 1):
            self.line([(x[0], 10.0**power), (x[1], 10.0**power)], "thin", width=0.5)
            self.text((x[0], 10.0**power), power_of_ten(power), anchor="end", shift=(-6, -4), size=12)
        self.line([(x[0], y[1]), (x[0], y[0]), (x[1], y[0])], "line", width=1)
        self.parts.append(
            f'<text x="{(left + right) / 2}" y="{bottom + 38}" text-anchor="middle" font-size="13">{labels[0]}</text>'
        )
        self.parts.append(
            f'<text transform="translate(14 {(top + bottom) / 2}) rotate(-90)" text-anchor="middle" font-size="13">{labels[1]}</text>'
        )

    def at(self, p: Place) -> tuple[float, float]:
        left, top, right, bottom = self.frame
        u = (np.log10(p[0]) - self.x[0]) / (self.x[1] - self.x[0])
        v = (np.log10(p[1]) - self.y[0]) / (self.y[1] - self.y[0])
        return left + u * (right - left), bottom - v * (bottom - top)


def power_of_ten(power: int) -> str:
    if -3 <= power <= 4:
        return f"{10.0**power:g}"
    return f'10<tspan dy="-5" font-size="9">{power}</tspan>'
