"""Registers of an IP by name, for markervp.Overlay: register_map.CTRL.AP_START."""


class Register:
    """A register of a register map: an integer that is read anew each time, its bits by number or slice, its fields by name."""

    def __init__(self, overlay, place, fields):
        object.__setattr__(self, "_place", (overlay, place, fields))

    def __int__(self):
        overlay, place, _ = self._place
        return overlay._load(place)

    __index__ = __int__

    def _write(self, value):
        overlay, place, _ = self._place
        overlay._store(place, value & 0xFFFFFFFF)

    def _bits(self, bits):
        if isinstance(bits, slice):  # as in hardware: [7:0]
            first, last = (0 if bits.stop is None else bits.stop), (31 if bits.start is None else bits.start)
            first, last = min(first, last), max(first, last)
        else:
            first = last = bits
        if not 0 <= first <= last < 32:
            raise IndexError(f"bits {last}:{first} are outside of 31:0")
        return first, last - first + 1

    def __getitem__(self, bits):
        first, count = self._bits(bits)
        return int(self) >> first & (1 << count) - 1

    def __setitem__(self, bits, value):
        first, count = self._bits(bits)
        mask = (1 << count) - 1
        if not 0 <= int(value) <= mask:
            raise ValueError(f"{value} does not fit into {count} bits")
        self._write(int(self) & ~(mask << first) | int(value) << first)

    def _field(self, name):
        fields = self._place[2]
        if name not in fields:
            raise AttributeError(f"no field '{name}': there are {', '.join(fields) or 'none'}")
        low, count = fields[name]
        return slice(low + count - 1, low)

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return self[self._field(name)]

    def __setattr__(self, name, value):
        self[self._field(name)] = value

    def __repr__(self):
        value = int(self)
        fields = ", ".join(f"{name}={value >> low & (1 << count) - 1}" for name, (low, count) in self._place[2].items())
        return f"Register({fields or f'value={value}'})"

    def __format__(self, form):
        return format(int(self), form)

    def __hash__(self):
        return id(self)

    def __bool__(self):
        return int(self) != 0

    def __invert__(self):
        return ~int(self)


def _as_integer(name):
    operator = getattr(int, name)
    return lambda self, other: operator(int(self), int(other) if isinstance(other, Register) else other)


for _name in ("eq", "ne", "lt", "le", "gt", "ge", "and", "rand", "or", "ror", "xor", "rxor", "add", "radd", "sub", "rsub", "mul", "rmul",
              "floordiv", "mod", "lshift", "rlshift", "rshift", "rrshift"):
    setattr(Register, f"__{_name}__", _as_integer(f"__{_name}__"))


class RegisterMap:
    """The registers of an IP by name: ip.register_map.GPIO_DATA reads, and an assignment writes. The names are those of the hand-off
    where `markervp import` wrote them (registers.json), else those of `markervp map`."""

    def __init__(self, overlay, name):
        described = overlay._registers.get(name, {})
        object.__setattr__(self, "_place", (overlay, name, described))

    def _register(self, register):
        overlay, name, described = self._place
        if register not in described:
            raise AttributeError(f"{name} has no register '{register}': there are {', '.join(described) or 'none'}")
        return Register(overlay, overlay.ip_dict[name]["phys_addr"] + described[register]["offset"], described[register]["fields"])

    def __getattr__(self, register):
        if register.startswith("_"):
            raise AttributeError(register)
        return self._register(register)

    def __setattr__(self, register, value):
        self._register(register)._write(int(value))

    def __dir__(self):
        return [*super().__dir__(), *self._place[2]]

    def __repr__(self):
        shown = ",\n".join(f"  {register} = {getattr(self, register)!r}" for register in self._place[2])
        return f"RegisterMap {{\n{shown}\n}}"
