#!/usr/bin/env python3
"""The coefficients pl.* and static.* of data/power that come from public power reports, and what they are worth for designs
that they never saw.

  refit.py REPORTS.csv            prints coefficients, bands and errors
  refit.py REPORTS.csv TABLE.json the same, and ends with 1 where the table has other coefficients
  refit.py --markdown REPORTS.csv the errors as a table
  refit.py --documented REPORTS.csv DOC.md  ends with 1 where that table is not in the document

Every family has one vote: its reports are of one design, or of variants of one. What is left out in turn is a whole family, and
the bands are those of the errors on what was left out: nine of ten reports lie inside.
"""

import csv
import json
import math
import statistics
import sys
from collections import Counter

PRINTED_W = 0.0005  # half of the last digit of a report
LEAST_LUT = 100  # below that a report's milliwatts have no digit left
LEAST_MHZ = 1.5  # below that a clock tree's have none
AMBIENT_C, THETA_JA = 25, 11.5
STATIC_BASE_W, STATIC_LEAKAGE_W, STATIC_SLOPE = 0.0634, 0.0399, 0.0342  # static.* of the XC7Z020
STATIC_BASE_BAND_W = 0.0048
STATIC_BANDS = {"static.bram": 0.015, "static.older_tool_7020": 0.004, "static.older_tool_7010": 0.004}  # assumed
BAND_SCALE = 1.2  # of the kinds, so that nine of ten totals lie inside as well
STATIC_OF_DEVICE = {"xc7z020": 1.0, "xc7z010": 0.874}  # data/devices
LAST_OLDER_TOOL = (2017, 2)  # its Vccaux is 21 mA on an XC7Z020; that of 2017.3 is 15
REWEIGHTINGS, LEAST_REST = 60, 1e-4  # of least absolute errors
LISTS_AND_TEXTS = ("set", "family", "repository", "commit", "top", "vivado", "device", "clocks_mhz", "mmcm_mhz",
                   "mmcm_fractional_mhz")
PLACES = 3  # significant digits of a coefficient


class Report:
    def __init__(self, row):
        self.set, self.family, self.device = row["set"], row["family"], row["device"]
        self.is_zynq = self.device in STATIC_OF_DEVICE
        self.older_tool = tuple(map(int, row["vivado"].split("."))) <= LAST_OLDER_TOOL
        self.clocks_mhz = [float(mhz) for mhz in row["clocks_mhz"].split()]
        self.mmcm_ghz = [float(mhz) / 1e3 for mhz in row["mmcm_mhz"].split()]
        self.mmcm_fractional_ghz = [float(mhz) / 1e3 for mhz in row["mmcm_fractional_mhz"].split()]
        for key, value in row.items():
            if key not in LISTS_AND_TEXTS:
                setattr(self, key, float(value) if value else None)


def read_reports(path):
    with open(path, encoding="utf-8") as file:
        return [Report(row) for row in csv.DictReader(line for line in file if not line.startswith("#"))]


def by_family(reports, value):
    """One number, or tuple, a family: the median of its reports."""
    groups = {}
    for report in reports:
        groups.setdefault(report.family, []).append(value(report))
    return [statistics.median(group) if not isinstance(group[0], tuple) else tuple(map(statistics.median, zip(*group)))
            for group in groups.values()]


# ---- kinds: whether a report says something of it, what it says, W, and what a fit says


class Logic:
    """Logic and signals: the more LUT a flip-flop has before it, the more a signal toggles on its way through them. Fitted to
    the reports that came first: the later ones, mostly of small interconnect, gain nothing and pull it away from kernels."""

    name, column = "logic and signals", "logic_w"

    @staticmethod
    def applies(r):
        return r.lut > LEAST_LUT and r.clock_mhz > LEAST_MHZ and r.logic_w is not None

    @staticmethod
    def fit(reports):
        points = by_family([r for r in reports if r.set not in ("later", "fabric")],
                           lambda r: (math.log(r.lut / r.ff),
                                      math.log(max(r.logic_w, PRINTED_W) / (r.lut * r.clock_mhz) * 1e6)))
        slopes = [(b[1] - a[1]) / (b[0] - a[0]) for i, a in enumerate(points) for b in points[:i] if abs(b[0] - a[0]) > 0.2]
        slope = statistics.median(slopes)  # Theil and Sen
        return {"pl.logic": math.exp(statistics.median(y - slope * x for x, y in points)), "pl.logic_depth": slope}

    @staticmethod
    def predict(r, c):
        return c["pl.logic"] * (r.lut / r.ff) ** c["pl.logic_depth"] * r.lut * r.clock_mhz * 1e-6 if r.ff else 0


class LinearKind:
    """A sum of physical quantities, each with a coefficient: least absolute relative errors, so that a report that is far off does
    not pull the others with it. One vote a family, no coefficient negative."""

    def __init__(self, name, column, coefficients, applies, quantities):
        self.name, self.column, self.coefficients = name, column, coefficients
        self.applies, self.quantities = applies, quantities

    def fit(self, reports):
        votes = Counter(r.family for r in reports)
        rows = []
        for r in reports:
            watts = max(getattr(r, self.column), PRINTED_W)
            rows.append(([quantity / watts for quantity in self.quantities(r)], 1 / votes[r.family]))
        return dict(zip(self.coefficients, least_absolute(rows)))

    def predict(self, r, c):
        return sum(c[name] * quantity for name, quantity in zip(self.coefficients, self.quantities(r)))


def least_absolute(rows):
    """x >= 0 of the least sum of weight |row x - 1|: least squares, weighted anew by what each left over."""
    used = list(range(len(rows[0][0])))
    while True:
        x = [0.0] * len(used)
        for _ in range(REWEIGHTINGS):
            weights = [weight / max(LEAST_REST, abs(sum(row[u] * v for u, v in zip(used, x)) - 1)) for row, weight in rows]
            matrix = [[sum(w * row[i] * row[j] for w, (row, _) in zip(weights, rows)) for j in used] for i in used]
            x = solved(matrix, [sum(w * row[i] for w, (row, _) in zip(weights, rows)) for i in used])
        if min(x) >= 0:
            return [x[used.index(i)] if i in used else 0.0 for i in range(len(rows[0][0]))]
        del used[x.index(min(x))]


def solved(matrix, right):
    """Gauss: of a positive definite matrix, no pivot is 0."""
    rows = [line + [value] for line, value in zip(matrix, right)]
    for i in range(len(rows)):
        rows[i] = pivot = [v / rows[i][i] for v in rows[i]]
        rows = [row if row is pivot else [v - row[i] * p for v, p in zip(row, pivot)] for row in rows]
    return [row[-1] for row in rows]


def has_clocks(r):
    return r.lut > LEAST_LUT and r.clock_mhz > LEAST_MHZ and r.clocks_mhz and r.clocks_w is not None


def clock_quantities(r):
    """Each net takes its own, loaded or not; its branches reach over the square root of its flip-flops; each of them is a load.
    1e-3: mW/MHz, and so on."""
    loads = r.ff * 1e-3 * r.clock_mhz * 1e-3
    return sum(r.clocks_mhz) * 1e-3, math.sqrt(r.ff * 1e-3) * r.clock_mhz * 1e-3, loads


def has_known_oscillators(r):
    return r.mmcms and r.mmcm_w is not None and len(r.mmcm_ghz + r.mmcm_fractional_ghz) == r.mmcms


def mmcm_quantities(r):
    """A manager takes its own, its oscillator by GHz, and more of a fractional counter. At 1 GHz and whole where nothing is known."""
    unknown = r.mmcms - len(r.mmcm_ghz + r.mmcm_fractional_ghz)
    fractional_ghz = sum(r.mmcm_fractional_ghz)
    return r.mmcms, sum(r.mmcm_ghz) + fractional_ghz + unknown, fractional_ghz


class PerPrimitive:
    """Block memories and multipliers work or rest; what a design does with them no report tells. So the mean of all."""

    def __init__(self, name, column, coefficient, count):
        self.name, self.column, self.coefficient, self.count = name, column, coefficient, count

    def applies(self, r):
        return getattr(r, self.count) > 0 and r.clock_mhz > LEAST_MHZ and getattr(r, self.column) is not None

    def fit(self, reports):
        return {self.coefficient: statistics.mean(by_family(
            reports, lambda r: getattr(r, self.column) / (getattr(r, self.count) * r.clock_mhz) * 1e6))}

    def predict(self, r, c):
        return c[self.coefficient] * getattr(r, self.count) * r.clock_mhz * 1e-6


class Plls(PerPrimitive):
    """PLL at 1 GHz, as most are. A memory controller's, on other devices, are slower."""

    def applies(self, r):
        return r.is_zynq and r.plls and r.pll_w is not None

    def fit(self, reports):
        return {self.coefficient: statistics.median(by_family(reports, lambda r: r.pll_w / r.plls))}

    def predict(self, r, c):
        return c[self.coefficient] * r.plls


KINDS = [Logic,
         LinearKind("clock trees", "clocks_w", ("pl.clock_root", "pl.clock_branch", "pl.clock"), has_clocks, clock_quantities),
         PerPrimitive("block memories", "bram_w", "pl.bram", "bram36"),
         PerPrimitive("multipliers", "dsp_w", "pl.dsp", "dsp"),
         LinearKind("MMCM", "mmcm_w", ("pl.mmcm", "pl.mmcm_oscillator", "pl.mmcm_fractional"), has_known_oscillators,
                    mmcm_quantities),
         Plls("PLL", "pll_w", "pl.pll", "plls")]


class Leakage:
    """What a report leaks beyond the curve of static.*: by block memory, W at 25 C, and in the tool's older years."""

    OLDER = {"xc7z020": "static.older_tool_7020", "xc7z010": "static.older_tool_7010"}

    @staticmethod
    def growth(junction_c):
        return math.exp(STATIC_SLOPE * (junction_c - 25))

    @classmethod
    def curve(cls, device, junction_c):
        return STATIC_OF_DEVICE[device] * (STATIC_BASE_W + STATIC_LEAKAGE_W * cls.growth(junction_c))

    @classmethod
    def fit(cls, reports):
        zynq = [r for r in reports if r.is_zynq]
        beyond = {r: r.static_w - cls.curve(r.device, r.junction_c) for r in zynq}
        up = down = 0
        for device in STATIC_OF_DEVICE:
            newer = [r for r in zynq if r.device == device and not r.older_tool]
            blocks = [r.bram36 * cls.growth(r.junction_c) for r in newer]
            x, y = statistics.mean(blocks), statistics.mean(beyond[r] for r in newer)
            up += sum((b - x) * (beyond[r] - y) for b, r in zip(blocks, newer))
            down += sum((b - x) ** 2 for b in blocks)
        fitted = {"static.bram": 1e3 * up / down}
        for device, name in cls.OLDER.items():
            older = [r for r in zynq if r.device == device and r.older_tool]
            fitted[name] = statistics.mean(
                by_family(older, lambda r: beyond[r] - 1e-3 * fitted["static.bram"] * r.bram36 * cls.growth(r.junction_c)))
        return fitted

    @classmethod
    def predict(cls, r, c, junction_c):
        older = c[cls.OLDER[r.device]] if r.older_tool else 0
        return cls.curve(r.device, junction_c) + 1e-3 * c["static.bram"] * r.bram36 * cls.growth(junction_c) + older


def fit_all(reports):
    coefficients = Leakage.fit(reports)
    for kind in KINDS:
        coefficients.update(kind.fit([r for r in reports if kind.applies(r)]))
    return coefficients


def total(r, coefficients):
    """What find_static_point() of vp/power_meter.h finds; PS and pins as reported."""
    dynamic = r.ps_w + r.io_w + (r.xadc_w or 0) + sum(kind.predict(r, coefficients) for kind in KINDS)
    junction = AMBIENT_C
    for _ in range(100):
        leak = Leakage.predict(r, coefficients, junction)
        junction = AMBIENT_C + THETA_JA * (dynamic + leak)
    return dynamic + leak


def left_out(reports):
    """Pairs of a report and coefficients fitted to the reports of all other families."""
    for family in sorted({r.family for r in reports}):
        coefficients = fit_all([r for r in reports if r.family != family])
        yield from ((r, coefficients) for r in reports if r.family == family)


def quantile(values, share):
    """Of a small sample: the value that `share` of them do not exceed."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, max(0, math.ceil(share * len(ordered)) - 1))]


def rounded(value):
    return float(f"{value:.{PLACES}g}")


class Errors:
    """Of one kind, on reports that were left out."""

    def __init__(self, name, pairs):
        self.name, self.count = name, len(pairs)
        said, is_so = [p for p, _ in pairs], [a for _, a in pairs]
        relative = [abs(p / max(a, PRINTED_W) - 1) for p, a in pairs]
        self.sum = sum(said) / sum(is_so) - 1
        self.typical, self.mean, self.most = statistics.median(relative), statistics.mean(relative), quantile(relative, 0.9)
        self.mw = 1e3 * statistics.mean(abs(p - a) for p, a in pairs)
        ratios = [max(a, PRINTED_W) / p for p, a in pairs if p > 0]
        self.low, self.high = min(1.0, quantile(ratios, 0.05)), max(1.0, quantile(ratios, 0.95))


class Validation:
    """Errors by kind and of totals, and whether totals lie within their bands: those of the kinds, in quadrature."""

    def __init__(self, reports):
        pairs = list(left_out(reports))
        self.kinds = [Errors(k.name, [(k.predict(r, c), getattr(r, k.column)) for r, c in pairs if k.applies(r)]) for k in KINDS]
        totals = [(r, c, total(r, c)) for r, c in pairs if r.is_zynq]
        self.totals = [Errors(name, [(t, r.total_w) for r, _, t in totals if chosen(r)]) for name, chosen in (
            ("total", lambda r: True), ("total, with PS", lambda r: r.ps_w > 0), ("total, PL alone", lambda r: r.ps_w == 0),
            ("total, later reports", lambda r: r.set == "later"))]
        widths, inside = [], 0
        for r, c, t in totals:
            low, high = self.band(r, c)
            inside += t - low <= r.total_w <= t + high
            widths.append((low + high) / 2 / t)
        self.inside, self.width = inside / len(totals), statistics.mean(widths)

    def band(self, r, c):
        """How far a total may be off, W below and above. Logic, memories and multipliers of a design are busy together, so their
        errors add up; the others are independent."""
        older_w = STATIC_BANDS[Leakage.OLDER[r.device]] if r.older_tool else 0
        static_w = math.hypot(STATIC_BASE_BAND_W, older_w)
        parts = [(kind.predict(r, c), *scaled(e)) for kind, e in zip(KINDS, self.kinds)]
        busy = [parts[i] for i in (0, 2, 3)]
        low = [p * (1 - low) for p, low, _ in (parts[1], *parts[4:])] + [sum(p * (1 - low) for p, low, _ in busy)]
        high = [p * (high - 1) for p, _, high in (parts[1], *parts[4:])] + [sum(p * (high - 1) for p, _, high in busy)]
        return math.hypot(static_w, *low), math.hypot(static_w, *high)


def scaled(errors):
    """Low and high of a coefficient, over its nominal value."""
    return max(0.0, 1 - BAND_SCALE * (1 - errors.low)), 1 + BAND_SCALE * (errors.high - 1)


def bands(coefficients, validation):
    """low, nominal, high of each coefficient that has a kind's errors."""
    of_kind = {"pl.logic": 0, "pl.bram": 2, "pl.dsp": 3, "pl.pll": 5,
               **dict.fromkeys(KINDS[1].coefficients, 1), **dict.fromkeys(KINDS[4].coefficients, 4)}
    result = {}
    for name, value in coefficients.items():
        low, high = scaled(validation.kinds[of_kind[name]]) if name in of_kind else (1, 1)
        spread = STATIC_BANDS.get(name, 0)
        result[name] = tuple(rounded(v) for v in (value * low - spread, value, value * high + spread))
    return result


def markdown(validation):
    lines = ["| Kind | Reports | all together | typical report | mean | nine of ten below | on average | nine of ten lie within |",
             "|---|---|---|---|---|---|---|---|"]
    for e in validation.kinds + validation.totals:
        lines.append(f"| {e.name} | {e.count} | {100 * e.sum:+.1f} % | {100 * e.typical:.1f} % | {100 * e.mean:.1f} % | "
                     f"{100 * e.most:.1f} % | {e.mw:.1f} mW | x{e.low:.2f} to x{e.high:.2f} |")
    lines += ["", f"{100 * validation.inside:.0f} % of the totals lie within their bands, which reach {100 * validation.width:.1f} % to "
              "each side on average."]
    return "\n".join(lines)


def main(arguments):
    option = arguments[0] if arguments[:1] and arguments[0].startswith("--") else ""
    files = arguments[1:] if option else arguments
    if (option, len(files)) not in (("", 1), ("", 2), ("--markdown", 1), ("--documented", 2)):
        sys.exit(__doc__)
    reports = read_reports(files[0])
    validation = Validation(reports)
    if option == "--markdown":
        print(markdown(validation))
        return 0
    if option == "--documented":
        with open(files[1], encoding="utf-8") as file:
            if markdown(validation) in file.read():
                return 0
        print(f"{files[1]} is old: put what 'refit.py --markdown' prints into it", file=sys.stderr)
        return 1
    fitted = bands(fit_all(reports), validation)
    for name, (low, nominal, high) in fitted.items():
        print(f"{name:<24} {low:>8g} {nominal:>8g} {high:>8g}")
    print(markdown(validation))
    if len(files) == 1:
        return 0
    with open(files[1], encoding="utf-8") as file:
        entries = {e["name"]: (e["low"], e["nominal"], e["high"]) for e in json.load(file)["entries"]}
    wrong = [name for name, band in fitted.items() if entries.get(name) != band]
    for name in wrong:
        print(f"{files[1]}: '{name}' is {entries.get(name)}, the reports give {fitted[name]}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
