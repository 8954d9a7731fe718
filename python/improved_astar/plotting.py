"""Pictures drawn with matplotlib, which is imported on first use."""
import math
import numbers

from ._core import Error

# The colours of the C++ pictures (svg_colour in SvgMap.h), with darker obstacles.
FORWARD, REVERSE, START, GOAL, CAR = '#2563eb', '#ea580c', '#334155', '#059669', '#1e3a8a'
FREE, OBSTACLE, UNKNOWN, OUTSIDE = '#ffffff', '#64748b', '#e3cf9b', '#e1e6ed'

# The entries of a legend in their order.
LABELS = ['forwards', 'reverse', 'car along the path', 'start', 'goal', 'other goal', 'middle of the rear axle', 'slot', 'obstacle',
          'unknown', 'outside of the map']


class _View:
    """The visible region of the axes, and the labels used so far."""

    def __init__(self, axes, scenario, states):
        self.axes = axes
        self.named = set()
        margin = scenario.vehicle.length + 1.0
        poses = [scenario.start, *scenario.goals, *states[:, :3]]
        x, y = [pose[0] for pose in poses], [pose[1] for pose in poses]
        self.low, self.high = (min(x) - margin, min(y) - margin), (max(x) + margin, max(y) + margin)

    def name(self, label, seen=True):
        """Returns the label for the first visible artist of its kind, and None for others."""
        if not seen or label in self.named:
            return None
        self.named.add(label)
        return label

    def name_colour(self, label, colour):
        """Adds a legend entry for a colour without an artist of its own."""
        if label not in self.named:
            self.axes.plot([], [], linestyle='none', marker='s', markersize=8, color=colour, markeredgecolor=START,
                           markeredgewidth=0.4, label=self.name(label))

    def shows(self, corners):
        from matplotlib.path import Path
        from matplotlib.transforms import Bbox
        return Path(corners, closed=False).intersects_bbox(Bbox([self.low, self.high]))

    def corners(self):
        return [self.low, (self.high[0], self.low[1]), self.high, (self.low[0], self.high[1])]


def _draw_grid(view, scenario):
    import numpy
    from matplotlib import colors
    from matplotlib.transforms import Affine2D
    grid, axes = scenario.grid, view.axes
    rows, columns = grid.shape
    x, y, yaw = scenario.origin
    place = Affine2D().scale(scenario.resolution).rotate(yaw).translate(x, y)
    axes.imshow(grid, origin='lower', extent=(0, columns, 0, rows), cmap=colors.ListedColormap([FREE, OBSTACLE, UNKNOWN]),
                vmin=0, vmax=2, interpolation='nearest', transform=place + axes.transData, zorder=0)
    # The cells near the view, and among these the ones with their centre in it.
    seen = place.inverted().transform(view.corners())
    first = numpy.clip(numpy.floor(seen.min(axis=0)), 0, (columns, rows)).astype(int)
    end = numpy.clip(numpy.ceil(seen.max(axis=0)), 0, (columns, rows)).astype(int)
    near = grid[first[1]:end[1], first[0]:end[0]]
    for label, colour, kind in (('obstacle', OBSTACLE, 1), ('unknown', UNKNOWN, 2)):
        middles = place.transform(numpy.argwhere(near == kind)[:, ::-1] + first + 0.5)
        if ((middles >= view.low) & (middles <= view.high)).all(axis=1).any():
            view.name_colour(label, colour)
    if ((seen < 0) | (seen > (columns, rows))).any():
        view.name_colour('outside of the map', OUTSIDE)


def _draw_world(view, scenario):
    from matplotlib.patches import Polygon, Rectangle
    axes = view.axes
    axes.set_facecolor(OUTSIDE)
    if scenario.grid is not None:
        _draw_grid(view, scenario)
    else:
        left, bottom, right, top = scenario.bounds
        axes.add_patch(Rectangle((left, bottom), right - left, top - bottom, facecolor=FREE, zorder=0))
        if left > view.low[0] or bottom > view.low[1] or right < view.high[0] or top < view.high[1]:
            view.name_colour('outside of the map', OUTSIDE)
    for corners in scenario.polygons:
        axes.add_patch(Polygon(corners, closed=True, facecolor=OBSTACLE, edgecolor='#334155', linewidth=0.6, zorder=1,
                               label=view.name('obstacle', view.shows(corners))))
    if scenario.slot is not None:
        axes.add_patch(Polygon(scenario.slot.outline, closed=True, fill=False, edgecolor=GOAL, linewidth=1.2, linestyle='--',
                               zorder=2, label=view.name('slot', view.shows(scenario.slot.outline))))


def _draw_cars(view, scenario):
    """Draws the car at its start and its first goal, and a mark for each other goal."""
    from matplotlib.patches import Polygon
    for pose, colour, label in ((scenario.start, START, 'start'), (scenario.goals[0], GOAL, 'goal')):
        body = Polygon(scenario.vehicle.footprint(pose), closed=True, facecolor=colour + '55', edgecolor=colour, linewidth=1.2,
                       zorder=4, label=view.name(label))
        view.axes.add_patch(body)
        view.axes.plot(*pose[:2], 'o', color=colour, markersize=3, zorder=6, label=view.name('middle of the rear axle'))
    for goal in scenario.goals[1:]:
        view.axes.plot(*goal[:2], 'o', color='#ffffff', markeredgecolor=GOAL, markersize=5, linestyle='none', zorder=6,
                       label=view.name('other goal'))


def _draw_footprints(view, vehicle, path, spacing):
    from matplotlib.patches import Polygon
    driven, last = 0.0, -math.inf
    for k, (x, y, yaw, _, _) in enumerate(path):
        if k > 0:
            driven += math.hypot(x - path[k - 1][0], y - path[k - 1][1])
        end = k == len(path) - 1
        cusp = 0 < k < len(path) - 1 and path[k][3] != path[k + 1][3]
        if end or cusp or driven - last >= spacing:
            last = driven
            view.axes.add_patch(Polygon(vehicle.footprint((x, y, yaw)), closed=True, fill=False, edgecolor=CAR, alpha=0.35,
                                        linewidth=0.6, zorder=3, label=view.name('car along the path')))


def _draw_path(view, path):
    begin = 0
    for k in range(1, len(path) + 1):
        if k == len(path) or (k > begin + 1 and path[k][3] != path[k - 1][3]):
            forwards = path[k - 1][3] > 0
            view.axes.plot(path[begin:k, 0], path[begin:k, 1], color=FORWARD if forwards else REVERSE, linewidth=1.8,
                           zorder=5, label=view.name('forwards' if forwards else 'reverse'))
            begin = k - 1


def _draw_legend(axes, beside):
    """Draws the legend of the named artists, beside the axes or in a corner of them."""
    handles, labels = axes.get_legend_handles_labels()
    named = dict(zip(labels, handles))
    order = [label for label in LABELS if label in named] + [label for label in named if label not in LABELS]
    place = {'loc': 'upper left', 'bbox_to_anchor': (1.01, 1.0), 'borderaxespad': 0.0} if beside else {'loc': 'upper right'}
    axes.legend([named[label] for label in order], order, fontsize='small', **place)


def plot(self, path=None, axes=None, footprints=1.5):
    """Draws a result with obstacles, slot, path, outlines of the car and a legend, and returns the axes.

    path : picture file to write (.png, .svg, .pdf)
    axes : matplotlib axes for the drawing
    footprints : metres between outlines of the car; 0 for none
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
            figure, axes = pyplot.subplots(figsize=(9, 6), layout='constrained')
        else:
            figure = Figure(figsize=(9, 6), layout='constrained')
            axes = figure.add_subplot()
    states = self.path
    view = _View(axes, scenario, states)
    _draw_world(view, scenario)
    _draw_cars(view, scenario)
    if len(states) > 0:
        _draw_path(view, states)
        if footprints > 0:
            _draw_footprints(view, scenario.vehicle, states, footprints)
    _draw_legend(axes, beside=figure is not None)
    axes.set_xlim(view.low[0], view.high[0])
    axes.set_ylim(view.low[1], view.high[1])
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
