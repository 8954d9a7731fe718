"""Pictures with matplotlib, which is imported when the first one is drawn."""
import math
import numbers

from ._core import Error

FORWARD, REVERSE, CAR, OBSTACLE, SLOT = '#2563eb', '#ea580c', '#1e3a8a', '#64748b', '#16a34a'


def _draw_world(axes, scenario):
    from matplotlib import colors
    from matplotlib.patches import Polygon
    from matplotlib.transforms import Affine2D
    for corners in scenario.polygons:
        axes.add_patch(Polygon(corners, closed=True, facecolor=OBSTACLE, edgecolor='#334155', linewidth=0.6, zorder=1))
    if scenario.grid is not None:
        rows, columns = scenario.grid.shape
        x, y, yaw = scenario.origin
        shades = colors.ListedColormap(['#ffffff', OBSTACLE, '#e2e8f0'])
        placed = Affine2D().scale(scenario.resolution).rotate(yaw).translate(x, y) + axes.transData
        axes.imshow(scenario.grid, origin='lower', extent=(0, columns, 0, rows), cmap=shades, vmin=0, vmax=2,
                    interpolation='nearest', transform=placed, zorder=0)
    if scenario.slot is not None:
        axes.add_patch(Polygon(scenario.slot.outline, closed=True, fill=False, edgecolor=SLOT, linewidth=1.2,
                               linestyle='--', zorder=2))


def _draw_footprints(axes, vehicle, path, spacing):
    from matplotlib.patches import Polygon
    driven, last = 0.0, -math.inf
    for k, (x, y, yaw, _, _) in enumerate(path):
        if k > 0:
            driven += math.hypot(x - path[k - 1][0], y - path[k - 1][1])
        end = k in (0, len(path) - 1)
        cusp = 0 < k < len(path) - 1 and path[k][3] != path[k + 1][3]
        if end or cusp or driven - last >= spacing:
            last = driven
            axes.add_patch(Polygon(vehicle.footprint((x, y, yaw)), closed=True, fill=end, facecolor='#dbe7fb',
                                   edgecolor=CAR, alpha=1.0 if end else 0.35, linewidth=1.0 if end else 0.6,
                                   zorder=4 if end else 3))


def _draw_path(axes, path):
    begin = 0
    drawn = set()
    for k in range(1, len(path) + 1):
        if k == len(path) or (k > begin + 1 and path[k][3] != path[k - 1][3]):
            direction = path[k - 1][3]
            name = 'forwards' if direction > 0 else 'reverse'
            axes.plot(path[begin:k, 0], path[begin:k, 1], color=FORWARD if direction > 0 else REVERSE, linewidth=1.8,
                      zorder=5, label=None if name in drawn else name)
            drawn.add(name)
            begin = k - 1


def plot(self, path=None, axes=None, footprints=1.5):
    """Draws a result: obstacles, slot, path, the car along it.

    path: of a picture to write (.png, .svg, .pdf); axes: matplotlib's, to draw into;
    footprints: metres between outlines of the car, 0 for none. Returns the axes.
    """
    from matplotlib.figure import Figure
    if not isinstance(footprints, numbers.Real):
        raise Error(f'footprints must be a number of metres, not {footprints!r}')
    if axes is not None and not hasattr(axes, 'add_patch'):
        raise Error(f"axes must be matplotlib's, not {type(axes).__name__}")
    scenario = self.scenario
    figure = None
    if axes is None:
        if path is None:
            from matplotlib import pyplot
            figure, axes = pyplot.subplots(figsize=(9, 6))
        else:
            figure = Figure(figsize=(9, 6), layout='constrained')
            axes = figure.add_subplot()
    _draw_world(axes, scenario)
    states = self.path
    if len(states) > 0:
        _draw_path(axes, states)
        if footprints > 0:
            _draw_footprints(axes, scenario.vehicle, states, footprints)
        axes.legend(loc='upper right', fontsize='small')
    x, y = [scenario.start[0]], [scenario.start[1]]
    for goal in scenario.goals:
        x.append(goal[0])
        y.append(goal[1])
    x += list(states[:, 0])
    y += list(states[:, 1])
    room = scenario.vehicle.length + 1.0
    axes.set_xlim(min(x) - room, max(x) + room)
    axes.set_ylim(min(y) - room, max(y) + room)
    axes.set_aspect('equal')
    axes.set_xlabel('x, m')
    axes.set_ylabel('y, m')
    about = f'{self.length:.2f} m, {self.cusps} cusps, clearance {self.clearance:.2f} m' if self.length is not None else ''
    axes.set_title(f'{scenario.name}: {self.status}' + (f', {about}' if about else ''), fontsize='medium')
    if path is not None:
        if figure is None:
            figure = axes.figure
        figure.savefig(path, dpi=130)
    return axes
