"""Runs that a test leads: what comes in from outside, what goes wrong, and that it is the same every time."""
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import time

import markervp
import pytest


def test_keys_and_interrupts_come_in(board):
    board.wait_for_text("ready", timeout="1 ms")
    board.uart("ab")
    # Two characters at 115 200 baud, and four of the answer.
    assert board.wait_for_text("uart0: <b>", timeout="2 ms") > 500e-6
    board.interrupt(63)
    board.wait_for_text("pressed", timeout="10 us")
    board.interrupt(63, level=False)
    board.interrupt(63)
    board.run("20 us")
    board.uart("q")
    board.finish()
    assert board.console == ["ready", "uart0: <a>", "uart0: <b>", "pressed", "pressed"]


def test_standard_input_is_on_from_the_start(start):
    board = start(pathlib.Path(os.environ["MARKERVP_PROGRAM"]).with_name("inbyte.so"))
    board.run("10 us")
    board.uart("k!", device="uart1")
    # The program reads after 1 ms: by then the 20 bits have come, at 115 200 baud.
    assert board.finish()["program_end.exit_code"] == 0
    assert 1e-3 < board.time < 1.01e-3


def test_where_nothing_is_typed_the_message_says_how(start):
    board = start(pathlib.Path(os.environ["MARKERVP_PROGRAM"]).with_name("typed.so"), set={"ps.cpu.timeout": "5 ms"})
    with pytest.raises(markervp.Error, match="nothing comes to uart1: type with --terminal uart1=NAME"):
        board.finish()


def test_the_c_library_reads_what_is_typed(start):
    board = start(pathlib.Path(os.environ["MARKERVP_PROGRAM"]).with_name("typed.so"))
    board.run("1 ms")
    board.uart("42 is\r", device="uart1")
    board.run("2 ms")
    board.uart("two words\n", device="uart1")
    assert board.finish()["program_end.exit_code"] == 0
    assert board.console == ["42 is two words"]
    # 17 characters of 10 bits at 115 200 baud, the second line from 3 ms on.
    assert 3e-3 + 10 * 10 / 115200 < board.time < 3e-3 + 11 * 10 / 115200


def test_memory_and_signals_are_read_and_written(board):
    board.write("ocm+0x100", 0x12345678)
    assert board.read("ocm+0x100") == 0x12345678
    assert board.read_words("ocm+0x100", 2) == [0x12345678, 0]
    before = board.time
    board.run(5e-6)
    assert board.time == pytest.approx(before + 5e-6, abs=1e-15)
    assert board.signal("ps.gic.n_irq") == 1
    board.drive("ps.gic.n_irq", 0)
    assert board.signal("ps.gic.n_irq") == 0


def test_the_same_commands_make_the_same_run(start):
    def lead():
        session = start(options=["--no-report"])
        session.uart("x")
        time = session.wait_for_text("<x>", timeout="5 ms")
        session.uart("q")
        run = session.finish()
        return time, session.console, {key: value for key, value in run.result.items() if key != "provenance"}

    assert lead() == lead()


def test_a_run_that_is_only_watched_is_the_run(start, tmp_path):
    watched = start("blink", options=["--no-report"])
    for _ in range(7):
        watched.run("33.3 us")
        watched.read("axi_gpio_0.GPIO_DATA")
    result = watched.finish().result
    alone = markervp.run(output=tmp_path / "alone", options=["--program", "blink", "--no-report"]).result
    for one in (result, alone):
        del one["provenance"]
    assert json.dumps(result) == json.dumps(alone)


def test_what_comes_at_the_very_end_of_a_wait_ends_no_later_one(start):
    # The interrupt falls into the last picosecond of a wait that looks at a register, too.
    falls = start("blink").wait_for("ps.gic.n_irq falls", timeout="1 ms")
    again = start("blink")
    again.wait_for("axi_gpio_0.GPIO_DATA == 0xFFFF or ps.gic.n_irq falls", timeout=falls, every=falls)
    before = again.time
    again.run("7 us")
    assert falls == before
    assert again.time == pytest.approx(before + 7e-6, abs=1e-12)


@pytest.mark.parametrize("mistake, message", [
    (lambda board: board.read("nosuch.DATA"), "no device 'nosuch': choose ocm_low, ddr"),
    (lambda board: board.read("axi_gpio_0.DATA"), "axi_gpio_0 has GPIO_DATA, GPIO_TRI"),
    (lambda board: board.read("axi_gpio_0"), "no register 'axi_gpio_0'"),
    (lambda board: board.read(0x80020), "nothing answers at 0x00080020"),
    (lambda board: board.read("ddr+0x7fffffff"), "is not in ddr"),
    (lambda board: board.write("ocm", 1 << 32), "needs 'value', a whole number up to 4294967295"),
    (lambda board: board.signal("ps.gic.n_irk"), "did you mean 'ps.gic.n_irq'?"),
    (lambda board: board.drive("ps.gic.n_irq", 2), "a whole number up to 1"),
    (lambda board: board.interrupt(31), "interrupts with a wire from outside are 32 to 95"),
    (lambda board: board.interrupt(96), "a whole number up to 95"),
    (lambda board: board.uart("x", device="uart7"), "choose ps.uart0, ps.uart1"),
    (lambda board: board.run("5 kg"), "write it in ps, ns, us, ms or s"),
    (lambda board: board.run("-1 us"), "not between 0 and 1000 s"),
    (lambda board: board.wait_for("1 +", timeout="1 us"), "column 4: a value is missing"),
    (lambda board: board.wait_for("ps.gic.n_irq == 7", timeout="1 us"), "did not come within 1 us"),
    (lambda board: board.wait_for_text("nothing like that", timeout="1 us"), "did not come within 1 us"),
    (lambda board: board._ask("jump"), "no command 'jump': there are run, wait"),
    (lambda board: board._ask("run"), "needs 'for', a text"),
])
def test_a_mistake_is_told_and_the_run_goes_on(board, mistake, message):
    with pytest.raises(markervp.Error, match=re.escape(message)):
        mistake(board)
    board.run("1 us")
    assert not board.ended


def test_a_program_that_fails_is_told(start, tmp_path):
    board = start()
    board.uart("f")
    with pytest.raises(markervp.Error, match="program 'echo' ended with exit code 1"):
        board.finish()
    with pytest.raises(markervp.Error, match="no program 'nosuch'"):
        start("nosuch")


def test_a_test_that_never_ends_is_ended(start):
    board = start()
    board.wall_time = 1  # The start may take longer, on a busy computer.
    with pytest.raises(markervp.Error, match="no answer to 'run' within 1 s"):
        board.run("900 s")


def test_a_test_that_leaves_ends_the_run(tmp_path):
    ours, theirs = socket.socketpair()
    run = subprocess.Popen([os.environ["MARKERVP"], "run", "--program", os.environ["MARKERVP_PROGRAM"], "--control",
                            str(theirs.fileno()), "--output", str(tmp_path / "out")], pass_fds=[theirs.fileno()],
                           stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
    theirs.close()
    ours.sendall(b'not JSON\n{"do": "run", "for": "3 us"}\n')
    answers = ours.makefile()
    assert "a command is a line with a JSON object" in json.loads(answers.readline())["error"]
    assert json.loads(answers.readline())["time_ps"] == 3_000_000
    answers.close()
    ours.close()
    assert "the test left the run at 3 us without 'finish'" in run.communicate(timeout=60)[1]
    assert run.returncode == 2


@pytest.mark.parametrize("descriptor", ["0", "77"])
def test_what_is_no_socket_is_refused(descriptor, tmp_path):
    run = subprocess.run([os.environ["MARKERVP"], "run", "--control", descriptor, "--output", str(tmp_path / "out")],
                         stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    assert run.returncode == 2
    assert f"--control {descriptor}: no socket is open under this number" in run.stderr
    assert not (tmp_path / "out").exists() or not list(pathlib.Path(tmp_path / "out").iterdir())


PATIENCE = 60  # s, for a machine under load

LONG = """
import markervp
session = markervp.Session(inputs=["demo"], options=["--repeat", "1000000", "--no-report", "--fidelity", "clocked"])
print(session._process.pid, session.output, flush=True)
session.run("1000 s")
"""


def comes(condition):
    for _ in range(PATIENCE * 100):
        if condition():
            return True
        time.sleep(0.01)
    return False


def runs(process):
    """One that ended may wait for its parent to ask."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def test_a_test_that_is_killed_leaves_no_run_and_no_folder(tmp_path):
    test = subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True,
                            env={**os.environ, "TMPDIR": str(tmp_path), "PYTHONPATH": os.pathsep.join(sys.path)})
    with test:
        number, folder = test.stdout.readline().split()
        assert runs(number) and list(tmp_path.iterdir()) == [pathlib.Path(folder)]
        # In the middle of a command that would take for days.
        test.send_signal(signal.SIGKILL)
    try:
        assert comes(lambda: not runs(number))
        assert comes(lambda: not any(tmp_path.iterdir()))
    finally:
        if runs(number):
            os.kill(int(number), signal.SIGKILL)


def test_a_run_that_is_killed_leaves_no_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(markervp.tempfile, "tempdir", None)
    session = markervp.Session(os.environ["MARKERVP_PROGRAM"], options=["--no-report"])
    os.kill(session._process.pid, signal.SIGKILL)
    with pytest.raises(markervp.Error):
        session.run("1 ms")
    assert session.output.exists(), "what it left is there until the test closes it"
    session.close()
    session.close()
    assert not any(tmp_path.iterdir())


def test_a_test_that_leaves_in_a_long_command_ends_the_run(tmp_path):
    session = markervp.Session(inputs=["demo"], output=tmp_path,
                               options=["--repeat", "1000000", "--no-report", "--fidelity", "clocked"])
    session._socket.sendall(json.dumps({"do": "run", "for": "1000 s"}).encode() + b"\n")
    session._socket.close()
    try:
        assert session._process.wait(PATIENCE) == 2
        session._messages.seek(0)
        assert "the test left the run at" in session._messages.read()
    finally:
        session.close()
