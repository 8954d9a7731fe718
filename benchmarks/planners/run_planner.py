"""Runs a planner written in Python for parking_plan and parking_benchmark, which start this program in a process of its own.

usage: run_planner.py FILE.py

The two exchange objects in JSON, one a line, through the socket that is file descriptor 3. Printed text goes to standard
error. This program begins with {"ready": {"name", "summary", "improves", "parameters"}}, receives {"problem": {...}}, and
answers {"path": poses or null} for each path and {"done": true} at its end. In between it may send questions such as
{"is_free": poses}, each of which is answered by {"answer": [...]}. {"error": text} may come at any time and is the end."""
import importlib.util
import inspect
import json
import random
import socket
import sys
import traceback
from pathlib import Path

FARTHEST = 1e6  # metres; OMPL's curves fail far beyond


class Problem:
    """What a planner is given. Poses are (x, y, yaw) of the rear axle's midpoint in metres and radians."""

    def __init__(self, channel, members):
        self._channel = channel
        self.__dict__.update(members)

    def is_free(self, poses):
        """Whether the car is free at each of these poses."""
        return self._ask('is_free', poses_of(poses))

    def is_motion_free(self, motions):
        """Whether the space's curve between the two poses of each motion is free."""
        return self._ask('is_motion_free', [poses_of(motion) for motion in motions])

    def distance(self, motions):
        """Length of the space's curve between the two poses of each motion, in metres, whether free or not."""
        return self._ask('distance', [poses_of(motion) for motion in motions])

    def _ask(self, question, subject):
        self._channel.send(**{question: subject})
        return self._channel.receive()['answer']


class Channel:
    def __init__(self, descriptor):
        self.stream = socket.socket(fileno=descriptor).makefile('rw', encoding='utf-8', newline='\n')

    def send(self, **message):
        self.stream.write(json.dumps(message, allow_nan=False) + '\n')
        self.stream.flush()

    def receive(self):
        line = self.stream.readline()
        if not line:
            sys.exit(0)  # the other program has ended
        return json.loads(line)


def poses_of(poses):
    """Poses of any sequence or array as lists of three numbers. Raises ValueError for others."""
    found = []
    for k, pose in enumerate(poses):
        try:
            x, y, yaw = map(float, pose)
        except (TypeError, ValueError):
            raise ValueError(f'pose {k} is not x, y, yaw: {pose!r}') from None
        if not abs(x) + abs(y) + abs(yaw) <= FARTHEST:
            raise ValueError(f'pose {k} is out of range: {pose!r}')
        found.append([x, y, yaw])
    return found


def load(file):
    sys.path.insert(0, str(Path(file).resolve().parent))
    spec = importlib.util.spec_from_file_location(Path(file).stem, file)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    if not callable(getattr(module, 'plan', None)):
        raise ValueError('it defines no function plan(problem)')
    parameters = getattr(module, 'PARAMETERS', {})
    for name, value in parameters.items():
        if not isinstance(name, str) or not isinstance(value, (bool, int, float, str)):
            raise ValueError(f'PARAMETERS: {name!r} must be a bool, an int, a float or a str, not {value!r}')
    return module, {'name': getattr(module, 'NAME', Path(file).stem), 'parameters': parameters,
                    'improves': inspect.isgeneratorfunction(module.plan),
                    'summary': (inspect.getdoc(module) or 'a planner in Python').splitlines()[0]}


def solve(channel, plan, members):
    random.seed(members['seed'])
    if 'numpy' in sys.modules:
        sys.modules['numpy'].random.seed(members['seed'])
    answer = plan(Problem(channel, members))
    for path in answer if inspect.isgenerator(answer) else [answer]:
        channel.send(path=None if path is None else poses_of(path))
    channel.send(done=True)


def text_of(error, file):
    """The last line of the exception's text, and the line of the planner's file that it comes from."""
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if Path(frame.filename) == Path(file)]
    line = lines[-1] if lines else error.lineno if isinstance(error, SyntaxError) else None
    return traceback.format_exception_only(type(error), error)[-1].strip() + \
        (f' (line {line} of {Path(file).name})' if line else '')


def main(file):
    channel = Channel(3)
    try:
        module, description = load(file)
        channel.send(ready=description)
        solve(channel, module.plan, channel.receive()['problem'])
    except Exception as error:  # of the planner, whatever it is
        channel.send(error=text_of(error, file))


if __name__ == '__main__':
    main(sys.argv[1])
