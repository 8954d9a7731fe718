"""Paths of the planners, from parking_benchmark's pictures of its problems."""
import dataclasses
import os
import xml.etree.ElementTree as ElementTree

SHAPES = {'g', 'path', 'rect', 'polygon', 'polyline', 'circle', 'text', 'tspan'}  # without scripts and links


@dataclasses.dataclass
class Path:
    """A planner's path: the number of its run, and its stretches between changes of direction, (direction, points)."""
    run: int
    stretches: list = dataclasses.field(default_factory=list)

    @property
    def cusps(self):
        """Positions of the changes of direction."""
        return [points.split(' ', 1)[0].split(',') for _, points in self.stretches[1:]]


@dataclasses.dataclass
class Picture:
    """A problem without paths, as the content of an SVG element, and the paths on it."""
    width: float
    height: float
    content: str
    paths: dict  # planner -> Path


def _whole_pixels(points):
    """Rounded points without repetitions."""
    rounded = [','.join(f'{float(value):.0f}' for value in point.split(',')) for point in points.split()]
    return ' '.join(point for k, point in enumerate(rounded) if k == 0 or rounded[k - 1] != point)


def _take_paths(group):
    """Removes the planners' lines from a group and returns them."""
    paths = {}
    for line in group.findall('polyline[@data-planner]'):
        path = paths.setdefault(line.get('data-planner'), Path(int(line.get('data-run'))))
        path.stretches.append((line.get('data-direction'), _whole_pixels(line.get('points'))))
        group.remove(line)
    return paths


def read_picture(folder, problem):
    """The picture of a problem; None without one of this program."""
    try:
        root = ElementTree.parse(os.path.join(folder, 'pictures', problem + '.svg')).getroot()
        for element in root.iter():
            element.tag = element.tag.rpartition('}')[2]
        panel = root.find('svg')
        width, height = float(panel.get('width')), float(panel.get('height'))
        paths = {}
        for group in panel.findall('g'):
            paths.update(_take_paths(group))
        shapes = [element for child in panel for element in child.iter()]
        if any(shape.tag not in SHAPES or any(name.startswith('on') for name in shape.attrib) for shape in shapes):
            return None
        return Picture(width, height, ''.join(ElementTree.tostring(child, encoding='unicode') for child in panel), paths)
    except (OSError, ElementTree.ParseError, AttributeError, TypeError, ValueError):
        return None
