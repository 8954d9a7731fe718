"""Pictures, pages, results of comparisons, stubs."""
import math
import os
import re
import sqlite3

import pytest

import improved_astar as ia
from improved_astar import plotting

ROOT = os.environ['PARKING_SOURCE_DIR']
SCENARIOS = os.path.join(ROOT, 'benchmarks', 'scenarios')


def result(name='perpendicular'):
    return ia.plan(ia.Scenario.read(os.path.join(SCENARIOS, name + '.yaml')))


@pytest.mark.parametrize('name', ['perpendicular', 'underground_garage', 'unreachable'])
def test_plot_writes_a_picture(name, tmp_path):
    pytest.importorskip('matplotlib')
    file = tmp_path / 'path.svg'
    found = result(name)
    axes = found.plot(file)
    text = file.read_text()
    assert text.startswith('<?xml') and len(text) > 5000
    assert axes.get_title().startswith(name)
    if found:
        # Both directions are drawn, and the car at start and goal.
        assert {line.get_label() for line in axes.lines} >= {'forwards', 'reverse'}
        low, high = axes.get_xlim()
        assert low < found.path[:, 0].min() and high > found.path[:, 0].max()


def legend_of(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


PATH, CARS = ['forwards', 'reverse', 'car along the path'], ['start', 'goal', 'middle of the rear axle']


def test_legends_name_all_that_is_seen(tmp_path):
    pytest.importorskip('matplotlib')
    file = tmp_path / 'path.png'

    def named(problem, **values):
        return legend_of(ia.plan(problem, **values).plot(file))

    assert legend_of(result().plot(file)) == [*PATH, *CARS, 'slot', 'obstacle']
    assert legend_of(result().plot(file, footprints=0)) == ['forwards', 'reverse', *CARS, 'slot', 'obstacle']
    # Of a path that goes one way only, in a world whose one obstacle lies beyond the view.
    far = [[80, 80], [81, 80], [81, 81]]
    ahead = ia.Scenario.from_polygons([far], (0, 0, 0), (8, 0, 0))
    assert named(ahead) == ['forwards', 'car along the path', *CARS]
    # One that lies across the view has no corner in it; a hole in a map lies askew as the map does.
    across = ia.Scenario.from_polygons([[[-90, 4], [90, 4], [90, 4.5], [-90, 4.5]]], (0, 0, 0), (8, 0, 0))
    assert named(across)[-1] == 'obstacle'
    either = ia.Slot('perpendicular', (8, 5, 0), length=6, width=3, entry='either')
    several = ia.Scenario.from_polygons([far], (0, 0, 0), slot=either)
    assert [*CARS[:2], 'other goal', CARS[2], 'slot'] == named(several)[-5:]
    # Without a path the problem is drawn all the same.
    blocked = ia.Scenario.from_polygons([[[-1, -3], [4, -3], [4, 3], [-1, 3]]], (0, 0, 0), (8, 0, 0))
    assert named(blocked) == [*CARS, 'obstacle']


def test_legends_of_maps(tmp_path):
    pytest.importorskip('matplotlib')
    import numpy

    def named(cells, **more):
        problem = ia.Scenario.from_grid(cells, (40, 40, 0), (48, 40, 0), resolution=0.5, **more)
        return legend_of(ia.plan(problem).plot(tmp_path / 'map.png'))[5:]

    cells = numpy.zeros((200, 200), dtype=numpy.uint8)
    assert named(cells) == []
    cells[0, :], cells[:, 0] = 1, 2  # which the view does not reach
    assert named(cells) == []
    cells[72, 105] = 1
    assert named(cells) == ['obstacle']
    cells[88, 85] = 2
    assert named(cells) == ['obstacle', 'unknown']
    assert named(cells[:90, :]) == ['obstacle', 'unknown', 'outside of the map']
    # On a map that lies askew, and ends in the lower left corner of the view.
    assert named(numpy.zeros((200, 200), dtype=numpy.uint8), origin=(53, 1, 0.5)) == ['outside of the map']
    # A cell 10 m along it and 30 m across it, which lies in the view; with the two swapped it does not.
    turned, origin = numpy.zeros((400, 400), dtype=numpy.uint8), (44 - 10 * 0.8 + 30 * 0.6, 43 - 10 * 0.6 - 30 * 0.8,
                                                                  math.atan2(0.6, 0.8))
    turned[68, 26] = 2  # 13 m along it and 34 m across it: 2 m above the view
    assert named(turned, origin=origin) == ['outside of the map']
    turned[60, 20] = 2
    assert named(turned, origin=origin) == ['unknown', 'outside of the map']


def test_pictures_have_the_same_colours_everywhere():
    with open(os.path.join(ROOT, 'parking_geometry', 'drawing', 'SvgMap.h'), encoding='utf-8') as stream:
        colours = dict(re.findall(r'constexpr const char \*(\w+) = "(#\w+)"', stream.read()))
    for name in ('FORWARD', 'REVERSE', 'START', 'GOAL', 'UNKNOWN', 'OUTSIDE'):
        assert getattr(plotting, name) == colours[name], name


def test_plot_draws_into_axes_of_the_caller():
    matplotlib = pytest.importorskip('matplotlib')
    matplotlib.use('Agg')
    from matplotlib import pyplot
    _, axes = pyplot.subplots()
    axes.plot([0, 1], [0, 1], label='mine')
    assert result().plot(axes=axes) is axes
    once = legend_of(axes)
    assert once[-1] == 'mine' and once[:3] == PATH
    result().plot(axes=axes)
    assert legend_of(axes) == once


def test_animate_makes_a_page_that_needs_nothing(tmp_path):
    found = result()
    animation = found.animate('A <drive>')
    assert animation.page.startswith('<!DOCTYPE html>')
    assert 'A &lt;drive&gt;' in animation.page and '<drive>' not in animation.page
    assert set(re.findall(r'https?://[^"\' ]+', animation.page)) <= {'http://www.w3.org/2000/svg'}
    shown = animation._repr_html_()
    assert shown.startswith('<iframe srcdoc="') and shown.count('"') == 6
    file = tmp_path / 'drive.html'
    animation.save(file)
    assert file.read_text(encoding='utf-8') == animation.page


def test_runs_of_a_database(tmp_path):
    pytest.importorskip('pandas')
    with pytest.raises(ia.Error, match='holds no results'):
        ia.read_runs(tmp_path)
    # In a folder whose name would mean something else in an address.
    tmp_path = tmp_path / 'run#1?50%41'
    tmp_path.mkdir()
    file = tmp_path / 'benchmark.db'
    connection = sqlite3.connect(file)
    connection.executescript('''
        CREATE TABLE experiments (id INTEGER, name TEXT);
        CREATE TABLE plannerConfigs (id INTEGER, name TEXT, settings TEXT);
        CREATE TABLE runs (id INTEGER, experimentid INTEGER, plannerid INTEGER, run INTEGER, success BOOLEAN,
                           path_length REAL);
        CREATE TABLE progress (runid INTEGER, time REAL, best_cost REAL);
        INSERT INTO experiments VALUES (1, 'slot');
        INSERT INTO plannerConfigs VALUES (1, 'geometric_RRTConnect', 'range = 2' || char(10) || ';');
        INSERT INTO runs VALUES (1, 1, 1, 1, 1, 12.5);
        INSERT INTO runs VALUES (2, 1, 1, 0, NULL, NULL);
        INSERT INTO progress VALUES (1, 0.4, NULL), (1, 0.5, 13), (1, 0.6, 13), (1, 0.7, 12.5);''')
    connection.commit()
    connection.close()
    for path in (tmp_path, file):
        frame = ia.read_runs(path)
        assert list(frame['planner']) == ['RRTConnect', 'RRTConnect'] and list(frame['problem']) == ['slot', 'slot']
        assert list(frame['run']) == [0, 1] and frame['success'][1] is True and frame['success'][0] is None
        assert frame['path length'][1] == 12.5 and frame['progress'][1] == [(0.5, 13.0), (0.7, 12.5)]
        assert frame['parameters'][0] == {'range': '2'}
    file.write_text('junk')
    with pytest.raises(ia.Error, match='is not a benchmark database'):
        ia.read_runs(tmp_path)


def test_the_stubs_know_what_there_is():
    folder = os.path.dirname(ia.__file__)
    with open(os.path.join(folder, '_core.pyi'), encoding='utf-8') as stream:
        stub = ' '.join(stream.read().split())
    assert os.path.exists(os.path.join(folder, 'py.typed'))
    for name, (default, _, _, _) in ia.parameters().items():
        if name == 'anytime':
            continue
        wanted = f'{name}: {type(default).__name__} = {default!r}'
        assert stub.count(wanted) == 2, f'python/improved_astar/_core.pyi: plan() and plan_batch() need "{wanted}"'
    for kind in (ia.Vehicle, ia.Slot, ia.Scenario, ia.Result, ia.ParkingPlan, ia.ParkingPlanner, ia.Verdict):
        assert kind.__doc__
        body = re.search(rf'class {kind.__name__}\b.*?(?= class | # parameters)', stub).group(0)
        if issubclass(kind, ia.Drive):
            body += re.search(r'class Drive\b.*?(?= class )', stub).group(0)
        for name in vars(kind):
            if not name.startswith('_'):
                assert f'def {name}(' in body, f'_core.pyi: {kind.__name__} lacks {name}'


def test_everything_public_has_a_docstring():
    for name in ia.__all__:
        assert getattr(ia, name).__doc__, name
