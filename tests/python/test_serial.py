"""The drivers of I2C, SPI and XADC of markervp::compat, with what they talk to."""
import markervp
import pytest


def test_drivers_meet_their_devices(board):
    eeprom = board.attach("ps.i2c0", "eeprom", address=0x50)
    board.attach("ps.spi1", "flash", slave=1)
    board.analogue(0, 51.0)
    board.wait_for_text("all there", timeout="1 s")
    assert eeprom.read(0, 256) == bytes(range(256))
    run = board.finish()
    assert run["program_end.exit_code"] == 0
    assert "warnings" not in run.result


@pytest.mark.parametrize("attached, step", [([], 14), (["ps.i2c0"], 34)])
def test_a_device_that_is_not_there_is_noticed(board, attached, step):
    for bus in attached:
        board.attach(bus, "eeprom", address=0x50)
    with pytest.raises(markervp.Error, match=f"exit code {step}"):
        board.finish()
