"""Files that are written completely or not at all."""
import os
import tempfile

from results import ReportError


def write_whole(file, content):
    """Raises ReportError when the file cannot be written; what was there before then stays."""
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
