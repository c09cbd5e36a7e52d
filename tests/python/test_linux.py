"""A Linux application that a test leads, as it leads any program."""
import os

import markervp
import pytest

APPLICATION = os.environ["MARKERVP_PROGRAM"]


@pytest.fixture
def gpio(tmp_path):
    with markervp.Session(output=tmp_path / "run", options=["--linux", APPLICATION]) as session:
        yield session


def test_it_blinks_while_the_test_looks(gpio):
    rises = [gpio.wait_for("axi_gpio_0.GPIO_DATA[8] rises", timeout="3 ms", every="1 us") for _ in range(4)]
    assert all(1.0e-3 < later - earlier < 1.05e-3 for earlier, later in zip(rises, rises[1:]))
    gpio.wait_for_text("4 blinks", timeout="2 ms")
    assert gpio.finish()["program_end.exit_code"] == 0


def test_it_may_be_left_in_the_middle(gpio):
    gpio.wait_for("axi_gpio_0.GPIO_DATA[8] rises", timeout="3 ms")
    assert not gpio.ended
