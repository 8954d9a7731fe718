"""Pictures, pages, results of comparisons, stubs."""
import json
import os
import re
import sqlite3

import pytest

import improved_astar as ia

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


def test_plot_draws_into_axes_of_the_caller():
    matplotlib = pytest.importorskip('matplotlib')
    matplotlib.use('Agg')
    from matplotlib import pyplot
    _, axes = pyplot.subplots()
    assert result().plot(axes=axes) is axes


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


def line(planner, run, length, fingerprint='1'):
    return json.dumps({'experiment': 'slot', 'planner': planner, 'fingerprint': fingerprint, 'parameters': {'a': '1'},
                       'reported': {'iterations': 3}, 'progress': [[0.1, length + 1], [0.2, length]],
                       'figures': {'run': run, 'seed': 1000 + run, 'path length': length, 'success': True}})


def test_runs_of_a_journal(tmp_path):
    pytest.importorskip('pandas')
    header = json.dumps({'parking_benchmark': 2, 'fingerprints': {'slot': {'mine': '1', 'other': '1'}}})
    (tmp_path / 'runs.jsonl').write_text('\n'.join([
        header, line('mine', 1, 10.0), line('mine', 0, 11.0), line('mine', 0, 11.0), line('other', 0, 12.0),
        line('other', 1, 99.0, 'of another configuration'), '{"cut sho']))
    for path in (tmp_path, tmp_path / 'runs.jsonl'):
        frame = ia.read_runs(path)
        assert list(frame['planner']) == ['mine', 'mine', 'other']
        assert list(frame['run']) == [0, 1, 0]
        assert frame.groupby('planner')['path length'].median().to_dict() == {'mine': 10.5, 'other': 12.0}
        assert frame['progress'][0] == [(0.1, 12.0), (0.2, 11.0)]
    (tmp_path / 'runs.jsonl').write_text(header + '\n{"experiment": 3}\n')
    with pytest.raises(ia.Error, match=r'runs\.jsonl:2: is not a line'):
        ia.read_runs(tmp_path)
    (tmp_path / 'runs.jsonl').write_text('{"parking_benchmark": 1}\n')
    with pytest.raises(ia.Error, match='another version'):
        ia.read_runs(tmp_path)


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
        CREATE TABLE runs (id INTEGER, experimentid INTEGER, plannerid INTEGER, run INTEGER, path_length REAL);
        CREATE TABLE progress (runid INTEGER, time REAL, best_cost REAL);
        INSERT INTO experiments VALUES (1, 'slot');
        INSERT INTO plannerConfigs VALUES (1, 'geometric_RRTConnect', '');
        INSERT INTO runs VALUES (1, 1, 1, 0, 12.5);
        INSERT INTO runs VALUES (2, 1, 1, 1, NULL);
        INSERT INTO progress VALUES (1, 0.5, 12.5);''')
    connection.commit()
    connection.close()
    for path in (tmp_path, file):
        frame = ia.read_runs(path)
        assert list(frame['planner']) == ['RRTConnect', 'RRTConnect'] and list(frame['problem']) == ['slot', 'slot']
        assert frame['path length'][0] == 12.5 and frame['progress'][0] == [(0.5, 12.5)]


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
