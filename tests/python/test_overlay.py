"""Notebooks of PYNQ on a design in YAML: registers, buffers, DMA, GPIO and interrupts, with PYNQ's names."""
import asyncio
import pathlib

import markervp
import markervp_overlay
import markervp_pynq
import pytest

numpy = pytest.importorskip("numpy")


@pytest.fixture(scope="module")
def overlay():
    with markervp.Overlay(pathlib.Path(__file__).with_name("overlay.yaml")) as made:
        yield made


def test_parts_are_found_by_name(overlay):
    assert overlay.ip_dict["axi_dma_0"]["phys_addr"] == 0x40400000
    assert set(overlay.ip_dict) == {"axi_dma_0", "leds"}
    with pytest.raises(AttributeError, match="Could not find IP or hierarchy buttons in overlay: there are axi_dma_0, leds"):
        overlay.buttons.read()


def test_dma_brings_back_what_it_sends_and_takes_time(overlay):
    sent, came = markervp.allocate(shape=(1000,), dtype=numpy.uint32), markervp.allocate((1000,), "u4")
    sent[:] = numpy.arange(1000) * 7
    dma, before = overlay.axi_dma_0, overlay.session.time
    dma.recvchannel.transfer(came)
    dma.sendchannel.transfer(sent)
    dma.sendchannel.wait()
    dma.recvchannel.wait()
    assert (came == sent).all() and came[999] == 6993
    assert dma.recvchannel.transferred == 4000
    assert 10e-6 < overlay.session.time - before < 30e-6, "1000 words at 100 MHz"


@pytest.mark.parametrize("look", [lambda came: came[63], lambda came: numpy.max(came), lambda came: (came + 0)[63], lambda came: list(came)[63],
                                  lambda came: came.tolist()[63]])
def test_a_transfer_has_ended_before_python_looks_at_its_buffer(overlay, look):
    sent, came = overlay.allocate((64,)), overlay.allocate((64,))
    sent[:] = range(64)
    overlay.axi_dma_0.recvchannel.transfer(came)
    overlay.axi_dma_0.sendchannel.transfer(sent)
    assert numpy.array_equal(sent[:2], [0, 1]), "of another buffer"
    assert look(came) == 63
    assert numpy.array_equal(sent, came)
    came += 1
    assert came[63] == 64 and type(came) is type(sent)


def test_a_transfer_that_does_not_end_costs_ten_milliseconds(overlay):
    with markervp.Overlay(pathlib.Path(__file__).with_name("overlay.yaml")) as other:
        came = other.allocate((64,))
        other.axi_dma_0.recvchannel.transfer(came)
        before = other.session.time
        assert came[0] == 0 and 10e-3 <= other.session.time - before < 40e-3
        before = other.session.time
        assert came[0] == 0 and other.session.time == before


def test_pins_between_ps_and_logic(overlay):
    pin = markervp_pynq.GPIO(markervp_pynq.GPIO.get_gpio_pin(33), "out")
    for value in (1, 0):
        pin.write(value)
        assert overlay.session._ask("access", at=0xE000A000 + 0x4C)["value"] >> 1 & 1 == value  # DATA of bank 3
    assert markervp_pynq.GPIO(markervp_pynq.GPIO.get_gpio_pin(2), "in").read() == 0
    with pytest.raises(AttributeError):
        pin.read()
    with pytest.raises(ValueError, match="pin 7 does not lead to the logic"):
        markervp_pynq.GPIO(7, "in")


def test_a_driver_is_made_from_its_description(overlay):
    leds = markervp_overlay.AxiGPIO(overlay.ip_dict["leds"])
    leds.setdirection("out")
    leds[0:4].write(9)
    assert overlay.leds.read(8) & 15 == 9


def test_a_part_of_a_buffer_is_transferred(overlay):
    sent, came = overlay.allocate((64,), "u1"), overlay.allocate((64,), "u1")
    sent[:] = range(64)
    overlay.axi_dma_0.recvchannel.transfer(came)
    overlay.axi_dma_0.sendchannel.transfer(sent, start=16, nbytes=8)
    overlay.axi_dma_0.recvchannel.wait()
    assert list(came[:9]) == [16, 17, 18, 19, 20, 21, 22, 23, 0]
    assert sent[16:].physical_address == sent.physical_address + 16
    with pytest.raises(ValueError, match="exceeds the buffer"):
        overlay.axi_dma_0.sendchannel.transfer(sent, start=60, nbytes=8)


def test_a_failed_transfer_is_an_error(overlay):
    with markervp.Overlay(pathlib.Path(__file__).with_name("overlay.yaml")) as other:
        sent, came = other.allocate((16,)), other.allocate((4,))
        other.axi_dma_0.recvchannel.transfer(came)
        other.axi_dma_0.sendchannel.transfer(sent)
        with pytest.raises(RuntimeError, match="DMA channel failed: status 0x.*0x10 internal"):
            other.axi_dma_0.recvchannel.wait()


def test_gpio_and_register_maps(overlay):
    leds = overlay.leds
    leds.setdirection("out")
    leds[0:4].write(0b1010)
    assert leds.channel2.read() == 0b1010
    leds[0].on()
    leds[3].toggle()
    assert leds.channel2.read() == 0b0011
    leds.register_map.GPIO_DATA = 0x81
    assert leds.register_map.GPIO2_DATA == 0x81 and leds.read(8) == 0x81
    with pytest.raises(AttributeError, match="leds has no register 'GPIO_DATE': there are .*GPIO_DATA, "):
        leds.register_map.GPIO_DATE


def test_fields_and_bits_of_registers(overlay):
    control = overlay.axi_dma_0.register_map.MM2S_DMACR
    before = int(control)
    control.IOC_IrqEn = 1
    assert control.IOC_IrqEn == 1 and int(control) == before | 1 << 12 and control[12] == 1
    control[12] = 0
    assert control == before and control[12:12] == 0 and control & 1 == before & 1
    assert f"{control:#x}" == f"{before:#x}" and "IOC_IrqEn=0" in repr(control)
    assert "MM2S_DMACR = Register(" in repr(overlay.axi_dma_0.register_map)
    with pytest.raises(AttributeError, match="no field 'IOC': there are .*IOC_IrqEn"):
        control.IOC
    with pytest.raises(AttributeError, match="no field 'IOC'"):
        control.IOC = 1
    with pytest.raises(ValueError, match="2 does not fit into 1 bits"):
        control.IOC_IrqEn = 2
    with pytest.raises(IndexError):
        control[32]


def test_names_of_the_hand_off_go_first(tmp_path):
    folder = pathlib.Path(__file__).parent
    (tmp_path / "design.yaml").write_text((folder / "overlay.yaml").read_text())
    (tmp_path / "registers.json").write_text('{"leds": {"a": {"offset": 8, "fields": {"LOW": [0, 4]}}}}')
    with markervp.Overlay(tmp_path) as other:
        other.leds.register_map.GPIO_DATA = 0x35
        assert other.leds.register_map.a == 0x35 and other.leds.register_map.a.LOW == 5
        assert other.leds.register_map.GPIO2_DATA == 0x35


def test_interrupts_and_clocks_by_name(overlay):
    assert overlay.interrupt_pins["axi_dma_0/s2mm_introut"]["raw_irq"] == 61
    assert overlay.clock_dict[0]["mhz"] == 100


def test_a_notebook_runs_as_it_is():
    markervp.as_pynq({"loop.bit": pathlib.Path(__file__).with_name("overlay.yaml")})
    names = {}
    exec("""
import numpy as np
import pynq.lib.dma
from pynq import MMIO, Overlay, Xlnk, allocate
overlay = Overlay("/home/xilinx/jupyter_notebooks/loop.bit")
sent, came = allocate(shape=(8,), dtype=np.uint32, cacheable=1), Xlnk().cma_array((8,), np.uint32)
np.copyto(sent, np.arange(8, dtype=np.uint32))
dma = overlay.axi_dma_0
assert isinstance(dma, pynq.lib.dma.DMA)
dma.recvchannel.transfer(came)
dma.sendchannel.transfer(sent)
dma.sendchannel.wait()
dma.recvchannel.wait()
MMIO(overlay.ip_dict["leds"]["phys_addr"], 16).write(0, 7)
""", names)
    assert list(names["came"]) == list(range(8)) and names["overlay"].leds.read(8) == 7
    names["overlay"].close()
    with pytest.raises(markervp.Error, match="no design is named for 'other.bit': as_pynq.. has loop.bit"):
        exec("Overlay('other.bit')", names)
    with pytest.raises(ImportError, match="BaseOverlay|pynq.overlays"):
        exec("from pynq.overlays.base import BaseOverlay", names)


def test_registers_at_an_address(overlay):
    mmio = markervp.MMIO(0x41200000, 0x10)
    mmio.write(0x0, 0x55)
    assert mmio.read(0x8) == 0x55
    with pytest.raises(MemoryError):
        mmio.read(0x2)
    with pytest.raises(IndexError):
        mmio.read(0x10)
    with pytest.raises(markervp.Error, match="a data abort on the processor"):
        markervp.MMIO(0x50000000).read()


def test_an_interrupt_is_awaited(overlay):
    sent, came = overlay.allocate((16,)), overlay.allocate((16,))
    dma = overlay.axi_dma_0
    dma.write(0x30, 0x1001)  # run, interrupt on completion
    dma.recvchannel.transfer(came)
    dma.sendchannel.transfer(sent)
    asyncio.run(dma.s2mm_introut.wait())
    assert dma.read(0x34) & 0x1000
    dma.write(0x34, 0x1000)
    overlay.session.run("1 us")
    assert overlay.session.signal("pl.axi_dma_0.s2mm_introut") == 0
    with pytest.raises(AttributeError, match="axi_dma_0 has no line 'mm2s'"):
        dma.mm2s
