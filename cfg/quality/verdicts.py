"""Sources in which clang-tidy found nothing, kept in the user's cache folder by a digest of all that its verdict depends on."""
import hashlib
import os
import pathlib

import includes

MOST = 5000  # verdicts; the oldest go
FOLDER = pathlib.Path(os.environ.get('XDG_CACHE_HOME') or pathlib.Path.home() / '.cache') / '3dlasso/lint'


class Verdicts:
    """`tools` are versions, those of libraries among them: a header from outside of the repository is known by its package."""

    def __init__(self, top, tools):
        self.top, self.tools = top, repr(sorted(tools.items()))

    def key(self, name, command):
        """By tools, rules, command line and text: in another folder the same."""
        rules = [place for folder in pathlib.PurePath(name).parents if (self.top / (place := (folder / '.clang-tidy').as_posix())).is_file()]
        digest = hashlib.sha256(f'{self.tools}\n{command.replace(str(self.top), ".")}\n'.encode())
        for file in (*rules, *sorted(includes.closure(self.top, name))):
            text = (self.top / file).read_bytes()
            digest.update(f'{file} {len(text)}\n'.encode() + text)
        return digest.hexdigest()

    def known(self, key):
        path = FOLDER / key
        try:
            os.utime(path)
        except OSError:
            return path.is_file()
        return True

    def keep(self, key):
        """Two runs may do so at a time: a verdict is an empty file."""
        try:
            FOLDER.mkdir(parents=True, exist_ok=True)
            (FOLDER / key).touch()
        except OSError:
            pass  # without it the next run reads the file again


def prune():
    """Leaves the newest."""
    try:
        for path in sorted(FOLDER.glob('*'), key=lambda path: path.stat().st_mtime, reverse=True)[MOST:]:
            path.unlink()
    except OSError:
        pass  # another run is at it
