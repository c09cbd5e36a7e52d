#!/usr/bin/env python3
"""The coefficients pl.* of data/power from public power reports, and what they are worth for designs that they never saw.

  refit.py REPORTS.csv            prints coefficients, bands and errors
  refit.py REPORTS.csv TABLE.json the same, and ends with 1 where the table has other coefficients
  refit.py --markdown REPORTS.csv the errors as a table
  refit.py --documented REPORTS.csv DOC.md  ends with 1 where that table is not in the document

Every repository has one vote: its reports are of one design, or of variants of one. What is left out in turn is a whole
repository, and the bands are those of the errors on what was left out: nine of ten reports lie inside.
"""

import csv
import json
import math
import statistics
import sys

CLOCK_ROOT_W_PER_MHZ = 1e-5  # pl.clock_root: 1 mW for a clock of 100 MHz
MMCM_W = 0.106  # pl.mmcm
PRINTED_W = 0.0005  # half of the last digit of a report
LEAST_LUT = 100  # below that a report's milliwatts have no digit left
AMBIENT_C, THETA_JA = 25, 11.5
STATIC_BASE_W, STATIC_LEAKAGE_W, STATIC_SLOPE = 0.0634, 0.0399, 0.0342  # static.* of the XC7Z020
STATIC_OF_DEVICE = {"xc7z020": 1.0, "xc7z010": 0.874}  # data/devices
PLACES = 2  # significant digits of a coefficient


class Report:
    def __init__(self, row):
        self.owner = row["repository"].split("/")[0]
        self.device = row["device"]
        for key, value in row.items():
            if key not in ("set", "repository", "commit", "top", "vivado", "device"):
                setattr(self, key, float(value) if value else None)


def read_reports(path):
    with open(path, encoding="utf-8") as file:
        return [Report(row) for row in csv.DictReader(line for line in file if not line.startswith("#"))]


def by_owner(reports, value):
    """One number, or tuple, an owner: the median of its reports."""
    groups = {}
    for report in reports:
        groups.setdefault(report.owner, []).append(value(report))
    return [statistics.median(group) if not isinstance(group[0], tuple) else tuple(map(statistics.median, zip(*group)))
            for group in groups.values()]


# ---- kinds: whether a report says something of it, what it says, W, and what a fit says


class Logic:
    """Logic and signals: the more LUT a flip-flop has before it, the more a signal toggles on its way through them."""

    name, column = "logic and signals", "logic_w"

    @staticmethod
    def applies(r):
        return r.lut > LEAST_LUT and r.clock_mhz > 0 and r.logic_w is not None

    @staticmethod
    def fit(reports):
        points = by_owner(reports, lambda r: (math.log(r.lut / r.ff),
                                              math.log(max(r.logic_w, PRINTED_W) / (r.lut * r.clock_mhz) * 1e6)))
        slopes = [(b[1] - a[1]) / (b[0] - a[0]) for i, a in enumerate(points) for b in points[:i] if abs(b[0] - a[0]) > 0.2]
        slope = statistics.median(slopes)  # Theil and Sen
        return {"pl.logic": math.exp(statistics.median(y - slope * x for x, y in points)), "pl.logic_depth": slope}

    @staticmethod
    def predict(r, c):
        return c["pl.logic"] * (r.lut / r.ff) ** c["pl.logic_depth"] * r.lut * r.clock_mhz * 1e-6 if r.ff else 0


class Clocks:
    name, column = "clock trees", "clocks_w"

    @staticmethod
    def applies(r):
        return r.lut > LEAST_LUT and r.clock_mhz > 0 and r.clocks_w is not None

    @staticmethod
    def fit(reports):
        return {"pl.clock": statistics.median(by_owner(
            reports, lambda r: max(0, r.clocks_w - CLOCK_ROOT_W_PER_MHZ * r.clock_mhz) / (r.ff * r.clock_mhz) * 1e6))}

    @staticmethod
    def predict(r, c):
        return r.clock_mhz * (CLOCK_ROOT_W_PER_MHZ + c["pl.clock"] * r.ff * 1e-6)


class PerPrimitive:
    """Block memories and multipliers work or rest; what a design does with them no report tells. So the mean of all."""

    def __init__(self, name, column, coefficient, count):
        self.name, self.column, self.coefficient, self.count = name, column, coefficient, count

    def applies(self, r):
        return getattr(r, self.count) > 0 and r.clock_mhz > 0 and getattr(r, self.column) is not None

    def fit(self, reports):
        return {self.coefficient: statistics.mean(by_owner(
            reports, lambda r: getattr(r, self.column) / (getattr(r, self.count) * r.clock_mhz) * 1e6))}

    def predict(self, r, c):
        return c[self.coefficient] * getattr(r, self.count) * r.clock_mhz * 1e-6


KINDS = [Logic, Clocks, PerPrimitive("block memories", "bram_w", "pl.bram", "bram36"),
         PerPrimitive("multipliers", "dsp_w", "pl.dsp", "dsp")]


def fit_all(reports):
    coefficients = {}
    for kind in KINDS:
        coefficients.update(kind.fit([r for r in reports if kind.applies(r)]))
    return coefficients


def total(r, coefficients):
    """What find_static_point() of vp/power_meter.h finds; PS and pins as reported."""
    dynamic = r.ps_w + r.io_w + r.mmcms * MMCM_W + sum(kind.predict(r, coefficients) for kind in KINDS)
    junction = AMBIENT_C
    for _ in range(100):
        leak = STATIC_OF_DEVICE[r.device] * (STATIC_BASE_W + STATIC_LEAKAGE_W * math.exp(STATIC_SLOPE * (junction - 25)))
        junction = AMBIENT_C + THETA_JA * (dynamic + leak)
    return dynamic + leak


def left_out(reports):
    """Pairs of a report and coefficients fitted to the reports of all other owners."""
    for owner in sorted({r.owner for r in reports}):
        coefficients = fit_all([r for r in reports if r.owner != owner])
        yield from ((r, coefficients) for r in reports if r.owner == owner)


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
        self.sum = sum(said) / sum(is_so) - 1
        self.typical = statistics.median(abs(p / max(a, PRINTED_W) - 1) for p, a in pairs)
        self.mw = 1e3 * statistics.mean(abs(p - a) for p, a in pairs)
        ratios = [max(a, PRINTED_W) / p for p, a in pairs if p > 0]
        self.low, self.high = min(1.0, quantile(ratios, 0.05)), max(1.0, quantile(ratios, 0.95))


def cross_validate(reports):
    pairs = list(left_out(reports))
    errors = [Errors(k.name, [(k.predict(r, c), getattr(r, k.column)) for r, c in pairs if k.applies(r)]) for k in KINDS]
    errors.append(Errors("total", [(total(r, c), r.total_w) for r, c in pairs]))
    with_ps = [(total(r, c), r.total_w) for r, c in pairs if r.ps_w > 0]
    without = [(total(r, c), r.total_w) for r, c in pairs if r.ps_w == 0]
    return errors + [Errors("total, with PS", with_ps), Errors("total, PL alone", without)]


def bands(coefficients, errors):
    """low, nominal, high of each coefficient."""
    of_kind = {"pl.logic": 0, "pl.clock": 1, "pl.bram": 2, "pl.dsp": 3}
    result = {}
    for name, value in coefficients.items():
        e = errors[of_kind[name]] if name in of_kind else None
        result[name] = tuple(rounded(v) for v in ((value * e.low, value, value * e.high) if e else (value,) * 3))
    return result


def markdown(errors):
    lines = ["| Kind | Reports | all together | typical report | on average | nine of ten lie within |",
             "|---|---|---|---|---|---|"]
    for e in errors:
        lines.append(f"| {e.name} | {e.count} | {100 * e.sum:+.1f} % | {100 * e.typical:.1f} % | {e.mw:.1f} mW | "
                     f"x{e.low:.2f} to x{e.high:.2f} |")
    return "\n".join(lines)


def main(arguments):
    option = arguments[0] if arguments[:1] and arguments[0].startswith("--") else ""
    files = arguments[1:] if option else arguments
    if (option, len(files)) not in (("", 1), ("", 2), ("--markdown", 1), ("--documented", 2)):
        sys.exit(__doc__)
    reports = read_reports(files[0])
    errors = cross_validate(reports)
    if option == "--markdown":
        print(markdown(errors))
        return 0
    if option == "--documented":
        with open(files[1], encoding="utf-8") as file:
            if markdown(errors) in file.read():
                return 0
        print(f"{files[1]} is old: put what 'refit.py --markdown' prints into it", file=sys.stderr)
        return 1
    fitted = bands(fit_all(reports), errors)
    for name, (low, nominal, high) in fitted.items():
        print(f"{name:<16} {low:>8g} {nominal:>8g} {high:>8g}")
    for e in errors:
        print(f"{e.name:<18} {e.count:3} reports, together {100 * e.sum:+.1f} %, typical {100 * e.typical:.1f} %")
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
