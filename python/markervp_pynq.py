"""PYNQ's modules for notebooks that run as they are: markervp.as_pynq()."""
import pathlib
import sys
import types

import markervp
import markervp_overlay


class GPIO:
    """A pin of the PS between it and the logic (EMIO): GPIO(GPIO.get_gpio_pin(3), "out").write(1)."""

    _mio_pins, _registers = 54, 0xE000A000

    def __init__(self, gpio_index, direction):
        if direction not in ("in", "out"):
            raise ValueError("Direction should be 'in' or 'out'.")
        if not self._mio_pins <= gpio_index < self._mio_pins + 64:
            raise ValueError(f"pin {gpio_index} does not lead to the logic, as 54 to 117 do: GPIO.get_gpio_pin(0) is the first")
        self.index, self.direction = gpio_index, direction
        bank, self._bit = divmod(gpio_index - self._mio_pins, 32)
        self._bank = 2 + bank
        self._mmio = markervp_overlay.MMIO(self._registers, 0x1000)
        for at in (0x204, 0x208) if direction == "out" else (0x204,):  # DIRM, OEN
            word = self._mmio.read(at + 0x40 * self._bank) & ~(1 << self._bit)
            self._mmio.write(at + 0x40 * self._bank, word | (direction == "out") << self._bit)

    @staticmethod
    def get_gpio_pin(gpio_user_index, target_label=None):
        return GPIO._mio_pins + gpio_user_index

    @property
    def path(self):
        return f"/sys/class/gpio/gpio{self.index}/"

    def read(self):
        if self.direction != "in":
            raise AttributeError("Cannot read GPIO output.")
        return self._mmio.read(0x60 + 4 * self._bank) >> self._bit & 1  # DATA_RO

    def write(self, value):
        if self.direction != "out":
            raise AttributeError("Cannot write GPIO input.")
        if value not in (0, 1):
            raise ValueError("Can only write integer 0 or 1.")
        half, bit = divmod(self._bit, 16)  # MASK_DATA: a mask of 0 lets a bit change
        self._mmio.write(8 * self._bank + 4 * half, (0xFFFF & ~(1 << bit)) << 16 | int(value) << bit)

    def release(self):
        """The pin stays as it is."""


class Xlnk:
    """Buffers as PYNQ had them before allocate()."""

    def cma_array(self, shape, dtype="u4", cacheable=0, pointer=None, cache=None):
        return markervp_overlay.allocate(shape, dtype)

    def xlnk_reset(self):
        """Buffers go with their overlay."""


def as_pynq(designs):
    """Lets `import pynq` find this module, so that notebooks run as they are. `designs`: the design of each bitstream, as
    {"design_1.bit": "mine/"}, or one for all. What PYNQ has beyond Overlay, MMIO, allocate, Xlnk, GPIO, DefaultIP, pynq.lib.dma.DMA and
    pynq.lib.AxiGPIO is an ImportError or AttributeError with its name."""

    class Bitstream(markervp_overlay.Overlay):
        def __init__(self, bitfile_name, dtbo=None, download=True, ignore_version=False, device=None, gen_cache=False):
            name = pathlib.Path(bitfile_name).name
            if isinstance(designs, dict) and name not in designs:
                raise markervp.Error(f"no design is named for '{name}': as_pynq() has {', '.join(designs)}", None)
            super().__init__(designs[name] if isinstance(designs, dict) else designs)

    Bitstream.__name__ = "Overlay"
    of = {name: getattr(markervp_overlay, name) for name in ("MMIO", "allocate", "DefaultIP", "Interrupt", "DMA", "AxiGPIO")}
    of.update(Overlay=Bitstream, GPIO=GPIO, Xlnk=Xlnk)
    modules = {"pynq": ("Overlay", "MMIO", "allocate", "Xlnk", "DefaultIP", "Interrupt", "GPIO"), "pynq.overlay": ("Overlay", "DefaultIP"),
               "pynq.mmio": ("MMIO",), "pynq.gpio": ("GPIO",), "pynq.interrupt": ("Interrupt",), "pynq.lib": ("DMA", "AxiGPIO"),
               "pynq.lib.dma": ("DMA",), "pynq.lib.axigpio": ("AxiGPIO",)}
    for name, members in modules.items():
        module = types.ModuleType(name, "markervp in the place of PYNQ")
        module.__path__ = []
        module.__dict__.update({member: of[member] for member in members})
        sys.modules[name] = module
        outer, _, inner = name.rpartition(".")
        if outer:
            setattr(sys.modules[outer], inner, module)
