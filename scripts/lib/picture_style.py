"""The style of all pictures of the documents: colours for light and dark pages, the font, ticks, axes.

Pictures are drawn in the colours of light pages, those of the programs' own drawings. themed() adds the dark ones, which a
browser takes for itself where the page is dark.
"""
import dataclasses
import math
import xml.sax.saxutils

FONT = "Inter, 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif"
TITLE, TEXT = 13, 12  # pixels

PAPER, PANEL, GRID, FRAME, ZERO = '#ffffff', '#fbfcfd', '#e9edf2', '#cbd5e1', '#b6c0cd'
INK, FAINT, STRONG = '#334155', '#64748b', '#0f172a'
FORWARD, REVERSE, GOAL, DRIVEN = '#2563eb', '#ea580c', '#059669', '#be185d'
OBSTACLE, OBSTACLE_EDGE, OUTSIDE, UNKNOWN = '#b4bdca', '#66717f', '#e1e6ed', '#e3cf9b'
CURVES = (FORWARD, REVERSE, GOAL, DRIVEN, '#7c3aed', '#854d0e', '#0891b2', '#475569')  # distinguishable with colour blindness

DARK = {PAPER: '#14181d', PANEL: '#191e24', GRID: '#272e36', FRAME: '#3b4550', ZERO: '#566270',
        INK: '#cbd5e1', FAINT: '#94a3b8', STRONG: '#f1f5f9',
        FORWARD: '#6ea0ff', REVERSE: '#fb923c', GOAL: '#34d399', DRIVEN: '#f472b6',
        OBSTACLE: '#434e5b', OBSTACLE_EDGE: '#8492a3', OUTSIDE: '#20262d', UNKNOWN: '#5c5132',
        '#7c3aed': '#a78bfa', '#854d0e': '#d6a45c', '#0891b2': '#22b8d6', '#475569': '#9fb0c5'}


def dark_rules():
    """CSS that turns the attributes fill and stroke of the light colours into the dark ones."""
    rules = ''.join(f'[{key}="{light}"]{{{key}:{dark}}}' for light, dark in DARK.items() for key in ('fill', 'stroke'))
    return f'@media (prefers-color-scheme: dark){{{rules}}}'


def themed(svg):
    """A picture in light colours, with the dark ones for dark pages."""
    end = svg.index('>', svg.index('<svg')) + 1
    return f'{svg[:end]}\n<style>{dark_rules()}</style>{svg[end:]}'


def picture(width, height, body, name):
    """A complete SVG; name is its description for screen readers."""
    return themed(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}" height="{height:g}" '
                  f'viewBox="0 0 {width:g} {height:g}" font-family="{FONT}" role="img">\n<title>{escape(name)}</title>\n'
                  f'<rect width="100%" height="100%" fill="{PAPER}"/>\n{body}</svg>\n')


def escape(words):
    return xml.sax.saxutils.escape(words)


def text(x, y, words, colour=FAINT, anchor='start', size=TEXT, more=''):
    return (f'<text x="{x:.5g}" y="{y:.5g}" font-size="{size}" fill="{colour}" text-anchor="{anchor}"{more}>{escape(words)}'
            '</text>\n')


def line(points, colour, width=1.8, dash=''):
    """An open line through pixels."""
    dashed = f' stroke-dasharray="{dash}"' if dash else ''
    places = ' '.join(f'{x:.1f},{y:.1f}' for x, y in points)
    return (f'<polyline points="{places}" fill="none" stroke="{colour}" stroke-width="{width:g}"{dashed} '
            'stroke-linejoin="round" stroke-linecap="round"/>\n')


def round_ticks(low, high, most):
    """At most about that many multiples of 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10((high - low) / most))
    step = next(factor * power for factor in (1, 2, 5, 10) if (high - low) / (factor * power) <= most * (1 + 1e-9))
    return [round(k * step, 12) for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def decade_ticks(low, high):
    """The powers of ten of a logarithmic axis."""
    return [10.0 ** k for k in range(math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9) + 1)]


@dataclasses.dataclass
class Axes:
    """A frame with ticks; values in it become pixels."""
    left: float
    top: float
    width: float
    height: float
    x_range: tuple[float, float]
    y_range: tuple[float, float]

    def place(self, x, y):
        (x0, x1), (y0, y1) = self.x_range, self.y_range
        return self.left + (x - x0) / (x1 - x0) * self.width, self.top + (y1 - y) / (y1 - y0) * self.height

    def frame(self, title='', x_label='', y_label='', x_ticks=(), y_ticks=()):
        """Axes and grid. Ticks are values, or pairs of a value and its label."""
        bottom, body = self.top + self.height, ''
        for tick in x_ticks:
            value, label = tick if isinstance(tick, tuple) else (tick, f'{tick:g}')
            x = self.place(value, self.y_range[0])[0]
            body += line([(x, self.top), (x, bottom)], GRID, 1) + text(x, bottom + 16, label, anchor='middle')
        for tick in y_ticks:
            value, label = tick if isinstance(tick, tuple) else (tick, f'{tick:g}')
            y = self.place(self.x_range[0], value)[1]
            body += line([(self.left, y), (self.left + self.width, y)], ZERO if value == 0 else GRID, 1)
            body += text(self.left - 8, y + 4, label, anchor='end')
        body += (f'<rect x="{self.left:g}" y="{self.top:g}" width="{self.width:g}" height="{self.height:g}" fill="none" '
                 f'stroke="{FRAME}"/>\n')
        if title:
            body += text(self.left, self.top - 10, title, INK, size=TITLE, more=' font-weight="600"')
        if x_label:
            body += text(self.left + self.width / 2, bottom + 34, x_label, anchor='middle')
        if y_label:
            x, y = self.left - 46, self.top + self.height / 2
            body += text(x, y, y_label, anchor='middle', more=f' transform="rotate(-90 {x:g} {y:g})"')
        return body

    def curve(self, x, y, colour, dash='', width=1.8):
        return line([self.place(*point) for point in zip(x, y)], colour, width, dash)


def legend(x, y, entries):
    """Samples of lines with their labels, in one row; entries are (label, colour, dash)."""
    body = ''
    for label, colour, dash in entries:
        body += line([(x, y - 4), (x + 22, y - 4)], colour, 1.8, dash) + text(x + 28, y, label, INK)
        x += 28 + 0.54 * TEXT * len(label) + 20
    return body
