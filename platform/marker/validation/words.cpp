#include <fmt/format.h>

#include <algorithm>

#include <marker/validation/measured.h>
#include <marker/validation/published.h>
#include <marker/validation/validation.h>
#include <vp/text.h>

namespace platform::validation {

namespace {

using vp::format_fixed;

constexpr int most_decimals = 5;

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit == "1" ? number : number + " " + unit;
}

}  // namespace

std::string published_text(const Published& published) {
  return with_unit(format_fixed(published.value, published.decimals), published.unit);
}

std::string modelled_text(const Row& row) {
  if (!row.modelled) return "-";
  const int decimals = std::min(std::max(row.published.decimals, 1) + 1, most_decimals);
  return with_unit(format_fixed(row.modelled->value, decimals), row.published.unit);
}

std::string difference_text(const Row& row) {
  if (!row.modelled || row.kind == Kind::given) return "-";
  const std::string text = format_fixed(row.difference_percent, 1);
  return (text[0] == '-' || text == "0.0" ? "" : "+") + text + " %";
}

std::string use_text(const Row& row) {
  if (row.kind == Kind::accuracy || row.kind == Kind::given || !row.modelled) return "";
  switch (row.use) {
    case Use::calibration:
      return "used for calibration";
    case Use::follows:
      return "follows from calibration";
    case Use::taken:
      return "taken from the thesis";
    default:
      return "predicted";
  }
}

std::string verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::met:
      return "met";
    case Verdict::met_rounded:
      return "met, as printed";
    case Verdict::known_miss:
      return "missed, known";
    case Verdict::explained:
      return "explained";
    case Verdict::absent:
      return "not modelled";
    case Verdict::given:
      return "input";
    default:
      return "MISSED";
  }
}

std::string kind_text(Kind kind) {
  switch (kind) {
    case Kind::timing:
      return "timing";
    case Kind::geometry:
      return "geometry";
    case Kind::accuracy:
      return "accuracy";
    case Kind::estimate:
      return "estimate";
    default:
      return "input";
  }
}

std::string order_text(const OrderStudy& study) {
  return fmt::format(
      "The order of the squares: with the times measured here, the same squares added in another "
      "order give a mean identification time of {} to {} ms and a mean speed-up of {} to {}. Of "
      "{} such orders {} meet the published time within {} %, {} the published speed-up, {} both; "
      "the thesis does not print its order, and ours was fixed before.",
      format_fixed(study.least_ms, 2), format_fixed(study.most_ms, 2),
      format_fixed(study.least_speedup, 2), format_fixed(study.most_speedup, 2), study.orders,
      study.identification, format_fixed(band_percent, 0), study.speedup, study.both);
}

std::string turn_text(const TurnStudy& study) {
  return fmt::format(
      "The turned pictures: the published speed-up asks for {} ms a frame on the PS, {} ms more "
      "than modelled. Turned edges cost {} ms of corner detection on average; for the rest, a "
      "pixel that passes the pre-test would have to cost {} times as much, and the corner "
      "detection would grow by {} (published 1.018) and deviate by {} ms (published 0.249 ms) in "
      "the increased-feature test. No cost of a pixel meets both.",
      format_fixed(study.asked_ms, 1), format_fixed(study.lacking_ms, 1),
      format_fixed(study.excess_ms, 2), format_fixed(study.factor, 1),
      format_fixed(study.growth, 3), format_fixed(study.deviation_ms, 2));
}

std::string verdict_line(const Validation& validation) {
  if (validation.passed()) {
    return "validation passed: every gate met, or missed for the known reasons above";
  }
  std::vector<std::string> failed;
  for (const Gate& gate : validation.gates) {
    if (!gate.passed) failed.push_back(gate.name);
  }
  return "validation FAILED: " + vp::join(failed, "; ");
}

namespace {

/// Notes below the table; equal ones once.
class Notes {
 public:
  /// The mark of a row: "[3]"; empty for no text.
  std::string mark(const std::string& text) {
    if (text.empty()) return "";
    auto place = std::find(notes_.begin(), notes_.end(), text);
    if (place == notes_.end()) place = notes_.insert(notes_.end(), text);
    return fmt::format("[{}]", place - notes_.begin() + 1);
  }
  std::string text() const {
    std::string lines;
    for (std::size_t i = 0; i < notes_.size(); ++i) {
      lines += fmt::format("[{}] {}\n", i + 1, notes_[i]);
    }
    return lines;
  }

 private:
  std::vector<std::string> notes_;
};

std::string head_text(const Validation& v) {
  std::string text =
      fmt::format("Chapter 5 on both systems: {} images, {}, profile {}\n",
                  v.measured.hybrid.frames.size(), v.measured.hybrid.fidelity, v.profile);
  text += v.repetitions == 1 ? "Times are exact: the platform has no jitter.\n"
                             : fmt::format(
                                   "Times are means of {} measurements with the published "
                                   "jitter.\n",
                                   v.repetitions);
  text += v.fitted.empty() ? "No constant is fitted to the thesis.\n" : "Fitted constants:\n";
  for (const profiles::FittedConstant& constant : v.fitted) {
    text += fmt::format("  {:<28} {:>8}  from {}\n", constant.name,
                        vp::format_fixed(constant.value, 3), vp::join(constant.published, ", "));
  }
  return text;
}

std::string table_text(const Validation& v, Notes& notes) {
  std::string text = fmt::format("\n{:<34} {:>12} {:>13} {:>8}  {:<24} {}\n", "row", "published",
                                 "modelled", "diff", "use", "verdict");
  for (const Row& row : v.rows) {
    const std::string mark = row.verdict == Verdict::absent ? "" : notes.mark(row.reason);
    text += fmt::format("{:<34} {:>12} {:>13} {:>8}  {:<24} {}{}\n", row.published.id,
                        published_text(row.published), modelled_text(row), difference_text(row),
                        use_text(row), verdict_text(row.verdict), mark.empty() ? "" : " " + mark);
  }
  return text;
}

}  // namespace

std::string console_text(const Validation& v) {
  Notes notes;
  std::string text = head_text(v) + table_text(v, notes);
  text += "\n" + notes.text();
  if (v.orders) text += "\n" + order_text(*v.orders) + "\n";
  if (v.turns) text += "\n" + turn_text(*v.turns) + "\n";
  text += "\nWhere the thesis contradicts itself or says too little:\n";
  for (const Contradiction& c : contradictions()) text += "  " + c.topic + ": " + c.text + "\n";
  text += "\n";
  for (const Gate& gate : v.gates) {
    text += fmt::format("{} {}: {}\n", gate.passed ? "ok    " : "FAILED", gate.name, gate.text);
  }
  return text + "\n" + verdict_line(v) + "\n";
}

namespace {

using vp::format_fixed;

constexpr const char* head = R"(# Validation

Chapter 5 of the thesis on both systems, value by value, as `markervp validate --markdown` writes it; a test keeps this
page up to date.

```
markervp validate                              # rows, verdict and report.html in out/validation
markervp validate --repetitions 20             # with the published jitter, each test 20 times
markervp validate --profile a9-O2              # nothing fitted to the thesis: tells how far off that is
markervp validate --markdown docs/validation.md
```

Exit code 0: every gate is met, or missed for a reason that is below with its numbers; 1: a gate failed; 2: a wrong
option or profile. The folder has `validation.json`, `validation.csv` (the rows), `frames.csv` (each frame of each system:
counts, times, errors), the two systems' `result.json`, and `report.html`, which draws every quantity over the images of each
test, as the thesis' figures 5.19 to 5.45 do:

![Times: differences to the thesis](images/validation.png)

## What the numbers are

* **Published**: printed in the thesis (`data/published.csv`, with section). *Used for calibration* are those that a constant
  of the profile was fitted to; *follows from calibration* are sums, differences and ratios of such values; *taken from the
  thesis* are figures that the platform has as data; all others are *predicted*.
* **Measured**: on the platform, in simulated time, with the program's own time stamps: one tick of the global timer is two
  cycles of the CPU.
* **Derived**: the cost of each unit of work, from the code compiled for a Cortex-A9 ([calibration.md](calibration.md)).
* **Assumed**: memory latencies (150 ns, 25 cycles), the code around the kernels, the order and places of the squares, the
  room, and that jitter spreads over the PS stages of a frame by their time ({} us for all of them, {} us for the PL).

Mean speed-ups are means of ratios: the ratio of the thesis' own mean times in the increased-feature test is 9.4, not 9.87.
*Met, as printed*: within {} % of a value that the thesis would print the same (it prints 7 % and 1 % without decimals).
)";

std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string constants_text(const Validation& v) {
  if (v.fitted.empty()) return "\nNo constant is fitted to the thesis.\n";
  std::string text = fmt::format(
      "\n## Profile `{}`\n\n{} fitted constants, of at most {}:\n\n"
      "| Constant | Value | Fitted to |\n|---|---|---|\n",
      v.profile, v.fitted.size(), profiles::max_fitted);
  for (const profiles::FittedConstant& constant : v.fitted) {
    text += fmt::format("| {} | {} | `{}` |\n", constant.name, format_fixed(constant.value, 3),
                        vp::join(constant.published, "`, `"));
  }
  return text;
}

std::string verdict_section(const Validation& v) {
  std::string text = "\n## Verdict\n\n| Gate | Result | |\n|---|---|---|\n";
  for (const Gate& gate : v.gates) {
    text += fmt::format("| {} | {} | {} |\n", gate.name, gate.passed ? "met" : "**FAILED**",
                        cell(gate.text));
  }
  return text;
}

std::string rows_table(const Validation& v, Kind kind) {
  std::string text =
      "| Value | Section | Published | Modelled | Difference | Use | Verdict |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Row& row : v.rows) {
    if (row.kind != kind) continue;
    std::string spread;
    if (row.published.spread) {
      spread = " ± " + format_fixed(*row.published.spread, row.published.decimals + 1);
    }
    text += fmt::format("| `{}`<br>{} | {} | {}{} | {} | {} | {} | {} |\n", row.published.id,
                        cell(row.how), row.published.section, published_text(row.published), spread,
                        modelled_text(row), difference_text(row), use_text(row),
                        verdict_text(row.verdict));
  }
  return text;
}

/// The rows with this verdict, one a line.
std::string missed_rows(const Validation& v, Verdict verdict) {
  std::string text;
  for (const Row& row : v.rows) {
    if (row.verdict != verdict) continue;
    text +=
        fmt::format("* `{}`: {} instead of {} ({}): {}.\n", row.published.id, modelled_text(row),
                    published_text(row.published), difference_text(row), row.reason);
  }
  return text;
}

std::string reasons_section(const Validation& v) {
  std::string text = "\n## What is not met, and why\n\n" + missed_rows(v, Verdict::missed) +
                     missed_rows(v, Verdict::known_miss);
  text += "\nWhat the frames say about it:\n\n";
  if (v.orders) text += "* " + order_text(*v.orders) + "\n";
  if (v.turns) text += "* " + turn_text(*v.turns) + "\n";
  text += "\n## Where the thesis contradicts itself or says too little\n\n| | |\n|---|---|\n";
  for (const Contradiction& c : contradictions()) {
    text += fmt::format("| {} | {} |\n", cell(c.topic), cell(c.text));
  }
  return text;
}

std::string accuracy_section(const Validation& v) {
  std::string text =
      "\n## Accuracy\n\nShown side by side and never tuned: the errors follow from our images, "
      "whose "
      "places within a pixel the thesis' images do not share.\n\n"
      "| Value | Section | Published | Modelled | Why it differs |\n|---|---|---|---|---|\n";
  for (const Row& row : v.rows) {
    if (row.kind != Kind::accuracy) continue;
    std::string published = published_text(row.published), modelled = modelled_text(row);
    if (row.published.spread) published += " ± " + format_fixed(*row.published.spread, 2);
    if (row.modelled && row.modelled->spread) {
      modelled += " ± " + format_fixed(*row.modelled->spread, 2);
    }
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", row.published.id, row.published.section,
                        published, modelled, cell(row.reason));
  }
  return text;
}

}  // namespace

std::string markdown_text(const Validation& v) {
  return fmt::format(head, format_fixed(ps_jitter_us, 0), format_fixed(pl_jitter_us, 0),
                     format_fixed(band_percent, 0)) +
         constants_text(v) + verdict_section(v) + "\n## Times\n\n" + rows_table(v, Kind::timing) +
         reasons_section(v) + accuracy_section(v) + "\n## Marker widths (table 5.3)\n\n" +
         rows_table(v, Kind::geometry) + "\n## Power and clocks\n\n" +
         rows_table(v, Kind::estimate);
}

}  // namespace platform::validation
