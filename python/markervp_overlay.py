"""Notebooks for PYNQ on a design in YAML, in simulated time: markervp.Overlay.

    from markervp import Overlay, allocate
    overlay = Overlay("mine/design.yaml")      # or "mine/", the folder that `markervp import` wrote
    data = allocate(shape=(100,), dtype="u4")
    overlay.axi_dma_0.sendchannel.transfer(data)
    overlay.axi_dma_0.sendchannel.wait()

Names are PYNQ's. Each read and write of a register is an access of the processor with its time; `overlay.session` is the
markervp.Session behind it (time, signals, waiting). Needs numpy.
"""
import json
import pathlib
import weakref

import markervp
from markervp_registers import RegisterMap

_open = []  # overlays; MMIO and allocate() are for the one that was made last


def _current():
    if not _open:
        raise markervp.Error("make a markervp.Overlay first", None)
    return _open[-1]


class MMIO:
    """Registers from an address on, of the overlay that was made last."""

    def __init__(self, base_addr, length=4, overlay=None, **_):
        self.base_addr, self.length = base_addr, length
        self._overlay = overlay or _current()

    def _address(self, offset):
        if offset % 4:
            raise MemoryError("Unaligned read: offset must be multiple of 4.")
        if not 0 <= offset < self.length:
            raise IndexError(f"offset {offset:#x} is outside the {self.length:#x} bytes at {self.base_addr:#x}")
        return self.base_addr + offset

    def read(self, offset=0, length=4, word_order="little"):
        words = [self._overlay._load(self._address(offset + 4 * i)) for i in range((length + 3) // 4)]
        return int.from_bytes(b"".join(word.to_bytes(4, "little") for word in words)[:length], word_order)

    def write(self, offset, data):
        if isinstance(data, (bytes, bytearray)):
            for at in range(0, len(data), 4):
                self.write(offset + at, int.from_bytes(data[at:at + 4], "little"))
            return
        self._overlay._store(self._address(offset), int(data) & 0xFFFFFFFF)


class Interrupt:
    """A line by name, "axi_dma_0/s2mm_introut": `await interrupt.wait()`, or interrupt.wait_now() outside of coroutines."""

    def __init__(self, pinname, overlay=None):
        self._overlay = overlay or _current()
        self._signal = "pl." + pinname.replace("/", ".")

    async def wait(self):
        self.wait_now()

    def wait_now(self, timeout="10 s"):
        self._overlay.session.wait_for(f"{self._signal} == 1", timeout)
        self._overlay._invalidate()


class DefaultIP:
    """An IP of the overlay: its registers by offset and by name, and its interrupt. `description`: its entry of ip_dict."""

    def __init__(self, description, overlay=None):
        self._overlay, self._name = overlay or _current(), description["fullpath"]
        self.description = description
        self.mmio = MMIO(description["phys_addr"], description["addr_range"], self._overlay)
        self.register_map = RegisterMap(self._overlay, self._name)

    def read(self, offset=0):
        return self.mmio.read(offset)

    def write(self, offset, value):
        self.mmio.write(offset, value)

    def __getattr__(self, line):
        """A line of the IP, as ip.s2mm_introut or ip.interrupt."""
        if line.startswith("_"):
            raise AttributeError(line)
        lines = {"interrupt": ["interrupt", "ip2intc_irpt", "irq", "iic2intc_irpt", "cdma_introut"]}.get(line, [line])
        for one in lines:
            try:
                self._overlay.session.signal(f"pl.{self._name}.{one}")
            except markervp.Error:
                continue
            return Interrupt(f"{self._name}/{one}", self._overlay)
        raise AttributeError(f"{self._name} has no line '{line}'")


class _Channel:
    """A channel of an AXI DMA without scatter-gather; `at`: of its registers."""

    def __init__(self, ip, at, flush):
        self._ip, self._at, self._flush = ip, at, flush
        self._buffer = None
        self.start()

    def start(self):
        self._ip.write(self._at, 0x0001)
        while not self.running:
            pass

    def stop(self):
        self._ip.write(self._at, 0x0000)

    def _status(self):
        return self._ip.read(self._at + 0x04)

    @property
    def running(self):
        return self._status() & 0x01 == 0

    @property
    def idle(self):
        return self._status() & 0x02 == 0x02

    @property
    def error(self):
        return self._status() & 0x70 != 0

    @property
    def transferred(self):
        return self._ip.read(self._at + 0x28)

    def transfer(self, array, start=0, nbytes=0):
        if not self.running:
            raise RuntimeError("DMA channel not started")
        if self._buffer is not None and not self.idle:
            raise RuntimeError("DMA channel not idle")
        count = nbytes or array.nbytes - start
        if start < 0 or start + count > array.nbytes:
            raise ValueError("Transfer size exceeds the buffer")
        self._buffer = array
        if self._flush:
            array.flush()
        self._ip.write(self._at + 0x18, (array.physical_address + start) & 0xFFFFFFFF)
        self._ip.write(self._at + 0x28, count)
        if not self._flush:
            receiving = self._ip._overlay._receiving
            if self not in receiving:
                receiving.append(self)

    def _let_end(self, step=1e-6):
        """Waits for a transfer as long as Python needs on the board from one call to the next. Whether it has ended."""
        session = self._ip._overlay.session
        end = session.time + _python_s
        while not self.idle and not self.error and session.time < end:
            session.run(f"{step * 1e6:g} us")
            step *= 2
        self._buffer.invalidate()
        return self.idle or self.error

    def _fills(self, buffer):
        first, other = self._buffer.physical_address, buffer.physical_address
        return first < other + buffer.nbytes and other < first + self._buffer.nbytes

    def wait(self, timeout=10.0):
        """Until it is idle; `timeout` in simulated seconds."""
        if self._buffer is None:
            raise RuntimeError("No transfer was started")
        session = self._ip._overlay.session
        end = session.time + timeout
        while True:
            status = self._status()
            if status & 0x70:
                raise RuntimeError(f"DMA channel failed: status {status:#x} (0x10 internal, 0x20 slave, 0x40 decode error)")
            if status & 0x02:
                break
            if session.time > end:
                raise RuntimeError(f"DMA channel not idle after {timeout:g} s of simulated time")
            session.run("1 us")
        if not self._flush:
            self._buffer.invalidate()

    async def wait_async(self):
        self.wait()


class DMA(DefaultIP):
    """AXI DMA: sendchannel and recvchannel, as far as it has them."""

    def __init__(self, description, overlay=None):
        super().__init__(description, overlay)
        settings, name = self._overlay._settings, self._name
        has = {way: settings.get(f"pl.{name}.include_{way}", "true") == "true" for way in ("mm2s", "s2mm", "sg")}
        if has["sg"]:
            raise markervp.Error(f"{name} is built with scatter-gather, which this driver does not take: read() and write() reach "
                                 "its registers", None)
        if has["mm2s"]:
            self.sendchannel = _Channel(self, 0x00, True)
        if has["s2mm"]:
            self.recvchannel = _Channel(self, 0x30, False)


class _Pins:
    """Pins of a GPIO channel: all, or channel[0:4]."""

    def __init__(self, channel, first, count):
        self._channel, self._first, self._mask = channel, first, ((1 << count) - 1) << first

    def read(self):
        return (self._channel.read() & self._mask) >> self._first

    def write(self, value):
        self._channel.write(value << self._first, self._mask)

    def on(self):
        self.write(self._mask >> self._first)

    def off(self):
        self.write(0)

    def toggle(self):
        self.write(~(self._channel.val >> self._first))


class _GpioChannel:
    def __init__(self, ip, at):
        self._ip, self._at = ip, at
        self.val = 0  #: what was written

    def read(self):
        return self._ip.read(self._at)

    def write(self, val, mask=0xFFFFFFFF):
        self.val = (self.val & ~mask | val & mask) & 0xFFFFFFFF
        self._ip.write(self._at, self.val)

    def setdirection(self, direction):
        """ "in", "out", or a word: 1 is an input."""
        words = {"in": 0xFFFFFFFF, "out": 0}
        self._ip.write(self._at + 4, words.get(direction, direction))

    def __getitem__(self, pins):
        if isinstance(pins, slice):
            first, last = pins.start or 0, 32 if pins.stop is None else pins.stop
            return _Pins(self, first, last - first)
        return _Pins(self, pins, 1)


class AxiGPIO(DefaultIP):
    """AXI GPIO: channel1 and channel2; read() and write() are those of registers."""

    def __init__(self, description, overlay=None):
        super().__init__(description, overlay)
        self.channel1, self.channel2 = _GpioChannel(self, 0x00), _GpioChannel(self, 0x08)

    def __getitem__(self, pins):
        return self.channel1[pins]

    def setdirection(self, direction, channel=1):
        (self.channel1 if channel == 1 else self.channel2).setdirection(direction)


_python_s = 0.01  # of simulated time

_drivers = {"AXI DMA": DMA, "AXI GPIO": AxiGPIO}


class Overlay:
    """A design in YAML with Python in the place of the processor. `design`: its file, or the folder of an import. `set`, `options`:
    as of markervp.Session. Use it with `with`, or close() it."""

    def __init__(self, design, set=None, options=(), **session):
        path = pathlib.Path(design)
        path = path / "design.yaml" if path.is_dir() else path
        # It waits for what Python does: neither simulated time nor the host's is too long for it.
        values = {"ps.cpu.timeout": "1000000 s", **(set or {})}
        options = ["--design", str(path), "--no-report", *options]
        self.session = markervp.Session("notebook", set=values, options=options, **session)
        self._next = None
        self._buffers = []  # weak: a buffer that is gone needs nothing
        self._receiving = []  # channels whose transfers may not have ended
        self._is_new = False  # a register was written since Python looked at a buffer
        found = self.session._ask("devices")
        self._settings = found["settings"]
        described = path.with_name("registers.json")
        named = json.loads(described.read_text()) if described.exists() else {}
        self._registers = {one["name"]: {**one["registers"], **named.get(one["name"], {})} for one in found["devices"]}
        self.ip_dict = {one["name"]: {"phys_addr": one["base"], "addr_range": one["size"], "type": one["what"], "fullpath": one["name"]}
                        for one in found["devices"]}
        self.interrupt_pins = {source.removeprefix("pl.").replace(".", "/"): {"controller": "", "index": number, "raw_irq": number}
                               for source, number in found["interrupts"].items() if source.startswith("pl.")}
        self.clock_dict = {number: {"enable": 1, "name": f"fclk{number}_mhz", "mhz": found["clocks"][f"ps.fclk_clk{number}.clk"] / 1e6}
                           for number in range(4) if f"ps.fclk_clk{number}.clk" in found["clocks"]}
        self._made = {}
        _open.append(self)

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        self.close()

    def close(self):
        self.session.close()
        if self in _open:
            _open.remove(self)

    def is_loaded(self):
        return True

    def download(self):
        """It is there from the start."""

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self.ip_dict:
            raise AttributeError(f"Could not find IP or hierarchy {name} in overlay: there are {', '.join(sorted(self.ip_dict))}")
        if name not in self._made:
            description = self.ip_dict[name]
            driver = next((made for what, made in _drivers.items() if description["type"].startswith(what)), DefaultIP)
            self._made[name] = driver(description, self)
        return self._made[name]

    def __dir__(self):
        return [*super().__dir__(), *self.ip_dict]

    def _load(self, at):
        value = self.session._ask("access", at=at)["value"]
        self._invalidate()
        return value

    # A master may read a buffer from the very access on.
    def _store(self, at, value):
        for buffer in self._alive():
            buffer._flush_changes()
        self.session._ask("access", at=at, value=value)
        self._is_new = True

    def _catch_up(self, buffer):
        filling = [one for one in self._receiving if one._fills(buffer)] if self._is_new else []
        for channel in filling:
            if channel._let_end():
                self._receiving.remove(channel)
            else:
                self._is_new = False

    def _invalidate(self):
        for buffer in self._alive():
            buffer._flush_changes()
            buffer.invalidate()

    def _alive(self):
        self._buffers = [buffer for buffer in self._buffers if buffer() is not None]
        return [buffer() for buffer in self._buffers]

    def allocate(self, shape, dtype="u4"):
        import numpy
        if self._next is None:
            self._next = 0x10000000
        buffer = _buffer_class()(shape, dtype=numpy.dtype(dtype))
        buffer._overlay, buffer.physical_address = self, self._next
        end = self._next + max(buffer.nbytes, 1)
        self._next = end + -end % 4096
        buffer[...] = 0
        buffer.flush()
        self._buffers.append(weakref.ref(buffer))
        return buffer


_memory_part = 1 << 17  # bytes of a command


def _buffer_class():
    """An array in the DDR of the board: numpy's, and its address. What Python wrote goes to the DDR before each write of a register,
    and what the logic wrote comes with each read of one and at the end of transfers; flush() and invalidate() do it at once."""
    global _buffer_type
    if _buffer_type is None:
        import numpy

        class PynqBuffer(numpy.ndarray):
            _overlay, _known, physical_address = None, b"", 0

            @property
            def device_address(self):
                return self.physical_address

            def __array_finalize__(self, made_from):
                if made_from is not None and self.base is not None and isinstance(made_from, PynqBuffer):
                    offset = self.__array_interface__["data"][0] - made_from.__array_interface__["data"][0]
                    self._overlay, self.physical_address = made_from._overlay, made_from.physical_address + offset

            def flush(self):
                self._put(self.tobytes(), 0, self.nbytes)

            def _put(self, data, first, last):
                for at in range(first, last, _memory_part):
                    part = data[at:min(at + _memory_part, last)]
                    self._overlay.session._ask("memory", at=self.physical_address + at, hex=part.hex())
                self._known = data

            def invalidate(self):
                data = b"".join(bytes.fromhex(self._overlay.session._ask(
                    "memory", at=self.physical_address + at, bytes=min(_memory_part, self.nbytes - at))["hex"])
                    for at in range(0, self.nbytes, _memory_part))
                self._known = data
                numpy.copyto(self.view(numpy.ndarray), numpy.frombuffer(data, dtype=self.dtype).reshape(self.shape))

            def _flush_changes(self):
                data = self.tobytes()
                if data != self._known:
                    changed = numpy.flatnonzero(numpy.frombuffer(data, "u1") != numpy.frombuffer(self._known, "u1"))
                    self._put(data, int(changed[0]), int(changed[-1]) + 1)

            # Python on the board is slow: before it looks at a buffer, a transfer that was started has ended.
            def _look(self):
                if self._overlay is not None:
                    self._overlay._catch_up(self)

            def __getitem__(self, place):
                self._look()
                return super().__getitem__(place)

            def __iter__(self):
                self._look()
                return super().__iter__()

            @staticmethod
            def _look_at_all(arguments):
                for one in arguments:
                    if isinstance(one, PynqBuffer):
                        one._look()
                    elif isinstance(one, (list, tuple)):
                        PynqBuffer._look_at_all(one)

            def __array_function__(self, function, kinds, arguments, named):
                self._look_at_all(arguments)
                return super().__array_function__(function, kinds, arguments, named)

            def __array_ufunc__(self, function, method, *inputs, **named):
                self._look_at_all(inputs)
                plain = [one.view(numpy.ndarray) if isinstance(one, PynqBuffer) else one for one in inputs]
                into = named.get("out")
                if into is not None:
                    named["out"] = tuple(one.view(numpy.ndarray) if isinstance(one, PynqBuffer) else one for one in into)
                result = getattr(function, method)(*plain, **named)
                return into[0] if into is not None and len(into) == 1 else result

            def tolist(self):
                self._look()
                return super().tolist()

            sync_to_device, sync_from_device = flush, invalidate

            def freebuffer(self):
                self._overlay._buffers = [one for one in self._overlay._buffers if one() is not self]

            close = freebuffer

        _buffer_type = PynqBuffer
    return _buffer_type


_buffer_type = None


def allocate(shape, dtype="u4", target=None, **_):
    """A buffer of the overlay that was made last, or of `target`."""
    return (target or _current()).allocate(shape, dtype)
