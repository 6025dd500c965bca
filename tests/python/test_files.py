"""Files are written together or not at all."""

import os
from pathlib import Path

import pytest

from workflow.render.files import format_os_error, write_atomically


def test_a_failure_leaves_the_previous_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = tmp_path / "one", tmp_path / "other"
    write_atomically({first: b"1", second: b"2"})
    write = Path.write_bytes

    def full(path: Path, content: bytes) -> int:
        if path.name.startswith("other"):
            raise OSError(28, "No space left on device", str(path))
        return write(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OSError, match="No space left") as error:
        write_atomically({first: b"3", second: b"4"})
    assert format_os_error(error.value) == f"{second}.{os.getpid()}.tmp: No space left on device"
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {"one": b"1", "other": b"2"}
