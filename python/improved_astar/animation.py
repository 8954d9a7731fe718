"""Drives as pages that move, for notebooks and browsers."""
import html
import numbers

from ._core import Error


class Animation:
    """A page that shows a drive: in notebooks by itself, elsewhere after save()."""

    def __init__(self, page, height):
        self.page = page
        self.height = height

    def save(self, path):
        """Writes the page, which needs nothing else, to a file."""
        with open(path, 'w', encoding='utf-8') as stream:
            stream.write(self.page)
        return path

    def _repr_html_(self):
        return (f'<iframe srcdoc="{html.escape(self.page, quote=True)}" style="width:100%;border:0" '
                f'height="{self.height}"></iframe>')


def animate(self, title=None, height=760):
    """The drive of a result along its trajectory: a page with the car on the map, speed, acceleration and steering.

    title: plain text; height: pixels in a notebook. Returns an Animation.
    """
    if not isinstance(height, numbers.Real):
        raise Error(f'height must be a number of pixels, not {height!r}')
    text = str(title) if title is not None else self.scenario.name
    about = f'{self.length:.1f} m in {self.duration:.1f} s' if self.length is not None else ''
    return Animation(self._page(text, about), height)
