#include <cli/trace_window.h>

#include <optional>

#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform::cli {

namespace {

/// What the user wrote, and where.
struct Written {
  std::string text, option;
};

[[noreturn]] void refuse(const Written& written, const std::string& problem) {
  throw vp::InputError(written.option + " '" + written.text + "' " + problem +
                       ": write it like 6ms:7ms");
}

std::optional<std::uint64_t> parse_time(const std::string& part, const Written& written) {
  const std::string trimmed(vp::trim(part));
  if (trimmed.empty()) return std::nullopt;
  std::optional<vp::Decimal::Whole> ps;
  try {
    ps = vp::parse_quantity(trimmed, vp::Unit::time).whole();
  } catch (const vp::InputError& error) {
    refuse(written, error.what());
  }
  constexpr vp::Decimal::Whole largest = UINT64_MAX;
  if (!ps || *ps < 0 || *ps > largest) refuse(written, "is no time in whole picoseconds");
  return static_cast<std::uint64_t>(*ps);
}

}  // namespace

TimeWindow parse_trace_window(const std::string& text, const std::string& option) {
  const Written written{text, option};
  const std::vector<std::string> parts = vp::split(text, ':');
  if (parts.size() != 2) refuse(written, "is no span of time");
  TimeWindow window;
  window.from_ps = parse_time(parts[0], written).value_or(window.from_ps);
  window.to_ps = parse_time(parts[1], written).value_or(window.to_ps);
  if (window.to_ps <= window.from_ps) refuse(written, "ends before it begins");
  return window;
}

}  // namespace platform::cli
