"""Curves as SVG pictures of one style, which follow the light or dark theme of the page that shows them."""
import math
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 760, 320
LEFT, RIGHT, TOP, BOTTOM = 56, 230, 14, 46  # of the field; the legend is at its right
COLOURS = ('#3d85c6', '#e07b39', '#1f9e89', '#d1559b', '#9270d6', '#9b9b20', '#3aa9d6', '#8b8b8b')  # on light and dark
DASHES = ('', '7 4', '2 3')
STYLE = """
svg { font: 12px sans-serif; color-scheme: light dark; }
text { fill: #222; } .grid { stroke: #ddd; } .frame { stroke: #888; fill: none; }
.curve { fill: none; stroke-width: 2; stroke-linejoin: round; }
@media (prefers-color-scheme: dark) { text { fill: #ddd; } .grid { stroke: #444; } }
"""


def time_label(seconds):
    """100 µs, 1 ms, 10 s."""
    for unit, factor in (('µs', 1e-6), ('ms', 1e-3), ('s', 1.0)):
        if seconds < 999.5 * factor:
            return f'{seconds / factor:g} {unit}'
    return f'{seconds:g} s'


def round_ticks(low, high, count=6):
    """Multiples of 1, 2 or 5 times a power of ten in the range."""
    step = 10.0 ** math.floor(math.log10((high - low) / count))
    step = next(step * factor for factor in (1, 2, 5, 10) if (high - low) / (step * factor) <= count)
    return [round(k * step, 12) for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def step_points(points, end):
    """A curve that keeps its height until the next point, up to the end."""
    made = []
    for x, y in points:
        if made:
            made.append((x, made[-1][1]))
        made.append((x, y))
    return made + [(end, made[-1][1])] if made else []


def step_curves(curves, times, heights, x_title, y_title, height_label):
    """curves: name -> points (seconds, height); times and heights: the ranges of the axes, that of the times logarithmic. A
    curve has the colour of its place among all, also where others lie outside of the field and are left out."""
    low, high = times
    bottom, top = heights

    def across(time):
        share = math.log(max(time, low) / low) / math.log(high / low)
        return LEFT + (WIDTH - LEFT - RIGHT) * min(share, 1.0)

    def down(height):
        share = (height - bottom) / (top - bottom)
        return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * share
    made = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img">',
            f'<title>{escape(y_title)}, {escape(x_title)}</title>', f'<style>{STYLE}</style>',
            f'<clipPath id="field"><path d="M{LEFT} {TOP - 2}H{WIDTH - RIGHT}V{HEIGHT - BOTTOM + 2}H{LEFT}Z"/></clipPath>']
    for exponent in range(math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9) + 1):
        x = across(10.0 ** exponent)
        made += [f'<path class="grid" d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}"/>',
                 f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 17}" text-anchor="middle">{time_label(10.0 ** exponent)}</text>']
    for height in round_ticks(bottom, top):
        y = down(height)
        made += [f'<path class="grid" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>',
                 f'<text x="{LEFT - 7}" y="{y + 4:.1f}" text-anchor="end">{height_label(height)}</text>']
    made += [f'<path class="frame" d="M{LEFT} {TOP}V{HEIGHT - BOTTOM}H{WIDTH - RIGHT}"/>',
             f'<text x="{(LEFT + WIDTH - RIGHT) / 2:.0f}" y="{HEIGHT - 8}" text-anchor="middle">{escape(x_title)}</text>',
             f'<text transform="translate(14 {(TOP + HEIGHT - BOTTOM) / 2:.0f}) rotate(-90)" text-anchor="middle">'
             f'{escape(y_title)}</text>']
    seen = [(index, name, points) for index, (name, points) in enumerate(curves.items())
            if any(bottom <= height <= top for _, height in points)]
    for place, (index, name, points) in enumerate(seen):
        dash = DASHES[index // len(COLOURS) % len(DASHES)]
        look = f'stroke="{COLOURS[index % len(COLOURS)]}"' + (f' stroke-dasharray="{dash}"' if dash else '')
        line = ' '.join(f'{across(x):.1f},{down(y):.1f}' for x, y in step_points(points, high))
        made.append(f'<polyline class="curve" clip-path="url(#field)" {look} points="{line}"/>')
        y = TOP + 10 + 19 * place
        made += [f'<path class="curve" {look} d="M{WIDTH - RIGHT + 12} {y}h22"/>',
                 f'<text x="{WIDTH - RIGHT + 40}" y="{y + 4}">{escape(name)}</text>']
    return '\n'.join(made + ['</svg>']) + '\n'
