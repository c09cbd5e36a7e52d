#include <validation/console.h>

#include <fmt/format.h>

#include <algorithm>

#include <validation/reasons.h>
#include <validation/words.h>
#include <vp/text.h>

namespace platform::validation {

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

}  // namespace platform::validation
