"""Pictures of the problems and paths of the planners, from parking_benchmark's pictures."""
import dataclasses
import math
import os
import re
import xml.etree.ElementTree as ElementTree

from formatting import shown
from page_tables import shown_length

SHAPES = {'g', 'path', 'rect', 'polygon', 'polyline', 'circle', 'text', 'tspan'}  # without scripts and links
DARK = re.compile(r'@media \(prefers-color-scheme: dark\)\{(\[(fill|stroke)="#[0-9a-f]{6}"\]\{(fill|stroke):#[0-9a-f]{6}\})*\}')


@dataclasses.dataclass
class Panel:
    """A drawing as the content of an SVG element, with a planner's path or, of a ground, without one."""
    width: str
    height: str
    content: str
    planner: str = ''
    run: int = -1


@dataclasses.dataclass
class Picture:
    """A problem: the best path of all, the ground of all other panels, and the path of each planner on it."""
    best: Panel
    ground: str  # content
    paths: dict  # planner -> Panel without the ground
    style: str   # CSS for dark themes


def _content(elements):
    """The elements as text. Raises ValueError unless they are shapes."""
    shapes = [shape for element in elements for shape in element.iter()]
    if any(shape.tag not in SHAPES or any(name.startswith('on') for name in shape.attrib) for shape in shapes):
        raise ValueError('not only shapes')
    return ''.join(ElementTree.tostring(element, encoding='unicode') for element in elements)


def _panel(svg, elements):
    path = svg.find('g[@data-planner]')
    width, height = svg.get('viewBox').split()[2:]
    panel = Panel(f'{float(width):g}', f'{float(height):g}', _content(elements))
    if path is not None:
        panel.planner, panel.run = path.get('data-planner'), int(path.get('data-run'))
    return panel


def read_picture(folder, problem):
    """The picture of a problem; None without one of this program."""
    try:
        root = ElementTree.parse(os.path.join(folder, 'pictures', problem + '.svg')).getroot()
        for element in root.iter():
            element.tag = element.tag.rpartition('}')[2]
        style = root.findtext('style')
        best, panels = root.find('svg[@class="best"]'), root.findall('svg[@class="planner"]')
        if not DARK.fullmatch(style):
            return None
        paths = [_panel(svg, svg.findall('g[@data-planner]')) for svg in panels]
        return Picture(_panel(best, list(best)), _content(list(root.find('defs/g[@id="ground"]'))),
                       {path.planner: path for path in paths}, style)
    except (OSError, ElementTree.ParseError, AttributeError, IndexError, TypeError, ValueError):
        return None


def _described(run):
    """Length, changes of direction and clearance of a solved run."""
    changes, clearance = run.figure('cusps'), run.figure('least clearance')
    return (shown_length(run.length) + ('' if math.isnan(changes) else f', {changes:.0f} change{"s"[:changes != 1]} of direction')
            + ('' if math.isnan(clearance) else f', clearance {100 * clearance:.1f} cm'))


class Gallery:
    """The pictures of a problem, one of each folder of results, for the template."""

    def __init__(self, results, problem, cells):
        self._results, self._problem, self._cells = results, problem, cells
        self._pictures = {}
        for index in cells:
            folder = results.origins[results.planners[index]][0]
            if folder not in self._pictures:
                self._pictures[folder] = read_picture(folder, problem)
        # A picture without the path of a planner that solved the problem is that of other results.
        for index, cell in cells.items():
            folder, name = results.origins[results.planners[index]]
            if cell.solved and self._pictures[folder] and name not in self._pictures[folder].paths:
                self._pictures[folder] = None
        self._pictures = {folder: picture for folder, picture in self._pictures.items() if picture}

    def __bool__(self):
        return bool(self._pictures)

    @property
    def style(self):
        return next((picture.style for picture in self._pictures.values()), '')

    def _found(self, index):
        """(folder, panel, run) of a planner's path; None for a missing one."""
        folder, name = self._results.origins[self._results.planners[index]]
        picture = self._pictures.get(folder)
        panel = picture.paths.get(name) if picture else None
        run = next((run for run in self._cells[index].runs if panel and run.number == panel.run), None)
        return folder, panel, run

    def best(self):
        """One picture for each folder: the shortest path."""
        solvers = f'{sum(cell.solved > 0 for cell in self._cells.values())} of {len(self._cells)} planners solve it'
        made = []
        for folder, picture in self._pictures.items():
            index = next((index for index in self._cells
                          if self._results.origins[self._results.planners[index]] == (folder, picture.best.planner)), None)
            run = None if index is None else self._found(index)[2]
            name = '' if index is None else self._results.planners[index]
            if self._problem in self._results.unsolvable:
                text = 'no solution exists' + (f'; a path of {name} to a pose near the goal' if name else '')
            elif run and run.solved:
                text = f'{_described(run)}: {name}; {solvers}'
            else:
                text = 'solved by no planner'
            made.append({'panel': picture.best, 'text': text})
        return made

    def grounds(self):
        return [(place, picture.ground) for place, picture in enumerate(self._pictures.values())]

    def cards(self):
        """Valid paths, one card each."""
        places = {folder: place for place, folder in enumerate(self._pictures)}
        made = []
        for index, cell in self._cells.items():
            folder, panel, run = self._found(index)
            if run and run.solved:
                file = f'paths/{self._problem}-{panel.planner}-{panel.run}.csv'
                there = folder == self._results.folder and os.path.isfile(os.path.join(folder, file))
                made.append({'index': index, 'name': self._results.planners[index], 'ground': places[folder], 'panel': panel,
                             'text': _described(run), 'csv': file if there else '', 'count': f'{cell.solved}/{cell.count}'})
        return made

    def failures(self):
        """Planners without a valid path, in a few words each."""
        made = []
        for index, cell in self._cells.items():
            if not cell.solved:
                nearest = min((distance for run in cell.runs if (distance := run.figure('distance to goal')) >= 0.0), default=math.nan)
                what = ('▲ invalid' if cell.invalid else 'no path' if math.isnan(nearest)
                        else f'ends {shown(nearest)} m from the goal')
                made.append(f'{self._results.planners[index]} ({what})')
        return made
