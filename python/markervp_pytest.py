"""Fixtures of pytest for PS programs: `pytest -p markervp_pytest`, or markervp_add_program_test() in CMake."""
import os

import markervp
import pytest


def pytest_addoption(parser):
    parser.addoption("--markervp", action="append", default=[], metavar="ARGUMENT",
                     help="for 'markervp run', where a test names no options")


@pytest.fixture
def start(tmp_path, pytestconfig):
    """Starts runs that the test leads: start(program_file, inputs=…, set=…, options=…) is a markervp.Session. The program is
    $MARKERVP_PROGRAM if none is named, and the options are those of --markervp. What still runs when the test ends is ended."""
    sessions = []

    def start_one(program_file=None, **values):
        values.setdefault("options", pytestconfig.getoption("markervp"))
        values.setdefault("output", tmp_path / f"run{len(sessions)}")
        sessions.append(markervp.Session(program_file or os.environ.get("MARKERVP_PROGRAM"), **values))
        return sessions[-1]

    yield start_one
    for session in sessions:
        session.close()


@pytest.fixture
def board(start):
    """The program of this test, at its start."""
    return start()
