"""Animated drives for notebooks and browsers."""
import html
import numbers

from ._core import Error


class Animation:
    """A page that animates a drive: notebooks display it, save() writes it to a file."""

    def __init__(self, page, height):
        self.page = page
        self.height = height

    def save(self, path):
        """Writes the page to a self-contained HTML file and returns its path."""
        with open(path, 'w', encoding='utf-8') as stream:
            stream.write(self.page)
        return path

    def _repr_html_(self):
        return (f'<iframe srcdoc="{html.escape(self.page, quote=True)}" style="width:100%;border:0" '
                f'height="{self.height}"></iframe>')


def animate(self, title=None, height=760):
    """Returns the Animation of a result: the car on the map, and plots of speed, acceleration and steering.

    title : plain text
    height : pixels in a notebook
    """
    if not isinstance(height, numbers.Real):
        raise Error(f'height must be a number of pixels, not {height!r}')
    text = str(title) if title is not None else self.scenario.name
    about = f'{self.length:.1f} m in {self.duration:.1f} s' if self.length is not None else ''
    return Animation(self._page(text, about), height)
