#include <validation/words.h>

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace platform::validation
