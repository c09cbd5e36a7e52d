#pragma once

#include <string>
#include <vector>

#include <validation/plots.h>
#include <validation/validation.h>

/// Phrases that console, files and the page of the documentation share.

namespace platform::validation {

/// "12.16 x", "6144.63 us"; percent and numbers without unit have none of their own.
std::string published_text(const Published& published);
/// The modelled value with two decimals more than the published one has; "-" for none.
std::string modelled_text(const Row& row);
/// "-4.1 %"; "-" without a value.
std::string difference_text(const Row& row);
/// "used for calibration", "follows from calibration", "taken from the thesis" or "predicted";
/// empty where that says nothing.
std::string use_text(const Row& row);
/// "met", "met, as printed", "missed, known", "MISSED", "explained", "not modelled", "input".
std::string verdict_text(Verdict verdict);
std::string kind_text(Kind kind);

/// One or two sentences each.
std::string order_text(const OrderStudy& study);
std::string turn_text(const TurnStudy& study);

/// "validation passed: …" or "validation FAILED: …", with the gates that failed.
std::string verdict_line(const Validation& validation);

/// The whole report for a terminal: every row, the reasons, the gates and the verdict.
std::string console_text(const Validation& validation);

/// The page docs/validation.md. Its pictures are expected in `pictures`, relative to it.
std::string markdown_text(const Validation& validation, const std::vector<Plot>& plots,
                          const std::string& pictures);

}  // namespace platform::validation
