"""Whatever is wrong is said in one line that names the field."""
import numpy
import pytest

import improved_astar as ia

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]
START, GOAL = (-8.0, 3.0, 0.0), (8.0, 3.0, 0.0)


def world(polygons=(SQUARE,), start=START, goal=GOAL, **more):
    return ia.Scenario.from_polygons(polygons, start, goal, **more)


def grid(cells, resolution=0.5, **more):
    return ia.Scenario.from_grid(cells, (2, 2, 0), (3, 2, 0), resolution=resolution, **more)


NAN, INF = float('nan'), float('inf')
CELLS = numpy.zeros((40, 40), dtype=numpy.uint8)

WRONG = [
    (lambda: world(start=(0, 0)), 'start must be three numbers (x, y, yaw)'),
    (lambda: world(start='here'), "start must be three numbers (x, y, yaw), not 'here'"),
    (lambda: world(start=(NAN, 0, 0)), 'start: x is nan'),
    (lambda: world(goal=(0, INF, 0)), 'goal: y is inf'),
    (lambda: world(goal=None), 'neither goal nor slot'),
    (lambda: world(goal=[[1, 2], [3, 4]]), 'goal must be an array of n rows (x, y, yaw)'),
    (lambda: world(goal=(5e5, 0, 0)), 'lies 500008 m from the start'),
    (lambda: world(start=(5e12, 0, 0), goal=(5e12, 9, 0)), 'scenario: the start lies at 5000000000000, 0; coordinates of at most '
     '10000000000 m'),
    (lambda: ia.Slot('parallel', (4e9, -5e12, 0), 6, 2.5), 'slot: pose y is -5000000000000; it must be at most 10000000000 m'),
    (lambda: world(slot=3, goal=None), 'slot must be a Slot'),
    (lambda: world(slot=ia.Slot('parallel', (0, 5, 0), 6, 2.5)), 'both goal and slot'),
    (lambda: world(slot=ia.Slot('parallel', (0, 5, 0), 4, 2.5), goal=None), 'slot: length is 4 m'),
    (lambda: world([SQUARE, numpy.zeros((0, 2))]), 'polygon 2 has no corners'),
    (lambda: world([[[0, 0], [1, 1], [1, 0], [0, 1]]]), 'polygon 1 crosses itself'),
    (lambda: world([[[0, 0], [1, NAN], [1, 1]]]), 'polygon 1: corner 2'),
    (lambda: world([[0, 0, 1]]), 'polygons[0] must be an array of n rows (x, y); its shape is (3,)'),
    (lambda: world([['a', 'b']]), 'polygons[0] must be an array of n rows (x, y)'),
    (lambda: world(3), 'polygons must be a list'),
    (lambda: world(vehicle='vw_golf9'), "unknown vehicle 'vw_golf9'; did you mean 'vw_golf8'"),
    (lambda: world(vehicle=7), 'vehicle must be the path of a file, not int'),
    (lambda: grid(CELLS[0]), 'grid must be a 2-D array'),
    (lambda: grid(CELLS + 0.5), 'its dtype is float64'),
    (lambda: grid(CELLS + 7), 'cell [0, 0] is 7'),
    (lambda: grid(numpy.zeros((0, 0), dtype=bool)), 'map of 0 x 0 cells'),
    (lambda: grid(CELLS, resolution=0), 'resolution'),
    (lambda: grid(CELLS, resolution='a'), "resolution must be a number, not 'a'"),
    (lambda: grid(CELLS, origin=(NAN, 0, 0)), 'origin'),
    (lambda: ia.Scenario.from_grid(CELLS, (2, 2, 0), (3, 2, 0)), 'resolution must be given'),
    (lambda: ia.Scenario.from_grid(CELLS, (-9, 2, 0), (3, 2, 0), resolution=0.5), 'start outside the map'),
    (lambda: ia.Scenario.read('no/such.yaml'), 'no/such.yaml'),
    (lambda: ia.Scenario.read(__file__), 'bad_input_test.py'),
    (lambda: ia.Scenario.read(7), 'path must be the path of a file, not int'),
    (lambda: ia.Vehicle(wheelbase=-1), 'wheelbase'),
    (lambda: ia.Vehicle(wheelbas=2), "did you mean 'wheelbase'"),
    (lambda: ia.Vehicle(outline=[[0, 0], [1, 0]]), 'outline has 2 corners; it must have 3 to 128'),
    (lambda: ia.Vehicle(outline=[[0, 0], [2, 0], [0, 1], [2, 1]]), 'outline crosses itself'),
    (lambda: ia.Vehicle(outline=[[0, 0], [2, 0], [NAN, 1]]), 'outline'),
    (lambda: ia.Vehicle(outline=3), 'vehicle: outline must be an array of n rows (x, y)'),
    (lambda: ia.Vehicle(outline=[[0, 0], [2, 0], [0, 1]], width=7), 'width is 7'),
    (lambda: ia.Vehicle(width='broad'), "vehicle: width must be a number, not 'broad'"),
    (lambda: ia.Slot('diagonal', (0, 0, 0), 5, 2), "'diagonal'"),
    (lambda: ia.Slot('parallel', (0, 0), 5, 2), 'slot: pose must be three numbers'),
    (lambda: ia.plan(3), 'scenario must be a Scenario, not 3'),
    (lambda: ia.plan(world(), time_limit=0), 'time_limit must be a positive number of seconds, not 0'),
    (lambda: ia.plan(world(), time_limit=NAN), 'time_limit must be a positive number of seconds, not nan'),
    (lambda: ia.plan(world(), time_limit='1'), "time_limit must be a number, not '1'"),
    (lambda: ia.plan(world(), anytime=1), 'anytime must be True or False, not 1'),
    (lambda: ia.plan(world(), anytime=True, time_limit=INF), 'anytime requires a finite time_limit'),
    (lambda: ia.plan(world(), max_expansions=-1), 'max_expansions must be a whole number'),
    (lambda: ia.plan(world(), gear_change_penalt=1), "did you mean 'gear_change_penalty'"),
    (lambda: ia.plan(world(), look_ahead=True), 'look_ahead was removed: it is always on with detours'),
    (lambda: ia.plan(world(), gear_change_penalty=-1), 'gear_change_penalty must be between 0 and 100'),
    (lambda: ia.plan(world(), gear_change_penalty=NAN), 'gear_change_penalty must be between 0 and 100'),
    (lambda: ia.plan(world(), heading_bins=72.5), 'heading_bins must be between 8 and 1440'),
    (lambda: ia.plan(world(), motion_model='bike'), "'bike'"),
    (lambda: ia.plan(world(), bidirectional='yes'), "bidirectional must be True or False, not 'yes'"),
    (lambda: ia.plan(world(), parameter_set='best'), "'best'"),
    (lambda: ia.plan(world(), turning_radius=7), 'turning_radius has no effect'),
    (lambda: ia.plan_batch([world()], turning_radius=7), 'by wheelbase and max_steering_angle'),
    (lambda: ia.plan_batch(world()), 'scenarios must be a list of Scenario'),
    (lambda: ia.plan_batch([world(), 2]), 'scenarios[1] must be a Scenario, not 2'),
    (lambda: ia.plan_batch([world()], threads=-1), 'threads must be a whole number'),
    (lambda: ia.ParkingPlanner(gapss=[0.1]), "did you mean 'gaps'"),
    (lambda: ia.ParkingPlanner(clearance_weight=1), 'use preferred_clearance and clearance_cost'),
    (lambda: ia.ParkingPlanner(way_in='sideways'), "'sideways'"),
    (lambda: ia.ParkingPlanner(time_limit=-1), 'time'),
    (lambda: ia.ParkingPlanner(gaps=3), 'gaps must be a list of metres, not 3'),
    (lambda: ia.ParkingPlanner().plan(None), 'scenario must be a Scenario, not None'),
    (lambda: ia.check(world(), 'path'), "path must be a result, or an array of n rows (x, y, yaw, ...), not 'path'"),
    (lambda: ia.check(world(), [[1, 2]]), 'its shape is (1, 2)'),
    (lambda: ia.check(world(), [[0, 0, 0], [0, 1, 0]]), 'no arc joins rows 0 and 1'),
    (lambda: ia.check(world(), [[0, 0, 0], [NAN, 1, 0]]), 'row 1 is not finite'),
    (lambda: ia.check(3, [[0, 0, 0]]), 'scenario must be a Scenario, not 3'),
    (lambda: world(name=3), "name must be a str, not 3"),
    (lambda: ia.Scenario.read('no\nsuch.yaml'), 'no?such.yaml'),
    (lambda: world().is_free([[0, 0, 0], [0, NAN, 0]]), 'poses: row 1 is not finite'),
    (lambda: world().clearance_at([[INF, 0, 0]]), 'poses: row 0 is not finite'),
    (lambda: ia.plan(world()).animate(height='tall'), "height must be a number of pixels, not 'tall'"),
    (lambda: ia.read_runs(None), 'path must be the path of a file or folder, not None'),
    (lambda: world().is_free([1, 2, 3]), 'poses must be an array of n rows (x, y, yaw)'),
    (lambda: ia.read_runs('no/such/folder'), 'no/such/folder: there is no such file or folder'),
    (lambda: ia.read_runs(__file__), 'bad_input_test.py'),
]


@pytest.mark.parametrize('number', range(len(WRONG)))
def test_says_what_is_wrong(number):
    call, expected = WRONG[number]
    with pytest.raises(ia.Error) as caught:
        call()
    text = str(caught.value)
    assert expected in text
    assert '\n' not in text
    assert isinstance(caught.value, ValueError)


def test_bad_pictures_are_refused():
    pytest.importorskip('matplotlib')
    result = ia.plan(world())
    for values, expected in (({'footprints': 'all'}, 'footprints must be a number'), ({'axes': 3}, "axes must be matplotlib's")):
        with pytest.raises(ia.Error, match=expected):
            result.plot(**values)


def test_the_parameters_of_a_plan_can_be_given_to_another():
    result = ia.plan(world(), heading_bins=36)
    assert ia.plan(world(), **result.parameters).parameters == result.parameters


def test_numbers_of_numpy_are_numbers():
    result = ia.plan(world(), heading_bins=numpy.int64(36), detours=numpy.bool_(False), gear_change_penalty=numpy.float32(1))
    assert result and not result.parameters['detours'] and result.parameters['heading_bins'] == 36
    counted = [ia.plan(world(), max_expansions=count).statistics for count in (100, numpy.int64(100), numpy.uint8(100))]
    assert counted[0]['expanded'] == counted[1]['expanded'] == counted[2]['expanded']
    for wrong in (True, numpy.bool_(True), 100.0, numpy.float64(100), '100', numpy.array([100]), None):
        with pytest.raises(ia.Error, match='max_expansions must be a whole number, not'):
            ia.plan(world(), max_expansions=wrong)


def test_what_cannot_be_is_a_result_and_no_error():
    blocked = world([[[-12, -2], [12, -2], [12, 8], [-12, 8]]])
    result = ia.plan(blocked)
    assert not result and result.status == 'invalid_start' and result.reason
    assert result.path.shape == (0, 5) and result.pieces.shape == (0, 4)
    assert result.length is None and result.cusps is None and result.clearance is None and result.goal is None
    assert not ia.check(blocked, result)
    with pytest.raises(ia.Error, match='no path'):
        result.trajectory  # pylint: disable=pointless-statement
    walled = world([[[4, -1], [12, -1], [12, 0], [4, 0]], [[4, 6], [12, 6], [12, 7], [4, 7]],
                    [[11, 0], [12, 0], [12, 6], [11, 6]], [[4, 0], [5, 0], [5, 6], [4, 6]]])
    result = ia.plan(walled)
    assert result.status == 'approximate' and result.reason and result.path.shape[0] > 0
    assert ia.check(walled, result, exact=False)
