"""What a test puts on the pins of the chip: an EEPROM, a button, a wire, a temperature."""
import markervp
import pytest


def test_program_meets_its_board(board):
    eeprom = board.attach("ps.i2c0", "eeprom", address=0x50)
    eeprom.write(0x10, b"\x01\x02\x03\x04")
    board.analogue(0, 51.0)
    board.pin(10, wire_to=14)
    assert board.pin(50)  # its pull-up
    board.pin(50, level=0)
    board.pin(51, level=0)
    board.wait_for_text("copied, temperature 0x", timeout="10 ms")
    assert "a4a0" in "".join(board.console).lower()
    assert eeprom.read(0x20, 5) == b"\x01\x02\x03\x04\xff"
    board.run("20 us")
    assert not board.pin(10)
    board.pin(50, level=1)
    board.wait_for_text("button, loop-back 1", timeout="1 ms")
    assert board.pin(10) and board.pin(14)
    board.pin(50, released=True)
    assert board.pin(50)
    assert board.finish()["program_end.exit_code"] == 0


def test_board_without_the_eeprom(start):
    board = start()
    board.wait_for_text("no EEPROM", timeout="10 ms")
    with pytest.raises(markervp.Error):
        board.finish()


def test_block_without_a_model_is_named(board):
    board.attach("ps.i2c0", "eeprom", address=0x50)
    board.pin(50, level=1)
    board.pin(51, level=1)
    with pytest.raises(markervp.Error, match=r"data abort: read of 0xE0008000 \(CAN 0: not modelled\), at"):
        board.finish()


def test_what_there_is_not(board):
    for call, says in [
        (lambda: board.attach("ps.i2c9", "eeprom", address=1), "no I2C controller 'ps.i2c9': choose ps.i2c0, ps.i2c1"),
        (lambda: board.attach("ps.i2c0", "clock", address=1), "choose eeprom or registers"),
        (lambda: board.attach("ps.i2c0", "eeprom", address=0x50, size=100), "a power of two"),
        (lambda: board.attach("ps.spi0", "flash", slave=7), ""),
        (lambda: board.pin(118), "up to 117"),
        (lambda: board.analogue(7, 1.0), "no input 7"),
    ]:
        with pytest.raises(markervp.Error, match=says):
            call()
    board.attach("ps.i2c0", "registers", address=0x18, index_bytes=2)
    with pytest.raises(markervp.Error, match="already"):
        board.attach("ps.i2c0", "eeprom", address=0x18)
    board.close()
