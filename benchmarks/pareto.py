"""Error against time as an SVG that is readable in light and dark, each program a point with its name beside it."""

import math
from html import escape
from pathlib import Path

WIDTH, HEIGHT = 860, 560
LEFT, RIGHT, TOP, BOTTOM = 96, 20, 56, 52  # of the frame
BAND = 92  # pixels for the programs whose errors are rounding
TEXT, SMALL = 13, 12  # pixels
NEAR = 7  # pixels around a point that stay free

# The colours of the site (docs/_static/site.css). A picture in a page does not see the page's theme, only that of the
# reader's system: so it has a background of its own.
STYLE = """
svg { color-scheme: light dark; font-family: system-ui, -apple-system, "Segoe UI", Helvetica, Arial, sans-serif; }
.paper { fill: #ffffff; } .band { fill: #f0f1f3; } .frame { fill: none; stroke: #9aa0a6; }
.grid { stroke: #dfe2e6; } text { fill: #1f2328; } .quiet { fill: #5a6169; }
.ours { fill: #a33b0b; } .others { fill: #3166a4; } .to-ours { stroke: #a33b0b; } .to-others { stroke: #3166a4; }
@media (prefers-color-scheme: dark) {
  .paper { fill: #131416; } .band { fill: #202327; } .frame { stroke: #6b7178; }
  .grid { stroke: #2d3136; } text { fill: #e6e8eb; } .quiet { fill: #a5abb3; }
  .ours { fill: #ff9d5c; } .others { fill: #7db4f0; } .to-ours { stroke: #ff9d5c; } .to-others { stroke: #7db4f0; }
}
"""


def text_width(text, size):
    """At least what a sans serif takes: drawn where that is known only to the reader's browser."""
    narrow, wide = "ijltfrI.,:;|'()[]- ", "mwMWGOQ@%†"
    return size * sum(0.36 if c in narrow else 0.9 if c in wide else 0.62 for c in text)


class Scale:
    """Logarithmic, of values onto pixels."""

    def __init__(self, low, high, begin, end):
        self.low, self.high, self.begin, self.end = math.log10(low), math.log10(high), begin, end

    def __call__(self, value):
        return self.begin + (math.log10(value) - self.low) / (self.high - self.low) * (self.end - self.begin)

    def decades(self):
        return [10**e for e in range(math.ceil(self.low - 1e-9), math.floor(self.high + 1e-9) + 1)]


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def candidates(x, y, width):
    """Boxes for a text around a point, from the nearest on: beside it, above and below, then farther away."""
    half = TEXT / 2 + 1
    for distance in (0, *range(16, 240, 8)):
        for dy in (0,) if distance == 0 else (-distance, distance):
            for left in (x + NEAR + 3, x - NEAR - 3 - width, x - width / 2, x - 12, x + 12 - width):
                if distance == 0 and left < x + NEAR < left + width:
                    continue  # over the point itself
                yield left, y + dy - half, left + width, y + dy + half


def leader(x, y, box):
    """The line from a point to its name, where that is not right beside it."""
    end = min(max(x, box[0]), box[2]), box[3] if box[3] < y else box[1] if box[1] > y else y
    return (x, y, *end) if math.hypot(end[0] - x, end[1] - y) > 2 * NEAR else None


def crosses(line, box):
    """Whether a line comes into a box; close enough, by points along it."""
    if line is None:
        return False
    x, y, to_x, to_y = line
    along = ((x + i / 40 * (to_x - x), y + i / 40 * (to_y - y)) for i in range(4, 40))
    return any(box[0] < p < box[2] and box[1] < q < box[3] for p, q in along)


def place(points, room_of, taken):
    """For each (x, y, name, ...) the box of its name, where it covers no other name, no point and no line to a name."""
    taken = [*taken, *((x - NEAR, y - NEAR, x + NEAR, y + NEAR) for x, y, *_ in points)]
    boxes, lines = {}, []
    # Where it is crowded first: there is least choice.
    crowd = lambda p: sum(1 / (30 + math.hypot(p[0] - q[0], p[1] - q[1])) for q in points)  # noqa: E731
    for point in sorted(points, key=crowd, reverse=True):
        x, y, name = point[:3]
        room = room_of(point)
        for box in candidates(x, y, text_width(name, TEXT)):
            inside = room[0] <= box[0] and box[2] <= room[2] and room[1] <= box[1] and box[3] <= room[3]
            line, others = leader(x, y, box), [b for b in taken if not (b[0] < x < b[2] and b[1] < y < b[3])]
            free = not any(overlap(box, other) for other in taken) and not any(crosses(other, box) for other in lines)
            if inside and free and not any(crosses(line, other) for other in others):
                boxes[name] = box
                lines.append(line)
                taken.append((box[0] - 4, box[1], box[2] + 4, box[3]))
                break
        else:
            raise ValueError(f"no room for the name of {name}")
    return boxes


def duration(nanoseconds):
    return f"{nanoseconds:g} ns" if nanoseconds < 1000 else f"{nanoseconds / 1000:g} µs"


def percent(value):
    return f"{100 * value:.9f}".rstrip("0").rstrip(".") + " %"


def draw(programs, file, title):
    """`programs`: (name, nanoseconds a vertex, mean error or None where it is rounding, whether it is ours)."""
    errors = [error for _, _, error, _ in programs if error]
    times = [time for _, time, _, _ in programs]
    frame = (LEFT, TOP, WIDTH - RIGHT, HEIGHT - BOTTOM)
    floor = frame[3] - BAND  # errors above, rounding below
    across = Scale(min(times) / 1.6, max(times) * 1.6, frame[0], frame[2])
    up = Scale(10 ** math.floor(math.log10(min(errors))), max(errors) * 2, floor, frame[1])
    points = [
        (across(time), up(error) if error else floor + BAND / 2, name, error, ours)
        for name, time, error, ours in programs
    ]
    inner = lambda top, bottom: (frame[0] + 4, top + 3, frame[2] - 4, bottom - 3)  # noqa: E731
    words = "exact to rounding"
    label = (frame[0] + 8, frame[3] - 20, frame[0] + 8 + text_width(words, SMALL), frame[3] - 4)
    boxes = place(points, lambda p: inner(frame[1], floor) if p[3] else inner(floor, frame[3]), [label])

    parts = [f'<rect class="paper" width="{WIDTH}" height="{HEIGHT}" rx="6"/>']
    parts += [f'<rect class="band" x="{frame[0]}" y="{floor}" width="{frame[2] - frame[0]}" height="{BAND}"/>']
    for time in across.decades():
        x = across(time)
        parts += [f'<line class="grid" x1="{x:.1f}" x2="{x:.1f}" y1="{frame[1]}" y2="{frame[3]}"/>']
        parts += [f'<text x="{x:.1f}" y="{frame[3] + 18}" text-anchor="middle">{duration(time)}</text>']
    for error in up.decades():
        y = up(error)
        parts += [f'<line class="grid" x1="{frame[0]}" x2="{frame[2]}" y1="{y:.1f}" y2="{y:.1f}"/>']
        parts += [f'<text x="{frame[0] - 8}" y="{y + 4:.1f}" text-anchor="end">{percent(error)}</text>']
    parts += [f'<rect class="frame" x="{frame[0]}" y="{frame[1]}" width="{frame[2] - frame[0]}" height="{frame[3] - frame[1]}"/>']
    parts += [f'<text class="quiet" x="{label[0]}" y="{label[3] - 4}" font-size="{SMALL}">{words}</text>']
    for x, y, name, _, ours in points:
        kind, box = "ours" if ours else "others", boxes[name]
        if line := leader(x, y, box):
            parts.append('<line class="to-{}" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>'.format(kind, *line))
        parts.append(
            f'<circle class="{kind}" cx="{x:.1f}" cy="{y:.1f}" r="5"/>' if ours
            else f'<rect class="{kind}" x="{x - 4.5:.1f}" y="{y - 4.5:.1f}" width="9" height="9"/>'
        )  # fmt: skip
        # Drawn from the side of the point, so that it stays beside it whatever the font's width.
        anchor, at = ("start", box[0]) if box[0] >= x else ("end", box[2]) if box[2] <= x else ("middle", (box[0] + box[2]) / 2)
        parts.append(
            f'<text class="{kind}" x="{at:.1f}" y="{box[1] + TEXT - 1:.1f}" text-anchor="{anchor}">{escape(name)}</text>'
        )
    parts += [f'<text x="{frame[0]}" y="24" font-size="15" font-weight="600">{escape(title)}</text>']
    legend = '<tspan class="ours">● Brushfire</tspan>  <tspan class="others" dx="10">■ other programs</tspan>'
    parts += [f'<text x="{frame[0]}" y="44">{legend}</text>']
    parts += [f'<text class="quiet" x="{frame[2]}" y="44" text-anchor="end">lower left is better</text>']
    parts += [f'<text x="{(frame[0] + frame[2]) / 2}" y="{HEIGHT - 10}" text-anchor="middle">from arrays to field, time a vertex, one thread</text>']
    middle = (frame[1] + floor) / 2
    parts += [f'<text transform="translate(16 {middle}) rotate(-90)" text-anchor="middle">mean relative error</text>']
    Path(file).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" font-size="{TEXT}" role="img">\n'
        f"<title>{escape(title)}</title>\n<style>{STYLE}</style>\n" + "\n".join(parts) + "\n</svg>\n"
    )
