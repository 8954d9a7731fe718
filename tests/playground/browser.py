"""Headless Chromium, driven through the pipe of its debugging protocol: nothing but Python is needed."""
import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

PROGRAM = next((found for found in map(shutil.which, ('chromium', 'chromium-browser', 'google-chrome')) if found), None)


class Browser:
    """One page. What it says on its console, errors above all, is kept in `console`."""

    def __init__(self, width=1400, height=900, dark=False, still=False):
        self.profile = tempfile.mkdtemp()
        to_read, to_write = os.pipe(), os.pipe()

        def wire():
            # The protocol wants these two numbers. The originals may have them already, in the wrong order.
            first, second = os.dup2(to_read[0], 50), os.dup2(to_write[1], 51)
            os.dup2(first, 3)
            os.dup2(second, 4)
        self.process = subprocess.Popen(
            [PROGRAM, '--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
             '--remote-debugging-pipe', f'--user-data-dir={self.profile}', f'--window-size={width},{height}',
             '--force-color-profile=srgb', '--hide-scrollbars'],
            preexec_fn=wire, close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(to_read[0])
        os.close(to_write[1])
        self.sink, self.source = to_read[1], to_write[0]
        self.buffer, self.count, self.console, self.session = b'', 0, [], None
        target = next(each for each in self.call('Target.getTargets')['targetInfos'] if each['type'] == 'page')
        self.session = self.call('Target.attachToTarget', targetId=target['targetId'], flatten=True)['sessionId']
        self.call('Page.enable')
        self.call('Runtime.enable')
        self.call('Log.enable')
        self.resize(width, height)
        self.features = [{'name': 'prefers-color-scheme', 'value': 'dark' if dark else 'light'},
                         {'name': 'prefers-reduced-motion', 'value': 'reduce' if still else 'no-preference'}]
        self.medium('')

    def close(self):
        """Ends the browser."""
        self.process.kill()
        self.process.wait()
        shutil.rmtree(self.profile, ignore_errors=True)

    def _receive(self, seconds):
        end = time.monotonic() + seconds
        while b'\0' not in self.buffer:
            if not select.select([self.source], [], [], max(0.0, end - time.monotonic()))[0]:
                return None
            data = os.read(self.source, 1 << 20)
            if not data:
                raise RuntimeError('the browser has ended')
            self.buffer += data
        line, _, self.buffer = self.buffer.partition(b'\0')
        message = json.loads(line)
        method, values = message.get('method'), message.get('params', {})
        if method == 'Runtime.exceptionThrown':
            details = values['exceptionDetails']
            self.console.append(details.get('exception', {}).get('description', details['text']))
        elif method == 'Log.entryAdded' and values['entry']['level'] in ('error', 'warning'):
            self.console.append(values['entry']['text'])
        elif method == 'Runtime.consoleAPICalled' and values['type'] in ('error', 'warning'):
            self.console.append(' '.join(str(each.get('value')) for each in values['args']))
        return message

    def worker_time(self):
        """Seconds of processor time that the page's first worker has had, or None where the system does not tell."""
        found, processes = [], {}
        for name in filter(str.isdigit, os.listdir('/proc')):
            try:
                with open(f'/proc/{name}/stat', encoding='utf-8', errors='replace') as stream:
                    processes[int(name)] = int(stream.read().rpartition(')')[2].split()[1])  # its parent
            except (OSError, IndexError, ValueError):
                pass  # ended meanwhile
        for process in processes:
            above = process
            while above in processes and above != self.process.pid:
                above = processes[above]
            if above != self.process.pid:
                continue
            try:
                for task in os.listdir(f'/proc/{process}/task'):
                    with open(f'/proc/{process}/task/{task}/comm', encoding='utf-8') as stream:
                        if stream.read().startswith('DedicatedWorker'):
                            with open(f'/proc/{process}/task/{task}/schedstat', encoding='utf-8') as times:
                                found.append((int(task), 1e-9 * int(times.read().split()[0])))
            except (OSError, IndexError, ValueError):
                pass
        return min(found)[1] if found else None

    def call(self, method, **values):
        """A command of the protocol and its result."""
        self.count += 1
        message = {'id': self.count, 'method': method, 'params': values}
        if self.session:
            message['sessionId'] = self.session
        data = json.dumps(message).encode() + b'\0'
        while data:
            data = data[os.write(self.sink, data):]
        end = time.monotonic() + 120
        while time.monotonic() < end:
            answer = self._receive(120)
            if answer and answer.get('id') == self.count:
                if 'error' in answer:
                    raise RuntimeError(f'{method}: {answer["error"]["message"]}')
                return answer['result']
        raise RuntimeError(f'{method}: the browser does not answer')

    def resize(self, width, height, mobile=False):
        """The size of the window; mobile: as of a phone that is touched."""
        self.call('Emulation.setTouchEmulationEnabled', enabled=mobile)
        self.call('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=1, mobile=mobile)

    def medium(self, name):
        """What the page is shown on: 'print', or '' for a screen."""
        self.call('Emulation.setEmulatedMedia', media=name, features=self.features)

    def force(self, selector, states):
        """Has all elements that a selector finds in states such as 'hover' and 'active' until told otherwise."""
        self.call('DOM.enable')
        self.call('CSS.enable')
        root = self.call('DOM.getDocument')['root']['nodeId']
        for node in self.call('DOM.querySelectorAll', nodeId=root, selector=selector)['nodeIds']:
            self.call('CSS.forcePseudoState', nodeId=node, forcedPseudoClasses=states)

    def touch(self, kind, *points):
        """A finger: touchStart and touchMove with a point, touchEnd without."""
        self.call('Input.dispatchTouchEvent', type=kind, touchPoints=[{'x': x, 'y': y} for x, y in points])

    def open(self, file, fragment=''):
        """Loads a file."""
        self.call('Page.navigate', url='file://' + os.path.abspath(file) + fragment)
        self.until('document.readyState === "complete" && document.body')

    def value(self, expression):
        """What a JavaScript expression is worth; promises are waited for."""
        found = self.call('Runtime.evaluate', expression=expression, returnByValue=True, awaitPromise=True)
        if 'exceptionDetails' in found:
            raise RuntimeError(found['exceptionDetails'].get('exception', {}).get('description', expression))
        return found['result'].get('value')

    def until(self, expression, seconds=90):
        """Waits until an expression is true."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.value(f'Boolean({expression})'):
                return
            time.sleep(0.05)
        raise AssertionError(f'not within {seconds} s: {expression}; console: {self.console}')

    def mouse(self, kind, x, y, **more):
        """A real event of the mouse: mousePressed, mouseMoved, mouseReleased."""
        self.call('Input.dispatchMouseEvent', type=kind, x=x, y=y, button='left' if kind != 'mouseMoved' else 'none',
                  buttons=more.pop('buttons', 1), clickCount=1, **more)

    def drag(self, begin, end, steps=8):
        """Presses, moves, lets go."""
        self.mouse('mousePressed', *begin)
        for k in range(1, steps + 1):
            self.mouse('mouseMoved', begin[0] + (end[0] - begin[0]) * k / steps,
                       begin[1] + (end[1] - begin[1]) * k / steps)
        self.mouse('mouseReleased', *end)

    def key(self, key, modifiers=0):
        """A key: 'ArrowLeft', 'q'."""
        text = {'text': key} if len(key) == 1 and not modifiers & 2 else {}
        self.call('Input.dispatchKeyEvent', type='keyDown', key=key, modifiers=modifiers, **text)
        self.call('Input.dispatchKeyEvent', type='keyUp', key=key, modifiers=modifiers)

    def picture(self, file=None):
        """A screenshot as PNG."""
        data = base64.b64decode(self.call('Page.captureScreenshot', format='png')['data'])
        if file:
            with open(file, 'wb') as stream:
                stream.write(data)
        return data
