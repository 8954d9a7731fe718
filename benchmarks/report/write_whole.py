"""Files that are written completely or not at all."""
import os
import tempfile

from results import ReportError


def require_no_input(outputs, inputs):
    """Raises ReportError when one of the outputs is one of the inputs, which would be lost."""
    for output in outputs:
        for file in inputs:
            if os.path.exists(output) and os.path.exists(file) and os.path.samefile(output, file):
                raise ReportError(f'{output}: is the input {file}, which would be lost; name another file to write')


def write_whole(file, content):
    """Raises ReportError when the file cannot be written; what was there before then stays."""
    if os.path.exists(file) and not os.path.isfile(file):
        kind = 'a folder' if os.path.isdir(file) else 'a pipe or a device, which a file would take the place of'
        raise ReportError(f'{file}: cannot be written: is {kind}')
    temporary = None
    try:
        with tempfile.NamedTemporaryFile('w', encoding='utf-8', dir=os.path.dirname(os.path.abspath(file)),
                                         prefix='.report-', delete=False) as stream:
            temporary = stream.name
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(temporary, 0o666 & ~mask)
        os.replace(temporary, file)
    except OSError as error:
        if temporary is not None and os.path.exists(temporary):
            os.remove(temporary)
        raise ReportError(f'{file}: cannot be written: {error.strerror}') from error
