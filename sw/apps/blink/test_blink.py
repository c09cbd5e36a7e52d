"""What blink promises, checked while it runs: markervp_add_program_test() in CMakeLists.txt runs this."""
import markervp
import pytest

LED = 0x100


def test_it_blinks_with_the_period_that_it_was_written_for(board):
    rises = [board.wait_for("axi_gpio_0.GPIO_DATA[8] rises", timeout="200 us", every="100 ns") for _ in range(4)]
    periods = [later - earlier for earlier, later in zip(rises, rises[1:])]
    assert all(100e-6 <= period < 103e-6 for period in periods)


def test_the_alarm_interrupts_it_once(board):
    assert board.wait_for("ps.gic.n_irq falls", timeout="1 ms") == pytest.approx(150e-6, rel=0.05)
    with pytest.raises(markervp.Error, match="before the program ended"):
        board.wait_for("ps.gic.n_irq falls", timeout="10 ms")
    assert "alarms 1, unhandled 0" in board.console[-1]


def test_it_leaves_the_light_off(board):
    run = board.finish()
    assert run["program_end.exit_code"] == 0
    assert [line for line in board.console if "too fast" in line] == [f"blink {n}: not too fast" for n in range(1, 5)]
