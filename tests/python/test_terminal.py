"""The other end of a UART's line, as a terminal that any program opens. The program is programs/echo.cpp."""
import contextlib
import os
import pathlib
import select
import subprocess
import time

import pytest

PATIENCE = 60  # s, for a machine under load


class Board:
    """A run whose UART 0 is a terminal."""

    def __init__(self, folder, link, *options):
        command = [os.environ["MARKERVP"], "run", "--program", os.environ["MARKERVP_PROGRAM"], "--output",
                   str(folder / "out"), "--no-report", "--terminal", f"uart0={link}", *options]
        self.link = pathlib.Path(link)
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.line = None

    def open(self):
        for _ in range(PATIENCE * 100):
            if self.link.is_symlink() or self.process.poll() is not None:
                break
            time.sleep(0.01)
        self.line = os.open(self.link, os.O_RDWR | os.O_NOCTTY)

    def close(self):
        os.close(self.line)

    def type(self, text):
        os.write(self.line, text.encode())

    def read(self, count):
        text = b""
        while len(text) < count and select.select([self.line], [], [], PATIENCE)[0]:
            text += os.read(self.line, count - len(text))
        return text.decode()

    def end(self):
        out, err = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, out, err


@contextlib.contextmanager
def board_at(folder, *options):
    board = Board(folder, folder / "board", *options)
    try:
        yield board
    finally:
        board.process.kill()
        board.process.wait()


def test_what_is_typed_is_answered(tmp_path):
    with board_at(tmp_path) as board:
        board.open()
        board.type("ab")
        assert board.read(8) == "<a>\n<b>\n"  # as the bytes are: no echo, no line ends changed
        board.close()
        board.open()  # who comes back finds the line as it was
        board.type("c")
        assert board.read(4) == "<c>\n"
        board.type("q")
        code, out, err = board.end()
    assert code == 0, err
    assert f"uart0 is the terminal {os.path.sep}dev" in out and str(tmp_path / "board") in out
    assert "uart0: <a>" in out  # on the console, too
    assert not (tmp_path / "board").is_symlink()


def test_two_runs_on_one_terminal(tmp_path):
    with board_at(tmp_path) as board:
        board.open()
        second = Board(tmp_path / "second", tmp_path / "board")
        code, _, err = second.end()
        assert code == 2
        assert "if another run has it, give this one another name" in err
        board.type("a")
        assert board.read(4) == "<a>\n"  # the first one has noticed nothing


def test_the_link_goes_with_a_run_that_is_killed(tmp_path):
    with board_at(tmp_path) as board:
        board.open()
        board.close()
        board.process.kill()
        board.process.wait()
        for _ in range(PATIENCE * 100):
            if not board.link.is_symlink():
                break
            time.sleep(0.01)
        assert not board.link.is_symlink()


def test_a_link_that_leads_nowhere_is_taken(tmp_path):
    (tmp_path / "board").symlink_to("/dev/pts/none")
    with board_at(tmp_path) as board:
        deadline = time.monotonic() + PATIENCE
        while not os.path.exists(tmp_path / "board") and time.monotonic() < deadline:
            time.sleep(0.01)
        board.open()
        board.type("q")
        assert board.end()[0] == 0


@pytest.mark.parametrize("terminal, message", [
    ("uart2", "give uart0 or uart1"),
    ("uart1=", "give uart0 or uart1"),
    ("uart0=/nowhere/board", "No such file or directory"),
])
def test_a_terminal_that_cannot_be(tmp_path, terminal, message):
    run = subprocess.run([os.environ["MARKERVP"], "run", "--program", os.environ["MARKERVP_PROGRAM"], "--output",
                          str(tmp_path / "out"), "--terminal", terminal], capture_output=True, text=True,
                         timeout=PATIENCE)
    assert run.returncode == 2
    assert "--terminal" in run.stderr and message in run.stderr


def test_such_a_run_cannot_be_made_again(tmp_path):
    with board_at(tmp_path) as board:
        board.open()
        board.type("q")
        assert board.end()[0] == 0
    again = subprocess.run([os.environ["MARKERVP"], "history", str(tmp_path / "out"), "--register", "uart0.SR"],
                           capture_output=True, text=True, timeout=PATIENCE)
    assert again.returncode == 2
    assert "this run had a terminal" in again.stderr
