#include <validation/markdown.h>

#include <fmt/format.h>

#include <validation/jitter.h>
#include <validation/reasons.h>
#include <validation/words.h>
#include <vp/text.h>

namespace platform::validation {

namespace {

using vp::format_fixed;

constexpr const char* head = R"(# Validation

Chapter 5 of the thesis on both systems, value by value, as `markervp validate --markdown` writes it; a test keeps this
page up to date.

```
markervp validate                              # rows, plots and verdict in out/validation
markervp validate --repetitions 20             # with the published jitter, each test 20 times
markervp validate --profile a9-O2              # nothing fitted to the thesis: tells how far off that is
markervp validate --markdown docs/validation.md
```

Exit code 0: every gate is met, or missed for a reason that stands below with its numbers; 1: a gate failed; 2: a wrong
option or profile. The folder has `validation.json`, `validation.csv` (the rows), `frames.csv` (each frame of each system:
counts, times, errors), the two systems' `result.json` and the plots.

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

std::string plots_section(const std::vector<Plot>& plots, const std::string& pictures) {
  std::string text = "\n## Plots\n";
  for (const Plot& plot : plots) {
    text += fmt::format("\n{} (thesis' figures: {}).\n\n![{}]({}/{}.svg)\n", plot.caption,
                        plot.figures, plot.caption, pictures, plot.name);
  }
  return text;
}

}  // namespace

std::string markdown_text(const Validation& v, const std::vector<Plot>& plots,
                          const std::string& pictures) {
  return fmt::format(head, format_fixed(ps_jitter_us, 0), format_fixed(pl_jitter_us, 0),
                     format_fixed(band_percent, 0)) +
         constants_text(v) + verdict_section(v) + "\n## Times\n\n" + rows_table(v, Kind::timing) +
         reasons_section(v) + accuracy_section(v) + "\n## Marker widths (table 5.3)\n\n" +
         rows_table(v, Kind::geometry) + "\n## Power and clocks\n\n" +
         rows_table(v, Kind::estimate) + plots_section(plots, pictures);
}

}  // namespace platform::validation
