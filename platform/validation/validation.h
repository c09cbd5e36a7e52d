#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <profiles/cost_profile.h>
#include <validation/evidence.h>
#include <validation/judgement.h>
#include <validation/measured.h>

namespace platform::validation {

/// Everything that the report says.
struct Validation {
  Measured measured;
  std::string profile;
  std::string profile_origin;
  std::vector<profiles::FittedConstant> fitted;
  std::uint32_t repetitions = 1;
  std::vector<Row> rows;
  std::vector<Gate> gates;
  std::optional<OrderStudy> orders;
  std::optional<TurnStudy> turns;

  bool passed() const { return all_passed(gates); }
};

/// Judges the two runs. `profile`: the one that they used. Throws vp::InputError if the runs do not
/// belong together.
Validation validate_runs(const Measured& measured, const profiles::CostProfile& profile,
                         const std::vector<Published>& published, std::uint32_t repetitions);

}  // namespace platform::validation
