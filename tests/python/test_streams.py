"""Words that a test gives to a stream of the design, and takes from one; levels of pins."""
import re

import markervp
import pytest


def echoed(board, words):
    board.send("pl.source", words)
    board.wait_for("pl.out.tlast falls", timeout="1 ms")
    board.run("10 ns")  # the sink takes its last beat on that very edge
    return board.received("pl.sink")


def test_a_line_of_the_start_is_waited_for(board):
    assert board.time == 0 and board.console == ["up"]
    assert board.wait_for_text("up", timeout="1 us") == 0
    board.run("1 us")
    with pytest.raises(markervp.Error, match="did not come within 1 us"):
        board.wait_for_text("up", timeout="1 us")  # it is over
    board.send("pl.source", [0])
    board.finish()


def test_what_goes_in_comes_back(board):
    beats = echoed(board, [1, 0xFFFF_FFFF, 7])
    assert [(beat.data, beat.last, beat.keep) for beat in beats] == [(2, False, 15), (0, False, 15), (8, True, 15)]
    assert [beat.cycle - beats[0].cycle for beat in beats] == [0, 1, 2]
    assert board.received("pl.sink") == []  # each is reported once
    assert [beat.data for beat in echoed(board, range(1, 257))] == list(range(2, 258))
    board.send("pl.source", [0])
    board.finish()


def test_a_packet_in_two_parts_is_one(board):
    board.send("pl.source", [5, 6], last=False)
    board.run("20 us")
    assert board.received("pl.sink") == []
    assert [(beat.data, beat.last) for beat in echoed(board, [9])] == [(6, False), (7, False), (10, True)]
    board.send("pl.source", [0])
    board.finish()


def test_a_picture_goes_at_once(board, monkeypatch):
    parts, ask = [], board._ask

    def watch(command, **values):
        parts.append(values)
        return ask(command, **values)

    monkeypatch.setattr(board, "_ask", watch)
    picture = [0xFFFF_FFFF - i for i in range(640 * 480)]  # longer than the longest command
    before = board.time
    board.send("pl.source", picture)
    assert board.time == before
    assert [word for part in parts for word in part["words"]] == picture
    assert [part["last"] for part in parts] == [0] * (len(parts) - 1) + [1]
    board.run("1 us")
    assert not board.ended


def test_the_same_words_come_back_on_the_same_edges(start):
    def lead():
        board = start()
        beats = echoed(board, [1, 2, 3])
        board.send("pl.source", [0])
        return beats, {key: value for key, value in board.finish().result.items() if key != "provenance"}

    assert lead() == lead()


def test_the_pins_of_a_gpio_are_driven(board):
    for level in 5, 2, 0xFFFF_FFFF:
        board.drive("pl.pins", level)
        board.run("1 us")
        assert board.read("axi_gpio_0.GPIO_DATA") == level


@pytest.mark.parametrize("mistake, message", [
    (lambda board: board.send("pl.sauce", [1]), "no stream source 'pl.sauce': choose pl.source"),
    (lambda board: board.send("pl.sink", [1]), "no stream source 'pl.sink': choose pl.source"),
    (lambda board: board.received("pl.source"), "no stream sink 'pl.source': choose pl.sink"),
    (lambda board: board.send("pl.source", []), "needs 'words', whole numbers up to 4294967295, one at least"),
    (lambda board: board.send("pl.source", [1, 1 << 32]), "needs 'words', whole numbers up to 4294967295"),
    (lambda board: board.send("pl.source", [1, -1]), "needs 'words', whole numbers up to 4294967295"),
])
def test_a_mistake_is_told_and_no_word_goes(board, mistake, message):
    with pytest.raises(markervp.Error, match=re.escape(message)):
        mistake(board)
    assert [beat.data for beat in echoed(board, [3])] == [4]


def test_a_design_without_such_ends_is_told(start):
    with pytest.raises(markervp.Error, match="no stream source 'pl.source': this design has none"):
        start("blink", options=["--no-report"]).send("pl.source", [1])
