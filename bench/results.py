"""Finished runs on disk, one file a run, so that a benchmark goes on where it was stopped."""

import hashlib
import json
import os

from programs import Failure, USAGE


class Results:
    """Finished runs by file. Those of another `identity` (mesh, program...) do not count."""

    def __init__(self, folder, identity):
        self.folder, self.identity = folder, identity

    def path(self, run):
        return self.folder / f"{str(run).replace(' ', '-')}.json"

    def read(self, run):
        try:
            result = json.loads(self.path(run).read_text())
        except FileNotFoundError:
            return None
        except ValueError as error:
            raise Failure(USAGE, f"{self.path(run)} is damaged ({error}): remove it, its row is then done again") from error
        return result if all(result.get(key) == value for key, value in self.identity.items()) else None

    def write(self, run, result):
        write_whole(self.path(run), json.dumps({**self.identity, **result}, indent=1) + "\n")


def identity_of_mesh(path):
    return {"name": path.name, "sha256": file_hash(path)}


def make_folder(path):
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Failure(USAGE, f"cannot make the folder {path} ({error.strerror}): choose another --out") from error


def write_whole(path, text):
    """So that a kill leaves the old file or the new one, never a part."""
    part = path.with_name(path.name + ".part")
    part.write_text(text)
    os.replace(part, path)


def file_hash(path):
    digest = hashlib.sha256()
    with path.open("rb") as content:
        for block in iter(lambda: content.read(1 << 20), b""):
            digest.update(block)
    return digest.hexdigest()
