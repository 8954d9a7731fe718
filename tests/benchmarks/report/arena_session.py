"""Opens a database in the real Planner Arena (package plannerarena, which must be installed here) and makes each of its plots.

usage: arena_session.py DATABASE

Talks to the app like a browser: over its websocket, with the inputs that the widgets on the page offer. Prints an object in JSON:
`made`, the number of pictures, `options`, the values offered by each widget, and `faults`, a text for each plot or table that is
missing."""
import asyncio
import html
import json
import os
import re
import socket
import sys
import threading

LONGEST, BEGIN, QUIET = 60.0, 2.0, 0.2  # seconds until the end of an answer, its begin if there is one, and after its last part
OUTPUTS = {'performance': ['problem_ui', 'problem_parameter_ui', 'attribute_ui', 'version_ui', 'planner_ui', 'plot', 'missing_data_table'],
           'progress': ['problem_ui', 'problem_parameter_ui', 'attribute_ui', 'version_ui', 'planner_ui', 'plot', 'plot_num_measurements'],
           'regression': ['problem_ui', 'problem_parameter_ui', 'attribute_ui', 'versions_ui', 'planner_ui', 'plot'],
           'database_info': ['benchmark_info', 'planner_configs']}
SWITCHES = {'performance': ['show_as_cdf', 'show_simplified', 'hide_outliers', 'y_log_scale'], 'progress': ['show_measurements']}


def attribute(tag, name):
    found = re.search(rf'\b{name}="([^"]*)"', tag)
    return html.unescape(found.group(1)) if found else None


def widgets_of(page):
    """Choices and selected values of the widgets on a page, by the name of their input."""
    choices, chosen = {}, {}
    for select, inner in re.findall(r'(<select[^>]*>)(.*?)</select>', page, re.DOTALL):
        options = re.findall(r'<option[^>]*>', inner)
        name = attribute(select, 'id')
        choices[name] = [attribute(option, 'value') for option in options]
        chosen[name] = next((attribute(option, 'value') for option in options if ' selected' in option), choices[name][0])
    for box in re.findall(r'<input[^>]*type="checkbox"[^>]*>', page):
        name = attribute(box, 'name')
        choices.setdefault(name, []).append(attribute(box, 'value'))
        chosen.setdefault(name, [])
        if ' checked' in box:
            chosen[name].append(attribute(box, 'value'))
    return choices, chosen


class Session:
    def __init__(self, connection):
        self.connection = connection
        self.values, self.errors, self.notices, self.options = {}, {}, [], {}

    async def send(self, method, inputs):
        await self.connection.send(json.dumps({'method': method, 'data': inputs}))
        is_idle, wait = True, BEGIN
        while True:
            try:
                message = json.loads(await asyncio.wait_for(self.connection.recv(), wait))
            except asyncio.TimeoutError:
                if not is_idle:
                    raise
                return
            is_idle = message.get('busy', 'idle' if is_idle else 'busy') == 'idle'
            wait = QUIET if is_idle else LONGEST
            for name, value in (message.get('values') or {}).items():
                self.values[name] = value
                self.errors.pop(name, None)
            for name, error in (message.get('errors') or {}).items():
                self.errors[name] = error
                self.values.pop(name, None)
            if 'notification' in message:
                self.notices.append(json.dumps(message['notification']))

    async def open(self, tab):
        """Shows a tab and sends what its widgets select, as often as that changes them."""
        shown = {f'.clientdata_output_{tab}-{output}_hidden': False for output in OUTPUTS[tab]}
        shown.update({f'{tab}-{switch}': False for switch in SWITCHES.get(tab, [])})
        await self.send('update', {**shown, 'navbar': tab, f'{tab}-opacity': 50})
        known = None
        while True:
            page = ''.join(value['html'] for name, value in self.values.items()
                           if name.startswith(tab + '-') and name.endswith('_ui') and value)
            choices, chosen = widgets_of(page)
            if chosen == known:
                break
            await self.send('update', chosen)
            known = chosen
        self.options.update(choices)

    def fault_of(self, output):
        """What is wrong with a plot; None if its picture is there."""
        value = self.values.get(output)
        if output in self.errors:
            return str(self.errors[output].get('message'))
        return None if value and str(value.get('src')).startswith('data:image/png') else 'no picture'


async def look(url):
    import websockets
    made, faults = 0, []
    async with websockets.connect(url, max_size=None) as connection:
        session = Session(connection)
        start = {'.clientdata_pixelratio': 1, 'database': None, 'navbar': 'performance'}
        for tab, outputs in OUTPUTS.items():
            for output in outputs:
                start.update({f'.clientdata_output_{tab}-{output}_hidden': True, f'.clientdata_output_{tab}-{output}_width': 500,
                              f'.clientdata_output_{tab}-{output}_height': 300})
        await session.send('init', start)

        def check(what, *outputs):
            nonlocal made
            for output in outputs:
                fault = session.fault_of(output)
                made += not fault
                if fault:
                    faults.append(f'{what}: {output}: {fault}')

        await session.open('performance')
        attributes = session.options['performance-attribute']
        for each in attributes:
            await session.send('update', {'performance-attribute': each})
            check(each, 'performance-plot')
            if not session.values.get('performance-missing_data_table'):
                faults.append(f'{each}: no table of missing data')
        for is_simplified in (False, True):
            for is_cdf in (True, False):
                await session.send('update', {'performance-show_simplified': is_simplified, 'performance-show_as_cdf': is_cdf,
                                              'performance-attribute': 'path length'})
                check(f'path length, simplified: {is_simplified}, distribution: {is_cdf}', 'performance-plot')
        await session.send('update', {'performance-hide_outliers': True, 'performance-y_log_scale': True})
        check('path length, logarithmic', 'performance-plot')
        await session.open('progress')
        for each in session.options['progress-attribute']:
            for is_shown in (False, True):
                await session.send('update', {'progress-attribute': each, 'progress-show_measurements': is_shown})
                check(f'{each} over time', 'progress-plot', 'progress-plot_num_measurements')
        await session.open('regression')
        await session.open('database_info')
        for each in OUTPUTS['database_info']:
            if not session.values.get('database_info-' + each):
                faults.append(f'no table {each}: {session.errors.get("database_info-" + each)}')
        return {'made': made, 'faults': faults, 'options': session.options, 'notices': session.notices,
                'regression': str(session.errors.get('regression-plot') or 'ok')}


async def main():
    import uvicorn
    from plannerarena.app import app
    listener = socket.socket()
    listener.bind(('127.0.0.1', 0))
    server = uvicorn.Server(uvicorn.Config(app, log_level='critical'))
    threading.Thread(target=lambda: server.run(sockets=[listener]), daemon=True).start()
    while not server.started:
        await asyncio.sleep(0.1)
    print(json.dumps(await look(f'ws://127.0.0.1:{listener.getsockname()[1]}/websocket/')))


if __name__ == '__main__':
    os.environ['DATABASE'] = os.path.abspath(sys.argv[1])
    asyncio.run(main())
